#!/usr/bin/env python3
"""Draw simulated scans to a PNG: one scan as its scanner saw it (a range image) above all scans from above.

  scene_pictures.py FOLDER out.png             the scans of a folder that `tcm-icp simulate` wrote
  scene_pictures.py --all EXE docs/images      simulates every scene (6 scans, seed 1) with EXE and draws
                                               docs/images/scene-NAME.png

In the range image near is dark; white is no return. From above each scan has a colour of its own; crosses are the scanners.
"""
import argparse
import io
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit("scene_pictures.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")
try:
    import matplotlib
    from PIL import Image
except ImportError:
    sys.exit("scene_pictures.py: matplotlib is missing: apt install python3-matplotlib, and run it with /usr/bin/python3")
matplotlib.use("Agg")
import matplotlib.pyplot as plt

from ply import read_points

# (scene, sensor): the sensor of the scene, and one scene seen by another.
SCENES = [("town", None), ("block", None), ("street", None), ("urban", None), ("canopy", None),
          ("orchard", None), ("tunnel", None), ("motorway", None), ("interior", None), ("plaza", None), ("bays", None),
          ("storeys", None), ("canopy", "aerial")]


def load(folder):
    """For each scan its points in the common frame, and the scanner's place there."""
    truth = json.loads((folder / "truth.json").read_text())
    out = []
    for scan in truth["scans"]:
        pose = np.array(scan["pose"])
        xyz = read_points(folder / scan["file"]) @ pose[:3, :3].T + pose[:3, 3]
        out.append((xyz, pose[:3, :3] @ np.array(scan["scanner"]) + pose[:3, 3]))
    return truth, out


def draw_ranges(ax, xyz, scanner, options):
    """Azimuth by elevation, a pixel a ray; of several returns in a pixel the nearest."""
    d = xyz - scanner
    r = np.linalg.norm(d, axis=1)
    azimuth, elevation = np.degrees(np.arctan2(d[:, 1], d[:, 0])), np.degrees(np.arcsin(d[:, 2] / r))
    low, high = np.quantile(elevation, [0.002, 0.998])
    rows = options.get("num_lines")
    step = max(options["step_deg"], 0.4)
    rows = min(rows or 10**6, max(8, int((high - low) / step)))
    image = np.full((rows, int(360 / step)), np.nan)
    i = np.clip(((high - elevation) / (high - low) * rows).astype(int), 0, rows - 1)
    j = np.clip(((180 - azimuth) / step).astype(int), 0, image.shape[1] - 1)
    far_first = np.argsort(-r)
    image[i[far_first], j[far_first]] = r[far_first]
    ax.imshow(np.log(image), cmap="cividis", extent=(180, -180, low, high), aspect="auto", interpolation="nearest",
              vmin=np.log(np.quantile(r, 0.01)), vmax=np.log(np.quantile(r, 0.99)))
    ax.set_xlabel("azimuth [deg]", fontsize=7)
    ax.set_ylabel("elevation [deg]", fontsize=7)


def draw_strip(ax, xyz, _scanner, _options):
    """An aerial scan from the side, by height."""
    middle = xyz[:, :2].mean(0)
    along = np.linalg.svd(xyz[:: max(1, len(xyz) // 5000), :2] - middle, full_matrices=False)[2][0]
    s = (xyz[:, :2] - middle) @ along
    across = (xyz[:, :2] - middle) @ np.array([-along[1], along[0]])
    near = np.abs(across) < 4
    ax.scatter(s[near], xyz[near, 2], s=0.6, c=xyz[near, 2], cmap="viridis", linewidths=0)
    ax.set_aspect("equal")
    ax.set_ylim(np.quantile(xyz[near, 2], [0.001, 0.999]) + [-2, 2])
    ax.set_xlabel("along the flight, 8 m of the strip [m]", fontsize=7)
    ax.set_ylabel("height [m]", fontsize=7)


def draw_from_above(ax, scans, ceiling_m):
    rng = np.random.default_rng(0)
    points = np.concatenate([np.column_stack([xyz, np.full(len(xyz), k)]) for k, (xyz, s) in enumerate(scans)
                             for xyz in [xyz[xyz[:, 2] < s[2] + ceiling_m]]])
    points = points[rng.permutation(len(points))[:220000]]
    ax.scatter(points[:, 0], points[:, 1], s=0.25, c=plt.cm.tab10(points[:, 3].astype(int) % 10), linewidths=0)
    for _, s in scans:
        ax.plot(s[0], s[1], "k+", markersize=7)
    low, high = np.quantile(points[:, :2], [0.003, 0.997], axis=0)
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    ax.set_xlabel("[m]", fontsize=7)


def draw(folder, png, whole=None):
    """`whole`: the same scans without thinning, for the range image."""
    truth, scans = load(folder)
    _, seen = load(whole) if whole else (truth, scans)
    options = truth["scanner_options"]
    aerial = options.get("sensor") == "aerial"
    fig, (upper, lower) = plt.subplots(2, 1, figsize=(9, 8.5), facecolor="white", height_ratios=[1, 2.2])
    (draw_strip if aerial else draw_ranges)(upper, *seen[len(scans) // 2], options)
    # From above one would see an interior's ceiling.
    draw_from_above(lower, scans, 0.6 if truth["scene"] in ("interior", "bays", "storeys") else np.inf)
    upper.set_title(f"{truth['scene']}, {options.get('sensor', 'terrestrial')} sensor: scan {len(scans) // 2}, "
                    f"{len(scans[len(scans) // 2][0]):,} points; {len(scans)} scans from above", fontsize=9)
    for ax in (upper, lower):
        ax.tick_params(labelsize=7)
    fig.tight_layout()
    buffer = io.BytesIO()
    fig.savefig(buffer, format="png", dpi=100)
    plt.close(fig)
    # 64 colours are enough for a figure, and a third of the bytes.
    Image.open(buffer).convert("RGB").quantize(64).save(png, optimize=True)
    print(f"{png}: {png.stat().st_size // 1024} KB")


def draw_all(exe, images):
    with tempfile.TemporaryDirectory() as temporary:
        for scene, sensor in SCENES:
            name = scene if sensor is None else f"{scene}-{sensor}"
            folder, whole = pathlib.Path(temporary) / name, pathlib.Path(temporary) / (name + "-whole")
            command = [exe, "simulate", "--scene", scene, "--scans", "6", "--seed", "1"]
            command += ["--sensor", sensor] if sensor else []
            for extra in (["--out", str(folder)], ["--out", str(whole), "--thinning", "0"]):
                subprocess.run(command + extra, check=True, stderr=subprocess.DEVNULL)
            draw(folder, images / f"scene-{name}.png", whole)


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("source", help="a folder of scans; with --all the executable")
    ap.add_argument("out", type=pathlib.Path, help="the PNG; with --all the folder of the pictures")
    ap.add_argument("--all", action="store_true", help="simulate and draw every scene")
    a = ap.parse_args()
    try:
        if a.all:
            draw_all(a.source, a.out)
        else:
            draw(pathlib.Path(a.source), a.out)
    except (OSError, ValueError, KeyError, subprocess.CalledProcessError) as e:
        sys.exit(f"scene_pictures.py: {e}")


if __name__ == "__main__":
    main()
