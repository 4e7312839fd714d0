"""Hypotheses and decisions of reports with whether they are right, by the truth of their set."""

import json
from dataclasses import dataclass, field

import numpy as np

from ply import read_points

SAMPLE = 2000  # points of a scan that displacements are taken over


def angle_deg(R):
    s = np.linalg.norm([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    return float(np.degrees(np.arctan2(s, (np.trace(R) - 1) / 2)))


def rms(E, points):
    d = points @ (E[:3, :3] - np.eye(3)).T + E[:3, 3]
    return float(np.sqrt((d**2).sum(1).mean()))


@dataclass
class Rows:
    """Features and labels, with the scene and set each row is from."""

    features: list = field(default_factory=list)
    right: list = field(default_factory=list)
    scene: list = field(default_factory=list)
    set: list = field(default_factory=list)

    def add(self, features, right, scene, name):
        self.features.append(features)
        self.right.append(right)
        self.scene.append(scene)
        self.set.append(name)

    def arrays(self):
        return (np.array(self.features, float), np.array(self.right, float), np.array(self.scene), np.array(self.set))


class Set:
    """A set's truth and the report of a run over it."""

    def __init__(self, folder, result):
        self.truth = json.loads((folder / "truth.json").read_text())
        self.report = json.loads((result / "report.json").read_text())
        self.pose = {s["file"]: np.array(s["pose"], float) for s in self.truth["scans"]}
        self.group = {s["file"]: s.get("group", 0) for s in self.truth["scans"]}
        self.folder, self._points = folder, {}
        self.tolerance_m = self.truth["tolerance"]["rmse_m"]
        self.tolerance_deg = self.truth["tolerance"]["rotation_deg"]

    def points(self, file):
        if file not in self._points:
            points = read_points(self.folder / file)
            self._points[file] = points[:: max(1, len(points) // SAMPLE)]
        return self._points[file]

    def error(self, a, b, T_a_b):
        E = np.linalg.inv(np.linalg.inv(self.pose[a]) @ self.pose[b]) @ T_a_b
        return self.rms(b, E), angle_deg(E[:3, :3])

    def rms(self, file, motion):
        """How far [m] the motion moves the points of a scan."""
        return rms(motion, self.points(file))


def hypotheses(data, scene, name, rows):
    """A hypothesis is right within two coarse voxels (or tolerances), wrong beyond four; between it is neither."""
    limit_m = 2 * max(data.report["coarse_voxel_m"], data.tolerance_m)
    limit_deg = 3 * max(1, data.tolerance_deg)
    for h in data.report["hypotheses"]:
        same = data.group[h["a"]] == data.group[h["b"]]
        m, deg = data.error(h["a"], h["b"], np.array(h["pose_of_b_in_a"]))
        right = same and m < limit_m and deg < limit_deg
        if right or not same or m >= 2 * limit_m or deg >= 2 * limit_deg:
            rows.add(h["features"], right, scene, name)


def decisions(data, scene, name, rows, slack=1.5, taken=lambda decision: decision["features"]):
    """`taken` of each decision. A scan is right within the tolerance of where the reference says (times `slack`, for what the reference itself is
    off by). Where that makes the reference the only right one, it is the wrong one."""
    poses = json.loads((data.folder_of_result / "poses.json").read_text())
    components = {}
    for scan, entry in zip(poses["scans"], data.report["scans"]):
        pose = scan["pose"] if scan["pose"] is not None else scan.get("pose_in_component")
        if pose is not None and "lead" in entry["decision"]:
            components.setdefault(scan["component"], []).append((scan["file"], np.array(pose, float), entry["decision"]))
    for members in components.values():
        agreeing = [_right_beside(data, member, members, slack) for member in members]
        reference = int(np.argmin([np.abs(T - np.eye(4)).max() for _, T, _ in members]))
        labels = agreeing[reference]
        if sum(labels) == 1 and len(members) > 2:
            labels = max(agreeing, key=sum)
        if sum(labels) == 1:
            labels = [False] * len(members)
        for (_, _, decision), right in zip(members, labels):
            rows.add(taken(decision), right, scene, name)


def probabilities(data, scene, name, rows):
    decisions(data, scene, name, rows, taken=lambda decision: [decision["probability"]])


def _right_beside(data, frame, members, slack):
    """Which members lie right to the first one."""
    out = []
    for file, T, _ in members:
        m, deg = data.error(frame[0], file, np.linalg.inv(frame[1]) @ T)
        out.append(data.group[file] == data.group[frame[0]] and m <= slack * data.tolerance_m
                   and deg <= slack * data.tolerance_deg)
    return out


def load(root, results, what, match=lambda name: True):
    """Rows of all sets; `what` is hypotheses(), decisions() or probabilities()."""
    rows = Rows()
    for folder in sorted(root.iterdir()):
        result = results / folder.name
        if not (folder / "truth.json").exists() or not (result / "report.json").exists() or not match(folder.name):
            continue
        data = Set(folder, result)
        data.folder_of_result = result
        scene = folder.name.split("-")[1] if "-" in folder.name else folder.name
        what(data, scene, folder.name, rows)
    return rows.arrays()
