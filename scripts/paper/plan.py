"""Which cells the tables and figures need."""

from dataclasses import dataclass

from paper.methods import METHODS

# The tables' degradations; "init" is none, but rough initial poses are given to all methods that take any.
ISOLATED_PERCENT, BLUR_PERCENT = 5, 20
TABLE_KINDS = (("none", 0), ("isolated", ISOLATED_PERCENT), ("blur", BLUR_PERCENT), ("init", 0))
# The curves' degradations, with the name of each axis.
CURVES = {"noise": "noise added [% of points]", "occlusion": "scan hidden [%]", "remove": "points removed [%]"}


@dataclass(frozen=True)
class Extent:
    """How much is run."""
    name: str
    seeds: tuple
    levels: tuple  # percent, of every curve
    register: tuple  # options every method gets
    simulate: tuple
    time_limit_s: float  # of CPU, for one run


# Off by up to so many degrees and metres: what a compass and a hand-held receiver may give.
ROUGH_POSES = ("--initial-guess", "5", "1")
# Four scans of a return in 0.2 m: ICP and features try all pairs, so that whole streets of 60 scans would take them days.
FULL_SCENES = ("--scans", "4", "--thinning", "0.2")
FULL = Extent("full", (1, 2, 3, 4, 5), (10, 30, 50), (), (*FULL_SCENES, *ROUGH_POSES), 1200)


def cells(data_sets, curve_sets, extent, methods=METHODS):
    """(data set, kind, percent, seed, method) of every cell, each once; the tables' first, seed by seed, so that an
    interrupted run has whole tables of fewer seeds."""
    out = []
    for seed in extent.seeds:
        for data_set in data_sets:
            # A user's scene has one seed: the scene is what it is, but the methods' and degradations' draws differ.
            for kind, percent in TABLE_KINDS:
                out += [(data_set, kind, percent, seed, m.key) for m in methods]
    for seed in extent.seeds:
        for data_set in curve_sets:
            for kind in CURVES:
                for percent in extent.levels:
                    out += [(data_set, kind, percent, seed, m.key) for m in methods]
    return list(dict.fromkeys(out))


def spec(data_set, kind, percent, seed, method, extent, program_id):
    """What decides a cell's figures."""
    return {"set": data_set.key, "scene": data_set.folder or f"{data_set.scene}+{data_set.seed_offset}", "kind": kind,
            "percent": percent, "seed": seed, "method": method, "register": list(extent.register),
            "simulate": list(extent.simulate), "limit_s": extent.time_limit_s, "program": program_id}
