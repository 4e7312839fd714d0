"""Pictures of scans: before registration, outliers, the correspondence graph, the gallery of overlays."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from paper.print_size import COLUMN_IN, PAGE_IN, save
from paper.scenes import scan_files
from ply import coordinates, read_ply, read_points

POINTS = 60_000  # a picture shows no more
OURS, OTHERS = "#e0a800", "#d01010"  # the paper's yellow and red


def thinned(points, count=POINTS):
    if len(points) <= count:
        return points
    return points[np.random.default_rng(0).choice(len(points), count, replace=False)]


def moved(points, T):
    return points @ T[:3, :3].T + T[:3, 3]


def frame(ax, xy):
    low, high = np.quantile(xy, [0.005, 0.995], axis=0)
    margin = 0.05 * (high - low).max()
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_aspect("equal")
    ax.set_xlabel("[m]")


def before_registration(scene, path, title):
    """Every scan in a colour, as the files have it, from above."""
    fig, ax = plt.subplots(figsize=(COLUMN_IN, 0.9 * COLUMN_IN))
    files = scan_files(scene)
    everything = []
    for i, file in enumerate(files):
        xyz = thinned(read_points(file), POINTS // len(files))
        everything.append(xyz)
        ax.scatter(xyz[:, 0], xyz[:, 1], s=0.15, color=plt.cm.tab10(i % 10), linewidths=0, label=file.name)
    frame(ax, np.concatenate(everything)[:, :2])
    ax.legend(markerscale=12)
    ax.set_title(title)
    save(fig, path)


def truth_poses(scene):
    truth = json.loads((Path(scene) / "truth.json").read_text(encoding="utf-8"))
    return {s["file"]: np.array(s["pose"]) for s in truth["scans"]}


def registered_cloud(scene, result):
    """The registered cloud in the frame of the truth, by the true pose of the result's reference scan."""
    poses = json.loads((result / "poses.json").read_text(encoding="utf-8"))
    return moved(read_points(result / "registered.ply"), truth_poses(scene)[poses["reference"]])


def true_cloud(scene):
    poses = truth_poses(scene)
    return np.concatenate([moved(read_points(f), poses[f.name]) for f in scan_files(scene)])


def gallery(rows, path):
    """One row a data set: features and ours, ICP and ours, ours and the truth, from above.
    @param rows  (name, scene, {method: folder of the result or why there is none})"""
    fig, axes = plt.subplots(len(rows), 3, figsize=(PAGE_IN, 2.1 * len(rows)), squeeze=False)
    for (name, scene, results), line in zip(rows, axes):
        truth = true_cloud(scene)
        ours = results["robust"]
        for ax, (other, label) in zip(line, (("features", "feature based"), ("icp", "ICP"), (None, "truth"))):
            title = f"{name}\n{label} (red), TCM-ICP (yellow)"
            if other is None:
                red = truth
            elif isinstance(results[other], Path):
                red = registered_cloud(scene, results[other])
            else:
                red, title = None, f"{title}\n{label}: {results[other]}"
            if red is not None:
                xyz = thinned(red)
                ax.scatter(xyz[:, 0], xyz[:, 1], s=0.08, color=OTHERS, linewidths=0)
            if isinstance(ours, Path):
                xyz = thinned(registered_cloud(scene, ours))
                ax.scatter(xyz[:, 0], xyz[:, 1], s=0.08, color=OURS, linewidths=0, alpha=0.6)
            else:
                title += f"\nTCM-ICP: {ours}"
            frame(ax, truth[:, :2])
            ax.set_title(title)
    save(fig, path)


def outliers(scene, result, path, title):
    """One scan before and after outlier removal, from the side; what was removed in red."""
    poses = json.loads((result / "poses.json").read_text(encoding="utf-8"))
    index = next(i for i, s in enumerate(poses["scans"]) if s["pose"] is not None)
    file = Path(scene) / poses["scans"][index]["file"]
    before = read_points(file)
    vertices = read_ply(result / "registered.ply")
    mine = next((n for n in vertices.dtype.names if n.startswith("scan")), None)
    pose = poses["scans"][index]["pose"]
    after = moved(coordinates(vertices[vertices[mine] == index]), np.linalg.inv(np.array(pose)))
    # By their places, since outlier removal tells no numbers; to a tenth of a millimetre of float rounding.
    kept = {tuple(p) for p in np.round(after, 3)}
    removed = np.array([tuple(p) not in kept for p in np.round(before, 3)])
    fig, (left, right) = plt.subplots(2, 1, figsize=(PAGE_IN, 3.1), sharex=True, sharey=True)
    left.scatter(before[:, 0], before[:, 2], s=0.12, color="0.4", linewidths=0)
    left.scatter(before[removed, 0], before[removed, 2], s=0.6, color=OTHERS, linewidths=0)
    left.set_title(f"before: {len(before)} points; red: the {removed.sum()} that are removed")
    right.scatter(after[:, 0], after[:, 2], s=0.12, color="0.4", linewidths=0)
    right.set_title(f"after: {len(after)} points")
    for ax in (left, right):
        ax.set_aspect("equal")
        ax.set_xlabel("x [m]")
        ax.set_ylabel("z [m]")
    fig.suptitle(title)
    save(fig, path)
    return len(before), len(after)


def correspondence_graph(scene, result, path, title):
    """Scans on a circle in the order of their files, connected scans joined, the reference marked."""
    graph = json.loads((result / "report.json").read_text(encoding="utf-8"))["graph"]
    files = [f.name for f in scan_files(scene)]
    turn = np.pi / 2 - 2 * np.pi * np.arange(len(files)) / len(files)
    at = {f: (np.cos(a), np.sin(a)) for f, a in zip(files, turn)}
    fig, ax = plt.subplots(figsize=(0.8 * COLUMN_IN, 0.75 * COLUMN_IN))
    for a, b in graph["edges"]:
        ax.plot(*zip(at[a], at[b]), color="0.6", zorder=1)
    for f in files:
        is_reference = f == graph["reference"]
        ax.scatter(*at[f], s=480 if is_reference else 380, color="tab:orange" if is_reference else "tab:blue", zorder=2,
                   edgecolors="black", linewidths=2 if is_reference else 0.5)
        degree = sum(f in edge for edge in graph["edges"])
        ax.annotate(f"{Path(f).stem}\n{degree}", at[f], ha="center", va="center", zorder=3)
    ax.set_aspect("equal")
    ax.margins(0.15)
    ax.axis("off")
    ax.set_title(f"{title}\nname and number of connections; orange: the reference, {graph['reference']}")
    save(fig, path)
