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


def provenance(exe, extent, conventional_exe=None):
    import matplotlib
    import numpy
    return {"command": "scripts/" + Path(sys.argv[0]).name + " " + " ".join(sys.argv[1:]),
            "extent": extent.name, "seeds": list(extent.seeds), "levels_percent": list(extent.levels),
            "register_options": list(extent.register), "simulate_options": list(extent.simulate),
            "cpu_limit_s": extent.time_limit_s,
            "commit": output_of("git", "rev-parse", "HEAD"),
            "uncommitted_changes": output_of("git", "status", "--porcelain", "--untracked-files=no") != "",
            "program": program(exe), "program_of_icp_and_features": program(conventional_exe or exe),
            "pcl": pcl_version(), "python": platform.python_version(), "numpy": numpy.__version__,
            "matplotlib": matplotlib.__version__, "processor": processor(), "cores": os.cpu_count()}


def write_provenance(folder, exe, extent, conventional_exe=None):
    text = json.dumps(provenance(exe, extent, conventional_exe), indent=1)
    (folder / "provenance.json").write_text(text + "\n", encoding="utf-8")
