"""Registers scans as NumPy arrays, and prints poses, verdicts and probabilities: register_arrays.py SCAN SCAN..."""

import sys
from pathlib import Path

import numpy as np

import tcm_icp


def show(stage: str, done: int, total: int) -> None:
    print(f"\r{stage} {done} of {total}      ", end="", file=sys.stderr)


def main(files: list[str]) -> int:
    clouds = {Path(file).name: tcm_icp.read_points(file) for file in files}  # any array of the shape (N, 3) [m]
    try:
        result = tcm_icp.register(clouds, progress=show)
    except tcm_icp.Error as error:
        print(error, file=sys.stderr)
        return 2
    np.set_printoptions(precision=4, suppress=True)
    for scan in result.scans:
        print(f"{scan.name}: {scan.verdict.name}, probability {scan.probability:.3f}, {scan.text}")
        if scan.pose is not None:
            middle = clouds[scan.name].mean(axis=0)
            print("  its middle is at", scan.pose[:3, :3] @ middle + scan.pose[:3, 3])
    return 0 if result.all_registered else 3


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
