"""Runs tcm-icp: with a time limit, its CPU time and peak memory, and every command line on record."""

import os
import resource
import shlex
import signal
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path


INTERRUPTED = 130  # tcm-icp's exit code


class Stopped(Exception):
    """The run was interrupted."""


@dataclass
class Run:
    """One finished program."""
    code: int
    cpu_s: float
    wall_s: float
    peak_mb: float
    errors: str
    timed_out: bool

    def why_not(self, allowed=(0, 3)):
        """Nothing where it did what it should; otherwise why not, for a table."""
        if self.timed_out:
            return f"timeout after {self.cpu_s:.0f} s"
        if self.code in allowed:
            return None
        last = [line for line in self.errors.replace("\r", "\n").splitlines() if line.startswith("tcm-icp:")]
        # The reason, without the remedy behind it.
        return f"failed (exit {self.code})" + (f": {last[-1].removeprefix('tcm-icp: ').split(';')[0]}" if last else "")


class Program:
    def __init__(self, exe, commands_file, time_limit_s):
        self.exe = Path(exe)
        self.commands_file = Path(commands_file)
        self.time_limit_s = time_limit_s
        self.stopped = False
        self._lock = threading.Lock()
        self._running = set()

    def stop(self):
        """Ends what runs, and whatever is asked for afterwards raises Stopped: no half measurement is kept."""
        self.stopped = True
        with self._lock:
            for child in self._running:
                child.kill()

    def line(self, arguments):
        return shlex.join(["tcm-icp", *map(str, arguments)])

    def __call__(self, *arguments, record=True):
        if self.stopped:
            raise Stopped("interrupted")
        if record:
            with self._lock, open(self.commands_file, "a", encoding="utf-8") as f:
                f.write(self.line(arguments) + "\n")
        limit = int(self.time_limit_s)

        def bound():
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 2))

        begin = time.monotonic()
        child = subprocess.Popen([str(self.exe), *map(str, arguments)], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, preexec_fn=bound)
        killer = threading.Timer(20 * limit + 60, child.kill)  # for a program that waits for ever
        killer.daemon = True
        killer.start()
        with self._lock:
            self._running.add(child)
        errors = child.stderr.read().decode("utf-8", "replace")
        _, status, usage = os.wait4(child.pid, 0)
        killer.cancel()
        child.stderr.close()
        with self._lock:
            self._running.discard(child)
        child.returncode = code = os.waitstatus_to_exitcode(status)
        if self.stopped or code in (INTERRUPTED, -signal.SIGINT):
            raise Stopped("interrupted")
        return Run(code, usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024, errors,
                   -code in (signal.SIGXCPU, signal.SIGKILL))

    def has_command(self, name):
        return self(name, "--help", record=False).code == 0
