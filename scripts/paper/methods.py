"""The methods that are compared, and how each is asked for."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Method:
    key: str
    name: str
    arguments: tuple
    colour: str


METHODS = (
    Method("robust", "TCM-ICP (robust)", (), "tab:green"),
    Method("paper", "TCM-ICP (paper)", ("--profile", "paper"), "tab:olive"),
    Method("icp", "ICP", ("--method", "icp"), "tab:red"),
    Method("features", "Feature based", ("--method", "features"), "tab:blue"),
)
BY_KEY = {m.key: m for m in METHODS}
CONVENTIONAL = ("icp", "features")  # what a build with PCL is needed for

# Small scans (a return in 0.3 m, some 8,000 to 18,000 a scan), and every method works with about 8,000 of them.
QUICK_SAMPLING = ("--sampling.coarse-voxels", "8000", "--sampling.fine-voxels", "20000")
QUICK_SCENES = ("--scans", "4", "--thinning", "0.3")
