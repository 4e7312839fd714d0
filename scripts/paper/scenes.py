"""Data sets 1-4 after the paper, made by the simulator, a user's own scenes, and both made worse."""

import json
import shutil
import threading
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class DataSet:
    key: str
    name: str
    scene: str = ""  # of the simulator
    seed_offset: int = 0
    folder: str = ""  # of a user's scene; then there is one seed


# 2 and 4 are the same kind of place, as in the paper; another seed makes it another place.
PAPER_SETS = (
    DataSet("1", "Data set 1 (urban)", "urban"),
    DataSet("2", "Data set 2 (street)", "street"),
    DataSet("3", "Data set 3 (canopy)", "canopy"),
    DataSet("4", "Data set 4 (street, another seed)", "street", 1000),
)


def own_sets(folders):
    """A user's scenes: folders of PLY scans with a truth.json."""
    sets = []
    for i, folder in enumerate(map(Path, folders)):
        if not (folder / "truth.json").exists():
            raise ValueError(f"{folder}: has no truth.json; a scene is a folder of scans with the poses they should get")
        sets.append(DataSet(f"own{i + 1}", folder.name, folder=str(folder.resolve())))
    return sets


def scan_files(scene):
    truth = json.loads((Path(scene) / "truth.json").read_text(encoding="utf-8"))
    return [Path(scene) / s["file"] for s in truth["scans"]]


class SceneMaker:
    """Makes each scene once; what is there is used again."""

    def __init__(self, program, folder, simulate_options=()):
        self.program, self.folder = program, Path(folder)
        self.simulate_options = tuple(simulate_options)
        self._lock = threading.Lock()  # two cells of one scene must not both make it

    def scene(self, data_set, seed):
        """Folder of the scene, or (None, why not)."""
        if data_set.folder:
            return Path(data_set.folder), None
        return self._make(self.folder / f"set{data_set.key}-seed{seed}",
                          lambda out: ["simulate", "--scene", data_set.scene, "--seed", data_set.seed_offset + seed,
                                       "--out", out, *self.simulate_options])

    def degraded(self, data_set, seed, kind, percent):
        """The scene with `percent` of a degradation; as it is where kind is "none"."""
        scene, why = self.scene(data_set, seed)
        if kind in ("none", "init") or why:
            return scene, why
        return self._make(self.folder / f"set{data_set.key}-seed{seed}-{kind}{percent:g}",
                          lambda out: ["degrade", *scan_files(scene), "--out", out, f"--{kind}", percent / 100, "--seed",
                                       seed], scene / "truth.json")

    def _make(self, out, arguments, truth=None):
        with self._lock:
            return self._make_unless_there(out, arguments, truth)

    def _make_unless_there(self, out, arguments, truth):
        if (out / "truth.json").exists():
            return out, None
        shutil.rmtree(out, ignore_errors=True)
        out.parent.mkdir(parents=True, exist_ok=True)
        run = self.program(*arguments(out))
        if run.why_not((0,)):
            return None, f"{arguments(out)[0]}: {run.why_not((0,))}"
        if truth:
            shutil.copy(truth, out / "truth.json")
        return out, None
