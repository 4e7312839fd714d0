#!/usr/bin/env python3
"""Draw point clouds to a PNG: from above and obliquely, side by side.

  render.py registered.ply out.png            one PLY; its red, green, blue are used, else its height
  render.py FOLDER out.png                    the scans of a folder, each in a colour of its own, moved by the folder's
                                              truth.json where there is one
  render.py FOLDER out.png --poses POSES.json moved by these poses instead
  render.py scan.ply out.png --intensity      one PLY by its intensity

At most --points points are drawn (300,000), an evenly spread sample. Reads binary PLY files with x, y, z.
"""
import argparse
import json
import pathlib
import sys

try:
    import numpy as np
except ImportError:
    sys.exit("render.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")
try:
    import matplotlib
except ImportError:
    sys.exit("render.py: matplotlib is missing: apt install python3-matplotlib, and run it with /usr/bin/python3")
matplotlib.use("Agg")
import matplotlib.pyplot as plt

from ply import coordinates, read_ply


def load_file(path, by_intensity):
    vertices = read_ply(path)
    xyz = coordinates(vertices)
    if by_intensity:
        return xyz, plt.cm.gray(np.clip(vertices["intensity"] / np.quantile(vertices["intensity"], 0.98), 0, 1))[:, :3]
    if "red" in vertices.dtype.names:
        return xyz, np.stack([vertices["red"], vertices["green"], vertices["blue"]], 1) / 255.0
    low, high = np.quantile(xyz[:, 2], [0.01, 0.99])
    return xyz, plt.cm.viridis(np.clip((xyz[:, 2] - low) / max(high - low, 1e-9), 0, 1))[:, :3]


def load_folder(folder, poses_path):
    poses_path = poses_path or folder / "truth.json"
    poses = {}
    if pathlib.Path(poses_path).exists():
        scans = json.loads(pathlib.Path(poses_path).read_text())["scans"]
        poses = {s["file"]: np.array(s["pose"]) for s in scans if s["pose"] is not None}
    points, colours = [], []
    files = sorted(p for p in folder.iterdir() if p.suffix.lower() == ".ply")
    for i, path in enumerate(f for f in files if not poses or f.name in poses):
        xyz = coordinates(read_ply(path))
        T = poses.get(path.name, np.eye(4))
        points.append(xyz @ T[:3, :3].T + T[:3, 3])
        colours.append(np.tile(plt.cm.tab10(i % 10)[:3], (len(xyz), 1)))
    if not points:
        raise ValueError(f"{folder}: no PLY file with a pose")
    return np.concatenate(points), np.concatenate(colours)


def draw(ax, xyz, colours, turn_deg, elevation_deg):
    """Parallel projection along a direction `elevation_deg` above the horizon; what is far is drawn first."""
    a, e = np.radians(turn_deg), np.radians(elevation_deg)
    right = np.array([np.cos(a), np.sin(a), 0])
    away = np.array([-np.sin(a) * np.cos(e), np.cos(a) * np.cos(e), -np.sin(e)])
    order = np.argsort(-xyz @ away)
    flat = np.stack([xyz @ right, xyz @ np.cross(right, away)], 1)[order]
    ax.scatter(flat[:, 0], flat[:, 1], s=0.35, c=colours[order], linewidths=0)
    ax.set_aspect("equal")
    low, high = np.quantile(flat, [0.002, 0.998], axis=0)
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("cloud", type=pathlib.Path, help="a PLY file, or a folder of them")
    ap.add_argument("png", type=pathlib.Path)
    ap.add_argument("--poses", type=pathlib.Path, help="poses.json or truth.json for a folder")
    ap.add_argument("--intensity", action="store_true", help="colour a file by its intensity")
    ap.add_argument("--points", type=int, default=300000, help="most points that are drawn")
    a = ap.parse_args()
    try:
        xyz, colours = load_folder(a.cloud, a.poses) if a.cloud.is_dir() else load_file(a.cloud, a.intensity)
    except (OSError, ValueError, KeyError) as e:
        sys.exit(f"render.py: {e}")
    if len(xyz) > a.points:
        chosen = np.random.default_rng(0).choice(len(xyz), a.points, replace=False)
        xyz, colours = xyz[chosen], colours[chosen]
    fig, (top, oblique) = plt.subplots(1, 2, figsize=(20, 10), facecolor="white")
    draw(top, xyz, colours, 0, 90)
    draw(oblique, xyz, colours, 20, 30)
    top.set_title("from above")
    oblique.set_title("obliquely")
    fig.tight_layout()
    fig.savefig(a.png, dpi=90)


if __name__ == "__main__":
    main()
