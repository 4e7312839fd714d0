"""Logistic regression, and how well its probabilities hold."""

import numpy as np


def fit(X, y, ridge=1.0, signs=None):
    """Constant and weights; where `signs` has +1 or -1, a weight of the other sign becomes 0, the worst first."""
    free = np.ones(X.shape[1], bool)
    while True:
        constant, weights, scaled = _newton(X[:, free], y, ridge)
        full, score = np.zeros(X.shape[1]), np.zeros(X.shape[1])
        full[free], score[free] = weights, scaled
        against = np.zeros(X.shape[1]) if signs is None else np.minimum(score * signs, 0)
        if against.min() >= 0:
            return constant, full
        free[int(np.argmin(against))] = False


def _newton(X, y, ridge, steps=60):
    """Constant, weights, and weights of standardised features, on which `ridge` is."""
    mean, deviation = X.mean(0), X.std(0) + 1e-9
    Z = np.c_[np.ones(len(X)), (X - mean) / deviation]
    b = np.zeros(Z.shape[1])
    R = ridge * np.eye(Z.shape[1])
    R[0, 0] = 1e-6
    for _ in range(steps):
        p = 1 / (1 + np.exp(-np.clip(Z @ b, -40, 40)))
        step = np.linalg.solve((Z * (p * (1 - p))[:, None]).T @ Z + R, Z.T @ (p - y) + R @ b)
        b -= np.clip(step, -5, 5)
        if abs(step).max() < 1e-8:
            break
    weights = b[1:] / deviation
    return b[0] - weights @ mean, weights, b[1:]


class Split:
    """Two logistic models of the same features, one for rows where column `by` is 0, one for the others. They share what
    does not differ: the ridge is on the difference, too."""

    def __init__(self, by, alike, ridge=1.0):
        """`alike`: columns whose weight both have in common."""
        self.by, self.alike, self.ridge = by, alike, ridge

    def _columns(self, X):
        apart = [k for k in range(X.shape[1]) if k != self.by and k not in self.alike]
        return np.c_[X, X[:, apart] * X[:, [self.by]]], apart

    def fit(self, X, y):
        Z, apart = self._columns(X)
        constant, weights = fit(Z, y, self.ridge)
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


def held_out(model, X, y, group):
    """Log-odds of each row by a model fitted to the rows of all other groups; `model` makes one that is not fitted."""
    out = np.zeros(len(y))
    for g in np.unique(group):
        rest = group != g
        out[~rest] = model().fit(X[rest], y[rest]).log_odds(X[~rest])
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
