"""Checks of scripts/paper, without tcm-icp: what is kept, counted and said."""

import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "scripts"))

from paper import provenance
from paper.cells import CellStore, cell_name
from paper.executable import NO_BASELINES, find_exe, require_baselines
from paper.findings import finding
from paper.formats import latex, markdown
from paper.measure import errors_of, iterations_of
from paper.methods import METHODS
from paper.plan import CURVES, FULL, TABLE_KINDS, cells
from paper.published import compare, published, row_of, write_cells
from paper.readings import DEFAULT, READINGS
from paper.scenes import PAPER_SETS, own_sets
from paper.summary import number, ratios, summarize
from paper.table_rows import table


@unittest.skipUnless(shutil.which("git"), "needs git")
class Provenance(unittest.TestCase):
    def test_a_table_that_was_made_is_no_change_of_the_code_and_a_script_is(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(provenance, "REPOSITORY", Path(folder)):
            table, script = Path(folder, "docs/results/table.csv"), Path(folder, "scripts/make.py")
            for path in (table, script):
                path.parent.mkdir(parents=True)
                path.write_text("1\n")
            for command in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "both"]):
                subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=n@n.n", *command], cwd=folder, check=True)
            self.assertFalse(provenance.code()["uncommitted_changes"])
            table.write_text("2\n")
            self.assertFalse(provenance.code()["uncommitted_changes"])
            script.write_text("2\n")
            self.assertTrue(provenance.code()["uncommitted_changes"])


class Cells(unittest.TestCase):
    def test_a_finished_cell_comes_back_and_another_does_not(self):
        with tempfile.TemporaryDirectory() as folder:
            store = CellStore(folder)
            store.put({"set": "1", "seed": 1}, {"rms": 2})
            self.assertEqual(CellStore(folder).get({"set": "1", "seed": 1}), {"rms": 2})
            self.assertIsNone(store.get({"set": "1", "seed": 2}))

    def test_half_a_file_is_no_measurement(self):
        with tempfile.TemporaryDirectory() as folder:
            store = CellStore(folder)
            store.path({"set": "1"}).write_text('{"spec": {"set": "1"}, "resu')
            self.assertIsNone(store.get({"set": "1"}))

    def test_names_differ_where_only_a_list_does(self):
        self.assertNotEqual(cell_name({"a": ["--x"]}), cell_name({"a": ["--y"]}))


class Published(unittest.TestCase):
    CELL = PAPER_SETS[1], "noise", 30, 4, "robust"
    RESULT = {"scans": 4, "ok": 4, "flagged": 0, "wrong": 0, "rms": 0.0123456789, "c2c_mean": 0.01, "c2c_std": None,
              "cpu_s": 1.5, "iterations": {"simplex": 10, "descent": 5}}

    def test_a_cell_that_was_written_is_found_by_what_it_is_of(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cells.csv"
            self.assertIsNone(published(path, self.CELL))
            write_cells(path, [row_of(self.CELL, self.RESULT, "abc")])
            row = published(path, self.CELL)
            self.assertEqual((row["rms"], row["iterations"], row["c2c_std"], row["program"]), ("0.0123457", "15", "", "abc"))
            self.assertIsNone(published(path, (*self.CELL[:3], 5, "robust")))

    def test_both_figures_stand_side_by_side_and_none_is_said(self):
        mine = row_of(self.CELL, self.RESULT, "abc")
        lines = compare(mine, {"rms": "0.02"})
        self.assertTrue(any(line.split() == ["rms", "0.0123457", "0.02"] for line in lines), lines)
        self.assertTrue(all(line.endswith("none") for line in compare(mine, None)[1:]))


class Readings(unittest.TestCase):
    def test_each_differs_from_the_default_in_what_it_says_alone(self):
        default = dict(zip(READINGS[0].arguments[::2], READINGS[0].arguments[1::2]))
        self.assertEqual(default, {"--profile": "paper", **{f"--paper.{k}": v for k, v in DEFAULT.items()}})
        for reading in READINGS[2:]:
            options = dict(zip(reading.arguments[::2], reading.arguments[1::2]))
            changed = [k for k in options if options[k] != default.get(k)]
            self.assertIn(len(changed), (1, 2, 3), reading.name)
        self.assertEqual(len({r.arguments for r in READINGS}), len(READINGS))


class Executable(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.build = self.folder / "build"

    def program(self, path, says="", code=2):
        exe = self.folder / path
        exe.parent.mkdir(parents=True)
        exe.write_text(f"#!/bin/sh\necho '{says}' >&2\nexit {code}\n")
        exe.chmod(0o755)
        return exe

    def found(self, named=None, path=""):
        with mock.patch.dict(os.environ, PATH=str(path)), redirect_stderr(io.StringIO()):
            return find_exe("x.py", named, self.build)

    def test_named_then_path_then_build(self):
        dev, release = self.program("build/dev/app/tcm-icp"), self.program("build/release/app/tcm-icp")
        installed, named = self.program("bin/tcm-icp"), self.program("other/tcm")
        self.assertEqual(self.found(named, installed.parent), named)
        self.assertEqual(self.found(path=installed.parent), installed)
        self.assertEqual(self.found(), release)
        release.unlink()
        self.assertEqual(self.found(), dev)

    def test_none_names_the_option(self):
        with self.assertRaisesRegex(SystemExit, "--exe"):
            self.found()
        with self.assertRaisesRegex(SystemExit, "no program"):
            self.found(self.folder)

    def test_without_baselines_the_status_says_so(self):
        without = self.program("a/tcm-icp", "tcm-icp: --method icp: this tcm-icp was built without PCL; install it", 1)
        with redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit) as end:
            require_baselines("x.py", without)
        self.assertEqual(end.exception.code, NO_BASELINES)
        self.assertIn("--conventional-exe", said.getvalue())
        require_baselines("x.py", self.program("b/tcm-icp", "tcm-icp: no-scan-1: cannot be opened"))


class Plan(unittest.TestCase):
    def test_every_cell_stands_once_and_the_tables_come_first(self):
        plan = cells(PAPER_SETS, PAPER_SETS[1:3], FULL)
        self.assertEqual(len(plan), len(set(plan)))
        tables = len(FULL.seeds) * len(PAPER_SETS) * len(TABLE_KINDS) * len(METHODS)
        self.assertEqual(len(plan), tables + len(FULL.seeds) * 2 * len(CURVES) * len(FULL.levels) * len(METHODS))
        self.assertTrue(all(c[1] not in CURVES for c in plan[:tables]))

    def test_a_folder_without_truth_is_refused(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(ValueError, "truth.json"):
            own_sets([folder])


class Summaries(unittest.TestCase):
    def test_median_and_range_of_the_runs_that_have_figures(self):
        s = summarize([{"x": 3, "ok": 1}, {"why": "timeout"}, {"x": 1, "ok": 1}, {"x": 2, "ok": 1}], lambda r: r["x"])
        self.assertEqual((s.median, s.spread), (2, (1, 3)))
        self.assertEqual(s.text(), "2 [1, 3] (3 of 4 runs)")

    def test_no_text_is_blank(self):
        for results in ([], [None], [{"why": "failed"}], [{"x": None, "ok": 1}]):
            self.assertTrue(summarize(results, lambda r: r["x"]).text())

    def test_ratios_are_taken_seed_by_seed(self):
        ours, theirs = [{"t": 1}, {"t": 10}], [{"t": 2}, {"t": 40}]
        self.assertEqual(sorted(ratios(ours, theirs, lambda r: r["t"]).values), [0.25, 0.5])
        self.assertEqual(ratios([{"t": 1}], [{"why": "timeout"}], lambda r: r["t"]).text(), "timeout")

    def test_numbers_have_no_exponent(self):
        self.assertEqual([number(x) for x in (0, 0.00123, 12.34, 750545.2)], ["0", "0.00123", "12.3", "750545"])


class Reports(unittest.TestCase):
    def test_iterations_of_both_kinds_of_report(self):
        merge = {"iterations": {"simplex_pivots": 5, "descent_steps": 2, "annealing_steps": 100, "sum": 107}}
        ours = {"method": "tcm", "merges": [merge, merge], "adjustment": {"lp": {"pivots": 7}, "steps": 3}}
        self.assertEqual(iterations_of(ours), {"simplex": 17, "descent": 4, "annealing": 200, "adjustment": 3})
        self.assertEqual(iterations_of({"method": "icp", "conventional": {"iterations": {"icp": 9, "ransac": 0}}}),
                         {"icp": 9, "ransac": 0})

    def test_errors_leave_out_what_was_not_measured(self):
        scans = [{"rmse": 3.0}, {"rmse": 4.0}, {"rmse": None}]
        errors = errors_of({"scans": scans, "ok": 1, "flagged": 1, "wrong": 1})
        self.assertAlmostEqual(errors["rms"], 12.5 ** 0.5)
        self.assertIsNone(errors["c2c_mean"])


class Texts(unittest.TestCase):
    def test_a_table_has_a_text_in_every_place(self):
        header, rows = table(lambda kind, percent, method: [{"why": "timeout after 60 s"}])
        for row in rows:
            self.assertEqual(len(row), len(header))
            self.assertTrue(all(row))

    def test_markup_survives_what_a_reason_may_hold(self):
        self.assertIn("a/b", markdown(["x"], [["a|b"]]))
        self.assertIn(r"20 \% \_", latex(["x"], [["20 % _"]], "c", "l"))

    def test_a_finding_names_the_better_variant_and_a_draw(self):
        default, other = ("default", 100, 0.010, 1.0), ("other", 100, 0.002, 1.0)
        self.assertIn("other does better", finding([default, other]))
        self.assertIn("not beaten", finding([default, ("other", 50, 0.002, 1.0)]))
        self.assertIn("No variant differs", finding([default, ("other", 100, 0.0101, 1.0)]))
        self.assertIn("2.0 times as long", finding([default, ("other", 100, 0.01, 2.0)]).replace(" 2 times", " 2.0 times"))
        self.assertIn("No comparison", finding([("default", None, None, None), other]))


if __name__ == "__main__":
    unittest.main()
