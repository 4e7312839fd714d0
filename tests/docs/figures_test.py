"""The figures of README.md and of the pages with figures are those of docs/results/*.csv.

A table of figures has a line above it that names its file: <!-- figures: table-set1.csv -->, or, where its rows come from
several, <!-- figures: table-set*.csv RMS (50,000 points) [m] -->: that criterion, a row a data set.
"""

import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
RESULTS = ROOT / "docs" / "results"
sys.path.insert(0, str(ROOT / "scripts"))

from update_figures import PAGES, TABLE, read_csv


def read_markdown(text):
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in text.strip().splitlines()]
    return rows[0], rows[2:]


def plain(text):
    return text.replace("|", "/").replace("**", "").strip()


def median_of(cell):
    """The median alone, as the README has it: "0.122 [0.0791, 0.156]" is 0.122."""
    return cell.split(" [")[0]


class Figures(unittest.TestCase):
    def tables(self, page):
        found = list(TABLE.finditer((ROOT / page).read_text(encoding="utf-8")))
        self.assertTrue(found, f"{page} has no table of figures: <!-- figures: FILE.csv -->")
        return found

    def check_whole_table(self, page, found):
        header, rows = read_markdown(found["table"])
        measured = read_csv(RESULTS / found["file"])
        self.assertEqual(len(rows), len(measured) - 1, f"{page}: {found['file']} has other rows")
        for row, line in zip(rows, measured[1:]):
            values = dict(zip(measured[0], map(plain, line)))
            for column, cell in zip(header, row):
                if column in values:  # a page may have more columns: what the paper says
                    self.assertEqual(plain(cell), values[column], f"{page}, {found['file']}: {row[0]}, {column}")

    def check_one_criterion(self, page, found):
        header, rows = read_markdown(found["table"])
        files = sorted(RESULTS.glob(found["file"]))
        self.assertEqual(len(rows), len(files), f"{page}: a row for each of {found['file']}")
        for row, path in zip(rows, files):
            measured = read_csv(path)
            line = next((r for r in measured if r[0] == found["criterion"]), None)
            self.assertIsNotNone(line, f"{path.name} has no row {found['criterion']}")
            values = dict(zip(measured[0], line))
            for column, cell in zip(header[1:], row[1:]):
                self.assertEqual(cell, median_of(values[column]), f"{page}: {row[0]}, {column}")

    def test_tables_are_those_of_the_files(self):
        for page in PAGES:
            for found in self.tables(page):
                with self.subTest(page=page, file=found["file"]):
                    (self.check_one_criterion if found["criterion"] else self.check_whole_table)(page, found)

    def test_every_table_has_a_provenance(self):
        import json
        tables = json.loads((RESULTS / "provenance.json").read_text(encoding="utf-8"))["tables"]
        for path in RESULTS.glob("*.csv"):
            with self.subTest(path.name):
                entry = tables.get(path.stem)
                self.assertIsNotNone(entry, f"{path.name}: nothing says where it comes from")
                for key in ("command", "commit", "program"):
                    self.assertTrue(entry[key], f"{path.name}: {key}")


if __name__ == "__main__":
    unittest.main()
