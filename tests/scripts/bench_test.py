"""Checks of scripts/benchmark, without the programs that it measures: files, errors, sets. Needs numpy."""

import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "scripts"))

from benchmark import files, growth, pairs
from benchmark.side_by_side import side_by_side
from benchmark.spent import Missing, require, run
from ply import read_points


class Files(unittest.TestCase):
    def test_all_formats_hold_the_same_points(self):
        with tempfile.TemporaryDirectory() as name:
            written = files.write_files(Path(name), 1000)
            points = read_points(written["PLY"])
            self.assertEqual(len(points), 1000)
            self.assertTrue(written["PCD"].read_bytes().endswith(points.astype("<f4").tobytes()))
            np.testing.assert_allclose(np.loadtxt(written["text"]), points[:400], atol=1e-5)

    def test_a_program_that_finds_other_points_is_left_out(self):
        def honest(file, _):
            return {"read_s": 1, "write_s": 1, "points": 40 if file.suffix == ".xyz" else 100}

        def liar(*_):
            return {"read_s": 0.1, "write_s": 0.1, "points": 3}

        with tempfile.TemporaryDirectory() as name, mock.patch("sys.stderr"), \
             mock.patch.object(files, "programs", return_value={"TCM-ICP": honest, "liar": liar}):
            rows = files.measure(Path(name), None, 100, 2)
        self.assertEqual({row[2] for row in rows}, {"TCM-ICP"})
        self.assertEqual(len(rows), 4)


class Pairs(unittest.TestCase):
    def test_the_truth_has_no_error(self):
        T = np.eye(4)
        T[:3, 3] = 1, 2, 3
        rotation, rmse = pairs.error_of({"T_target_source": T.tolist()}, np.ones((5, 3)), T)
        self.assertEqual((rotation, rmse), (0, 0))

    def test_a_turn_and_a_shift_are_found(self):
        turned = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]])
        source = np.array([[1.0, 0, 0], [0, 1, 0]])
        rotation, rmse = pairs.error_of({"T_target_source": np.eye(4).tolist()}, source, turned)
        self.assertAlmostEqual(rotation, 90)
        self.assertAlmostEqual(rmse, 1000 * np.sqrt(2 + 0.25))


class Growth(unittest.TestCase):
    def test_first_scans_keep_their_truth(self):
        with tempfile.TemporaryDirectory() as name:
            scene = Path(name) / "street"
            scene.mkdir()
            scans = [{"file": f"{k}.ply", "pose": k} for k in range(4)]
            (scene / "truth.json").write_text(json.dumps({"scans": scans, "overlap": [[1] * 4] * 4}))
            for scan in scans:
                (scene / scan["file"]).write_bytes(b"ply\nelement vertex 7\nend_header\n")
            folder = growth.first_of(scene, 2)
            self.assertEqual(json.loads((folder / "truth.json").read_text()), {"scans": scans[:2]})
            self.assertEqual([growth.points_of(p) for p in sorted(folder.glob("*.ply"))], [7, 7])


class Programs(unittest.TestCase):
    def test_what_is_missing_is_said_with_its_package(self):
        with self.assertRaisesRegex(Missing, "apt install nothing"):
            require("no-program-of-this-name", "nothing")

    def test_memory_is_the_program_s_own(self):
        held = np.ones(60_000_000)
        del held
        self.assertLess(run(["true"]).memory_mb, 300)

    def test_a_failure_is_an_error_with_what_the_program_said(self):
        with self.assertRaisesRegex(RuntimeError, "exit status 3: too bad"):
            run(["sh", "-c", "echo too bad; exit 3"])


class SideBySide(unittest.TestCase):
    @staticmethod
    def row(scene, method, ok, wrong, cpu_s, unanswered=False):
        return {"scene": scene, "method": method, "ok": ok, "scans": 6, "wrong": wrong, "cpu_s": cpu_s, "peak_mb": 10 * cpu_s, "unanswered": unanswered}

    def test_each_kind_has_a_total(self):
        rows = [self.row("real-a", "tcm-icp", 6, 0, 3), self.row("real-a", "pcl", 4, 2, 20), self.row("real-b", "tcm-icp", 5, 0, 4),
                self.row("real-b", "pcl", 0, 0, 90, True), self.row("simulated-c", "tcm-icp", 6, 0, 1), self.row("simulated-c", "pcl", 6, 0, 12)]
        header, table = side_by_side(rows)
        self.assertEqual(header, ["Scenes", "Scene", "tcm-icp", "PCL"])
        self.assertEqual(table, [["real", "a", "6/6, 3.0 s, 30 MB", "4/6, 2 WRONG, 20 s, 200 MB"],
                                 ["real", "b", "5/6, 4.0 s, 40 MB", "0/6, no answer, 90 s, 900 MB"],
                                 ["real", "all", "11/12, 7.0 s, 40 MB", "4/12, 2 WRONG, 1 without an answer, 110 s, 900 MB"],
                                 ["simulated", "c", "6/6, 1.0 s, 10 MB", "6/6, 12 s, 120 MB"],
                                 ["simulated", "all", "6/6, 1.0 s, 10 MB", "6/6, 12 s, 120 MB"]])

    def test_what_was_not_run_has_no_total(self):
        _, table = side_by_side([self.row("a", "tcm-icp", 6, 0, 3), self.row("b", "tcm-icp", 6, 0, 3), self.row("b", "pcl", 6, 0, 3)])
        self.assertEqual(table, [["", "a", "6/6, 3.0 s, 30 MB", "-"], ["", "b", "6/6, 3.0 s, 30 MB", "6/6, 3.0 s, 30 MB"]])


if __name__ == "__main__":
    unittest.main()
