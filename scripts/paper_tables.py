#!/usr/bin/env python3
"""Makes the tables and figures of the paper, measured: TCM-ICP (robust and paper profile), ICP, feature based.

  paper_tables.py --out DIR [--quick] [--scenes SCENE...] [--exe TCM_ICP]

Tables 1-4 (time, iterations, RMS, error due to isolated points and feature blurring), bar charts, curves over noise,
occlusion and removal, and pictures, as CSV, Markdown, LaTeX and PNG. Data sets 1-4 after the paper are simulated: urban,
street, canopy, street (another seed). --scenes takes your own instead: folders of scans with a truth.json. Full: medians
over 5 seeds with their range, an hour on one core. --quick: smaller scans, one seed, one level, some 4 minutes on 2
cores.

--cell SET KIND PERCENT SEED METHOD repeats one measurement, from the simulation to the figures, and prints them beside
those of docs/results/cells.csv: --cell 2 noise 30 4 robust. Kinds: none, init, isolated, blur, noise, occlusion, remove.

It prints first how many runs it plans and what they cost. It can be interrupted and started again: finished cells (DIR/cells) are not run again, as long as the program is the
same; --methods runs the cells of some methods only. Beside the tables: commands.txt (every command line),
provenance.json (seeds, versions, commit). A cell without a figure says why. Needs numpy and matplotlib, and a tcm-icp
built with PCL (-DTCM_ICP_WITH_PCL=ON), which may be another one than --exe (--conventional-exe); without one it ends
with status 3 before anything is run, for a table without baselines says nothing. Without --exe, the tcm-icp on PATH is
measured, else the one in build/.
"""

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    sys.exit("paper_tables.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")
try:
    import matplotlib  # noqa: F401
except ImportError:
    sys.exit("paper_tables.py: matplotlib is missing: apt install python3-matplotlib, and run it with /usr/bin/python3")

from paper import charts, pictures
from paper.cells import CellStore, cell_name
from paper.executable import find_exe, require_baselines
from paper.formats import write_table
from paper.measure import initial_poses, judged, measure
from paper.methods import BY_KEY, CONVENTIONAL, METHODS, QUICK_SAMPLING, QUICK_SCENES
from paper.plan import FULL, ISOLATED_PERCENT, ROUGH_POSES, Extent, cells, spec
from paper.program import Program, Stopped
from paper.progress import Progress
from paper.provenance import REPOSITORY, program_id, record_tables, write_provenance
from paper.published import compare, published, row_of, write_cells
from paper.scenes import PAPER_SETS, SceneMaker, own_sets
from paper.standing import standing
from paper.table_rows import table

QUICK = Extent("quick", (1,), (30,), QUICK_SAMPLING, (*QUICK_SCENES, *ROUGH_POSES), 120)
PICTURED = "none", 0
# Processor time of one run with its evaluation [s], measured on two cores of an AMD EPYC: for the plan.
SECONDS = {"full": {"robust": 4, "paper": 4, "icp": 5, "features": 7}, "quick": {"robust": 2, "paper": 2, "icp": 3, "features": 4}}
PUBLISHED = REPOSITORY / "docs" / "results" / "cells.csv"


class Bench:
    """Runs cells, or finds them finished."""

    def __init__(self, options, extent, data_sets):
        self.out, self.extent, self.data_sets = options.out, extent, data_sets
        conventional = options.conventional_exe or options.exe
        log = options.out / "commands.txt"
        self.program = Program(options.exe, log, extent.time_limit_s)
        self.conventional = Program(conventional, log, extent.time_limit_s)
        self.ids = {m: program_id(conventional if m in CONVENTIONAL else options.exe) for m in BY_KEY}
        self.store = CellStore(options.out / "cells")
        self.scenes = SceneMaker(self.program, options.out / "scenes", extent.simulate)

    def spec(self, cell):
        return spec(*cell, self.extent, self.ids[cell[-1]])

    def kept_result(self, data_set, kind, method):
        return self.out / "results" / f"set{data_set.key}-{kind}-{method}"

    def run(self, cell):
        """The cell's result, and whether it was run now."""
        finished = self.store.get(self.spec(cell))
        if finished:
            return finished, False
        data_set, kind, percent, seed, method = cell
        scene, why = self.scenes.degraded(data_set, seed, kind, percent)
        extra = self.extent.register
        if kind == "init" and not why:
            guess, why = initial_poses(scene, method)
            extra += guess or ()
        if why:
            result = {"why": why}
        else:
            # The first seed's results are what the pictures show.
            keep = seed == self.extent.seeds[0] and kind in ("none", "isolated")
            program = self.conventional if method in CONVENTIONAL else self.program
            result = measure(program, scene, method, seed, self.out / "work" / cell_name(self.spec(cell)),
                             extra, self.kept_result(data_set, kind, method) if keep else None,
                             self.scenes.scene(data_set, seed)[0])
        self.store.put(self.spec(cell), result)
        return result, True

    def results_of(self, data_set, kind, percent, method):
        return [judged(self.store.get(self.spec((data_set, kind, percent, seed, method)))) for seed in self.extent.seeds]

    def picture_source(self, data_set, kind, percent, method):
        """Folder of the first seed's result, or why there is none."""
        folder = self.kept_result(data_set, kind, method)
        result = self.results_of(data_set, kind, percent, method)[0] or {"why": "not run"}
        return folder if folder.exists() and "why" not in result else result.get("why", "its files were not kept")


def print_plan(bench, todo, jobs):
    """How many cells are to be run, and about how long that takes."""
    missing = [cell for cell in todo if not bench.store.get(bench.spec(cell))]
    seconds = sum(SECONDS[bench.extent.name][cell[-1]] for cell in missing)
    by_method = ", ".join(f"{sum(c[-1] == m for c in missing)} {BY_KEY[m].name}" for m in BY_KEY if any(c[-1] == m for c in missing))
    print(f"{len(todo)} cells, {len(todo) - len(missing)} of them finished; to be run: {by_method or 'none'}; about "
          f"{seconds / 60:.0f} min of processor time, {seconds / 60 / jobs:.0f} min with {jobs} at a time", file=sys.stderr)


def repeat_cell(bench, words):
    """One cell, measured now whatever is kept, beside what was published."""
    key, kind, percent, seed, method = words
    data_set = next((d for d in bench.data_sets if d.key == key), None)
    if data_set is None or method not in BY_KEY:
        sys.exit(f"paper_tables.py: --cell: sets are {', '.join(d.key for d in bench.data_sets)}, methods {', '.join(BY_KEY)}")
    cell = (data_set, kind, float(percent), int(seed), method)
    bench.store.path(bench.spec(cell)).unlink(missing_ok=True)
    result, _ = bench.run(cell)
    mine = row_of(cell, result, bench.ids[method])
    print("\n".join(compare(mine, published(PUBLISHED, cell))))
    print("commands: " + str(bench.out / "commands.txt"))


def run_cells(bench, todo, jobs):
    progress = Progress(len(todo))

    def one(cell):
        result, was_run = bench.run(cell)
        data_set, kind, percent, seed, method = cell
        outcome = result.get("why") or f"{result['ok']}/{result['scans']} right, {result['cpu_s']:.1f} s"
        progress.step(f"set {data_set.key} {kind} {percent} seed {seed} {method}: {outcome}", was_run)

    with ThreadPoolExecutor(jobs) as pool:
        try:
            list(pool.map(one, todo))
        except (KeyboardInterrupt, Stopped):
            bench.program.stop()
            bench.conventional.stop()
            pool.shutdown(cancel_futures=True)
            sys.exit("\ninterrupted; the same command goes on where it was")


def note_of(extent):
    if extent.name == "quick":
        return f"Quick run: small scans (4 a scene, a return in 0.3 m), {len(extent.seeds)} seed, {len(extent.levels)} levels of degradation."
    scans = " (4 a scene, a return in 0.2 m)" if extent.simulate[:4] == FULL.simulate[:4] else ""
    return f"Full run: scans of moderate size{scans}, medians over {len(extent.seeds)} seeds, [least, largest]."


def tables_of(data_sets, curve_sets):
    return [*(f"table-set{d.key}" for d in data_sets), *(f"curves-set{d.key}" for d in curve_sets), "bars", "standing", "cells"]


def write_tables(bench, curve_sets):
    rows = []
    for cell in cells(bench.data_sets, curve_sets, bench.extent):
        result = bench.store.get(bench.spec(cell))
        if result:
            rows.append(row_of(cell, result, bench.ids[cell[-1]]))
    write_cells(bench.out / "cells.csv", rows)
    parts = [f"# Tables and figures\n\n{note_of(bench.extent)} RMS and distances are of the scans a method placed; the "
             "rows of right and wrong scans say how many those are. They are taken over the points of the undamaged scans.\n"]
    for data_set in bench.data_sets:
        header, rows = table(lambda kind, percent, m, d=data_set: bench.results_of(d, kind, percent, m))
        write_table(bench.out, f"table-set{data_set.key}", header, rows,
                    f"Performance of registration methods on {data_set.name}", note_of(bench.extent))
        parts.append("## " + (bench.out / f"table-set{data_set.key}.md").read_text(encoding="utf-8"))
    header, rows, comparisons = standing(bench.data_sets, curve_sets, bench.extent, bench.results_of)
    caption = (f"Where {BY_KEY['robust'].name} is neither best nor within 5 % of the best: {len(rows)} of {comparisons} medians "
               "of accuracy")
    write_table(bench.out, "standing", header, rows, caption, note_of(bench.extent))
    parts.append("## " + (bench.out / "standing.md").read_text(encoding="utf-8"))
    (bench.out / "tables.md").write_text("\n".join(parts), encoding="utf-8")


def draw(bench, curve_sets):
    note = note_of(bench.extent)
    charts.bar_charts(bench.out, bench.data_sets, bench.results_of, note)
    for data_set in curve_sets:
        charts.curves(bench.out, data_set, bench.extent.levels, bench.results_of, note)
    first, seed = bench.data_sets[0], bench.extent.seeds[0]
    rows, missing = [], []
    for data_set in bench.data_sets:
        scene, why = bench.scenes.scene(data_set, seed)
        if why:
            missing.append(f"{data_set.name}: {why}")
            continue
        rows.append((data_set.name, scene, {m.key: bench.picture_source(data_set, *PICTURED, m.key) for m in METHODS}))
        if data_set == first:
            pictures.before_registration(scene, bench.out / "before_registration.png",
                                         f"{data_set.name}: the scans as they lie in their files")
        result = bench.picture_source(data_set, *PICTURED, "robust")
        if isinstance(result, Path):
            pictures.correspondence_graph(scene, result, bench.out / f"graph-set{data_set.key}.png",
                                          f"Correspondence graph of {data_set.name}")
    if rows:
        pictures.gallery(rows, bench.out / "gallery.png")
    scene, why = bench.scenes.degraded(first, seed, "isolated", ISOLATED_PERCENT)
    result = bench.picture_source(first, "isolated", ISOLATED_PERCENT, "robust")
    if why or not isinstance(result, Path):
        missing.append(f"outliers.png: {why or result}")
    else:
        pictures.outliers(scene, result, bench.out / "outliers.png",
                          f"{first.name} with {ISOLATED_PERCENT} % isolated points: outlier removal of one scan, from the side")
    for line in missing:
        print("not drawn: " + line, file=sys.stderr)


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("--out", type=Path, required=True)
    ap.add_argument("--quick", action="store_true", help="small scans, one seed, one level")
    ap.add_argument("--scenes", nargs="+", help="your own scenes in place of the simulated ones")
    ap.add_argument("--exe", type=Path, help="the program to measure, in place of the one on PATH or in build/")
    ap.add_argument("--conventional-exe", type=Path, help="for ICP and features, where --exe was built without PCL")
    ap.add_argument("--methods", nargs="+", choices=list(BY_KEY), help="run these only; the others' finished cells count")
    ap.add_argument("--seeds", type=int, nargs="+", help="in place of 1 to 5, or 1 with --quick")
    ap.add_argument("--levels", type=int, nargs="+", help="of the curves [%%], in place of 10, 30, 50, or 30 with --quick")
    ap.add_argument("--jobs", type=int, help="runs at a time: 1, or 2 with --quick; more than the idle cores disturb the times")
    ap.add_argument("--plan", action="store_true", help="say what is to be run and what it costs, and stop")
    ap.add_argument("--cell", nargs=5, metavar=("SET", "KIND", "PERCENT", "SEED", "METHOD"), help="repeat one measurement")
    ap.add_argument("--draw-only", action="store_true", help="tables and figures of the cells that are there")
    options = ap.parse_args()
    options.exe = find_exe("paper_tables.py", options.exe)
    if options.conventional_exe:
        options.conventional_exe = find_exe("paper_tables.py", options.conventional_exe)
    asked = [options.cell[-1]] if options.cell else options.methods or CONVENTIONAL
    if not options.draw_only and not options.plan and set(asked) & set(CONVENTIONAL):
        require_baselines("paper_tables.py", options.conventional_exe or options.exe)
    extent = QUICK if options.quick else FULL
    if options.seeds:
        extent = replace(extent, seeds=tuple(options.seeds))
    if options.levels:
        extent = replace(extent, levels=tuple(options.levels))
    try:
        data_sets = own_sets(options.scenes) if options.scenes else list(PAPER_SETS)
    except ValueError as e:
        sys.exit(f"paper_tables.py: {e}")
    options.out.mkdir(parents=True, exist_ok=True)
    curve_sets = data_sets if options.scenes else [d for d in data_sets if d.key in ("2", "3")]
    bench = Bench(options, extent, data_sets)
    if options.cell:
        repeat_cell(bench, options.cell)
        return
    found = write_provenance(options.out, options.exe, extent, options.conventional_exe)
    if not options.draw_only:
        methods = [BY_KEY[key] for key in options.methods] if options.methods else METHODS
        todo, jobs = cells(data_sets, curve_sets, extent, methods), options.jobs or (2 if options.quick else 1)
        print_plan(bench, todo, jobs)
        if options.plan:
            return
        run_cells(bench, todo, jobs)
    write_tables(bench, curve_sets)
    draw(bench, curve_sets)
    record_tables(options.out, tables_of(data_sets, curve_sets), found)
    print((options.out / "tables.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
