"""What fits show that start from the right pose of a pair and from wrong ones, and end elsewhere with little to show."""

import numpy as np

LITTLE = -1  # log-odds
OVERLAP = 0.1  # what shares less shows little, right or wrong
DISTANCES = (0, 0.5, 1, 2, 3, 4)  # coarse voxels; beyond the last, poses are two
LEFT = (0, 0.55, 0.7, 0.85, np.inf)


def implied(data, scene, name, rows):
    """Of implied hypotheses: log-odds, overlap, what a slide in the weakest direction leaves of their agreement, and how
    far from its start the fit ended, in coarse voxels. Right are those that started within a coarse voxel of the truth
    (or the tolerance), wrong those that started beyond eight."""
    voxel_m = data.report["coarse_voxel_m"]
    for h in data.report["hypotheses"]:
        if "asked_at" not in h:
            continue
        a, b, e = h["a"], h["b"], h["evidence"]
        T_start = np.array(h["asked_at"])
        off = data.error(a, b, T_start)[0] / voxel_m if data.group[a] == data.group[b] else np.inf
        right = off < max(1, data.tolerance_m / voxel_m)
        if right or off > 8:
            slid_m = data.rms(b, np.linalg.inv(T_start) @ np.array(h["pose_of_b_in_a"]))
            rows.add([h["log_odds"], e["overlap"], e["left_after_slide"][0], slid_m / voxel_m], right, scene, name)


def table(X, right):
    """Rows: of those that show little, how many of either kind, and the logarithm of by how much likelier that is where
    the fit started from the right pose."""
    log_odds, overlap, left, slid = X.T
    of_all = np.log(right.sum() / (1 - right).sum())
    rows = [("Left after a slide", "Coarse voxels from start to end", "Right", "Wrong", "Log-likelihood ratio")]
    for low, high in zip(LEFT, LEFT[1:]):
        for near, far in zip(DISTANCES, DISTANCES[1:]):
            chosen = (log_odds < LITTLE) & (overlap > OVERLAP) & (left >= low) & (left < high) & (slid >= near) & (slid < far)
            yes, no = int(right[chosen].sum()), int((1 - right[chosen]).sum())
            ratio = np.log((yes + 0.5) / (no + 0.5)) - of_all
            rows.append((f"{low} to {high}" if np.isfinite(high) else f"above {low}", f"{near} to {far}", yes, no, round(float(ratio), 1)))
    return rows
