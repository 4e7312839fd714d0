"""One measurement: register a scene by a method, evaluate the result."""

import json
import math
import shutil
from pathlib import Path

from paper.methods import BY_KEY
from paper.scenes import scan_files


ERRORS = ("rms", "c2c_mean", "c2c_std", "hausdorff")
# Clouds are compared by as many points as the RMS is taken over.
CLOUD_POINTS = 50_000


def iterations_of(report):
    """Every iteration that a report tells of, by kind."""
    if report.get("method", "tcm") != "tcm":
        return dict(report["conventional"]["iterations"])
    kinds = {"simplex": 0, "descent": 0, "annealing": 0}
    for merge in report["merges"]:
        kinds["simplex"] += merge["iterations"]["simplex_pivots"]
        kinds["descent"] += merge["iterations"]["descent_steps"]
        kinds["annealing"] += merge["iterations"]["annealing_steps"]
    adjustment = report.get("adjustment") or {}
    kinds["simplex"] += (adjustment.get("lp") or {}).get("pivots") or 0
    kinds["adjustment"] = adjustment.get("steps") or 0
    return kinds


def number_at(json_object, path):
    """The number at a place ("a.b"), or None."""
    at = json_object
    for key in path.split("."):
        at = at.get(key) if isinstance(at, dict) else None
    return float(at) if isinstance(at, (int, float)) and math.isfinite(at) else None


def errors_of(evaluation):
    """What evaluate says, under the names of the tables [m]."""
    scans = evaluation["scans"]
    placed = [s for s in scans if s.get("rmse") is not None]
    pooled = math.sqrt(sum(s["rmse"] ** 2 for s in placed) / len(placed)) if placed else None
    rms = number_at(evaluation, "rms.rms")
    return {
        "rms": rms if rms is not None else pooled,
        "c2c_mean": number_at(evaluation, "registered_to_truth.mean"),
        "c2c_std": number_at(evaluation, "registered_to_truth.standard_deviation"),
        "hausdorff": number_at(evaluation, "hausdorff"),
        "scans": len(scans), "ok": evaluation["ok"], "flagged": evaluation["flagged"], "wrong": evaluation["wrong"],
    }


def judged(result):
    """A finished cell as tables see it: a run that places nothing but the reference has no errors, rather than none."""
    if result and "why" not in result and result["flagged"] == result["scans"] - 1:
        return {**result, **dict.fromkeys(ERRORS), "no_errors": "only the reference is placed"}
    return result


def initial_poses(scene, method_key):
    """Options that give a method the scene's rough initial poses, or (None, why not)."""
    if method_key == "features":
        return None, "takes no initial poses"
    path = Path(scene) / "initial_poses.json"
    if not path.exists():
        return None, "the scene has no initial_poses.json"
    return ("--init", path), None


def measure(program, scene, method_key, seed, work, extra=(), keep=None, judged_by=None):
    """A cell's result: figures, or {"why": ...}.
    @param keep       folder that receives the result's files, for pictures
    @param judged_by  scene whose points and truth the poses are judged by: the undamaged one of a damaged scene, so that
                      errors are of the same points whatever was done to the scans"""
    judged_by = Path(judged_by or scene)
    work = Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.parent.mkdir(parents=True, exist_ok=True)
    arguments = ["register", *scan_files(scene), "--out", work, "--threads", 1, "--seed", seed, "--quiet",
                 *BY_KEY[method_key].arguments, *extra]
    run = program(*arguments)
    result = {"command": program.line(arguments), "cpu_s": run.cpu_s, "wall_s": run.wall_s, "peak_mb": run.peak_mb}
    why = run.why_not()
    if not why:
        scores = work / "evaluation.json"
        evaluated = program("evaluate", "--scans", judged_by, "--poses", work / "poses.json", "--truth",
                            judged_by / "truth.json", "--json", scores, "--cloud-points", CLOUD_POINTS, "--threads", 1)
        why = evaluated.why_not((0,))
        if why:
            why = "evaluate: " + why
        else:
            report = json.loads((work / "report.json").read_text(encoding="utf-8"))
            result.update(errors_of(json.loads(scores.read_text(encoding="utf-8"))))
            result["iterations"] = iterations_of(report)
            result["stages"] = {s["name"]: s["seconds"] for s in report["stages"]}
            result["lp_seconds"] = sum(m["simplex"]["lp"]["seconds"] for m in report["merges"])
    if why:
        result["why"] = why
    if keep and not why:
        shutil.rmtree(keep, ignore_errors=True)
        Path(keep).parent.mkdir(parents=True, exist_ok=True)
        work.rename(keep)
    shutil.rmtree(work, ignore_errors=True)
    return result
