"""Judges poses of a set of scans by their truth. Needs numpy.

A scan is right where its pose relative to the reference scan, the only frame the poses and the truth share, differs
from the true one by no more than the scene's tolerance: its rotation, and the root mean square shift of its points. A
scan that the program itself gave up is "flagged"; one that it placed wrongly is "WRONG". A scan of another "group" of
the truth than the reference's shares nothing with it: giving it up is right, placing it wrong.
"""

import json
from pathlib import Path

import numpy as np

from ply import read_points


def rotation_angle_deg(R):
    """By the chord between R and the identity, which stays exact for small angles."""
    chord = np.linalg.norm(R - np.eye(3)) / np.sqrt(8)  # the sine of half the angle
    return float(np.degrees(2 * np.arcsin(min(chord, 1.0))))


def rms_shift(T, points):
    moved = points @ T[:3, :3].T + T[:3, 3]
    return float(np.sqrt(np.mean(np.sum((moved - points) ** 2, axis=1))))


def rigid(matrix, what):
    T = np.array(matrix, float)
    if T.shape != (4, 4) or not np.allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-3) or np.linalg.det(T) < 0:
        raise ValueError(f"{what} is not a rigid 4x4 matrix")
    return T


def score_poses(scene, poses_path):
    """Counts {"scans", "ok", "flagged", "wrong"} and, by file, (verdict, rotation_deg, rmse)."""
    truth = json.loads((Path(scene) / "truth.json").read_text(encoding="utf-8"))
    answer = json.loads(Path(poses_path).read_text(encoding="utf-8"))
    given = {Path(s["file"]).name: s for s in answer["scans"]}
    reference = Path(answer["reference"]).name
    tolerance = truth["tolerance"]
    true_pose = {s["file"]: rigid(s["pose"], f"truth of {s['file']}") for s in truth["scans"]}
    group = {s["file"]: s.get("group", 0) for s in truth["scans"]}
    reference_pose = rigid(given[reference]["pose"], "pose of the reference")
    details = {}
    for file in true_pose:
        is_placed = given[file]["status"] != "unregistered"
        if group[file] != group[reference]:
            details[file] = ("WRONG" if is_placed else "ok", None, None)
            continue
        if not is_placed:
            details[file] = ("flagged", None, None)
            continue
        estimated = np.linalg.solve(reference_pose, rigid(given[file]["pose"], f"pose of {file}"))
        expected = np.linalg.solve(true_pose[reference], true_pose[file])
        error = np.linalg.solve(expected, estimated)
        rotation_deg = rotation_angle_deg(error[:3, :3])
        rmse = rms_shift(error, read_points(Path(scene) / file))
        is_right = rotation_deg <= tolerance["rotation_deg"] and rmse <= tolerance["rmse_m"]
        details[file] = ("ok" if is_right else "WRONG", rotation_deg, rmse)
    verdicts = [d[0] for d in details.values()]
    return {"scans": len(verdicts), "ok": verdicts.count("ok"), "flagged": verdicts.count("flagged"),
            "wrong": verdicts.count("WRONG")}, details
