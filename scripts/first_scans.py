"""Smaller sets of a simulated scene: its first scans."""

import json


def first_scans(scene, count, folder):
    """`folder` with links to the first scans of a scene, and their truth. @throws ValueError  where it has fewer"""
    truth = json.loads((scene / "truth.json").read_text(encoding="utf-8"))
    if count > len(truth["scans"]):
        raise ValueError(f"{scene} has {len(truth['scans'])} scans, not {count}")
    truth.pop("overlap", None)
    truth["scans"] = truth["scans"][:count]
    folder.mkdir(exist_ok=True)
    for scan in truth["scans"]:
        link = folder / scan["file"]
        if not link.exists():
            link.symlink_to((scene / scan["file"]).resolve())
    (folder / "truth.json").write_text(json.dumps(truth), encoding="utf-8")
    return folder
