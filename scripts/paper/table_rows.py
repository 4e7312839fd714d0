"""Tables 1-3 of the paper (and data set 4): criteria by methods."""

from paper.methods import METHODS
from paper.plan import BLUR_PERCENT, ISOLATED_PERCENT
from paper.summary import ratios, summarize

# kind, percent, criterion, value: the paper's rows, then ours.
PAPER_ROWS = (
    ("none", 0, "Time [CPU s]", lambda r: r["cpu_s"]),
    ("none", 0, "Iterations", lambda r: sum(r["iterations"].values())),
    ("none", 0, "RMS (50,000 points) [m]", lambda r: r["rms"]),
    ("isolated", ISOLATED_PERCENT, f"Error due to {ISOLATED_PERCENT} % isolated points [m]", lambda r: r["rms"]),
    ("blur", BLUR_PERCENT, f"Error due to {BLUR_PERCENT} % feature blurring [m]", lambda r: r["rms"]),
)
MORE_ROWS = (
    ("none", 0, "Mean cloud-to-cloud distance [m]", lambda r: r["c2c_mean"]),
    ("none", 0, "Its standard deviation [m]", lambda r: r["c2c_std"]),
    ("none", 0, "Scans right [%]", lambda r: 100 * r["ok"] / r["scans"]),
    ("none", 0, "Scans said to be placed, and wrong [%]", lambda r: 100 * r["wrong"] / r["scans"]),
    ("init", 0, "RMS from rough initial poses [m]", lambda r: r["rms"]),
    ("init", 0, "Scans right from rough initial poses [%]", lambda r: 100 * r["ok"] / r["scans"]),
    ("isolated", ISOLATED_PERCENT, f"Scans right with {ISOLATED_PERCENT} % isolated points [%]", lambda r: 100 * r["ok"] / r["scans"]),
    ("blur", BLUR_PERCENT, f"Scans right with {BLUR_PERCENT} % feature blurring [%]", lambda r: 100 * r["ok"] / r["scans"]),
)


def time_with_ratios(results, method):
    """The time, and ours divided by each rival's in the same runs."""
    text = summarize(results(method), lambda r: r["cpu_s"]).text()
    if method not in ("robust", "paper"):
        return text
    notes = []
    for rival, name in (("icp", "ICP"), ("features", "features")):
        ratio = ratios(results(method), results(rival), lambda r: r["cpu_s"])
        notes.append(f"{ratio.text(2)} x {name}" if ratio.values else f"ratio to {name}: {ratio.text()}")
    return f"{text}; {', '.join(notes)}"


def table(results_of, methods=METHODS):
    """(header, rows) of text. @param results_of  (kind, percent, method) -> list of results, one a seed"""
    header = ["Criterion", *(m.name for m in methods)]
    rows = []
    for kind, percent, name, value in PAPER_ROWS + MORE_ROWS:
        row = [name]
        for m in methods:
            if name.startswith("Time"):
                row.append(time_with_ratios(lambda key: results_of("none", 0, key), m.key))
            else:
                row.append(summarize(results_of(kind, percent, m.key), value).text())
        rows.append(row)
    return header, rows
