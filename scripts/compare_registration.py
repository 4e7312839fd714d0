#!/usr/bin/env python3
"""Compares tcm-icp with Open3D and PCL: same scenes, same machine, one core each, no initial poses.

  compare_registration.py SCENES --out DIR [--exe TCM_ICP] [--pcl PROGRAM] [--methods ...] [--only SCENE...]

SCENES is a folder of scenes: scans (binary PLY) and their truth.json. Methods, all of them by default:
  tcm-icp        register --threads 1
  open3d-ransac  scripts/open3d_multiway.py: FPFH, RANSAC, ICP, pose graph, global optimisation
  open3d-fgr     the same with fast global registration
  pcl            FPFH, SampleConsensusPrerejective, ICP, maximum spanning tree (build target tcm_icp_pcl_multiway,
                 configured with -DTCM_ICP_BUILD_BENCHMARKS=ON)
The rivals choose their voxel size from the data, by their own fitness, and give scans up by their own rule; both are
described at the top of their programs. `CPU s` is all of it, `one size` the same without the
sizes that were not chosen.
Scenes may be named KIND-SCENE: comparison.csv, a row a scene and a column a program, has a total for each kind.
Each run is pinned to one core. After --cpu-limit seconds of CPU a rival finishes its first voxel size, begins no other
pair and answers from the sizes that are done; the run is killed at ten times the limit, and its scans count as flagged. DIR gets poses and logs, table.md,
table.csv, comparison.csv, provenance.json, and the command lines in commands.txt. Scoring: scripts/score_poses.py. Needs numpy.
It can be interrupted and started again: a run that gave an answer (DIR/runs) is not made again, as long as its program and command line are the same.
"""

import argparse
import csv
import json
import os
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILD = HERE.parent / "build" / "release"
METHODS = ("tcm-icp", "open3d-ransac", "open3d-fgr", "pcl")
COLUMNS = ("scene", "method", "scans ok", "flagged", "WRONG", "CPU s", "one size", "wall s", "peak MB", "note")

from benchmark.side_by_side import side_by_side
from benchmark.spent import forget_peak

from paper.cells import CellStore
from paper.provenance import add_tables, origin, program_id

try:
    from score_poses import score_poses
except ImportError:
    sys.exit("compare_registration.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")


def command(method, scans, work, options):
    """The command line of a run, and where its poses will lie."""
    limit = str(options.cpu_limit)
    seed = str(options.seed)
    if method == "tcm-icp":
        return [options.exe, "register", *scans, "--out", work / "result", "--threads", "1", "--seed",
                seed], work / "result" / "poses.json"
    poses = work / "poses.json"
    if method == "pcl":
        return [options.pcl, poses, seed, limit, *scans], poses
    return [options.python, HERE / "open3d_multiway.py", *scans, "--out", poses, "--variant",
            method.removeprefix("open3d-"), "--seed", seed, "--cpu-limit", limit], poses


def run_pinned(cmd, log, core, cpu_limit):
    """(exit code, CPU s, wall s, peak MB) of a program on one core; killed at ten times the limit."""
    hard_limit = int(10 * cpu_limit) + 60

    def pin():
        os.sched_setaffinity(0, {core})
        resource.setrlimit(resource.RLIMIT_CPU, (hard_limit, hard_limit + 5))

    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    forget_peak()
    begin = time.monotonic()
    with open(log, "wb") as out:
        child = subprocess.Popen(cmd, stdout=out, stderr=subprocess.STDOUT, env=environment, preexec_fn=pin)
        killer = threading.Timer(20 * hard_limit, child.kill)  # for a program that waits for ever
        killer.start()
        _, status, usage = os.wait4(child.pid, 0)
        killer.cancel()
    child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024


def chosen_size(poses, cpu_s):
    """What a rival says about the voxel sizes it tried: (CPU s without the others, note)."""
    answer = json.loads(poses.read_text(encoding="utf-8"))
    if "chosen_multiple" not in answer:
        return None, ""
    chosen = answer["chosen_multiple"]
    tried = [f"{t['multiple']:g}" + ("(time)" if t.get("out_of_time") else "") for t in answer["tried"]]
    cpu_s -= sum(t["cpu_s"] for t in answer["tried"] if t["multiple"] != chosen)
    return cpu_s, f"voxel {chosen:g} x spacing of {', '.join(tried)}"


def program_of(method, options):
    """What makes a run another one when its version changes."""
    return {"tcm-icp": options.exe, "pcl": options.pcl}.get(method, HERE / "open3d_multiway.py")


def run_of(scene, method, options):
    """One run with its score, made now or before: scene, method, scans, ok, flagged, wrong, cpu_s, one_size_s (None: one was tried), wall_s,
    peak_mb, note, unanswered."""
    work = options.out / scene.name / method
    files = [s["file"] for s in json.loads((scene / "truth.json").read_text(encoding="utf-8"))["scans"]]
    cmd, poses = command(method, [scene / f for f in files], work, options)
    cmd = [str(c) for c in cmd]
    with open(options.out / "commands.txt", "a", encoding="utf-8") as f:
        f.write(shlex.join(cmd) + "\n")
    store = CellStore(options.out / "runs")
    spec = {"scene": scene.name, "method": method, "program": program_id(program_of(method, options)), "command": cmd,
            "cpu_limit_s": options.cpu_limit}
    run = store.get(spec)
    if run is None:
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        run = new_run(scene, method, cmd, work, poses, len(files), options)
        if not run["unanswered"]:
            store.put(spec, run)
    return run


def new_run(scene, method, cmd, work, poses, num_scans, options):
    code, cpu_s, wall_s, peak_mb = run_pinned(cmd, work / "log.txt", options.core, options.cpu_limit)
    one_size_s = None
    if poses.exists():
        counts, details = score_poses(scene, poses)
        (work / "score.json").write_text(json.dumps(details, indent=1), encoding="utf-8")
        one_size_s, note = chosen_size(poses, cpu_s)
    else:
        counts = {"scans": num_scans, "ok": 0, "flagged": num_scans, "wrong": 0}
        why = "CPU limit" if -code in (signal.SIGXCPU, signal.SIGKILL) else f"exit code {code}"
        note = f"no answer: {why}"
    return {"scene": scene.name, "method": method, **counts, "cpu_s": cpu_s, "one_size_s": one_size_s, "wall_s": wall_s, "peak_mb": peak_mb,
            "note": note, "unanswered": not poses.exists()}


def table_row(r):
    """In the order of COLUMNS."""
    one_size = "" if r["one_size_s"] is None else f"{r['one_size_s']:.1f}"
    return (r["scene"], r["method"], f"{r['ok']}/{r['scans']}", r["flagged"], r["wrong"], f"{r['cpu_s']:.1f}", one_size, f"{r['wall_s']:.1f}",
            f"{r['peak_mb']:.0f}", r["note"])


def markdown(row):
    return "| " + " | ".join(str(cell) for cell in row) + " |"


def write_tables(runs, folder):
    rows = [table_row(r) for r in runs]
    lines = [markdown(COLUMNS), "|" + "---|" * len(COLUMNS), *map(markdown, rows)]
    (folder / "table.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    header, by_scene = side_by_side(runs)
    for name, table in (("table.csv", [COLUMNS, *rows]), ("comparison.csv", [header, *by_scene])):
        with open(folder / name, "w", newline="", encoding="utf-8") as f:
            csv.writer(f).writerows(table)


def check_programs(options):
    """What is missing is said before anything runs."""
    missing = []
    if "tcm-icp" in options.methods and not options.exe.exists():
        missing.append(f"{options.exe}: cmake --preset release && cmake --build --preset release")
    if "pcl" in options.methods and not options.pcl.exists():
        missing.append(f"{options.pcl}: apt install libpcl-dev libbenchmark-dev, cmake --preset release "
                       "-DTCM_ICP_BUILD_BENCHMARKS=ON, cmake --build build/release --target tcm_icp_pcl_multiway")
    if any(m.startswith("open3d") for m in options.methods):
        if subprocess.run([options.python, "-c", "import open3d"], capture_output=True, check=False).returncode != 0:
            missing.append(f"Open3D for {options.python}: apt install python3-open3d")
    if missing:
        sys.exit("compare_registration.py: what is not there, or leave it out with --methods:\n  " + "\n  ".join(missing))


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("scenes", type=Path)
    ap.add_argument("--out", type=Path, required=True)
    ap.add_argument("--exe", type=Path, default=BUILD / "app" / "tcm-icp")
    ap.add_argument("--pcl", type=Path, default=BUILD / "benchmarks" / "tcm_icp_pcl_multiway")
    ap.add_argument("--python", default="/usr/bin/python3", help="that has Open3D")
    ap.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS)
    ap.add_argument("--only", nargs="+", help="names of scenes")
    ap.add_argument("--cpu-limit", type=float, default=600, help="[s] of CPU for a scene")
    ap.add_argument("--core", type=int, default=0)
    ap.add_argument("--seed", type=int, default=1)
    options = ap.parse_args()
    check_programs(options)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "commands.txt").write_text(shlex.join(sys.argv) + "\n", encoding="utf-8")
    scenes = sorted(p.parent for p in options.scenes.glob("*/truth.json"))
    runs = []
    for scene in scenes:
        if options.only and scene.name not in options.only:
            continue
        for method in options.methods:
            runs.append(run_of(scene, method, options))
            print(markdown(table_row(runs[-1])), file=sys.stderr, flush=True)
            write_tables(runs, options.out)
    if not runs:
        sys.exit(f"compare_registration.py: {options.scenes}: no folder in it has a truth.json")
    add_tables(options.out, {"comparison": origin(options.exe)})
    print((options.out / "table.md").read_text(encoding="utf-8"), end="")


if __name__ == "__main__":
    main()
