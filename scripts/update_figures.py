#!/usr/bin/env python3
"""Brings the tables of README.md and of the pages with figures (PAGES) up to docs/results/*.csv.

  update_figures.py

A table of figures has a line above it that names its file: <!-- figures: table-set1.csv -->, or, where its rows come from
several, <!-- figures: table-set*.csv RMS (50,000 points) [m] -->: that criterion, a row a data set. Columns that the file
does not have (the paper's figures) stay as they are. tests/docs/figures_test.py checks what this writes. Standard library only.
"""

import csv
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "docs" / "results"
PAGES = ("README.md", "docs/results.md", "docs/failure_modes.md", "docs/comparison.md", "docs/performance.md",
         "docs/cluster.md", "docs/decisions/0006-verification.md", "docs/decisions/0013-inference.md")
TABLE = re.compile(r"^(?P<mark><!-- figures: (?P<file>\S+)(?: (?P<criterion>[^\n]+))? -->\n)(?P<table>(?:\|[^\n]*\n)+)", re.M)


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as f:
        return list(csv.reader(f))


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def row(values):
    return "| " + " | ".join(values) + " |"


def in_markdown(cell):
    return cell.replace("|", "/")


def whole_table(header, rows, measured):
    known = {r[0]: dict(zip(header, r)) for r in rows}
    out = []
    for line in measured[1:]:
        values = {k: in_markdown(v) for k, v in zip(measured[0], line)}
        first = in_markdown(line[0])
        before = known.get(first, {})
        out.append([first] + [values.get(column, before.get(column, "-")) for column in header[1:]])
    return out


def one_criterion(header, rows, pattern, criterion):
    out = []
    for old, path in zip(rows, sorted(RESULTS.glob(pattern))):
        measured = read_csv(path)
        values = dict(zip(measured[0], next(r for r in measured if r[0] == criterion)))
        out.append([old[0]] + [in_markdown(values[column]).split(" [")[0] for column in header[1:]])
    return out


def updated(found):
    lines = found["table"].strip().splitlines()
    header, rows = cells(lines[0]), [cells(line) for line in lines[2:]]
    if found["criterion"]:
        rows = one_criterion(header, rows, found["file"], found["criterion"])
    else:
        rows = whole_table(header, rows, read_csv(RESULTS / found["file"]))
    return found["mark"] + "\n".join([*lines[:2], *map(row, rows)]) + "\n"


def main():
    for page in PAGES:
        path = ROOT / page
        before = path.read_text(encoding="utf-8")
        after = TABLE.sub(updated, before)
        path.write_text(after, encoding="utf-8")
        print(f"{page}: {'updated' if after != before else 'as it was'}")


if __name__ == "__main__":
    main()
