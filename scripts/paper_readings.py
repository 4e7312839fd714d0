#!/usr/bin/env python3
"""Measures what the paper's text leaves open: readings of --profile paper, and ICP beside them, from rough initial poses.

  paper_readings.py --out DIR [--seeds N...] [--full] [--scenes SCENE...] [--only WORDS...] [--with OPTION...]

Data sets 1-4 of paper_tables.py, simulated (small scans; --full: its full size), seeds 1-3, scans off by up to 5 degrees
and 1 m; --scenes takes your own: folders of scans with truth.json and initial_poses.json, which are run once. A row a reading, as CSV and
Markdown: scans right and wrong, RMS, processor time. --with adds options to every reading ("--with paper.matches=mutual
refinement=none"). The plan and what it costs come first; it can be interrupted and started again, as paper_tables.py can.
Needs numpy, and a tcm-icp built with PCL for ICP. Without --exe, the tcm-icp on PATH is measured, else the one in build/.
"""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from statistics import median

from paper.cells import CellStore, cell_name
from paper.executable import find_exe, has_baselines
from paper.formats import markdown, write_table
from paper.measure import initial_poses, judged, measure
from paper.methods import QUICK_SAMPLING, QUICK_SCENES
from paper.plan import FULL, ROUGH_POSES
from paper.program import Program, Stopped
from paper.progress import Progress
from paper.provenance import program_id, record_tables, write_provenance
from paper.readings import ICP, READINGS
from paper.scenes import PAPER_SETS, SceneMaker, own_sets
from paper.summary import number

SMALL = replace(FULL, name="small", seeds=(1, 2, 3), levels=(), register=QUICK_SAMPLING,
                simulate=(*QUICK_SCENES, *ROUGH_POSES), time_limit_s=300)
SECONDS_EACH = {"small": 4, "full": 15}  # of one reading on one set, for the plan


class Bench:
    def __init__(self, options, extent):
        self.extent = extent
        self.program = Program(options.exe, options.out / "commands.txt", extent.time_limit_s)
        self.id = program_id(options.exe)
        self.store = CellStore(options.out / "cells")
        self.scenes = SceneMaker(self.program, options.out / "scenes", extent.simulate)
        self.work = options.out / "work"

    def result(self, reading, data_set, seed):
        """Figures of one reading on one set, or {"why": ...}; and whether it was run now."""
        arguments = (*self.extent.register, *reading.arguments)
        spec = {"set": data_set.key, "scene": data_set.folder or f"{data_set.scene}+{data_set.seed_offset}", "seed": seed,
                "arguments": list(arguments), "simulate": list(self.extent.simulate), "program": self.id}
        finished = self.store.get(spec)
        if finished:
            return finished, False
        scene, why = self.scenes.scene(data_set, seed)
        guess, why = initial_poses(scene, "paper") if not why else (None, why)
        # The method's own words come from the reading: measure() only knows the four methods of the tables.
        result = {"why": why} if why else measure(self.program, scene, "robust", seed, self.work / cell_name(spec),
                                                  (*arguments, *guess))
        self.store.put(spec, result)
        return result, True


def row(reading, results, keys):
    """Shares over all scans but the references, medians over the runs; the share of right scans of each set in the end."""
    results = [(key, judged(r)) for key, r in results]
    known = [r for _, r in results if "why" not in r]
    if not known:
        return [reading.question, reading.name, *["-"] * (4 + len(keys))]

    def right(of):
        return number(100 * sum(r["ok"] - 1 for r in of) / sum(r["scans"] - 1 for r in of))

    rms = [r["rms"] for r in known if r["rms"] is not None]
    by_set = [[r for key, r in results if key == k and "why" not in r] for k in keys]
    wrong = 100 * sum(r["wrong"] for r in known) / sum(r["scans"] - 1 for r in known)
    return [reading.question, reading.name, right(known), number(wrong), number(median(rms)) if rms else "none is placed",
            number(median(r["cpu_s"] for r in known)), *(right(of) if of else "-" for of in by_set)]


def with_added(arguments, added):
    """What is added wins over what the reading says."""
    out = list(arguments)
    for option in added:
        name, value = option.split("=", 1)
        if "--" + name in out:
            out[out.index("--" + name) + 1] = value
        else:
            out += ["--" + name, value]
    return tuple(out)


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("--out", type=Path, required=True)
    ap.add_argument("--exe", type=Path, help="the program to measure, in place of the one on PATH or in build/")
    ap.add_argument("--seeds", type=int, nargs="+", help="in place of 1 to 3")
    ap.add_argument("--full", action="store_true", help="scans of the size of the full tables")
    ap.add_argument("--scenes", nargs="+", help="your own scenes in place of the simulated ones")
    ap.add_argument("--only", nargs="+", help="readings whose question or name has one of these words")
    ap.add_argument("--with", nargs="+", default=[], dest="added", metavar="OPTION=VALUE", help="--OPTION VALUE for all readings of the paper")
    options = ap.parse_args()
    options.exe = find_exe("paper_readings.py", options.exe)
    extent = replace(SMALL, name="full", simulate=FULL.simulate, register=()) if options.full else SMALL
    extent = replace(extent, seeds=tuple(options.seeds or ((1,) if options.scenes else extent.seeds)))
    try:
        data_sets = own_sets(options.scenes) if options.scenes else list(PAPER_SETS)
    except ValueError as e:
        sys.exit(f"paper_readings.py: {e}")
    chosen = []
    for r in (*READINGS, ICP):
        if options.only and not any(w in r.question + " " + r.name for w in options.only):
            continue
        if r == ICP and not has_baselines(options.exe):
            print("paper_readings.py: without PCL there is no ICP to compare with", file=sys.stderr)
            continue
        chosen.append(r if r == ICP else replace(r, arguments=with_added(r.arguments, options.added)))
    cells = [(r, d, seed) for seed in extent.seeds for d in data_sets for r in chosen]
    print(f"{len(cells)} runs: {len(chosen)} readings x {len(data_sets)} sets x seeds {', '.join(map(str, extent.seeds))}; "
          f"about {len(cells) * SECONDS_EACH[extent.name] / 60:.0f} min of processor time", file=sys.stderr)
    options.out.mkdir(parents=True, exist_ok=True)
    found = write_provenance(options.out, options.exe, extent)
    bench, progress = Bench(options, extent), Progress(len(cells))
    results = {r: [] for r in chosen}
    for r, data_set, seed in cells:
        result, was_run = bench.result(r, data_set, seed)
        results[r].append((data_set.key, result))
        progress.step(f"{r.name}, set {data_set.key} seed {seed}: {result.get('why') or str(result['ok']) + ' right'}", was_run)
    keys = [d.key for d in data_sets]
    header = ["Question", "Reading", "Right [%]", "Wrong [%]", "RMS [m]", "CPU s", *(f"right, {d.name} [%]" for d in data_sets)]
    rows = [row(r, results[r], keys) for r in chosen]
    write_table(options.out, "readings", header, rows, "Readings of the paper's method, from rough initial poses",
                f"{len(data_sets) * len(extent.seeds)} runs a row; shares of the scans but the references.")
    record_tables(options.out, ["readings"], found)
    print(markdown(header, rows))


if __name__ == "__main__":
    try:
        main()
    except (KeyboardInterrupt, Stopped):
        sys.exit("\ninterrupted; the same command goes on where it was")
