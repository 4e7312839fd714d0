#!/usr/bin/env python3
"""Measures what each part of TCM-ICP is worth: one part replaced at a time.

  ablations.py --out DIR [--quick] [--scenes SCENE...] [--exe TCM_ICP] [--only KEY...]

LP solver (GLPK, CGAL), LP formulation, merge order, outlier removal, refinement and joint adjustment, and the stages
that search and decide, in rooms and bays of 8 scans: a table each, as
CSV and Markdown, with one sentence on what its figures say. Scenes, --quick, resuming and what lies beside the tables
are those of paper_tables.py, and a DIR of its --out is used again. --scans 12 and --scans 30 measure larger sets, where the
order of merging and joint programs may matter more. Without --exe, the tcm-icp on PATH is measured, else
the one in build/. Needs numpy.
"""

import argparse
import sys
from dataclasses import replace
from pathlib import Path

try:
    import numpy as np
except ImportError:
    sys.exit("ablations.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")

import json

from paper.cells import CellStore, cell_name
from paper.executable import find_exe
from paper.findings import finding
from paper.formats import markdown, write_table
from paper.measure import initial_poses, judged, measure
from paper.methods import QUICK_SAMPLING, QUICK_SCENES
from paper.plan import FULL, ROUGH_POSES, Extent
from paper.program import Program, Stopped
from paper.progress import Progress
from paper.provenance import program_id, record_tables, write_provenance
from paper.scenes import PAPER_SETS, SceneMaker, own_sets
from paper.summary import summarize
from paper.variants import ABLATIONS

QUICK = Extent("quick", (1,), (), QUICK_SAMPLING, (*QUICK_SCENES, *ROUGH_POSES), 120)

SECONDS_EACH = {"full": 5, "quick": 3}  # processor time of a run with its evaluation, for the plan


class Bench:
    def __init__(self, options, extent, data_sets):
        self.extent, self.data_sets, self.out = extent, data_sets, options.out
        self.program = Program(options.exe, options.out / "commands.txt", extent.time_limit_s)
        self.id = program_id(options.exe)
        self.store = CellStore(options.out / "cells")
        folder = "scenes" if options.scans is None else f"scenes-of-{options.scans}"
        self.scenes = SceneMaker(self.program, options.out / folder, extent.simulate)
        self.own_scenes = {a.key: SceneMaker(self.program, options.out / f"scenes-of-{a.key}", a.simulate)
                           for a in ABLATIONS if a.simulate}

    def cells(self, ablation):
        return [(d, s) for s in self.extent.seeds for d in ablation.data_sets or self.data_sets]

    def result(self, ablation, variant, data_set, seed):
        """The variant's figures and poses, and whether it was run now."""
        arguments = (*self.extent.register, *ablation.common, *variant.arguments)
        spec = {"ablation": ablation.key, "set": data_set.key, "scene": data_set.folder or data_set.scene, "seed": seed,
                "kind": ablation.kind, "percent": ablation.percent, "guess": ablation.from_guess,
                "arguments": list(arguments), "simulate": list(ablation.simulate or self.extent.simulate),
                "limit_s": self.extent.time_limit_s, "program": self.id}
        finished = self.store.get(spec)
        if finished:
            return finished, False
        scenes = self.own_scenes.get(ablation.key, self.scenes)
        scene, why = scenes.degraded(data_set, seed, ablation.kind, ablation.percent)
        if not why and ablation.from_guess:
            guess, why = initial_poses(scene, "robust")
            arguments += guess or ()
        if why:
            result = {"why": why}
        else:
            kept = self.out / "work" / (cell_name(spec) + "-kept")
            result = measure(self.program, scene, "robust", seed, self.out / "work" / cell_name(spec), arguments, kept,
                             scenes.scene(data_set, seed)[0])
            if "why" not in result:
                result["poses"] = {s["file"]: s["pose"] for s in
                                   json.loads((kept / "poses.json").read_text(encoding="utf-8"))["scans"]}
        self.store.put(spec, result)
        return result, True


def largest_difference(results, others):
    """Of the poses' entries (metres and cosines), between two variants on the same scenes; None where a run is missing
    or places other scans."""
    largest = 0.0
    for a, b in zip(results, others):
        if "why" in a or "why" in b:
            return None
        for file, pose in a["poses"].items():
            if (pose is None) != (b["poses"][file] is None):
                return None
            if pose is not None:
                largest = max(largest, float(np.abs(np.array(pose) - np.array(b["poses"][file])).max()))
    return largest


def right(r):
    return 100 * r["ok"] / r["scans"]


def table(ablation, results):
    """@param results  a list for each variant, one a scene and seed"""
    header = ["Variant", "Scans right [%]", "Wrong [%]", "RMS [m]", "CPU s", "Simplex pivots", "s in the solver",
              "Other steps", "Poses differ from the first by"]
    rows, figures = [], []
    for variant, mine in zip(ablation.variants, results):
        of = lambda value: summarize(mine, value)
        share = [r for r in mine if "why" not in r]
        scans = sum(r["scans"] for r in share)
        total = lambda key: 100 * sum(r[key] for r in share) / scans if scans else None
        difference = largest_difference(mine, results[0])
        percent = lambda value, s: f"{value:.0f}" if value is not None else s.text()
        rows.append([variant.name, percent(total("ok"), of(right)), percent(total("wrong"), of(right)),
                     of(lambda r: r["rms"]).text(), of(lambda r: r["cpu_s"]).text(),
                     of(lambda r: r["iterations"]["simplex"]).text(4), of(lambda r: r["lp_seconds"]).text(2),
                     of(lambda r: r["iterations"]["descent"] + r["iterations"]["annealing"]).text(4),
                     f"{difference:.1e}" if difference is not None else "other scans are placed, or a run failed"])
        figures.append((variant.name, total("ok"), of(lambda r: r["rms"]).median, of(lambda r: r["cpu_s"]).median))
    return header, rows, finding(figures)


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("--out", type=Path, required=True)
    ap.add_argument("--quick", action="store_true", help="small scans, one seed")
    ap.add_argument("--scenes", nargs="+", help="your own scenes in place of the simulated ones")
    ap.add_argument("--exe", type=Path, help="the program to measure, in place of the one on PATH or in build/")
    ap.add_argument("--scans", type=int, help="scans of a set, in place of 4; the tables get the number in their names")
    ap.add_argument("--seeds", type=int, nargs="+", help="in place of 1 to 5, or 1 with --quick")
    ap.add_argument("--only", nargs="+", choices=[a.key for a in ABLATIONS], help="these ablations")
    options = ap.parse_args()
    options.exe = find_exe("ablations.py", options.exe)
    extent = QUICK if options.quick else FULL
    if options.seeds:
        extent = replace(extent, seeds=tuple(options.seeds))
    suffix = ""
    if options.scans is not None:
        simulate = list(extent.simulate)
        simulate[simulate.index("--scans") + 1] = str(options.scans)
        extent = replace(extent, simulate=tuple(simulate))
        suffix = f"-{options.scans}-scans"
    try:
        data_sets = own_sets(options.scenes) if options.scenes else [d for d in PAPER_SETS if d.key != "4"]
    except ValueError as e:
        sys.exit(f"ablations.py: {e}")
    options.out.mkdir(parents=True, exist_ok=True)
    found = write_provenance(options.out, options.exe, extent)
    bench = Bench(options, extent, data_sets)
    # Those with scenes of their own are what they are for any --scans and --scenes.
    chosen = [a for a in ABLATIONS if a.key in options.only] if options.only else [
        a for a in ABLATIONS if not a.simulate or options.scans is None and not options.scenes and not options.quick]
    runs = sum(len(bench.cells(a)) * len(a.variants) for a in chosen)
    print(f"{runs} runs, those that are finished among them; about {runs * SECONDS_EACH[extent.name] * (options.scans or 4) / 4 / 60:.0f} min of "
          "processor time from the beginning", file=sys.stderr)
    progress = Progress(runs)
    parts = [f"# Ablations\n\n{extent.name.capitalize()} run: {', '.join(d.name for d in data_sets)}, where a table does not say otherwise; seeds "
             f"{', '.join(map(str, extent.seeds))}. Medians over all of them, [least, largest]; shares of scans over all "
             "scans.\n"]
    for ablation in chosen:
        results = []
        for variant in ablation.variants:
            results.append([])
            for data_set, seed in bench.cells(ablation):
                result, was_run = bench.result(ablation, variant, data_set, seed)
                results[-1].append(judged(result))
                outcome = result.get("why") or f"{result['ok']}/{result['scans']} right, {result['cpu_s']:.1f} s"
                progress.step(f"{ablation.key}, {variant.name}, set {data_set.key} seed {seed}: {outcome}", was_run)
        header, rows, sentence = table(ablation, results)
        name = f"ablation-{ablation.key}{suffix}"
        write_table(options.out, name, header, rows, ablation.title, sentence)
        parts.append(f"## {ablation.title}\n\n{markdown(header, rows)}\n{sentence}\n")
        record_tables(options.out, [name], found)
        (options.out / f"ablations{suffix}.md").write_text("\n".join(parts), encoding="utf-8")
    print("\n".join(parts))


if __name__ == "__main__":
    try:
        main()
    except (KeyboardInterrupt, Stopped):
        sys.exit("\ninterrupted; the same command goes on where it was")
