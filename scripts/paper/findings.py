"""One sentence on what an ablation's figures say, from the figures."""

from paper.summary import number


def differs(a, b, share=0.05):
    return abs(a - b) > share * max(abs(a), abs(b))


def finding(rows):
    """@param rows  (name, right %, RMS [m], CPU s) of the variants, the default first; None where there is none"""
    known = [r for r in rows if None not in r[1:]]
    if len(known) < 2 or known[0][0] != rows[0][0]:
        return "No comparison: the default or all others have no figures."
    default = known[0]
    best = min(known, key=lambda r: (-r[1], r[2]))
    worst = max(known, key=lambda r: (-r[1], r[2]))
    if best[1] == worst[1] and not differs(best[2], worst[2]):
        what = f"No variant differs: each places {number(best[1])} % of the scans right, with an RMS of {number(default[2])} m"
    elif best is default or (best[1] == default[1] and not differs(best[2], default[2])):
        what = (f"The default is not beaten: {number(default[1])} % right, RMS {number(default[2])} m; worst is "
                f"{worst[0]} with {number(worst[1])} % and {number(worst[2])} m")
    else:
        what = (f"{best[0]} does better than the default here: {number(best[1])} % right, RMS {number(best[2])} m, against "
                f"{number(default[1])} % and {number(default[2])} m")
    fastest, slowest = min(known, key=lambda r: r[3]), max(known, key=lambda r: r[3])
    if slowest[3] > 1.5 * fastest[3]:
        what += f"; {slowest[0]} takes {number(slowest[3] / fastest[3], 2)} times as long as {fastest[0]}"
    return what + "."
