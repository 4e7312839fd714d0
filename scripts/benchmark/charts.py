"""The tables of scripts/bench.py as pictures."""

import matplotlib.pyplot as plt
import numpy as np

from paper.print_size import COLUMN_IN, PAGE_IN, SMALL, save

COLOURS = {"TCM-ICP": "#1f77b4", "PCL": "#d62728", "Open3D": "#2ca02c", "CloudCompare": "#9467bd"}
METHOD_COLOURS = {"tcm-icp": "#1f77b4", "open3d-ransac": "#2ca02c", "open3d-fgr": "#98df8a", "pcl": "#d62728"}


def grouped_bars(ax, groups, series, values, colours):
    """`values[group, name]`; a gap where there is none."""
    width = 0.8 / len(series)
    for k, name in enumerate(series):
        heights = [values.get((group, name), 0) for group in groups]
        ax.bar(np.arange(len(groups)) + (k - (len(series) - 1) / 2) * width, heights, width, label=name, color=colours[name])
    ax.set_xticks(range(len(groups)), groups)
    ax.grid(axis="y", alpha=0.3)


def draw_files(rows, path):
    values = {(f"{operation} {kind}", program): float(speed) for kind, operation, program, _, _, speed, _ in rows}
    fig, ax = plt.subplots(figsize=(COLUMN_IN, 2.4))
    grouped_bars(ax, list(dict.fromkeys(group for group, _ in values)), [p for p in COLOURS if any(p == q for _, q in values)],
                 values, COLOURS)
    ax.set_yscale("log")
    ax.legend(ncol=4, loc="lower center", bbox_to_anchor=(0.5, 1))
    ax.set_ylabel("million points a second of one core")
    save(fig, path)


def draw_pairs(rows, path):
    fig, ax = plt.subplots(figsize=(PAGE_IN, 3.6))
    pairs = list(dict.fromkeys(row[0] for row in rows))
    for pair, name, method, _, ms, _, _, _, rmse, _ in rows:
        at = float(ms), max(float(rmse), 0.1)
        ax.loglog(*at, "os^Dv"[pairs.index(pair) % 5], color=COLOURS[name], alpha=0.8)
        ax.annotate(method.replace("two gates", "2 gates").replace(" to ", "-"), at, xytext=(4, -8 if pairs.index(pair) % 2 == 0 else 3), textcoords="offset points", fontsize=SMALL)
    handles = [plt.Line2D([], [], marker="o", linestyle="", color=colour, label=name) for name, colour in COLOURS.items()]
    handles += [plt.Line2D([], [], marker="os^Dv"[k % 5], linestyle="", color="#555555", label=pair) for k, pair in enumerate(pairs)]
    ax.legend(handles=handles)
    ax.set_xlabel("processor time [ms]")
    ax.set_ylabel("median root mean square error [mm]")
    ax.grid(alpha=0.3, which="both")
    save(fig, path)


def draw_sets(rows, path):
    scenes = list(dict.fromkeys(row[0] for row in rows))
    fig, (left, right) = plt.subplots(1, 2, figsize=(PAGE_IN, 2.5))
    methods = [m for m in METHOD_COLOURS if any(m == row[1] for row in rows)]
    grouped_bars(left, scenes, methods, {(row[0], row[1]): 100 * row[2] / row[5] for row in rows}, METHOD_COLOURS)
    grouped_bars(right, scenes, methods, {(row[0], row[1]): float(row[6]) for row in rows}, METHOD_COLOURS)
    left.set_ylabel("scans placed right [%]")
    right.set_ylabel("processor time [s]")
    right.set_yscale("log")
    right.legend(loc="upper left", bbox_to_anchor=(1, 1))
    for ax in (left, right):
        ax.tick_params(axis="x", rotation=20)
    save(fig, path)


def draw_growth(rows, path):
    fig, axes = plt.subplots(1, 3, figsize=(PAGE_IN, 2.5))
    for ax, what, column in zip(axes, ("points", "scans", "threads"), (3, 2, 1)):
        kept = [row for row in rows if row[0] == what]
        size = np.array([float(row[column]) for row in kept])
        if what == "threads":
            ax.plot(size, [float(kept[0][6]) / float(row[6]) for row in kept], "o-", label="measured")
            ax.plot(size, size, "--", color="#888888", label="as many times as threads")
            ax.set_ylabel("times faster")
        else:
            cpu_s, memory_mb = (np.array([float(row[k]) for row in kept]) for k in (5, 7))
            ax.loglog(size, cpu_s, "o-", label="processor time [s]")
            ax.loglog(size, memory_mb, "s-", color="#d62728", label="memory [MB]")
            ax.loglog(size, cpu_s[0] * size / size[0], "--", color="#888888", label="in proportion")
        if what != "points":
            ax.set_xticks(size, [f"{n:g}" for n in size])
            ax.minorticks_off()
        ax.set_xlabel("points a scan" if what == "points" else what)
        ax.grid(alpha=0.3)
        ax.legend(ncol=2, loc="lower center", bbox_to_anchor=(0.5, 1), columnspacing=1)
    save(fig, path)


PICTURES = {"files": draw_files, "pairs": draw_pairs, "sets": draw_sets, "growth": draw_growth}
