#!/usr/bin/env python3
"""Fits the models that tell how likely a link and a scan's place are right, to simulated scans that anyone can make.

  calibrate.py --out DIR [--exe TCM_ICP] [--seeds 1 2 3] [--jobs 2] [--only links|scans|calibration|scatter] [--check] [--dry-run]

Makes sets of every simulated scene with several sensors (calibration/sets.py), as they are, thinned, cropped, cluttered,
a few scans alone, with passers-by, a mirrored scan and scans of other scenes; registers each with `--confidence 0`, so that
wrong places are reported, too; fits, and writes lib/src/links/link_model.inc, lib/src/decision/scan_model.inc,
docs/results/calibration.csv and docs/images/reliability.png. Figures are of scenes left out of the fit, one at a time.
Decisions follow from links: after a change of the link model build the program and run again with --only scans, which leaves
the link model as it is. Figures and diagram are of both in either case.
Evidence that was added since the decisions' model was fitted makes its probabilities too low or too high: --only calibration fits
shift and slope of the log-odds that the program states, by two seeds or more, and writes lib/src/decision/scan_calibration.inc
and docs/images/decisions-reliability.png alone. Whatever was fitted before, build and do this last.
--only scatter writes docs/results/implied-hypotheses.csv, what fits show that start from right poses and from wrong ones, and
nothing else: figures in inference_options.hpp are set by it.
--check fits nothing: it writes docs/results/decisions-unseen.csv, how the probabilities hold that the program states, which is a
figure of its models where no fit has seen the seeds.
What DIR has already is used again. Needs numpy and matplotlib; about ten seconds of processor time a set.
"""

import argparse
import csv
import datetime
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

try:
    import numpy as np
except ImportError:
    sys.exit("calibrate.py: numpy is missing: apt install python3-numpy, and run it with /usr/bin/python3")

from calibration import labels, logistic, scatter, sets, softmin
from paper.provenance import add_tables, origin

ROOT = Path(__file__).resolve().parent.parent
# Of decisions: what tells a place from another; what more of speaks for a scan, and what against it.
PLACE = ("lead", "log_lead", "log_lead_a_pair", "lead_by_set")
FOR = PLACE + ("log_overlap", "log_inlier_share", "inliers_by_set", "few_agree")
AGAINST = ("residual_by_set", "weakest_left", "mean_left", "left_across", "violations", "opposed", "sigma")
CALIBRATION = ROOT / "lib/src/decision/scan_calibration.inc"
RIDGE = 2.0
SPREAD = 0.5  # of sets' own constants in log-odds; of 0, 0.5, 1 and 2 best where each run then learns its own


def make_sets(options):
    folder = options.out / "sets"
    jobs = [(scene, seed) for seed in options.seeds for scene in sets.SCENES]
    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda j: sets.simulate(options.exe, j[0], j[1], folder / f"plain-{j[0].name}-{j[1]}"), jobs))
    for k, (scene, seed) in enumerate(jobs):
        plain = folder / f"plain-{scene.name}-{seed}"
        other = folder / f"plain-{sets.SCENES[(k + 1 + seed) % len(sets.SCENES)].name}-{seed}"
        for variant in sets.VARIANTS[1:]:
            sets.make_variant(plain, variant, seed, other, folder / f"{variant}-{scene.name}-{seed}")
    return folder


def register_all(options, folder):
    results = options.out / "results"

    def register(data):
        out = results / data.name
        if (out / "report.json").exists():
            return
        results.mkdir(exist_ok=True)
        subprocess.run([options.exe, "register", *sorted(map(str, data.glob("*.ply"))), "--out", str(out), "--threads", "1",
                        "--confidence", "0", "--quiet"], check=False, stderr=subprocess.DEVNULL)
        (out / "registered.ply").unlink(missing_ok=True)

    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(register, [d for d in sorted(folder.iterdir()) if (d / "truth.json").exists()]))
    return results


def log_odds_of(probabilities):
    p = np.clip(probabilities, 1e-9, 1 - 1e-9)
    return np.log(p / (1 - p))


def names_of(header, array):
    text = (ROOT / "lib/internal/tcm_icp" / header).read_text()
    return re.findall(r'"(\w+)"', text[text.index(array): text.index("};", text.index(array))])


def braces(values):
    return "{" + ", ".join(f"{v:.5g}" for v in values) + "}"


def figures(name, log_odds, y):
    rows, error = logistic.reliability(log_odds, y)
    level = [np.log(p / (1 - p)) for p in (0.95, 0.99, 0.999)]
    return {"model": name, "rows": len(y), "right": int(y.sum()),
            "area_under_curve": round(logistic.area_under_curve(log_odds, y), 4),
            "log_loss": round(logistic.log_loss(log_odds, y), 4), "calibration_error": round(error, 4),
            **{f"right_above_{p}": round(float((log_odds[y > 0] >= t).mean()), 4)
               for p, t in zip(("0.95", "0.99", "0.999"), level)},
            **{f"wrong_above_{p}": int((log_odds[y == 0] >= t).sum())
               for p, t in zip(("0.95", "0.99", "0.999"), level)}}, rows


def head(options, count):
    command = f"scripts/calibrate.py --seeds {' '.join(map(str, options.seeds))}"
    return (f"// Made by `{command}` on {datetime.date.today()}; not to be changed by hand.\n"
            f"// Fitted to {count} of simulated sets; docs/results/calibration.csv has the figures of scenes left out.\n")


def fit_links(options, folder, results):
    X, y, scene, name_of_set = labels.load(folder, results, labels.hypotheses)
    names = names_of("links/link_measurements.hpp", "kLinkFeatureNames")
    blind, pose = names.index("blind"), names.index("blind") + 1
    searched = range(pose + 1, X.shape[1])  # the search knows nothing of viewpoints
    models, tables = [], []
    for name, part in (("hypothesis", X), ("pose", X[:, :pose])):
        def model():
            return logistic.Split(blind, searched, RIDGE, SPREAD)

        models.append(model().fit(part, y, name_of_set))
        tables.append(figures(name, logistic.held_out(model, part, y, scene, name_of_set), y))
    text = head(options, f"{len(y)} hypotheses ({int(y.sum())} right)")
    for name, model in zip(("kHypothesisModel", "kPoseModel"), models):
        halves = [f"{{{c:.5g},\n     {braces(np.pad(w, (0, X.shape[1] - len(w))))}}}"
                  for c, w in zip(model.constants, model.weights)]
        text += f"constexpr LinkModel {name}{{\n    {halves[0]},\n    {halves[1]}}};\n"
    if options.only != "scans":
        (ROOT / "lib/src/links/link_model.inc").write_text(text)
    return tables


def fit_scans(options, folder, results):
    X, y, scene, name_of_set = labels.load(folder, results, labels.decisions)
    names = names_of("decision/scan_decision.hpp", "kDecisionFeatureNames")
    place = [names.index(name) for name in PLACE]
    quality = [k for k in range(len(names)) if k not in place]
    signs = [(name in FOR) - (name in AGAINST) for name in names]

    def model():
        return softmin.TwoWays(place, quality, signs, RIDGE)

    whole = model().fit(X, y)
    text = head(options, f"{len(y)} decisions ({int(y.sum())} right)") + (
        f"const ScanModel kScanModel{{{whole.constants[0]:.5g}, {whole.constants[1]:.5g},\n"
        f"    {braces(whole.spread(0, X.shape[1]))},\n    {braces(whole.spread(1, X.shape[1]))},\n"
        f"    {braces(np.median(X[y > 0], 0))}}};\n")
    if options.only != "links":
        (ROOT / "lib/src/decision/scan_model.inc").write_text(text)
        write_calibration("// None: the model's own fit. `scripts/calibrate.py --only calibration` makes one.\n", 0, 1)
    return [figures("scan", logistic.held_out(model, X, y, scene, name_of_set), y)]


def write_calibration(text, shift, slope):
    CALIBRATION.write_text(text + f"constexpr ScanCalibration kScanCalibration{{{shift:.5g}, {slope:.5g}}};\n")


def calibrate_decisions(options, folder, results):
    """By what the program states, which is by the calibration it has."""
    stated, y, _, name_of_set = labels.load(folder, results, labels.probabilities)
    shift, slope = map(float, re.search(r"kScanCalibration{(.+), (.+)};", CALIBRATION.read_text()).groups())
    before = log_odds_of(stated[:, 0])
    log_odds = (before - shift) / slope
    _, seed = np.unique([name.rsplit("-", 1)[1] for name in name_of_set], return_inverse=True)
    held_out = np.zeros(len(y))
    for k in range(seed.max() + 1):
        a, b = logistic.rescale(log_odds[seed != k], y[seed != k])
        held_out[seed == k] = a + b * log_odds[seed == k]
    shift, slope = logistic.rescale(log_odds, y)
    tables = [figures(name, values, y) for name, values in (("as stated before", before), ("each seed held out", held_out))]
    for table, _ in tables:
        print(", ".join(f"{k} {v}" for k, v in table.items()))
    draw(tables, "decisions-reliability")
    command = f"scripts/calibrate.py --seeds {' '.join(map(str, options.seeds))} --only calibration"
    write_calibration(f"// Made by `{command}` on {datetime.date.today()}; not to be changed by hand.\n"
                      f"// Fitted to what the program stated of {len(y)} simulated decisions ({int(y.sum())} right).\n",
                      shift, slope)


def publish(options, name, rows):
    """A table of docs/results, with its origin, and on the terminal."""
    with open(ROOT / f"docs/results/{name}.csv", "w", newline="") as f:
        csv.writer(f).writerows(rows)
    add_tables(ROOT / "docs/results", {name: origin(options.exe)})
    for row in rows:
        print(*row, sep=", ")


def tell_scatter(options, folder, results):
    """What InferenceOptions::firm_left, loose_left and log_slid are set by."""
    X, y, _, _ = labels.load(folder, results, scatter.implied)
    publish(options, "implied-hypotheses", scatter.table(X, y))


def check(options, folder, results):
    """How many of the decisions that the program states at a probability and more are right."""
    stated, y, _, name_of_set = labels.load(folder, results, labels.probabilities)
    p, log_odds = stated[:, 0], log_odds_of(stated[:, 0])
    rows = [("Stated at least", "Decisions", "Right", "Wrong", "Of all that are right [%]")]
    for least in (0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 0.999):
        passes = p >= least
        right = int(y[passes].sum())
        rows.append((least, int(passes.sum()), right, int(passes.sum()) - right, round(100 * right / y.sum(), 1)))
    publish(options, "decisions-unseen", rows)
    print(f"{len(np.unique(name_of_set))} sets of seeds {options.seeds}: area under the curve "
          f"{logistic.area_under_curve(log_odds, y):.4f}, log loss {logistic.log_loss(log_odds, y):.4f}, "
          f"calibration error {logistic.reliability(log_odds, y)[1]:.4f}")


def draw(tables, name):
    try:
        from matplotlib import pyplot

        from paper.print_size import PAGE_IN, save
    except ImportError:
        print("calibrate.py: no diagram: apt install python3-matplotlib")
        return
    figure, axes = pyplot.subplots(1, len(tables), figsize=(PAGE_IN, 2.5))
    for axis, (table, rows) in zip(np.atleast_1d(axes), tables):
        stated, observed, count = np.array(rows).T
        axis.plot([0, 1], [0, 1], color="#aaaaaa", linewidth=1)
        axis.scatter(stated, observed, s=3 + 8 * np.log10(count), color="#1f5fa8")
        axis.set(title=f"{table['model']} (error {table['calibration_error']})", xlabel="stated probability",
                 ylabel="observed share", xlim=(0, 1), ylim=(0, 1))
    save(figure, ROOT / f"docs/images/{name}.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--exe", default=str(ROOT / "build/release/app/tcm-icp"))
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", choices=("links", "scans", "calibration", "scatter"), help="what is written")
    parser.add_argument("--check", action="store_true", help="fit nothing: judge what the program states")
    parser.add_argument("--dry-run", action="store_true", help="say how many sets there are, and stop")
    options = parser.parse_args()
    if options.only == "calibration" and len(set(options.seeds)) < 2:
        parser.error("--only calibration holds each seed out in turn: give --seeds two or more")
    count = len(options.seeds) * len(sets.SCENES) * len(sets.VARIANTS)
    print(f"{count} sets, about {10 * count / options.jobs / 60:.0f} minutes")
    if options.dry_run:
        return
    options.out.mkdir(parents=True, exist_ok=True)
    folder = make_sets(options)
    results = register_all(options, folder)
    if options.check:
        check(options, folder, results)
        return
    if options.only == "calibration":
        calibrate_decisions(options, folder, results)
        return
    if options.only == "scatter":
        tell_scatter(options, folder, results)
        return
    tables = fit_links(options, folder, results) + fit_scans(options, folder, results)
    for table, _ in tables:
        print(", ".join(f"{k} {v}" for k, v in table.items()))
    with open(ROOT / "docs/results/calibration.csv", "w", newline="") as f:
        writer = csv.DictWriter(f, tables[0][0].keys())
        writer.writeheader()
        writer.writerows(t for t, _ in tables)
    draw(tables, "reliability")


if __name__ == "__main__":
    main()
