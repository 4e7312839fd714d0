"""How our time and memory grow with points, scans and threads."""

import os

from benchmark.spent import run, say
from first_scans import first_scans
from ply import read_header
from score_poses import score_poses

HEADER = ("with", "value", "scans", "points a scan", "right", "processor time [s]", "wall time [s]", "memory [MB]")
POINT_STEPS_DEG = (0.8, 0.4, 0.2, 0.1, 0.05)  # four times the points each
NUM_SCANS = (8, 15, 30, 60)


def simulated(exe, folder, name, words):
    scene = folder / name
    if not (scene / "truth.json").exists():
        run([exe, "simulate", *map(str, words), "--seed", "20262", "--out", scene, "--force", "--quiet"])
    return scene


def points_of(scan):
    with open(scan, "rb") as f:
        return read_header(f)[1]


def first_of(scene, count):
    return first_scans(scene, count, scene.parent / f"{scene.name}-{count}")


def row_of(exe, scene, what, value, threads):
    scans = sorted(scene.glob("*.ply"))
    result = scene.parent / f"result-{what}-{value}"
    spent = run([exe, "register", *scans, "--out", result, "--force", "--quiet", "--threads", threads], accept=(0, 3))
    counts, _ = score_poses(scene, result / "poses.json")
    row = (what, value, len(scans), round(sum(map(points_of, scans)) / len(scans)), counts["ok"], f"{spent.cpu_s:.1f}",
           f"{spent.wall_s:.1f}", f"{spent.memory_mb:.0f}")
    say(" ".join(map(str, row)))
    return row


def measure(folder, exe, num_scans=NUM_SCANS, steps_deg=POINT_STEPS_DEG):
    """Rows of HEADER."""
    rows = []
    for step_deg in steps_deg:
        scene = simulated(exe, folder, f"points-{step_deg:g}", ("--scene", "town", "--scans", 4, "--step", step_deg, "--thinning", 0))
        rows.append(row_of(exe, scene, "points", f"{step_deg:g} deg", 1))
    street = simulated(exe, folder, "street", ("--scene", "street", "--scans", max(num_scans)))
    for count in num_scans:
        rows.append(row_of(exe, first_of(street, count), "scans", count, 1))
    for threads in [t for t in (1, 2, 4, 8, 16) if t <= (os.cpu_count() or 1)]:
        rows.append(row_of(exe, first_of(street, sorted(num_scans)[len(num_scans) // 2]), "threads", threads, threads))
    return rows
