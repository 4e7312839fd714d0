"""Registration of whole sets without initial poses, ourselves beside the others: compare_registration.py's runs."""

import argparse

from benchmark.spent import OPEN3D_PYTHON, run, say
from compare_registration import METHODS, run_of

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
            r = run_of(scene, method, options)
            ours_s = ours_s or r["cpu_s"]
            rows.append((scene.name, method, r["ok"], r["flagged"], r["wrong"], r["scans"], f"{r['cpu_s']:.1f}", f"{r['cpu_s'] / ours_s:.1f}",
                         f"{r['wall_s']:.1f}", f"{r['peak_mb']:.0f}"))
            say(" ".join(map(str, rows[-1])) + (f" ({r['note']})" if r["unanswered"] else ""))
    return rows
