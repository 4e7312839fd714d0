"""Which tcm-icp is measured, and whether it has the conventional methods."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

BUILD = Path(__file__).resolve().parent.parent.parent / "build"
NO_BASELINES = 3  # exit status: a table without the methods it compares with says nothing


def candidates(build):
    """Programs of the build folder, that of the preset `release` first."""
    return sorted(build.glob("*/app/tcm-icp"), key=lambda exe: (exe.parent.parent.name != "release", exe))


def find_exe(script, named, build=BUILD):
    """The program of --exe where it is named, else the one on PATH, else the one in build/. Ends the script where there is
    none."""
    if named:
        if not os.access(named, os.X_OK) or Path(named).is_dir():
            sys.exit(f"{script}: --exe {named}: is no program that can be run")
        return Path(named)
    on_path = shutil.which("tcm-icp")
    found = Path(on_path) if on_path else next((e for e in candidates(build) if os.access(e, os.X_OK)), None)
    if found is None:
        sys.exit(f"{script}: tcm-icp is neither on PATH nor in build/: name it by --exe TCM_ICP, or build it: "
                 "cmake --preset release && cmake --build --preset release --target tcm-icp")
    print(f"{script}: measures {found}", file=sys.stderr)
    return found


def has_baselines(exe):
    """Whether it was built with PCL. It says so before it looks for scans, of which there are none by these names."""
    run = subprocess.run([exe, "register", "no-scan-1", "no-scan-2", "--method", "icp", "--out", "no-result/here"],
                         capture_output=True, text=True, check=False)
    return "without PCL" not in run.stderr


def require_baselines(script, exe):
    """Ends the script with NO_BASELINES where they are missing."""
    if has_baselines(exe):
        return
    print(f"{script}: {exe} was built without PCL, so it has no ICP and no features to compare with, and a table without "
          "them says nothing: install libpcl-dev, configure with -DTCM_ICP_WITH_PCL=ON, build again; or name a program that "
          "has them by --conventional-exe; or ask for this program's own methods alone by --methods robust paper",
          file=sys.stderr)
    sys.exit(NO_BASELINES)
