"""The paper's bar charts and curves."""

import csv
import textwrap

import matplotlib.pyplot as plt

from paper.methods import METHODS
from paper.plan import CURVES
from paper.print_size import PAGE_IN, SMALL, save
from paper.summary import summarize

# A symmetric axis in logarithms: errors run from millimetres to tens of metres.
LINEAR_BELOW_M = 0.01


def bars(ax, groups, summary_of, title, unit, error_of=None):
    """One group of bars a data set; the range over seeds (or a given spread) as a line; why not, where there is none."""
    width = 0.8 / len(METHODS)
    for i, group in enumerate(groups):
        for j, m in enumerate(METHODS):
            x = i + (j - (len(METHODS) - 1) / 2) * width
            s = summary_of(group, m.key)
            if s.median is None:
                ax.text(x, LINEAR_BELOW_M / 10, s.text(), rotation=90, fontsize=SMALL, ha="center", va="bottom")
                continue
            ax.bar(x, s.median, width, color=m.colour, label=m.name)
            if error_of:
                low, high = max(s.median - error_of(group, m.key), 0), s.median + error_of(group, m.key)
            else:
                low, high = s.spread
            ax.plot([x, x], [low, high], color="black", linewidth=0.8)
    ax.set_xticks(range(len(groups)), [g.name.replace(" (", "\n(").replace(", ", ",\n") for g in groups])
    ax.set_xlim(-0.6, len(groups) - 0.4)
    ax.set_yscale("symlog", linthresh=LINEAR_BELOW_M)
    ax.set_ylim(bottom=0)
    ax.set_ylabel(unit)
    ax.set_title(title)


def legend_below(fig, ax):
    """What is drawn in one of the figure's axes, each name once."""
    shown = dict(zip(*reversed(ax.get_legend_handles_labels())))
    if shown:
        fig.legend(shown.values(), shown.keys(), ncol=len(shown), loc="lower center")


def bar_charts(folder, groups, results_of, note):
    """Figure of mean cloud-to-cloud distances with standard deviations, and of the RMS."""
    fig, (left, right) = plt.subplots(1, 2, figsize=(PAGE_IN, 2.9))
    of = lambda value: lambda g, m: summarize(results_of(g, "none", 0, m), value)
    std = of(lambda r: r["c2c_std"])
    bars(left, groups, of(lambda r: r["c2c_mean"]), "(a) cloud-to-cloud distance to the truth, +- standard deviation",
         "[m]", lambda g, m: std(g, m).median or 0)
    bars(right, groups, of(lambda r: r["rms"]), "(b) RMS of 50,000 points", "[m]")
    fig.suptitle(note)
    legend_below(fig, right)
    save(fig, folder / "bars.png", rect=(0, 0.06, 1, 1))
    with open(folder / "bars.csv", "w", newline="", encoding="utf-8") as f:
        out = csv.writer(f)
        out.writerow(["data set", "method", "cloud-to-cloud mean [m]", "standard deviation [m]", "RMS [m]"])
        for g in groups:
            for m in METHODS:
                values = [of(v)(g, m.key).text() for v in (lambda r: r["c2c_mean"], lambda r: r["c2c_std"],
                                                            lambda r: r["rms"])]
                out.writerow([g.name, m.name, *values])


def mean_and_deviation(result):
    if result["c2c_mean"] is None or result["c2c_std"] is None:
        return None
    return result["c2c_mean"] + result["c2c_std"]


# The paper's quantities: RMS over noise and removal, mean plus standard deviation over occlusion.
CURVE_VALUES = {"noise": ("RMS [m]", lambda r: r["rms"]), "remove": ("RMS [m]", lambda r: r["rms"]),
                "occlusion": ("cloud-to-cloud mean + std. deviation [m]", mean_and_deviation)}


def curves(folder, data_set, levels, results_of, note):
    """One figure a data set: three curves above, the share of right scans below; figures in a CSV beside it."""
    fig, axes = plt.subplots(2, 3, figsize=(PAGE_IN, 4.2))
    table = []
    for column, (kind, axis) in enumerate(CURVES.items()):
        unit, value = CURVE_VALUES[kind]
        for row, (name, of) in enumerate(((unit, value), ("scans right [%]", lambda r: 100 * r["ok"] / r["scans"]))):
            ax = axes[row][column]
            for order, m in enumerate(METHODS):
                points = []
                for percent in (0, *levels):
                    s = summarize(results_of(data_set, kind if percent else "none", percent, m.key), of)
                    table.append([kind, percent, name, m.name, s.text()])
                    if s.median is not None:
                        points.append((percent, s.median, *s.spread))
                if points:
                    x, y, low, high = zip(*points)
                    ax.plot(x, y, marker="o", markersize=2.5, color=m.colour, label=m.name,
                            linewidth=2.4 - 0.5 * order)  # so that equal curves all show
                    ax.fill_between(x, low, high, color=m.colour, alpha=0.15)
            ax.set_xlabel(axis)
            ax.set_ylabel(textwrap.fill(name, 28))
            if row == 0:
                ax.set_yscale("symlog", linthresh=LINEAR_BELOW_M)
                ax.set_ylim(bottom=0)
            else:
                ax.set_ylim(-3, 103)
    legend_below(fig, axes[0][0])
    fig.suptitle(f"{data_set.name}. {note}")
    save(fig, folder / f"curves-set{data_set.key}.png", rect=(0, 0.05, 1, 1))
    with open(folder / f"curves-set{data_set.key}.csv", "w", newline="", encoding="utf-8") as f:
        csv.writer(f).writerows([["degradation", "percent", "quantity", "method", "value"], *table])
