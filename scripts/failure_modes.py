#!/usr/bin/env python3
"""Shows how registration fails, one simulated set a kind: thin overlap, equal rooms, flat ground, leaves, bent sweeps.

  failure_modes.py --out DIR [--exe TCM_ICP] [--docs]

Makes each set, registers it without initial poses, judges the result and draws it beside the truth: DIR/failure-KIND.png and
DIR/failures.csv. --docs copies them to docs/images and docs/results. About two minutes of processor time; sets that are there
are used again. Needs numpy and matplotlib. Without --exe, the tcm-icp on PATH is measured, else the one in build/.
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
    sys.exit("failure_modes.py: apt install python3-numpy python3-matplotlib, and run it with /usr/bin/python3")

from paper.executable import find_exe
from paper.pictures import frame, moved, thinned
from paper.print_size import PAGE_IN, save
from paper.provenance import REPOSITORY, add_tables, origin
from ply import read_points

# Kind: what to simulate.
KINDS = {
    "thin-overlap": ("--scene", "street", "--scans", "6", "--overlap", "0.15"),
    "equal-rooms": ("--scene", "bays", "--scans", "8", "--clutter", "0"),
    "flat-ground": ("--scene", "plaza", "--scans", "6", "--max-range", "12"),
    "leaves": ("--scene", "canopy", "--scans", "6", "--max-range", "20", "--overlap", "0.25"),
    "bent-sweeps": ("--scene", "urban", "--scans", "6", "--sensor", "spinning", "--speed", "10"),
}
COMMON = ("--seed", "1", "--thinning", "0.2")
UNPLACED = "#b0b0b0"


def measured(exe, kind, out):
    """(simulated set, folder of the result, what evaluate says)"""
    scene, result, scores = out / kind, out / f"{kind}-result", out / f"{kind}.json"
    if not (scene / "truth.json").exists():
        subprocess.run([exe, "simulate", *KINDS[kind], *COMMON, "--out", scene, "--force", "--quiet"], check=True)
    if not (result / "poses.json").exists():
        run = subprocess.run([exe, "register", *sorted(scene.glob("*.ply")), "--out", result, "--force", "--quiet"],
                             stdout=subprocess.DEVNULL, check=False)
        if run.returncode not in (0, 3):
            sys.exit(f"failure_modes.py: register failed on {scene}")
    subprocess.run([exe, "evaluate", "--scans", scene, "--poses", result / "poses.json", "--truth", scene / "truth.json",
                    "--json", scores, "--quiet"], stdout=subprocess.DEVNULL, check=False)
    return scene, result, json.loads(scores.read_text(encoding="utf-8"))


def poses_of(result):
    return json.loads((result / "poses.json").read_text(encoding="utf-8"))


def draw(kind, scene, result, path):
    truth = {s["file"]: np.array(s["pose"]) for s in json.loads((scene / "truth.json").read_text())["scans"]}
    poses = poses_of(result)
    colours = plt.get_cmap("tab10").colors
    fig, axes = plt.subplots(1, 2, figsize=(PAGE_IN, 2.9))
    reference = truth[poses["reference"]]
    everything = []
    for k, s in enumerate(poses["scans"]):
        points = thinned(read_points(scene / s["file"]), 15_000)
        true = moved(points, truth[s["file"]])[:, :2]
        everything.append(true)
        axes[0].plot(*true.T, ",", color=colours[k % 10])
        # What has no pose stands in grey where it should be.
        placed = moved(points, reference @ np.array(s["pose"]))[:, :2] if s["pose"] else true
        axes[1].plot(*placed.T, ",", color=colours[k % 10] if s["pose"] else UNPLACED, zorder=2 if s["pose"] else 1)
    for ax, title in zip(axes, ("truth", "registered; grey: flagged, where it should be")):
        frame(ax, np.concatenate(everything))
        ax.set_title(f"{kind.replace('-', ' ')}: {title}")
    save(fig, path)


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("--out", type=Path, required=True)
    ap.add_argument("--exe", type=Path, help="the program to measure, in place of the one on PATH or in build/")
    ap.add_argument("--docs", action="store_true", help="copy pictures and table to docs/")
    options = ap.parse_args()
    exe = find_exe("failure_modes.py", options.exe)
    options.out.mkdir(parents=True, exist_ok=True)
    rows = []
    for kind in KINDS:
        scene, result, scores = measured(exe, kind, options.out)
        draw(kind, scene, result, options.out / f"failure-{kind}.png")
        placed = [s["rmse"] for s in scores["scans"] if s["file"] != poses_of(result)["reference"] and s.get("rmse")]
        rows.append([kind.replace("-", " "), len(scores["scans"]), scores["ok"], scores["flagged"], scores["wrong"],
                     f"{max(placed):.3g}" if placed else "none is placed", "tcm-icp simulate " + " ".join(KINDS[kind] + COMMON)])
    header = ["Kind", "Scans", "Right", "Flagged", "Wrong", "Largest RMS of a placed scan [m]", "Set"]
    with open(options.out / "failures.csv", "w", newline="", encoding="utf-8") as f:
        csv.writer(f).writerows([header, *rows])
    origins = {"failures": origin(exe)}
    add_tables(options.out, origins)
    if options.docs:
        add_tables(REPOSITORY / "docs" / "results", origins)
        shutil.copy(options.out / "failures.csv", REPOSITORY / "docs" / "results")
        for kind in KINDS:
            shutil.copy(options.out / f"failure-{kind}.png", REPOSITORY / "docs" / "images")
    for row in [header, *rows]:
        print(" | ".join(map(str, row)))


if __name__ == "__main__":
    main()
