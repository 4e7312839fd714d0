"""The ablations: one part of the method replaced at a time, everything else as it is."""

from dataclasses import dataclass

from paper.plan import ISOLATED_PERCENT
from paper.scenes import DataSet


@dataclass(frozen=True)
class Variant:
    name: str
    arguments: tuple


@dataclass(frozen=True)
class Ablation:
    key: str
    title: str
    variants: tuple  # the first is what the others are compared with
    common: tuple = ()  # options of all of them
    kind: str = "none"  # degradation of the scans
    percent: float = 0
    from_guess: bool = False  # start from rough initial poses
    data_sets: tuple = ()  # in place of the run's own
    simulate: tuple = ()  # options of their simulation


# Without what comes after the simplex: a joint adjustment hides what a placement was like.
PLACED_ONLY = ("--refinement", "none", "--adjustment.lp-steps", "0", "--adjustment.steps", "0")
# CGAL's exact solver takes seconds for programs of the usual size.
SMALL_PROGRAMS = ("--lp.coarse-points", "300", "--lp.fine-points", "300", "--lp.held-out-points", "300")

ABLATIONS = (
    Ablation("solver", "LP solver, from initial poses, programs of 300 points", (
        Variant("GLPK (default)", ("--solver", "glpk")), Variant("CGAL", ("--solver", "cgal"))),
        PLACED_ONLY + SMALL_PROGRAMS, from_guess=True),
    Ablation("formulation", "What a step minimises; no refinement, no joint adjustment", (
        Variant("6 parameters, point to plane, L1 (default)", ("--lp.formulation", "plane")),
        Variant("6 parameters, point to point, L1", ("--lp.formulation", "point")),
        Variant("12 entries, point to point, L1 (paper)", ("--lp.formulation", "entries")),
        Variant("6 parameters, point to plane, least squares", ("--lp.formulation", "squares"))), PLACED_ONLY),
    Ablation("merge-order", "Which scan is merged next; no refinement, no joint adjustment", (
        Variant("TCM, robust (default)", ("--merge-order", "robust-tcm")),
        Variant("TCM, paper", ("--merge-order", "paper-tcm")),
        Variant("largest overlap", ("--merge-order", "overlap")),
        Variant("order of the files", ("--merge-order", "file")),
        Variant("random", ("--merge-order", "random"))), PLACED_ONLY),
    Ablation("outliers", f"Outlier removal, scans with {ISOLATED_PERCENT} % isolated points", (
        Variant("k-means (default, paper)", ("--outliers", "kmeans")),
        Variant("distance", ("--outliers", "distance")),
        Variant("local outlier factor", ("--outliers", "lof")),
        Variant("none", ("--outliers", "none"))), kind="isolated", percent=ISOLATED_PERCENT),
    Ablation("refinement", "What follows the simplex", (
        Variant("joint adjustment (default)", ()),
        Variant("with descent and annealing", ("--refinement", "both")),
        Variant("with descent", ("--refinement", "descent")),
        Variant("with annealing", ("--refinement", "annealing")),
        Variant("no joint programs", ("--adjustment.lp-steps", "0")),
        Variant("no bending of scans", ("--adjustment.bending", "no")),
        Variant("no joint adjustment", ("--adjustment.lp-steps", "0", "--adjustment.steps", "0")),
        Variant("the simplex alone", PLACED_ONLY))),
    # Streets are placed with any one of them left out: they are for places that repeat themselves.
    Ablation("stages", "Stages that a set of poses is searched and decided by, in rooms and bays that repeat themselves", (
        Variant("all (default)", ()),
        Variant("without features", ("--without", "features")),
        Variant("without slides along corridors", ("--without", "slides")),
        Variant("without pairs asked where others put them", ("--without", "implied")),
        Variant("without free space", ("--without", "free-space")),
        Variant("without twins", ("--without", "twins")),
        Variant("without the set's constant", ("--without", "constant"))),
        data_sets=(DataSet("rooms", "Rooms", "interior"), DataSet("bays", "Bays", "bays")),
        simulate=("--scans", "8")),
)
