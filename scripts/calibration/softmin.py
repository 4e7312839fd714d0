"""Two ways of being wrong whose odds add up: odds(wrong) = exp(-place) + exp(-quality), both linear in features."""

import numpy as np


class TwoWays:
    """`place` and `quality` are the columns each part is linear in; `signs` (+1, -1, 0: either) bounds the weights."""

    def __init__(self, place, quality, signs, ridge):
        self.columns = np.array(place), np.array(quality)
        self.signs = np.asarray(signs)
        self.ridge = ridge

    def fit(self, X, y, _group=None, steps=4000, rate=0.03):
        """Adam on standardised features, weights of the wrong sign set to 0 after each step."""
        parts = [X[:, c] for c in self.columns]
        means, deviations = [p.mean(0) for p in parts], [p.std(0) + 1e-9 for p in parts]
        Z = [(p - m) / d for p, m, d in zip(parts, means, deviations)]
        signs = [self.signs[c] for c in self.columns]
        weights = [np.concatenate([[2.0], 0.3 * s]) for s in signs]
        first = [np.zeros_like(w) for w in weights]
        second = [np.zeros_like(w) for w in weights]
        for t in range(1, steps + 1):
            odds = [w[0] + z @ w[1:] for w, z in zip(weights, Z)]
            p = 1 / (1 + np.exp(np.logaddexp(-odds[0], -odds[1])))
            share = 1 / (1 + np.exp(np.clip(odds[0] - odds[1], -50, 50)))  # of a step that the place takes
            for k, part in enumerate((share, 1 - share)):
                g = (p - y) * part
                gradient = np.concatenate([[g.sum()], Z[k].T @ g + self.ridge * weights[k][1:]]) / len(y)
                first[k] = 0.9 * first[k] + 0.1 * gradient
                second[k] = 0.999 * second[k] + 0.001 * gradient**2
                step = first[k] / (1 - 0.9**t) / (np.sqrt(second[k] / (1 - 0.999**t)) + 1e-9)
                weights[k] -= rate * (1 if t < 0.7 * steps else 0.2) * step
                bad = np.concatenate([[False], weights[k][1:] * signs[k] < 0])
                weights[k][bad] = 0
        self.weights = [w[1:] / d for w, d in zip(weights, deviations)]
        self.constants = [w[0] - (w[1:] / d) @ m for w, m, d in zip(weights, means, deviations)]
        return self

    def log_odds(self, X):
        place, quality = (c + X[:, k] @ w for c, k, w in zip(self.constants, self.columns, self.weights))
        return -np.logaddexp(-place, -quality)

    def spread(self, k, size):
        """The weights of part k at their features' places."""
        out = np.zeros(size)
        out[self.columns[k]] = self.weights[k]
        return out
