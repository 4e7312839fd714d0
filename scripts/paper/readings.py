"""The readings of the paper's method that are measured: the default of --profile paper, and one question answered in another
way at a time."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Reading:
    question: str
    name: str
    arguments: tuple


# Every option named, so that a reading is the same whatever the defaults are.
DEFAULT = {"matches": "mutual", "kept-share": "1", "slack": "both", "unknowns": "entries", "points": "all", "rounds": "100",
           "end": "motion", "descent": "scans", "marginal": "0.001"}
FIRST = {**DEFAULT, "matches": "nearest", "points": "sample", "rounds": "30", "marginal": "0.01"}


def reading(question, name, *more, base=None, **changed):
    options = {**(base or DEFAULT), **{key.replace("_", "-"): value for key, value in changed.items()}}
    arguments = ("--profile", "paper", *(word for key, value in options.items() for word in (f"--paper.{key}", value)), *more)
    return Reading(question, name, arguments)


READINGS = (
    reading("default", "mutual matches, all points, 100 rounds, slack both ways, 12 entries, tau of whole scans, steps of 0.001"),
    reading("first reading", "nearest matches, sampled points, 30 rounds, steps of 0.01", base=FIRST),
    reading("matches", "nearest", matches="nearest"),
    reading("matches", "within the graph's threshold", matches="threshold"),
    reading("matches", "nearest, the best 90 %", matches="nearest", kept_share="0.9"),
    reading("matches", "nearest, the best 70 %", matches="nearest", kept_share="0.7"),
    reading("matches", "nearest, the best 50 %", matches="nearest", kept_share="0.5"),
    reading("matches", "mutual, the best 90 %", kept_share="0.9"),
    reading("matches", "mutual, the best 70 %", kept_share="0.7"),
    reading("rounds", "1, as Algorithm 1 is printed", rounds="1"),
    reading("rounds", "10", rounds="10"),
    reading("rounds", "30", rounds="30"),
    reading("rounds", "until the slack no longer falls", end="slack"),
    reading("points", "a sample of 1,500", points="sample"),
    reading("slack", "above (<)", slack="above"),
    reading("slack", "below (>)", slack="below"),
    reading("slack", "between the two", slack="between"),
    reading("unknowns", "6 of a small motion", unknowns="twist"),
    reading("descent", "tau of what is matched", descent="matches"),
    reading("descent", "steps of 0.01", marginal="0.01"),
    reading("descent", "tau of what is matched, steps of 0.01", descent="matches", marginal="0.01"),
    reading("descent", "one step of 0.01, no annealing", "--refinement", "descent", "--descent.steps", "1", marginal="0.01"),
    reading("descent", "neither descent nor annealing", "--refinement", "none"),
    reading("order", "largest overlap in place of least tau", "--merge-order", "overlap"),
)
ICP = Reading("conventional", "ICP", ("--method", "icp"))
