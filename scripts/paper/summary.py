"""Medians over seeds with their spread, and what a cell says where there is none."""

from dataclasses import dataclass, field
from statistics import median


@dataclass
class Summary:
    """Of one quantity over the seeds of a cell."""
    values: list = field(default_factory=list)  # of the seeds that gave one
    reasons: list = field(default_factory=list)  # of those that did not
    runs: int = 0

    @property
    def median(self):
        return median(self.values) if self.values else None

    @property
    def spread(self):
        return (min(self.values), max(self.values)) if self.values else None

    def text(self, digits=3):
        """Never blank: the median, with the range where there are several seeds, or why there is none."""
        if not self.values:
            return self.reasons[0] if self.reasons else "not run"
        out = number(self.median, digits)
        if len(self.values) > 1:
            out += f" [{number(self.spread[0], digits)}, {number(self.spread[1], digits)}]"
        if len(self.values) < self.runs:
            out += f" ({len(self.values)} of {self.runs} runs)"
        return out


def number(value, digits=3):
    """Significant digits, no exponent for what a table holds."""
    if value == 0:
        return "0"
    if abs(value) >= 10 ** (digits - 1):
        return f"{value:.0f}"
    return f"{value:.{digits}g}"


def summarize(results, value_of):
    """@param results  one a seed; None where it was not run, "why" where it has no figures"""
    out = Summary(runs=len(results))
    for result in results:
        if result is None:
            out.reasons.append("not run")
            continue
        if "why" in result:
            out.reasons.append(result["why"])
            continue
        value = value_of(result)
        if value is None:
            unknown = "not measured by this evaluate" if result.get("ok") is not None else "none"
            out.reasons.append(result.get("no_errors", unknown))
        else:
            out.values.append(value)
    return out


def ratios(results, others, value_of):
    """Of the same seeds, one by one: a slow scene is slow for both."""
    pairs = []
    for a, b in zip(results, others):
        missing = next((r for r in (a, b) if r is None or "why" in r), None)
        if missing is not None or a is None or b is None:
            pairs.append({"why": (missing or {}).get("why", "not run")})
        else:
            pairs.append({"ratio": value_of(a) / value_of(b), "ok": 0})
    return summarize(pairs, lambda r: r["ratio"])
