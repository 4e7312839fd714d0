#!/usr/bin/env python3
"""Shows what sets of many scans cost: time, memory and verdicts of simulated towns, from 60 to 1,000 scans.

  large_sets.py --out DIR [--exe TCM_ICP] [--scans 60 120 250 500 1000] [--threads N] [--docs] [-- REGISTER_OPTION...]

Makes a town of as many scans as the largest set has (town-grid, about 35,000 points a scan), registers its first scans without
initial poses, as many as each set has, and judges the results: DIR/large-sets.csv and DIR/results-large-sets.png. --docs copies
them to docs/results and docs/images. The town and results that are there are used again. All sizes take about an hour of
processor time, and 5 GB in DIR. Needs numpy and matplotlib. Without --exe, the tcm-icp on PATH is measured, else the one in
build/.
"""

import argparse
import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

try:
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError:
    sys.exit("large_sets.py: apt install python3-numpy python3-matplotlib, and run it with /usr/bin/python3")

from benchmark.spent import run
from first_scans import first_scans
from paper.executable import find_exe
from paper.print_size import PAGE_IN, save
from paper.provenance import REPOSITORY, add_tables, origin
from score_poses import score_poses

SIMULATED = ("--scene", "town-grid", "--seed", "5", "--step", "0.4", "--thinning", "0.2")
HEADER = ("scans", "right", "flagged", "WRONG", "largest error [mm]", "processor time [s]", "wall time [s]", "memory [MB]",
          "read [s]", "prepare [s]", "link [s]", "merge [s]", "adjust [s]", "write [s]")
STAGES = ("read and sample", "prepare", "link", "merge", "adjust and verify", "write")


def simulated(exe, num_scans, out):
    """The folder of a town of so many scans."""
    town = out / "town"
    if not (town / "truth.json").exists():
        subprocess.run([exe, "simulate", *SIMULATED, "--scans", str(num_scans), "--out", town, "--force", "--quiet"],
                       check=True)
    return town


def measured(exe, town, num_scans, threads, options, out):
    """A line of the table."""
    scene, result, times = out / f"scans-{num_scans}", out / f"result-{num_scans}", out / f"times-{num_scans}.json"
    try:
        first_scans(town, num_scans, scene)
    except ValueError as error:
        sys.exit(f"large_sets.py: {error}: name another --out")
    if not times.exists() or not (result / "poses.json").exists():
        try:  # scans that are left unregistered are no failure
            spent = run([exe, "register", *sorted(scene.glob("*.ply")), "--out", result, "--force", "--quiet",
                         "--threads", threads, *options], accept=(0, 3))
        except RuntimeError as error:
            sys.exit(f"large_sets.py: {error}")
        times.write_text(json.dumps({"cpu_s": spent.cpu_s, "wall_s": spent.wall_s}), encoding="utf-8")
    counts, details = score_poses(scene, result / "poses.json")
    stages = json.loads((result / "report.json").read_text(encoding="utf-8"))["stages"]
    spent_s = json.loads(times.read_text(encoding="utf-8"))
    largest_m = max(rmse for _, _, rmse in details.values() if rmse is not None)
    memory_mb = max(s["peak_memory_mb"] for s in stages)
    return (num_scans, counts["ok"], counts["flagged"], counts["wrong"], round(1000 * largest_m),
            round(spent_s["cpu_s"]), round(spent_s["wall_s"]), round(memory_mb),
            *(round(sum(s["seconds"] for s in stages if s["name"] == name)) for name in STAGES))


def draw(rows, path):
    """Time against the number of scans with the line of what grows with it, and memory."""
    table = {name: np.array([float(row[k]) for row in rows]) for k, name in enumerate(HEADER)}
    scans, cpu_s, memory_mb = table["scans"], table["processor time [s]"], table["memory [MB]"]
    fig, (left, right) = plt.subplots(1, 2, figsize=(PAGE_IN, 2.5))
    left.loglog(scans, cpu_s, "o-", color="#1f77b4", label="measured")
    if len(rows) > 1:
        exponent = np.polyfit(np.log(scans), np.log(cpu_s), 1)[0]
        left.loglog(scans, cpu_s[0] * scans / scans[0], "--", color="#888888", label="in proportion to the scans")
        left.set_title(f"processor time, with the {exponent:.2f}th power of the scans")
    left.set_ylabel("[s]")
    left.legend()
    right.plot(scans, memory_mb, "o-", color="#d62728")
    right.set_ylim(bottom=0)
    right.set_ylabel("[MB]")
    right.set_title("largest memory of the process")
    for ax in (left, right):
        ax.set_xticks(scans, [f"{int(n):,}" for n in scans])
        ax.minorticks_off()
        ax.set_xlabel("scans")
        ax.grid(alpha=0.3)
    save(fig, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder to make the sets and results in")
    parser.add_argument("--exe", type=Path, help="the tcm-icp to measure")
    parser.add_argument("--scans", type=int, nargs="+", default=[60, 120, 250, 500, 1000], help="sizes of the sets")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--docs", action="store_true", help="copy table and picture to docs/")
    parser.add_argument("options", nargs="*", help="of register, behind --")
    arguments = parser.parse_args()
    exe = find_exe("large_sets.py", arguments.exe)
    arguments.out.mkdir(parents=True, exist_ok=True)
    town = simulated(exe, max(arguments.scans), arguments.out)
    rows = []
    for num_scans in arguments.scans:
        rows.append(measured(exe, town, num_scans, arguments.threads, arguments.options, arguments.out))
        print(dict(zip(HEADER, rows[-1])), flush=True)
        with open(arguments.out / "large-sets.csv", "w", newline="", encoding="utf-8") as f:
            out = csv.writer(f)
            out.writerow(HEADER)
            out.writerows(sorted(rows))
    draw(sorted(rows), arguments.out / "results-large-sets.png")
    origins = {"large-sets": origin(exe)}
    add_tables(arguments.out, origins)
    if arguments.docs:
        add_tables(REPOSITORY / "docs" / "results", origins)
        shutil.copy(arguments.out / "large-sets.csv", REPOSITORY / "docs" / "results")
        shutil.copy(arguments.out / "results-large-sets.png", REPOSITORY / "docs" / "images")


if __name__ == "__main__":
    main()
