"""Measurements that are kept: a cell that is finished is not run again."""

import hashlib
import json
import re
from pathlib import Path


def cell_name(spec):
    """A file name for a specification: readable, and different where anything differs."""
    text = json.dumps(spec, sort_keys=True)
    words = re.sub(r"[^A-Za-z0-9]+", "-", "-".join(str(v) for v in spec.values() if not isinstance(v, (list, dict))))
    return words.strip("-")[:80] + "-" + hashlib.sha256(text.encode()).hexdigest()[:10]


class CellStore:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def path(self, spec):
        return self.folder / (cell_name(spec) + ".json")

    def get(self, spec):
        """The measurement, or None where it is not finished (a broken file counts as none)."""
        try:
            kept = json.loads(self.path(spec).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        return kept["result"] if kept.get("spec") == spec else None

    def put(self, spec, result):
        """Written beside and renamed: an interrupted run leaves no half cell."""
        path = self.path(spec)
        work = path.with_suffix(".tmp")
        work.write_text(json.dumps({"spec": spec, "result": result}, indent=1), encoding="utf-8")
        work.replace(path)
