"""What a program costs, and whether it can be run at all."""

import json
import os
import shutil
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

OPEN3D_PYTHON = "/usr/bin/python3"  # Debian's, which Debian's Open3D belongs to


class Missing(Exception):
    """A program that is not on this machine; its text says how to get it."""


def require(program, package):
    if shutil.which(program) is None:
        raise Missing(f"{program}: apt install {package}")


def forget_peak():
    """The most memory of a child counts from what its parent ever had, unless that is forgotten (proc(5), clear_refs)."""
    with suppress(OSError):  # where the kernel has none
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


@dataclass
class Spent:
    cpu_s: float
    wall_s: float
    memory_mb: float
    output: str


def run(command, accept=(0,), threads=1, cwd=None):
    """A program as a whole. @throws RuntimeError with its last line where it fails"""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), QT_QPA_PLATFORM="offscreen")
    forget_peak()
    begin = time.monotonic()
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=environment, cwd=cwd) as child:
        output = child.stdout.read()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in accept:
        last = output.strip().splitlines()[-1:] or [""]
        raise RuntimeError(f"{command[0]}: exit status {child.returncode}: {last[0]}")
    return Spent(usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024, output)


def json_of(command):
    """The last line of what a program prints."""
    return json.loads(run(command).output.strip().splitlines()[-1])


def say(text):
    print(f"bench.py: {text}", file=sys.stderr, flush=True)
