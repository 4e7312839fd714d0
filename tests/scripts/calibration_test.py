"""Checks of scripts/calibration, without tcm-icp: that fits find what data were made with."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "scripts"))

from calibration import logistic


def drawn(log_odds, rng):
    return (rng.random(len(log_odds)) < 1 / (1 + np.exp(-log_odds))).astype(float)


class Rescaled(unittest.TestCase):
    def setUp(self):
        self.rng = np.random.default_rng(1)
        self.log_odds = self.rng.normal(2, 3, 20000)

    def test_shift_and_slope_are_found(self):
        y = drawn(0.9 + 0.6 * self.log_odds, self.rng)
        shift, slope = logistic.rescale(self.log_odds, y)
        self.assertAlmostEqual(shift, 0.9, delta=0.1)
        self.assertAlmostEqual(slope, 0.6, delta=0.05)
        stated = logistic.reliability(self.log_odds, y)[1]
        self.assertGreater(stated, 0.03)
        self.assertLess(logistic.reliability(shift + slope * self.log_odds, y)[1], 0.01)

    def test_what_holds_stays(self):
        shift, slope = logistic.rescale(self.log_odds, drawn(self.log_odds, self.rng))
        self.assertAlmostEqual(shift, 0, delta=0.1)
        self.assertAlmostEqual(slope, 1, delta=0.05)

    def test_the_order_stays(self):
        y = drawn(2 * self.log_odds - 1, self.rng)
        shift, slope = logistic.rescale(self.log_odds, y)
        self.assertGreater(slope, 0)
        self.assertAlmostEqual(logistic.area_under_curve(shift + slope * self.log_odds, y),
                               logistic.area_under_curve(self.log_odds, y))


if __name__ == "__main__":
    unittest.main()
