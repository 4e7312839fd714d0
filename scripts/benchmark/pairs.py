"""Registration of a pair from starts near the truth: time and error of every program, on the same sampled points."""

import json
import shutil

import numpy as np

from benchmark.spent import OPEN3D_PYTHON, Missing, json_of, require, run, say
from paper.provenance import REPOSITORY
from ply import read_points

HEADER = ("pair", "program", "method", "points", "processor time [ms]", "times ours", "rotation [deg]", "worst rotation [deg]",
          "rmse [mm]", "worst rmse [mm]")
OURS = "lp_5000"


def error_of(pair, source, T):
    """(rotation [deg], root mean square displacement [mm]) of T against the truth."""
    off = np.linalg.inv(np.array(pair["T_target_source"])) @ np.array(T)
    angle = 2 * np.arcsin(min(1.0, np.linalg.norm(off[:3, :3] - np.eye(3)) / np.sqrt(8)))
    moved = source @ off[:3, :3].T + off[:3, 3]
    return np.degrees(angle), 1000 * np.sqrt(((moved - source) ** 2).sum(axis=1).mean())


def summary(times_s, errors):
    rotations, rmse = np.array(errors).T
    return (1000 * np.mean(times_s), np.median(rotations), rotations.max(), np.median(rmse), rmse.max())


def of_benchmark(program, folder, arguments):
    """{(pair, program, method): summary} of ours and PCL; `folder` gets what they were given."""
    results = folder / "registration.json"
    run([program, "--dump", folder / "pairs", *arguments, "--benchmark_out_format=json", f"--benchmark_out={results}"])
    out = {}
    for entry in json.loads(results.read_text(encoding="utf-8"))["benchmarks"]:
        pair, method = entry["run_name"].split("/")[:2]
        name, method = ("PCL", method.removeprefix("pcl_")) if method.startswith("pcl_") else ("TCM-ICP", method)
        out[pair, name, method] = (entry["cpu_time"], entry["rotation_deg"], entry["worst_rotation_deg"],
                                   1000 * entry["rmse_m"], 1000 * entry["worst_rmse_m"])
    return out


def of_open3d(folder, pair, source):
    answers = json_of([OPEN3D_PYTHON, REPOSITORY / "scripts/benchmark/open3d_pairs.py", folder])
    return {("Open3D", method): summary([r["cpu_s"] for r in runs], [error_of(pair, source, r["T_target_source"]) for r in runs])
            for method, runs in answers.items()}


def of_cloudcompare(folder, pair, source):
    """CloudCompare's ICP begins where the files are; of overlap it wants to be told, here 70 %."""
    require("CloudCompare", "cloudcompare")
    times_s, errors = [], []
    for number, start in enumerate(pair["starts"]):
        work = folder / f"cloudcompare-{number}"
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir()
        T = np.array(start)
        np.savetxt(work / "source.xyz", source @ T[:3, :3].T + T[:3, 3], fmt="%.7f")
        np.savetxt(work / "target.xyz", read_points(folder / "target.ply"), fmt="%.7f")
        both = ["CloudCompare", "-SILENT", "-NO_TIMESTAMP", "-AUTO_SAVE", "OFF", "-O", "source.xyz", "-O", "target.xyz"]
        idle_s = run(both, cwd=work).cpu_s
        spent = run([*both, "-ICP", "-ITER", "100", "-OVERLAP", "70"], cwd=work)
        matrix = np.loadtxt(next(work.glob("*REGISTRATION_MATRIX*.txt")))
        times_s.append(spent.cpu_s - idle_s)
        errors.append(error_of(pair, source, matrix @ T))
    return {("CloudCompare", "icp"): summary(times_s, errors)}


def measure(folder, program, arguments):
    """Rows of HEADER, pair by pair."""
    found = of_benchmark(program, folder, arguments)
    points = {}
    for place in sorted((folder / "pairs").glob("*/pair.json")):
        pair, name = json.loads(place.read_text(encoding="utf-8")), place.parent.name
        source = read_points(place.parent / "source.ply")
        points[name] = len(source)
        for others in (of_open3d, of_cloudcompare):
            try:
                found.update({(name, *key): value for key, value in others(place.parent, pair, source).items()})
            except (Missing, RuntimeError, StopIteration, ValueError) as error:
                say(f"{name}, {others.__name__[3:]}: left out: {error}")
    rows = []
    for (pair, name, method), (ms, rotation, worst_rotation, rmse, worst_rmse) in found.items():
        rows.append((pair, name, method.replace("_", " "), points[pair], f"{ms:.0f}", f"{ms / found[pair, 'TCM-ICP', OURS][0]:.1f}",
                     f"{rotation:.4f}", f"{worst_rotation:.4f}", f"{rmse:.1f}", f"{worst_rmse:.1f}"))
    return sorted(rows, key=lambda row: row[0])
