"""Sets of simulated scans that the link and scan models are fitted to: scenes, sensors, and what goes wrong with scans."""

import json
import shutil
import subprocess
from dataclasses import dataclass

import numpy as np

from ply import read_points, write_points


@dataclass(frozen=True)
class Scene:
    """What `tcm-icp simulate` is asked for."""

    name: str
    arguments: tuple


SCENES = (
    Scene("town", ("--scene", "town", "--scans", "6")),
    Scene("block", ("--scene", "block", "--scans", "9")),
    Scene("street", ("--scene", "street", "--scans", "9")),
    Scene("street16", ("--scene", "street", "--scans", "8", "--lines", "16")),
    Scene("urban", ("--scene", "urban", "--scans", "8")),
    Scene("urban16", ("--scene", "urban", "--scans", "8", "--lines", "16", "--speed", "0")),
    Scene("canopy", ("--scene", "canopy", "--scans", "6")),
    Scene("strips", ("--scene", "canopy", "--scans", "6", "--sensor", "aerial")),
    Scene("strips_far", ("--scene", "canopy", "--scans", "6", "--sensor", "aerial", "--overlap", "0.35", "--line-spacing",
                         "0.6", "--range-noise", "0.1", "--angular-noise", "0.03", "--thinning", "0.4")),
    Scene("interior", ("--scene", "interior", "--scans", "6")),
    Scene("rooms", ("--scene", "interior", "--scans", "10", "--spacing", "4")),
    Scene("rooms16", ("--scene", "interior", "--scans", "8", "--sensor", "spinning", "--lines", "16", "--spacing", "3",
                      "--height", "1.5", "--min-range", "0.3", "--max-range", "40")),
    Scene("rooms_moving", ("--scene", "interior", "--scans", "10", "--sensor", "spinning", "--lines", "16", "--spacing", "1",
                           "--height", "1.2", "--min-range", "0.3", "--max-range", "40", "--range-noise", "0.03",
                           "--speed", "1")),
    Scene("plaza", ("--scene", "plaza", "--scans", "6")),
    Scene("bays", ("--scene", "bays", "--scans", "8")),
    Scene("bays_dense", ("--scene", "bays", "--scans", "10", "--step", "0.2", "--thinning", "0.02")),
    # From here on added since the models in use were fitted.
    Scene("storeys", ("--scene", "storeys", "--scans", "12")),
    Scene("orchard", ("--scene", "orchard")),
    Scene("tunnel", ("--scene", "tunnel")),
    Scene("tunnel_tripod", ("--scene", "tunnel", "--scans", "8", "--sensor", "terrestrial", "--spacing", "12",
                            "--thinning", "0.03")),
    Scene("motorway", ("--scene", "motorway")),
    Scene("motorway16", ("--scene", "motorway", "--lines", "16", "--spacing", "12")),
)
VARIANTS = ("plain", "thin", "crop", "mirror", "stranger", "clutter", "subset", "passers")


def simulate(exe, scene, seed, folder):
    if not (folder / "truth.json").exists():
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([exe, "simulate", *scene.arguments, "--seed", str(seed), "--threads", "1", "--out", str(folder)],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def _emit(folder, scans, truth):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    entries = []
    for k, (points, pose, group) in enumerate(scans):
        name = f"{k:03d}.ply"
        write_points(folder / name, points)
        entries.append({"file": name, "pose": pose, "group": group})
    (folder / "truth.json").write_text(json.dumps({"scans": entries, "tolerance": truth["tolerance"]}))


def _extent(points):
    return float(np.median(np.linalg.norm(points - np.median(points, 0), axis=1)))


def make_variant(plain, variant, seed, other, folder):
    """The set in `plain` with one thing wrong; `other` is a set of another scene, for strangers."""
    if (folder / "truth.json").exists():
        return
    rng = np.random.default_rng([seed, sum(map(ord, variant))])
    truth = json.loads((plain / "truth.json").read_text())
    scans = [(read_points(plain / s["file"]), s["pose"], 0) for s in truth["scans"]]
    if variant == "thin":
        share = rng.uniform(0.08, 0.3)
        scans = [(p[rng.random(len(p)) < share], pose, g) for p, pose, g in scans]
    elif variant == "crop":
        cropped = []
        for p, pose, g in scans:
            along = p @ np.array([np.cos(a := rng.uniform(0, 2 * np.pi)), np.sin(a), 0])
            cropped.append((p[along <= np.quantile(along, rng.uniform(0.5, 0.7))], pose, g))
        scans = cropped
    elif variant == "mirror":
        k = int(rng.integers(len(scans)))
        scans[k] = (scans[k][0] * [-1, 1, 1], scans[k][1], 1)
    elif variant == "stranger":
        scans += _strangers(other, _extent(scans[0][0]), rng)
    elif variant == "clutter":
        scans = [(_cluttered(p, rng), pose, g) for p, pose, g in scans]
    elif variant == "passers":
        scans = [(_with_passers(p, np.array(s["pose"], float), s["scanner"], rng), pose, g)
                 for (p, pose, g), s in zip(scans, truth["scans"])]
    elif variant == "subset":
        size = int(rng.integers(2, min(4, len(scans) - 1) + 1))
        scans = [scans[i] for i in sorted(rng.permutation(len(scans))[:size])]
    _emit(folder, scans, truth)


def _strangers(other, extent, rng):
    """Two scans of another set, made as large as `extent`: they may belong together, and then it is known how."""
    truth = json.loads((other / "truth.json").read_text())["scans"]
    pair = [truth[i] for i in rng.permutation(len(truth))[:2]]
    points = [read_points(other / s["file"]) for s in pair]
    scale = extent / _extent(points[0])
    out = []
    for p, s in zip(points, pair):
        pose = np.array(s["pose"], float)
        pose[:3, 3] *= scale
        out.append((p * scale, pose.tolist(), 1))
    return out


def _with_passers(points, pose, scanner, rng):
    """People and cars about the scanner, others in every scan: where a ray meets one, its point lies there."""
    R, t = pose[:3, :3], pose[:3, 3]
    origin = R @ np.asarray(scanner, float) + t
    rays = points @ R.T + t - origin
    reach = float(np.median(np.linalg.norm(rays, axis=1)))
    least = np.ones(len(points))  # of each ray, as far as it gets
    low = np.flatnonzero(rays[:, 2] <= np.quantile(rays[:, 2], 0.3))
    for _ in range(int(rng.integers(3, 13))):
        foot = rays[low[int(rng.integers(len(low)))]]
        foot = foot * min(1, rng.uniform(0.3, 1.5) * reach / np.linalg.norm(foot[:2])) * [1, 1, 0] + [0, 0, foot[2]]
        is_car = reach > 8 and rng.random() < 0.4
        half = np.array([2.1, 0.9, 0.75]) if is_car else np.array([0.25, 0.25, 0.85])
        a = rng.uniform(0, 2 * np.pi)
        turn = np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])
        middle = turn @ (foot + [0, 0, half[2]])
        if (np.abs(middle[:2]) < half[:2] + 0.3).all():
            continue  # nobody stands in the scanner
        with np.errstate(divide="ignore", invalid="ignore"):
            along = rays @ turn.T
            sides = np.stack([(middle - half) / along, (middle + half) / along])
        enters, leaves = sides.min(0).max(1), sides.max(0).min(1)
        meets = (enters > 0) & (enters <= leaves) & (enters < least)
        least[meets] = enters[meets]
    noise = np.where(least < 1, rng.normal(size=len(points)) * 0.005, 0) / np.linalg.norm(rays, axis=1)
    return (rays * (least + noise)[:, None] + origin - t) @ R


def _cluttered(points, rng):
    """15 % of the points become blobs that no other scan has."""
    out, radius = points.copy(), 0.03 * _extent(points)
    for blob in np.array_split(rng.permutation(len(points))[: int(0.15 * len(points))], 40):
        out[blob] = points[int(rng.integers(len(points)))] + rng.normal(size=(len(blob), 3)) * radius + [0, 0, radius]
    return out
