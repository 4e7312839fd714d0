#!/usr/bin/python3
"""Opens the clouds this program writes with CloudCompare, PCL's tools and Open3D, and compares what they find with the
raw scans moved by poses.json: the number of points exactly, their bounds to what the program resolves.

check_formats_outside.py [--exe TCM_ICP] [--keep FOLDER]

Needs Debian's cloudcompare, pcl-tools, python3-open3d and python3-numpy (install_dependencies.sh --outside); a program
that is missing is said to be, and not counted. LAS, for which Debian 12 has no program, is read here by the fields of
the standard. The exit status is 1 where a file is not what it should be.
"""

import argparse
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from ply import read_points

REPOSITORY = Path(__file__).resolve().parent.parent
SCANS = [REPOSITORY / "datasets/town" / f"00{i}.ply" for i in range(3)]
FORMATS = {"ply": ".ply", "text": ".xyz", "pcd": ".pcd", "ptx": ".ptx", "las": ".las"}
FLOAT, DOUBLE = 2.0 ** -23, 1e-12  # relative resolution of what a program keeps


class Missing(Exception):
    """The program is not on this machine."""


def run(command, **options):
    if shutil.which(command[0]) is None:
        raise Missing
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            timeout=300, **options)
    if result.returncode != 0:
        raise ValueError(f"exit status {result.returncode}: {result.stdout.strip().splitlines()[-1:]}")


def read_rows(path, skip=0):
    return np.loadtxt(path, skiprows=skip, usecols=(0, 1, 2), ndmin=2)


def by_cloudcompare(path, folder):
    """Keeps points as floats."""
    out = folder / "cloudcompare.asc"
    merged = folder / "cloudcompare.asc_0"  # where there were several clouds in the file
    merged.unlink(missing_ok=True)
    run(["CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-O", path, "-MERGE_CLOUDS", "-C_EXPORT_FMT", "ASC", "-PREC", "12",
         "-SAVE_CLOUDS", "FILE", out], env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    return read_rows(merged if merged.exists() else out)


def by_pcl(path, folder):
    out = folder / "pcl.pcd"
    if path.suffix == ".ply":
        run(["pcl_ply2pcd", "-format", "0", path, out])
    else:
        run(["pcl_convert_pcd_ascii_binary", path, out, "0", "17"])
    lines = out.read_text(encoding="ascii", errors="replace").splitlines()
    data = next(i for i, line in enumerate(lines) if line.startswith("DATA"))
    names = next(line for line in lines if line.startswith("FIELDS")).split()[1:]
    if names[:3] != ["x", "y", "z"]:
        raise ValueError(f"the fields are {names}")
    return read_rows(out, data + 1)


def by_open3d(path, _folder):
    try:
        import open3d  # which takes seconds, and is not everywhere
    except ImportError as error:
        raise Missing from error
    return np.asarray(open3d.io.read_point_cloud(str(path)).points)


def by_las_fields(path, _folder):
    raw = path.read_bytes()
    assert raw[:4] == b"LASF" and raw[24:26] == b"\x01\x04", "signature and version"
    offset, = struct.unpack_from("<I", raw, 96)
    size, = struct.unpack_from("<H", raw, 105)
    scale, shift = struct.unpack_from("<3d", raw, 131), struct.unpack_from("<3d", raw, 155)
    count, = struct.unpack_from("<Q", raw, 247)
    records = np.frombuffer(raw, np.uint8, count * size, offset).reshape(count, size)
    return records[:, :12].copy().view("<i4") * scale + shift


READERS = [("CloudCompare", by_cloudcompare, ("ply", "text", "ptx"), FLOAT), ("PCL", by_pcl, ("ply", "pcd"), FLOAT),
           ("Open3D", by_open3d, ("ply", "text", "pcd"), DOUBLE), ("this script", by_las_fields, ("las",), DOUBLE)]


def moved(scan, pose):
    T = np.array(pose)
    return read_points(scan) @ T[:3, :3].T + T[:3, 3]


def verdict(points, expected, resolution):
    """(deviation of the bounds, what is wrong or "")."""
    if len(points) != len(expected):
        return None, f"{len(points)} points instead of {len(expected)}"
    off = max(np.abs(points.min(0) - expected.min(0)).max(), np.abs(points.max(0) - expected.max(0)).max())
    return off, "" if off <= resolution else f"bounds are off by more than {resolution:.1e}"


def register(exe, name, folder):
    """The registered cloud and a single scan of it, each with the points that should be in it."""
    subprocess.run([exe, "register", *SCANS, "--out", folder, "--format", name, "--each", "--outliers", "none", "--quiet",
                    "--sampling.working-points", "20000", "--sampling.coarse-voxels", "4000", "--sampling.fine-voxels", "10000"],
                   check=True, stdout=subprocess.DEVNULL)
    poses = json.loads((folder / "poses.json").read_text(encoding="utf-8"))["scans"]
    clouds = [moved(scan, pose["pose"]) for scan, pose in zip(SCANS, poses)]
    each = folder / "scans" / ("002.ply" if name == "ply" else "002.ply" + FORMATS[name])
    return [(folder / ("registered" + FORMATS[name]), np.concatenate(clouds)), (each, clouds[2])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--exe", default=str(REPOSITORY / "build/release/app/tcm-icp"))
    parser.add_argument("--keep", type=Path, help="leave the files in this folder")
    arguments = parser.parse_args()
    if shutil.which(arguments.exe) is None:
        parser.error(f"there is no {arguments.exe}; build it, or name it by --exe")
    folder = arguments.keep or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    failures = 0
    print(f"{'file':24} {'program':14} {'points':>8} {'bounds off by [m]':>18}  result")
    for name in FORMATS:
        for path, expected in register(arguments.exe, name, folder / name):
            # Stored as floats or as decimal integers, some of the digits are gone already.
            stored = {"pcd": FLOAT, "las": 1e-6}.get(name, 0)
            for program, reader, formats, kept in READERS:
                if name not in formats:
                    continue
                off, points = None, None
                try:
                    points = reader(path, folder)
                    off, problem = verdict(points, expected, max(kept, stored) * np.abs(expected).max())
                except Missing:
                    problem = "not installed"
                except (ValueError, AssertionError, OSError, subprocess.TimeoutExpired) as error:
                    problem = str(error)
                failures += problem not in ("", "not installed")
                print(f"{str(path.relative_to(folder)):24} {program:14} {'' if points is None else len(points):>8} "
                      f"{'' if off is None else f'{off:.1e}':>18}  {problem or 'ok'}", flush=True)
    if arguments.keep is None:
        shutil.rmtree(folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
