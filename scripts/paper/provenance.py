"""What a reader needs to make the tables again."""

import hashlib
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent.parent


def program_id(exe):
    """Of the program's bytes: another build measures again."""
    return hashlib.sha256(Path(exe).read_bytes()).hexdigest()[:16]


def output_of(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True, cwd=REPOSITORY).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()


def pcl_version():
    found = output_of("dpkg-query", "-W", "-f", "${Version}", "libpcl-dev")
    return found if found else "unknown"


def program(exe):
    return {"version": output_of(str(Path(exe).resolve()), "--version"), "sha256": program_id(exe)}


def code():
    """The command, and the commit it ran. Tables and pictures that it may have written by then are no change of the code."""
    status = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs/results", ":!docs/images")
    return {"command": "scripts/" + Path(sys.argv[0]).name + " " + " ".join(sys.argv[1:]),
            "commit": output_of("git", "rev-parse", "HEAD"), "uncommitted_changes": status != ""}


def provenance(exe, extent, conventional_exe=None):
    import matplotlib
    import numpy
    return {**code(), "extent": extent.name, "seeds": list(extent.seeds), "levels_percent": list(extent.levels),
            "register_options": list(extent.register), "simulate_options": list(extent.simulate),
            "cpu_limit_s": extent.time_limit_s,
            "program": program(exe), "program_of_icp_and_features": program(conventional_exe or exe),
            "pcl": pcl_version(), "python": platform.python_version(), "numpy": numpy.__version__,
            "matplotlib": matplotlib.__version__, "processor": processor(), "cores": os.cpu_count()}


def kept_tables(path):
    """What was recorded of tables already."""
    try:
        return json.loads(path.read_text(encoding="utf-8")).get("tables", {})
    except (OSError, ValueError):
        return {}


def write_provenance(folder, exe, extent, conventional_exe=None):
    path = folder / "provenance.json"
    found = provenance(exe, extent, conventional_exe)
    found["tables"] = kept_tables(path)
    path.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    return found


def record_tables(folder, names, found):
    """Where each table comes from: its command, commit and programs, table by table, for a folder holds those of several
    runs. @param found  what write_provenance() gave"""
    keys = ("command", "commit", "uncommitted_changes", "program", "program_of_icp_and_features", "pcl", "python", "numpy",
            "extent", "seeds")
    add_tables(folder, {name: {key: found[key] for key in keys} for name in names})


def origin(exe):
    """Where a table of one run comes from, for add_tables()."""
    import numpy
    versions = {name: output_of("dpkg-query", "-W", "-f", "${Version}", package)
                for name, package in (("pcl", "libpcl-dev"), ("open3d", "python3-open3d"), ("cloudcompare", "cloudcompare"))}
    return {**code(), "program": program(exe), **versions, "python": platform.python_version(), "numpy": numpy.__version__,
            "processor": processor()}


def add_tables(folder, origins):
    """Adds the origins of tables, by name, to those that the folder's provenance.json has."""
    path = folder / "provenance.json"
    whole = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {"tables": {}}
    whole["tables"].update(origins)
    path.write_text(json.dumps(whole, indent=1, sort_keys=False) + "\n", encoding="utf-8")
