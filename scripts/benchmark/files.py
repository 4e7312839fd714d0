"""Reading and writing clouds: millions of points a second on one core."""

import numpy as np

from benchmark.spent import OPEN3D_PYTHON, Missing, json_of, require, run, say
from paper.provenance import REPOSITORY
from ply import header_of_points

HEADER = ("format", "operation", "program", "points", "processor time [s]", "million points/s", "times ours")
SIDE_M = 100.0


def made_up_points(count):
    """Seeded: walls and ground of a square, as a scanner's file has them, in metres with 0.1 mm."""
    rng = np.random.default_rng(1)
    points = rng.uniform(0, SIDE_M, (count, 3))
    points[: count // 2, 2] = rng.normal(0, 0.01, count // 2)
    return np.round(points, 4)


def write_files(folder, num_points):
    """{format: file}. Text has two fifths of the points."""
    points = made_up_points(num_points)
    raw = points.astype("<f4").tobytes()
    files = {"PLY": folder / "cloud.ply", "PCD": folder / "cloud.pcd", "text": folder / "cloud.xyz"}
    files["PLY"].write_bytes(header_of_points(num_points, "float") + raw)
    files["PCD"].write_bytes((f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {num_points}\n"
                              f"HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {num_points}\nDATA binary\n").encode() + raw)
    np.savetxt(files["text"], points[: 2 * num_points // 5], fmt="%.4f")
    return files


class CloudCompare:
    """A whole program: what it takes to open a cloud of a few points is taken off."""

    def __init__(self, folder):
        require("CloudCompare", "cloudcompare")
        tiny = folder / "tiny.xyz"
        tiny.write_text("0 0 0\n1 0 0\n0 1 0\n0 0 1\n", encoding="ascii")
        self.idle_s = min(self.seconds(tiny) for _ in range(3))

    @staticmethod
    def seconds(file, *words):
        return run(["CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-O", file, *words]).cpu_s

    def __call__(self, file, out):
        read_s = self.seconds(file) - self.idle_s
        if out is None:
            return {"read_s": read_s}
        words = ("-NO_TIMESTAMP", "-C_EXPORT_FMT", "PLY", "-PLY_EXPORT_FMT", "BINARY_LE", "-SAVE_CLOUDS", "FILE", out)
        return {"read_s": read_s, "write_s": self.seconds(file, *words) - self.idle_s - read_s}


def by_command(*words):
    def measure(file, out):
        return json_of([*words, file] + ([] if out is None else [out]))
    return measure


def programs(folder, cloud_io):
    """{name: function of file and output}; those that are missing are said to be."""
    out = {"TCM-ICP": by_command(cloud_io, "tcm-icp"), "PCL": by_command(cloud_io, "pcl"),
           "Open3D": by_command(OPEN3D_PYTHON, REPOSITORY / "scripts/benchmark/open3d_io.py")}
    try:
        out["CloudCompare"] = CloudCompare(folder)
    except Missing as missing:
        say(f"left out: {missing}")
    return out


def measure(folder, cloud_io, num_points, rounds):
    """Rows of HEADER; the least of so many rounds, in which programs take turns."""
    files = write_files(folder, num_points)
    least, counts = {}, {name: 2 * num_points // 5 if name == "text" else num_points for name in files}
    refused, known = set(), programs(folder, cloud_io)
    for _ in range(rounds):
        for name, program in known.items():
            for kind, file in files.items():
                if (name, kind) in refused:
                    continue
                out = folder / f"written-{name}.ply" if kind == "PLY" else None
                try:
                    cost = program(file, out)
                except (RuntimeError, ValueError, OSError) as error:
                    say(f"{name}, {kind}: left out: {error}")
                    refused.add((name, kind))
                    continue
                if cost.get("points", counts[kind]) != counts[kind]:
                    say(f"{name}, {kind}: left out: {cost['points']} points instead of {counts[kind]}")
                    refused.add((name, kind))
                    continue
                for operation in ("read", "write") if out else ("read",):
                    key = (kind, operation, name)
                    least[key] = min(least.get(key, np.inf), cost[f"{operation}_s"])
    rows = []
    for kind, operation, name in sorted(least, key=lambda k: (k[1], k[0])):
        seconds = least[kind, operation, name]
        rows.append((kind, operation, name, counts[kind], f"{seconds:.3f}", f"{counts[kind] / seconds / 1e6:.1f}",
                     f"{seconds / least[kind, operation, 'TCM-ICP']:.2f}"))
    return rows
