"""A progress line on standard error."""

import sys
import time


class Progress:
    def __init__(self, total, out=sys.stderr):
        self.total, self.done, self.run, self.out, self.begin = total, 0, 0, out, time.monotonic()

    def step(self, what, was_run=True):
        self.done += 1
        self.run += was_run
        left = ""
        if self.run:
            each = (time.monotonic() - self.begin) / self.run
            left = f", at most {(self.total - self.done) * each / 60:.0f} min left"
        end = "\n" if self.done == self.total or not self.out.isatty() else ""
        self.out.write(f"\r[{self.done}/{self.total}] {what}{left}" + " " * 10 + end)
        self.out.flush()
