"""Logistic regression, and how well its probabilities hold."""

import numpy as np


def fit(X, y, group, ridge=1.0, spread=1.0):
    """Constant and weights. Every group has a constant of its own besides, normally distributed with deviation `spread`
    about 0 (a logistic model with random intercepts, by its mode): what makes all rows of a group look better or worse
    alike is not put down to features. `ridge` is on weights of standardised features."""
    mean, deviation = X.mean(0), X.std(0) + 1e-9
    Z = np.c_[np.ones(len(X)), (X - mean) / deviation]
    _, of = np.unique(group, return_inverse=True)
    count = of.max() + 1
    b, own = np.zeros(Z.shape[1]), np.zeros(count)
    R = ridge * np.eye(Z.shape[1])
    R[0, 0] = 1e-6
    for _ in range(60):
        p = 1 / (1 + np.exp(-np.clip(Z @ b + own[of], -40, 40)))
        w = p * (1 - p)
        # Newton's step; the groups' constants, of which each has rows of its own, are eliminated first.
        mixed = np.array([np.bincount(of, z * w, count) for z in Z.T])
        diagonal = np.bincount(of, w, count) + 1 / spread**2
        gradient, gradient_own = Z.T @ (p - y) + R @ b, np.bincount(of, p - y, count) + own / spread**2
        reduced = (Z * w[:, None]).T @ Z + R - (mixed / diagonal) @ mixed.T
        step = np.linalg.solve(reduced, gradient - (mixed / diagonal) @ gradient_own)
        step_own = (gradient_own - mixed.T @ step) / diagonal
        b -= np.clip(step, -3, 3)
        own -= np.clip(step_own, -3, 3)
        if abs(step).max() < 1e-8:
            break
    weights = b[1:] / deviation
    return b[0] - weights @ mean, weights


def rescale(log_odds, y):
    """Shift and slope with which log-odds state probabilities that hold (Platt, 1999), by maximum likelihood."""
    shift, slope = fit(log_odds[:, None], y, np.zeros(len(y)), ridge=0, spread=1e-6)  # no constants of groups
    return shift, slope[0]


class Split:
    """Two logistic models of the same features, one for rows where column `by` is 0, one for the others. They share what
    does not differ: the ridge is on the difference, too."""

    def __init__(self, by, alike, ridge=1.0, spread=1.0):
        """`alike`: columns whose weight both have in common. `spread`: see fit()."""
        self.by, self.alike, self.ridge, self.spread = by, alike, ridge, spread

    def _columns(self, X):
        apart = [k for k in range(X.shape[1]) if k != self.by and k not in self.alike]
        return np.c_[X, X[:, apart] * X[:, [self.by]]], apart

    def fit(self, X, y, group):
        Z, apart = self._columns(X)
        constant, weights = fit(Z, y, group, self.ridge, self.spread)
        own, more = weights[:X.shape[1]].copy(), weights[X.shape[1]:]
        other = own.copy()
        other[apart] += more
        self.constants = constant, constant + own[self.by]
        own[self.by] = other[self.by] = 0
        self.weights = own, other
        return self

    def log_odds(self, X):
        first, second = (c + X @ w for c, w in zip(self.constants, self.weights))
        return np.where(X[:, self.by] > 0, second, first)


def held_out(model, X, y, kind, group):
    """Log-odds of each row by a model fitted to the rows of all other kinds; `model` makes one that is not fitted."""
    out = np.zeros(len(y))
    for k in np.unique(kind):
        rest = kind != k
        out[~rest] = model().fit(X[rest], y[rest], group[rest]).log_odds(X[~rest])
    return out


def area_under_curve(log_odds, y):
    order = np.argsort(log_odds)
    rank = np.empty(len(y))
    rank[order] = np.arange(1, len(y) + 1)
    right, wrong = y.sum(), len(y) - y.sum()
    return float((rank[y > 0].sum() - right * (right + 1) / 2) / (right * wrong)) if right and wrong else float("nan")


def log_loss(log_odds, y):
    return float(np.mean(np.logaddexp(0, -log_odds) * y + np.logaddexp(0, log_odds) * (1 - y)))


def reliability(log_odds, y, edges=np.linspace(0, 1, 11)):
    """Rows of (stated probability, observed share, count), and the expected calibration error."""
    p = 1 / (1 + np.exp(-log_odds))
    rows, error = [], 0.0
    for low, high in zip(edges[:-1], edges[1:]):
        inside = (p >= low) & ((p < high) | (high >= 1))
        if inside.any():
            rows.append((float(p[inside].mean()), float(y[inside].mean()), int(inside.sum())))
            error += inside.mean() * abs(p[inside].mean() - y[inside].mean())
    return rows, float(error)
