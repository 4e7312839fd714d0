#!/usr/bin/env python3
"""Markdown tables of what scripts/benchmarks.sh measured: benchmark_tables.py FOLDER, with the JSON of each benchmark.

Times are CPU times of one thread. Standard library only.
"""

import json
import re
import sys
from pathlib import Path

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
LIBRARIES = {"TcmIcpIndex": "TCM-ICP", "NanoflannIndex": "nanoflann", "PclIndex": "PCL"}


def read_runs(path):
    """The runs of one benchmark; where it was repeated, the medians of the repetitions."""
    runs = json.loads(path.read_text(encoding="utf-8"))["benchmarks"]
    medians = [run for run in runs if run.get("aggregate_name") == "median"]
    return medians or [run for run in runs if run["run_type"] == "iteration"]


def milliseconds(run):
    return run["cpu_time"] * MILLISECONDS[run["time_unit"]]


def print_table(title, columns, rows):
    print(f"\n## {title}\n")
    print("| " + " | ".join(columns) + " |")
    print("|" + "---|" * len(columns))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")


def neighbor_rows(runs):
    """One row an operation and size: our time, and the others' with their ratio to ours."""
    cells = {}
    for run in runs:
        operation, index, points = re.match(r"(\w+)<(\w+)>/(\d+)", run["run_name"]).groups()
        per_query = run.get("time_per_query")
        time, unit = (per_query * 1e9, "ns") if per_query else (milliseconds(run), "ms")
        cells.setdefault((operation, int(points)), {})[index] = (time, unit)
    for (operation, points), times in sorted(cells.items()):
        row = [operation.replace("_", " ").replace("0 3", "0.3"), f"{points:,}"]
        ours = times["TcmIcpIndex"][0]
        for index in LIBRARIES:
            if index not in times:
                row.append("-")
                continue
            time, unit = times[index]
            row.append(f"{time:,.0f} {unit}" + ("" if index == "TcmIcpIndex" else f" ({time / ours:.2f} x)"))
        yield row


def lp_rows(runs):
    for run in runs:
        program, rows = run["run_name"].removeprefix("fit_rows/").split("/")[:2]
        yield [program.replace("_", " "), f"{int(rows):,}", f"{milliseconds(run):.2f}", f"{run['pivots']:.0f}", run["label"]]


def registration_rows(runs):
    for run in runs:
        scene, method = run["run_name"].split("/")[:2]
        yield [
            scene, method.replace("_", " "), f"{run['points']:,.0f}", f"{milliseconds(run):.0f}",
            f"{run['rotation_deg']:.4f}", f"{run['worst_rotation_deg']:.4f}",
            f"{1000 * run['rmse_m']:.1f}", f"{1000 * run['worst_rmse_m']:.1f}",
        ]


TABLES = {
    "neighbor": ("Nearest neighbours (time a query, ratio to TCM-ICP)",
                 ["operation", "points", *LIBRARIES.values()], neighbor_rows),
    "lp": ("Linear program of one step", ["solver and data", "rows", "ms", "pivots", "status"], lp_rows),
    "registration": ("Registration of a pair",
                     ["pair", "method", "points", "ms", "rotation [deg]", "worst", "rmse [mm]", "worst"],
                     registration_rows),
}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for name, (title, columns, rows) in TABLES.items():
        print_table(title, columns, rows(read_runs(Path(sys.argv[1]) / f"{name}.json")))


if __name__ == "__main__":
    main()
