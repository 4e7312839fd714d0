"""Where the robust profile is neither best nor within 5 % of the best: every accuracy row of the tables, every point of
the curves."""

from paper.methods import BY_KEY
from paper.plan import CURVES, TABLE_KINDS
from paper.summary import number, summarize

WITHIN = 1.05
# Name, value of a result, whether more is better.
CRITERIA = (
    ("RMS [m]", lambda r: r["rms"], False),
    ("Mean cloud-to-cloud distance [m]", lambda r: r["c2c_mean"], False),
    ("Scans right [%]", lambda r: 100 * r["ok"] / r["scans"], True),
)


def standing(data_sets, curve_sets, extent, results_of):
    """(header, rows, comparisons): a row for each comparison in which robust is behind.
    @param results_of  (data set, kind, percent, method) -> list of results, one a seed"""
    places = [(d, kind, percent) for d in data_sets for kind, percent in TABLE_KINDS]
    places += [(d, kind, percent) for d in curve_sets for kind in CURVES for percent in extent.levels]
    rows, comparisons = [], 0
    for data_set, kind, percent in places:
        for name, value, more_is_better in CRITERIA:
            medians = {m: summarize(results_of(data_set, kind, percent, m), value).median for m in BY_KEY}
            mine, others = medians.pop("robust"), {m: v for m, v in medians.items() if v is not None}
            if mine is None or not others:
                continue
            comparisons += 1
            best = (max if more_is_better else min)(others, key=others.get)
            behind = mine * WITHIN < others[best] if more_is_better else mine > WITHIN * others[best]
            if behind:
                rows.append([data_set.name, f"{kind} {percent:g} %" if percent else kind, name, number(mine),
                             number(others[best]), BY_KEY[best].name])
    return ["Data set", "Scans", "Criterion", "Robust", "Best", "by"], rows, comparisons
