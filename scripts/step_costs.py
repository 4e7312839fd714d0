#!/usr/bin/env python3
"""Measures what each step of a registration in a work folder costs (docs/cluster.md), on one thread.

  step_costs.py --out DIR [--exe TCM_ICP] [--scans 21] [--points 50000000] [--docs]

Simulates a town, gives its first scan so many points (copies of its own, moved by a scanner's noise), and does the steps
one by one: `sample` of that scan, twice, and of the others, `plan`, `match`, `solve`, and `write` of that scan; then `register`
of the other scans without a work folder, with an empty one, and with one that has all steps. DIR/step-costs.csv has a row for
each, and what the log of the steps' work folder says of what was searched; --docs copies it to docs/results. About five minutes,
3 GB in DIR. Needs numpy.
"""

import argparse
import csv
import shutil
import sys
import time
from collections import defaultdict
from pathlib import Path

try:
    import numpy as np
except ImportError:
    sys.exit("step_costs.py: apt install python3-numpy, and run it with /usr/bin/python3")

from benchmark.spent import run
from benchmark.volume import write_dense
from paper.executable import find_exe
from paper.provenance import REPOSITORY, add_tables, origin
from ply import read_points

SIMULATED = ("--scene", "town", "--seed", "7", "--thinning", "0.2")
HEADER = ("what", "number", "processor time [s]", "memory [MB]", "bytes written")


def simulated(exe, num_scans, num_points, out):
    """Scans of a town, the first of them dense."""
    town, dense = out / "town", out / "dense.ply"
    if not dense.exists():
        run([exe, "simulate", *SIMULATED, "--scans", num_scans, "--out", town, "--force", "--quiet"])
        first = sorted(town.glob("*.ply"))[0]
        write_dense(out / "unfinished.ply", read_points(first), num_points, np.random.default_rng(1))
        (out / "unfinished.ply").rename(dense)
        time.sleep(4)  # the check sum of a file that was written just now is not kept (steps/input_digest.cpp)
    return [dense, *sorted(town.glob("*.ply"))[1:]]


def bytes_in(folder):
    return sum(f.stat().st_size for f in folder.rglob("*") if f.is_file()) if folder.exists() else 0


def searched(work):
    """Rows of what the log says of its kinds: number, seconds, bytes."""
    sums = defaultdict(lambda: [0, 0.0, 0])
    for log in (work / "log").glob("*.tsv"):
        for line in log.read_text(encoding="utf-8").splitlines():
            _, kind, _, seconds, size = line.split("\t")
            of_kind = sums[kind]
            of_kind[0], of_kind[1], of_kind[2] = of_kind[0] + 1, of_kind[1] + float(seconds), of_kind[2] + int(size)
    return [(f"of these: {kind}", n, f"{seconds:.2f}", "", size) for kind, (n, seconds, size) in sorted(sums.items())]


def measure(exe, scans, out):
    work, site, kept = out / "work", out / "site", out / "kept"
    for old in (work, site, kept):
        shutil.rmtree(old, ignore_errors=True)
    rows = []

    def measured(what, number, words, folders):
        before = sum(map(bytes_in, folders))
        spent = run([exe, *words, "--threads", 1, "--quiet"], accept=(0, 3))
        rows.append((what, number, f"{spent.cpu_s:.2f}", round(spent.memory_mb), sum(map(bytes_in, folders)) - before))
        print(dict(zip(HEADER, rows[-1])), flush=True)

    def step(what, number, *words):
        measured(what, number, (*words, "--work", work), (work, site))

    def whole(what, *words):
        measured(f"register, {what}", len(scans) - 1, ("register", *scans[1:], "--out", out / "result", "--force", *words), (kept,))

    step("sample, dense scan", 1, "sample", scans[0])
    step("sample, where it was there", 1, "sample", scans[0])
    step("sample, other scans", len(scans) - 1, "sample", *scans[1:])
    step("plan", len(scans), "plan", *scans)
    step("match", 1, "match", "--block", "1/1")
    step("solve", len(scans), "solve", *scans, "--out", site)
    step("write, dense scan", 1, "write", scans[0], "--out", site)
    rows += searched(work)
    whole("no work folder")
    whole("an empty work folder", "--work", kept)
    whole("all steps there", "--work", kept)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--exe", type=Path, help="the tcm-icp to measure")
    parser.add_argument("--scans", type=int, default=21)
    parser.add_argument("--points", type=int, default=50_000_000, help="of the dense scan")
    parser.add_argument("--docs", action="store_true", help="copy the table to docs/results")
    arguments = parser.parse_args()
    exe = find_exe("step_costs.py", arguments.exe)
    arguments.out.mkdir(parents=True, exist_ok=True)
    rows = measure(exe, simulated(exe, arguments.scans, arguments.points, arguments.out), arguments.out)
    origins = {"step-costs": origin(exe)}
    for folder in (arguments.out, *([REPOSITORY / "docs" / "results"] if arguments.docs else [])):
        with open(folder / "step-costs.csv", "w", newline="", encoding="utf-8") as f:
            csv.writer(f).writerows([HEADER, *rows])
        add_tables(folder, origins)
    for row in rows:
        print(*row, sep="\t")


if __name__ == "__main__":
    main()
