"""A whole run over very many points beside what merely reading and writing them takes."""

import shutil

import numpy as np

from benchmark.spent import json_of, run, say
from ply import header_of_points, read_points
from score_poses import score_poses

HEADER = ("what", "points", "right", "scans", "processor time [s]", "wall time [s]", "memory [MB]")
NUM_SCANS = 10
JITTER_M = 0.005  # of a copy, an axis: a scanner's noise
THREADS = 2


def write_dense(path, points, count, rng):
    """So many points, each a copy of one of `points` moved by noise."""
    with open(path, "wb") as f:
        f.write(header_of_points(count, "float"))
        for begin in range(0, count, 1_000_000):
            size = min(1_000_000, count - begin)
            chosen = points[np.arange(begin, begin + size) * len(points) // count]
            f.write((chosen + rng.normal(0, JITTER_M, chosen.shape)).astype("<f4").tobytes())


def dense_scene(exe, folder, num_points):
    scene, dense = folder / "town", folder / "dense"
    if not (dense / "truth.json").exists():
        run([exe, "simulate", "--scene", "town", "--scans", NUM_SCANS, "--step", "0.2", "--thinning", "0", "--seed", "20263",
             "--out", scene, "--force", "--quiet"])
        dense.mkdir(exist_ok=True)
        rng = np.random.default_rng(1)
        for scan in sorted(scene.glob("*.ply")):
            write_dense(dense / scan.name, read_points(scan), num_points // NUM_SCANS, rng)
        shutil.copy(scene / "truth.json", dense)
    return dense


def measure(folder, exe, cloud_io, num_points):
    """Rows of HEADER: the copy, the run."""
    dense = dense_scene(exe, folder, num_points)
    scans, copy = sorted(dense.glob("*.ply")), folder / "copy.ply"
    cpu_s = sum(sum(json_of([cloud_io, "tcm-icp", scan, copy])[part] for part in ("read_s", "write_s")) for scan in scans)
    copy.unlink()
    result = folder / "result"
    spent = run([exe, "register", *scans, "--out", result, "--force", "--quiet", "--threads", THREADS], accept=(0, 3))
    counts, _ = score_poses(dense, result / "poses.json")
    (result / "registered.ply").unlink()
    rows = [("each scan read and written", num_points, "", len(scans), f"{cpu_s:.1f}", "", ""),
            (f"register --threads {THREADS}", num_points, counts["ok"], len(scans), f"{spent.cpu_s:.1f}", f"{spent.wall_s:.1f}",
             f"{spent.memory_mb:.0f}")]
    for row in rows:
        say(" ".join(map(str, row)))
    return rows
