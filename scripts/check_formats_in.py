#!/usr/bin/python3
"""Writes the scans of a folder in every format that is read, by writers of its own that share no code with the program,
registers each, and compares the poses: the largest difference of any entry of a matrix by the set's extent.

check_formats_in.py [--exe TCM_ICP] [--data FOLDER] [--keep FOLDER]

Coordinates are rounded to 2^-10 of a unit first, which floats, doubles, scaled integers and decimal text of ten digits
all hold without loss up to 8,000 units: so what the files say is the same. Needs Debian's python3-numpy (exit status 77
without it). The exit status is 1 where poses differ by more than 1e-6, or a scan is registered in one format alone.
"""

import argparse
import json
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("check_formats_in.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")
    sys.exit(77)

from ply import read_points

REPOSITORY = Path(__file__).resolve().parent.parent
STEP = 2.0 ** -10
ALLOWED = 1e-6  # of the extent
PAGE, PAGE_DATA = 1024, 1020  # E57: the rest is a check sum
E57_HEADER, E57_SECTION = 48, 32


def rows(points, separator):
    return "".join(separator.join(f"{value:.10f}" for value in p) + "\n" for p in points)


def ply(points, kind):
    header = ("ply\nformat {} 1.0\nelement vertex {}\n".format("ascii" if kind == "ascii" else "binary_little_endian", len(points))
              + "".join(f"property {'float' if kind == 'float' else 'double'} {axis}\n" for axis in "xyz") + "end_header\n")
    if kind == "ascii":
        return (header + rows(points, " ")).encode()
    return header.encode() + points.astype("<f4" if kind == "float" else "<f8").tobytes()


def text(points, separator, first=""):
    return (first + rows(points, separator)).encode()


def with_decimal_commas(points):
    return b"Easting;Northing;Height\n" + rows(points, ";").replace(".", ",").encode()


def ptx(points):
    header = f"{len(points)}\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
    return (header + "".join(line + " 0.5\n" for line in rows(points, " ").splitlines())).encode()


def pcd(points, size):
    header = (f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE {size} {size} {size}\nTYPE F F F\nCOUNT 1 1 1\n"
              f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n")
    return header.encode() + points.astype(f"<f{size}").tobytes()


def las(points):
    """LAS 1.2, point format 0."""
    records = np.zeros(len(points), np.dtype([("position", "<i4", 3), ("others", "V8")]))
    records["position"] = np.rint(points / STEP)
    header = bytearray(227)
    header[:4], header[24], header[25] = b"LASF", 1, 2
    struct.pack_into("<HII", header, 94, 227, 227, 0)
    struct.pack_into("<BHI", header, 104, 0, 20, len(points))
    struct.pack_into("<6d", header, 131, STEP, STEP, STEP, 0, 0, 0)
    high, low = points.max(0), points.min(0)
    struct.pack_into("<6d", header, 179, high[0], low[0], high[1], low[1], high[2], low[2])
    return bytes(header) + records.tobytes()


def crc32c(pages):
    """Of each row of bytes."""
    table = np.arange(256, dtype=np.uint32)
    for _ in range(8):
        table = np.where(table & 1, (table >> 1) ^ np.uint32(0x82F63B78), table >> 1)
    sums = np.full(len(pages), 0xFFFFFFFF, np.uint32)
    for byte in pages.T:
        sums = (sums >> 8) ^ table[(sums ^ byte) & 0xFF]
    return ~sums


def e57_columns(points, kind):
    """The type of a coordinate in the XML part, how many points fit into a packet, and bytes(axis, begin, end)."""
    if kind != "scaled":
        stored = points.astype("<f4" if kind == "float" else "<f8")
        precision = ' precision="single"' if kind == "float" else ""
        return f'type="Float"{precision}', 2000, lambda axis, begin, end: stored[begin:end, axis].tobytes()
    whole = np.rint(points / STEP).astype(np.int64)
    least, most = int(whole.min()), int(whole.max())
    digits = np.arange((most - least).bit_length())
    bits = ((whole - least)[:, :, None] >> digits & 1).astype(np.uint8)
    said = f'type="ScaledInteger" minimum="{least}" maximum="{most}" scale="{STEP!r}" offset="0"'
    return said, 4000, lambda axis, begin, end: np.packbits(bits[begin:end, axis].ravel(), bitorder="little").tobytes()


def e57(points, kind):
    """ASTM E2807-11: a header, a section of points in packets, an XML part, all in pages with check sums."""
    said, in_packet, column = e57_columns(points, kind)
    packets = b""
    for begin in range(0, len(points), in_packet):
        pieces = [column(axis, begin, begin + in_packet) for axis in range(3)]
        body = struct.pack("<4H", 3, *map(len, pieces)) + b"".join(pieces)
        size = (4 + len(body) + 3) // 4 * 4
        packets += struct.pack("<BBH", 1, 0, size - 1) + body.ljust(size - 4, b"\0")

    def physical(place):
        return place // PAGE_DATA * PAGE + place % PAGE_DATA

    section = struct.pack("<B7xQQQ", 1, E57_SECTION + len(packets), physical(E57_HEADER + E57_SECTION), 0) + packets
    xml = ('<?xml version="1.0" encoding="UTF-8"?>\n'
           '<e57Root type="Structure" xmlns="http://www.astm.org/COMMIT/E57/2010-e57-v1.0">'
           '<data3D type="Vector" allowHeterogeneousChildren="1"><vectorChild type="Structure">'
           f'<points type="CompressedVector" fileOffset="{physical(E57_HEADER)}" recordCount="{len(points)}">'
           '<prototype type="Structure">' + "".join(f"<cartesian{axis} {said}/>" for axis in "XYZ") + "</prototype>"
           '<codecs type="Vector" allowHeterogeneousChildren="1"></codecs></points></vectorChild></data3D></e57Root>\n').encode()
    xml_at = E57_HEADER + len(section)
    count = -(-(xml_at + len(xml)) // PAGE_DATA)
    header = b"ASTM-E57" + struct.pack("<IIQQQQ", 1, 0, count * PAGE, physical(xml_at), len(xml), PAGE)
    pages = np.frombuffer((header + section + xml).ljust(count * PAGE_DATA, b"\0"), np.uint8).reshape(count, PAGE_DATA)
    return np.hstack([pages, crc32c(pages).astype(">u4").view(np.uint8).reshape(count, 4)]).tobytes()


FORMATS = {
    "PLY, floats": (".ply", lambda p: ply(p, "float")),
    "PLY, doubles": (".ply", lambda p: ply(p, "double")),
    "PLY, ASCII": (".ply", lambda p: ply(p, "ascii")),
    "text": (".xyz", lambda p: text(p, " ")),
    "text with commas": (".csv", lambda p: text(p, ",", "x,y,z\n")),
    "text with decimal commas": (".csv", with_decimal_commas),
    "PTS": (".pts", lambda p: text(p, " ", f"{len(p)}\n")),
    "PTX": (".ptx", ptx),
    "PCD, floats": (".pcd", lambda p: pcd(p, 4)),
    "PCD, doubles": (".pcd", lambda p: pcd(p, 8)),
    "LAS, scaled integers": (".las", las),
    "E57, floats": (".e57", lambda p: e57(p, "float")),
    "E57, doubles": (".e57", lambda p: e57(p, "double")),
    "E57, scaled integers": (".e57", lambda p: e57(p, "scaled")),
    "KITTI": (".bin", lambda p: np.c_[p, np.zeros(len(p))].astype("<f4").tobytes()),
}


def poses_from(exe, name, scans, folder):
    """By the name of the scan without its extension; those that are not registered have none."""
    extension, write = FORMATS[name]
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for stem, points in scans.items():
        files.append(folder / (stem + extension))
        files[-1].write_bytes(write(points))
    options = ["--bin", "kitti"] if extension == ".bin" else []
    result = subprocess.run([exe, "register", *files, "--out", folder / "out", "--quiet", "--force", *options], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if result.returncode not in (0, 3):
        raise ValueError(result.stdout.strip())
    listed = json.loads((folder / "out/poses.json").read_text(encoding="utf-8"))["scans"]
    return {Path(s["file"]).stem: np.array(s["pose"]) for s in listed if s["pose"] is not None}


def compare(exe, scans, folder):
    """The exit status, after a line for each format."""
    extent = max(np.ptp(points, axis=0).max() for points in scans.values())
    expected, failures = None, 0
    print(f"{'format':26} {'registered':>10} {'difference by extent':>20}  result")
    for number, name in enumerate(FORMATS):
        try:
            poses = poses_from(exe, name, scans, folder / f"{number:02}")
        except ValueError as error:
            failures += 1
            print(f"{name:26} {'':>10} {'':>20}  {error}", flush=True)
            continue
        expected = expected or poses
        apart = max((np.abs(poses[s] - expected[s]).max() for s in poses if s in expected), default=0) / extent
        problem = ("no pair is registered" if len(poses) < 2
                   else "other scans are registered" if poses.keys() != expected.keys()
                   else "other poses" if apart > ALLOWED else "")
        failures += problem != ""
        print(f"{name:26} {len(poses):>7} of {len(scans)} {apart:>20.1e}  {problem or 'ok'}", flush=True)
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--exe", default=str(REPOSITORY / "build/release/app/tcm-icp"))
    parser.add_argument("--data", type=Path, default=REPOSITORY / "datasets/town", help="folder of PLY files")
    parser.add_argument("--keep", type=Path, help="leave the files in this folder")
    arguments = parser.parse_args()
    if shutil.which(arguments.exe) is None:
        parser.error(f"there is no {arguments.exe}; build it, or name it by --exe")
    scans = {path.stem: np.rint(read_points(path) / STEP) * STEP for path in sorted(arguments.data.glob("*.ply"))}
    if len(scans) < 2:
        parser.error(f"{arguments.data} has fewer than two PLY files")
    if arguments.keep:
        return compare(arguments.exe, scans, arguments.keep)
    with tempfile.TemporaryDirectory() as folder:
        return compare(arguments.exe, scans, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
