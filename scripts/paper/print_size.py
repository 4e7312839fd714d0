"""Figures at the size they are printed at, with letters that can be read there."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PAGE_IN, COLUMN_IN = 6.7, 4.3  # the width of a page's text, 17 cm, and of a figure beside text
DPI = 220
SMALL = 6.5  # [pt]

plt.rcParams.update({
    "font.size": 7, "axes.titlesize": 7, "axes.labelsize": 7, "figure.titlesize": 7.5, "xtick.labelsize": SMALL, "ytick.labelsize": SMALL,
    "legend.fontsize": SMALL, "axes.linewidth": 0.6, "lines.linewidth": 1.2, "lines.markersize": 3.5, "grid.linewidth": 0.5,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.major.size": 2.5, "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5, "ytick.minor.size": 1.5, "axes.labelpad": 2, "axes.titlepad": 4})


def save(fig, path, **layout):
    fig.tight_layout(**layout)
    fig.savefig(path, dpi=DPI, bbox_inches="tight", pad_inches=0.04)
    plt.close(fig)
