"""What compare_registration.py measured, a row a scene and a column a program, with a total of each kind of scene."""

NAMES = {"tcm-icp": "tcm-icp", "open3d-ransac": "Open3D RANSAC", "open3d-fgr": "Open3D FGR", "pcl": "PCL"}


def cell(ok, scans, wrong, cpu_s, peak_mb, unanswered):
    parts = [f"{ok}/{scans}"]
    if wrong:
        parts.append(f"{wrong} WRONG")
    if unanswered:
        parts.append("no answer" if isinstance(unanswered, bool) else f"{unanswered} without an answer")
    parts.append(f"{cpu_s:.0f} s" if cpu_s >= 10 else f"{cpu_s:.1f} s")
    parts.append(f"{peak_mb:.0f} MB")
    return ", ".join(parts)


def kind_and_scene(name):
    """Of KIND-SCENE; scenes without a kind are of one."""
    kind, dash, scene = name.partition("-")
    return (kind, scene) if dash else ("", name)


def total(rows):
    return cell(sum(r["ok"] for r in rows), sum(r["scans"] for r in rows), sum(r["wrong"] for r in rows), sum(r["cpu_s"] for r in rows),
                max(r["peak_mb"] for r in rows), sum(r["unanswered"] for r in rows))


def side_by_side(rows):
    """@param rows  dictionaries with scene, method, ok, scans, wrong, cpu_s, peak_mb and unanswered (bool)"""
    methods = [m for m in NAMES if any(r["method"] == m for r in rows)]
    of = {(r["scene"], r["method"]): r for r in rows}
    header, out = ["Scenes", "Scene", *(NAMES[m] for m in methods)], []
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    for kind in dict.fromkeys(kind_and_scene(s)[0] for s in scenes):
        mine = [s for s in scenes if kind_and_scene(s)[0] == kind]
        for s in mine:
            found = [of.get((s, m)) for m in methods]
            out.append([kind, kind_and_scene(s)[1], *(cell(r["ok"], r["scans"], r["wrong"], r["cpu_s"], r["peak_mb"], r["unanswered"]) if r else "-"
                                                      for r in found)])
        if all((s, m) in of for s in mine for m in methods):
            out.append([kind, "all", *(total([of[s, m] for s in mine]) for m in methods)])
    return header, out
