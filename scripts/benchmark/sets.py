"""Registration of whole sets without initial poses, ourselves beside the others: compare_registration.py's runs."""

import argparse
import re

from benchmark.spent import OPEN3D_PYTHON, run, say
from compare_registration import METHODS, row_of

HEADER = ("scene", "program", "ok", "flagged", "WRONG", "scans", "processor time [s]", "times ours", "wall time [s]", "memory [MB]")
SCENES = {"town": ("--scans", "5"), "interior": ("--scans", "6"), "street": ("--scans", "8"), "plaza": ("--scans", "5")}


def simulated(exe, folder):
    """A scene of each kind, none of whose seeds fitted anything."""
    for kind, words in SCENES.items():
        if not (folder / kind / "truth.json").exists():
            run([exe, "simulate", "--scene", kind, *words, "--seed", "20261", "--out", folder / kind, "--force", "--quiet"])
    return [folder / kind for kind in SCENES]


def measure(folder, exe, pcl_multiway, scenes, cpu_limit_s):
    """Rows of HEADER. @param scenes  folders of scans with a truth.json, beside the simulated ones"""
    options = argparse.Namespace(out=folder / "runs", exe=exe, pcl=pcl_multiway, python=OPEN3D_PYTHON, seed=1, core=0,
                                 cpu_limit=cpu_limit_s)
    options.out.mkdir(exist_ok=True)
    rows = []
    for scene in [*simulated(exe, folder), *scenes]:
        ours_s = None
        for method in METHODS:
            _, _, ok, flagged, wrong, cpu_s, _, wall_s, memory_mb, note = row_of(scene, method, options)
            right, scans = map(int, re.fullmatch(r"(\d+)/(\d+)", ok).groups())
            ours_s = ours_s or float(cpu_s)
            rows.append((scene.name, method, right, flagged, wrong, scans, cpu_s, f"{float(cpu_s) / ours_s:.1f}", wall_s, memory_mb))
            say(" ".join(map(str, rows[-1])) + (f" ({note})" if note.startswith("no answer") else ""))
    return rows
