"""Every measurement behind the tables, one a row, and the one that a reviewer repeats beside it."""

import csv

KEYS = ("set", "kind", "percent", "seed", "method")
FIGURES = ("scans", "ok", "flagged", "wrong", "rms", "c2c_mean", "c2c_std", "cpu_s", "iterations")


def row_of(cell, result, program):
    """A cell as text. @param result  None where it was not run"""
    data_set, kind, percent, seed, method = cell
    result = result or {"why": "not run"}

    def text(key):
        value = result.get(key)
        if value is None:
            return ""
        if isinstance(value, dict):
            return str(sum(value.values()))
        return f"{value:.6g}" if isinstance(value, float) else str(value)

    return [data_set.key, kind, f"{percent:g}", str(seed), method, *map(text, FIGURES), program, result.get("why", "")]


def write_cells(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as f:
        csv.writer(f).writerows([[*KEYS, *FIGURES, "program", "why"], *rows])


def published(path, cell):
    """The row of a cell in a file of write_cells(), as a dictionary; None where there is none."""
    data_set, kind, percent, seed, method = cell
    wanted = [data_set.key, kind, f"{percent:g}", str(seed), method]
    if not path.exists():
        return None
    with open(path, newline="", encoding="utf-8") as f:
        return next((row for row in csv.DictReader(f) if [row[key] for key in KEYS] == wanted), None)


def compare(mine, theirs):
    """Lines: figure, measured now, published."""
    header = [*KEYS, *FIGURES, "program", "why"]
    lines = [f"{'figure':12} {'now':>14} {'published':>14}"]
    for name, value in zip(header, mine):
        if name in KEYS or (name == "why" and not value):
            continue
        lines.append(f"{name:12} {value:>14} {(theirs or {}).get(name, 'none'):>14}")
    return lines
