"""Registers the example with --format e57 and reads the result by a reader of its own, which follows ASTM E2807-11 and
shares no code with the program: points moved by the poses in the headers must be those of registered.ply.

e57_check.py TCM_ICP TOWN"""

import math
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

NS = {"e": "http://www.astm.org/COMMIT/E57/2010-e57-v1.0"}
TCM = "{urn:tcm-icp:attributes}"


def crc32c_table():
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = byte >> 1 ^ (0x82F63B78 if byte & 1 else 0)
        table.append(byte)
    return table


TABLE = crc32c_table()


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc = crc >> 8 ^ TABLE[(crc ^ byte) & 255]
    return crc ^ 0xFFFFFFFF


class E57:
    def __init__(self, path):
        raw = Path(path).read_bytes()
        magic, major, minor, size, xml_at, xml_length, page = struct.unpack("<8sIIQQQQ", raw[:48])
        assert (magic, major, minor, size, page) == (b"ASTM-E57", 1, 0, len(raw), 1024), "file header"
        for at in range(0, len(raw), 1024 * (len(raw) // 1024 // 50 + 1)):  # Python is slow: some fifty pages
            assert crc32c(raw[at:at + 1020]) == struct.unpack(">I", raw[at + 1020:at + 1024])[0], f"page at {at}"
        self.bytes = b"".join(raw[at:at + 1020] for at in range(0, len(raw), 1024))
        start = self.logical(xml_at)
        self.root = ElementTree.fromstring(self.bytes[start:start + xml_length])
        self.scans = self.root.find("e:data3D", NS).findall("e:vectorChild", NS)

    @staticmethod
    def logical(physical):
        assert physical % 1024 < 1020
        return physical // 1024 * 1020 + physical % 1024

    def columns(self, scan):
        """Name -> values, of the float columns and those of whole bytes."""
        points = scan.find("e:points", NS)
        fields = list(points.find("e:prototype", NS))
        begin = self.logical(int(points.get("fileOffset")))
        section, length, data, _ = struct.unpack("<B7xQQQ", self.bytes[begin:begin + 32])
        assert section == 1, "section id"
        at, streams = self.logical(data), [b""] * len(fields)
        while at < begin + length:
            kind, _, size = struct.unpack("<BBH", self.bytes[at:at + 4])
            if kind == 1:
                count, = struct.unpack("<H", self.bytes[at + 4:at + 6])
                assert count == len(fields), "byte streams"
                sizes = struct.unpack(f"<{count}H", self.bytes[at + 6:at + 6 + 2 * count])
                here = at + 6 + 2 * count
                for i, n in enumerate(sizes):
                    streams[i] += self.bytes[here:here + n]
                    here += n
            at += size + 1
        number = int(points.get("recordCount"))
        return {field.tag.split("}")[-1]: decoded(field, stream, number) for field, stream in zip(fields, streams)}


def decoded(field, stream, number):
    if field.get("type") == "Float":
        code = "f" if field.get("precision") == "single" else "d"
        return struct.unpack(f"<{number}{code}", stream)
    low, high = int(field.get("minimum")), int(field.get("maximum"))
    code = {255: "B", 65535: "H", 4294967295: "I"}[high - low]
    return [low + v for v in struct.unpack(f"<{number}{code}", stream)]


def moved(scan, point):
    pose = scan.find("e:pose", NS)

    def value(path):
        return float(pose.find(path, NS).text)

    w, x, y, z = (value(f"e:rotation/e:{c}") for c in "wxyz")
    assert math.isclose(w * w + x * x + y * y + z * z, 1, abs_tol=1e-12), "unit quaternion"
    t = [value(f"e:translation/e:{c}") for c in "xyz"]
    # p + 2 w (v x p) + 2 v x (v x p)
    a = cross((x, y, z), point)
    b = cross((x, y, z), a)
    return [point[i] + 2 * (w * a[i] + b[i]) + t[i] for i in range(3)]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def ply_points(path):
    """x y z scan intensity of a registered.ply of ours."""
    raw = Path(path).read_bytes()
    head, body = raw.split(b"end_header\n", 1)
    codes = {"double": "d", "float": "f", "uchar": "B", "ushort": "H", "uint": "I", "int": "i", "short": "h", "char": "b"}
    fields, count = [], 0
    for line in head.decode("latin1").splitlines():
        words = line.split()
        if words[:2] == ["element", "vertex"]:
            count = int(words[2])
        if words[:1] == ["property"]:
            fields.append((words[2], codes[words[1]]))
    layout = struct.Struct("<" + "".join(code for _, code in fields))
    names = [name for name, _ in fields]
    assert len(body) == count * layout.size
    return [dict(zip(names, values)) for values in layout.iter_unpack(body)]


def main():
    program, town = sys.argv[1:3]
    scans = [str(Path(town) / name) for name in ("000.ply", "001.ply", "002.ply")]
    small = ["--sampling.working-points", "20000", "--sampling.coarse-voxels", "4000", "--sampling.fine-voxels", "10000"]
    with tempfile.TemporaryDirectory() as folder:
        for kind in ("ply", "e57"):
            subprocess.run([program, "register", *scans, "--out", f"{folder}/{kind}", "--format", kind, "--each", *small],
                           check=True, capture_output=True)
        expected = ply_points(f"{folder}/ply/registered.ply")
        merged = E57(f"{folder}/e57/registered.e57")
        assert [s.find("e:name", NS).text for s in merged.scans] == ["000.ply", "001.ply", "002.ply"]
        number = 0
        for index, scan in enumerate(merged.scans):
            columns = merged.columns(scan)
            alone = E57(f"{folder}/e57/scans/00{index}.ply.e57")
            assert len(alone.scans) == 1 and alone.columns(alone.scans[0]) == columns, "--each has the same points"
            for x, y, z, intensity in zip(*(columns[c] for c in ("cartesianX", "cartesianY", "cartesianZ", "intensity"))):
                other = expected[number]
                assert other["scan"] == index and other["intensity"] == intensity, number
                distance = math.dist(moved(scan, (x, y, z)), (other["x"], other["y"], other["z"]))
                assert distance < 1e-11, (number, distance)
                number += 1
        assert number == len(expected), (number, len(expected))
        print(f"{number} points of {len(merged.scans)} scans: the same in E57 as in PLY")


if __name__ == "__main__":
    main()
