#!/usr/bin/env python3
"""Measures this program beside PCL, Open3D and CloudCompare in one run: one command, ratios that can be compared.

  bench.py --out DIR [--parts files formats pairs sets growth volume] [--exe TCM_ICP] [--scenes DIR...] [--points N] [--docs]

  files    reading and writing a cloud of --points points (5 million): PLY, PCD, text
  formats  reading every format, coordinates alone and with all attributes: ours alone
  pairs    registration of a pair from eight starts near the truth
  sets     whole sets without initial poses: simulated scenes, and the folders of scans and truth.json in --scenes
  growth   our own time and memory against points, scans and threads
  volume   ten scans of 100 million points together, beside merely reading and writing them (4 GB in DIR)

DIR gets a CSV file for each part, pictures, tables.md and provenance.json. --docs copies them to docs/results and docs/images. A part's table
that is there is used again. All parts take about an hour; keep the machine quiet meanwhile. Processor time of one core, all of
it, is what is compared. Builds what it needs of benchmarks/ in build/bench. A program that is missing is left out, and said to be.
Needs python3-numpy, python3-matplotlib and what `install_dependencies.sh --benchmarks --comparison --outside` installs.
"""

import argparse
import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401

    from benchmark import charts
except ImportError:
    sys.exit("bench.py: apt install python3-numpy python3-matplotlib, and run it with /usr/bin/python3")

from benchmark import files, formats, growth, pairs, sets, volume
from benchmark.spent import say
from paper.executable import find_exe
from paper.provenance import REPOSITORY, add_tables, origin

BUILD = REPOSITORY / "build" / "bench"
PROGRAMS = BUILD / "benchmarks"
TARGETS = ("tcm_icp_cloud_io", "tcm_icp_benchmark_registration", "tcm_icp_pcl_multiway", "tcm_icp_read_formats")
TITLES = {"files": "Reading and writing", "formats": "Reading by format", "pairs": "Registration of a pair",
          "sets": "Whole sets without initial poses", "growth": "Growth", "volume": "Very many points"}
MODULES = {"files": files, "formats": formats, "pairs": pairs, "sets": sets, "growth": growth, "volume": volume}
ROUNDS = 3


def build():
    for command in (["cmake", "--preset", "release", "-B", BUILD, "-DTCM_ICP_BUILD_BENCHMARKS=ON", "-DTCM_ICP_BUILD_TESTS=OFF"],
                    ["cmake", "--build", BUILD, "--parallel", "--target", *TARGETS]):
        done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"bench.py: {' '.join(map(str, command[:2]))} failed; are the packages of --benchmarks installed?\n"
                     + done.stdout[-2000:] + done.stderr[-2000:])


def measure(part, work, arguments, exe):
    if part == "files":
        return files.measure(work, PROGRAMS / TARGETS[0], arguments.points, ROUNDS)
    if part == "formats":
        return formats.measure(work, PROGRAMS / TARGETS[3], arguments.points)
    if part == "pairs":
        town = REPOSITORY / "datasets" / "town"
        words = [word for scene in [town, *arguments.scenes]
                 for word in ("--pair", *sorted(scene.glob("*.ply"))[:2], scene / "truth.json")]
        return pairs.measure(work, PROGRAMS / TARGETS[1], words)
    if part == "sets":
        return sets.measure(work, exe, PROGRAMS / TARGETS[2], arguments.scenes, arguments.cpu_limit)
    if part == "volume":
        return volume.measure(work, exe, PROGRAMS / TARGETS[0], arguments.volume)
    return growth.measure(work, exe)


def table(part, arguments, exe):
    """(header, rows) of a part, measured where DIR has none."""
    header = MODULES[part].HEADER
    path = arguments.out / f"bench-{part}.csv"
    if not path.exists():
        work = arguments.out / part
        work.mkdir(exist_ok=True)
        rows = measure(part, work, arguments, exe)
        with open(path, "w", newline="", encoding="utf-8") as f:
            csv.writer(f).writerows([header, *rows])
        add_tables(arguments.out, {f"bench-{part}": origin(exe)})
    with open(path, newline="", encoding="utf-8") as f:
        rows = list(csv.reader(f))
    if tuple(rows[0]) != header:
        sys.exit(f"bench.py: {path} is of another version of this script: remove it")
    return header, [[int(cell) if cell.isdigit() else cell for cell in row] for row in rows[1:]]


def markdown(part, header, rows):
    lines = [f"## {TITLES[part]}", "", "| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join([*lines, *("| " + " | ".join(map(str, row)) + " |" for row in rows)]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="folder for tables, pictures and what is measured")
    parser.add_argument("--exe", type=Path, help="the tcm-icp to measure in sets and growth")
    parser.add_argument("--parts", nargs="+", choices=list(TITLES), default=list(TITLES))
    parser.add_argument("--scenes", nargs="+", type=Path, default=[], help="folders of scans and truth.json, for pairs and sets")
    parser.add_argument("--points", type=int, default=5_000_000, help="of the cloud that is read and written")
    parser.add_argument("--volume", type=int, default=100_000_000, help="points of the ten scans of volume")
    parser.add_argument("--cpu-limit", type=float, default=120, help="[s] of the others, for a set (compare_registration.py)")
    parser.add_argument("--docs", action="store_true", help="copy tables and pictures to docs/")
    arguments = parser.parse_args()
    for scene in arguments.scenes:
        if not (scene / "truth.json").exists():
            sys.exit(f"bench.py: --scenes {scene}: no truth.json in it")
    exe = find_exe("bench.py", arguments.exe)
    arguments.out.mkdir(parents=True, exist_ok=True)
    if any(not (arguments.out / f"bench-{part}.csv").exists() for part in arguments.parts if part != "growth"):
        say("builds benchmarks/ in build/bench")
        build()
    texts = []
    for part in arguments.parts:
        header, rows = table(part, arguments, exe)
        texts.append(markdown(part, header, rows))
        draw, picture = charts.PICTURES.get(part), arguments.out / f"results-bench-{part}.png"
        if draw:
            draw(rows, picture)
        if arguments.docs:
            known = json.loads((arguments.out / "provenance.json").read_text(encoding="utf-8"))["tables"]
            add_tables(REPOSITORY / "docs" / "results", {f"bench-{part}": known[f"bench-{part}"]})
            shutil.copy(arguments.out / f"bench-{part}.csv", REPOSITORY / "docs" / "results")
            if draw:
                shutil.copy(picture, REPOSITORY / "docs" / "images")
    (arguments.out / "tables.md").write_text("\n".join(texts), encoding="utf-8")
    print("\n".join(texts), end="")


if __name__ == "__main__":
    main()
