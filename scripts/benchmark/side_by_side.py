"""What compare_registration.py measured, a row a scene and a column a program, with a total of each kind of scene."""

NAMES = {"tcm-icp": "tcm-icp", "open3d-ransac": "Open3D RANSAC", "open3d-fgr": "Open3D FGR", "pcl": "PCL"}


def cell(runs):
    """Of one run, or of several together: scans and times are added, memory is the largest."""
    total = {key: sum(r[key] for r in runs) for key in ("ok", "scans", "wrong", "cpu_s", "unanswered")}
    parts = [f"{total['ok']}/{total['scans']}"]
    if total["wrong"]:
        parts.append(f"{total['wrong']} WRONG")
    if total["unanswered"]:
        parts.append("no answer" if len(runs) == 1 else f"{total['unanswered']} without an answer")
    seconds = total["cpu_s"]
    return ", ".join([*parts, f"{seconds:.0f} s" if seconds >= 10 else f"{seconds:.1f} s", f"{max(r['peak_mb'] for r in runs):.0f} MB"])


def kind_and_scene(name):
    """Of KIND-SCENE; scenes without a kind are of one."""
    kind, dash, scene = name.partition("-")
    return (kind, scene) if dash else ("", name)


def side_by_side(runs):
    """@param runs  as compare_registration.run_of() gives them"""
    methods = [m for m in NAMES if any(r["method"] == m for r in runs)]
    of = {(r["scene"], r["method"]): r for r in runs}
    header, out = ["Scenes", "Scene", *(NAMES[m] for m in methods)], []
    scenes = list(dict.fromkeys(r["scene"] for r in runs))
    for kind in dict.fromkeys(kind_and_scene(s)[0] for s in scenes):
        mine = [s for s in scenes if kind_and_scene(s)[0] == kind]
        for s in mine:
            out.append([kind, kind_and_scene(s)[1], *(cell([of[s, m]]) if (s, m) in of else "-" for m in methods)])
        if all((s, m) in of for s in mine for m in methods):
            out.append([kind, "all", *(cell([of[s, m] for s in mine]) for m in methods)])
    return header, out
