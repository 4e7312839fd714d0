"""Puts many partially overlapping LiDAR scans into one frame and says which can be trusted.

>>> import tcm_icp
>>> result = tcm_icp.register(["000.ply", "001.ply", "002.ply"])     # file names, or arrays of the shape (N, 3)
>>> for scan in result.scans:
...     print(scan.name, scan.verdict.name, scan.pose)

Coordinates are metres unless a file's name says otherwise ("hall.e57#2#ft"). The same points, options and seed give the
same bits, from files or from memory, for any number of threads.
"""

from __future__ import annotations

import os
from typing import Callable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from ._core import (Cancelled, ControlPoint, Error, InputError, InvalidInput, InvalidOptions, Link, OutlierMethod, OutputError,
                    Profile, Reason, Scan, Status, Verdict)

__all__ = ["Cancelled", "ControlPoint", "Error", "InputError", "InvalidInput", "InvalidOptions", "Link", "OutlierMethod",
           "OutputError", "Profile", "Reason", "Registration", "Scan", "Status", "Verdict", "find_scans", "linked_libraries", "read_points",
           "register"]

__version__: str = _core.version()
__commit__: str = _core.commit()

ScanLike = Union[str, "os.PathLike[str]", np.ndarray]
ProgressCallback = Callable[[str, int, int], Optional[bool]]


class Registration:
    """What a registration found: scans with poses and verdicts, and the links between them."""

    def __init__(self, core: _core.RegistrationCore, scans: _core.Scans, options: _core.Options, threads: int,
                 seed: int) -> None:
        self._core, self._scans, self._options, self._threads, self._seed = core, scans, options, threads, seed

    @property
    def scans(self) -> list[Scan]:
        """The scans in the order they were given."""
        return self._core.scans

    @property
    def links(self) -> list[Link]:
        """Pairs of scans that overlap at the final poses."""
        return self._core.links

    @property
    def reference(self) -> int:
        """Position of the reference scan, whose frame the poses are in."""
        return self._core.reference

    @property
    def warnings(self) -> list[str]:
        """Of scans that seem to be in another unit than the others."""
        return self._core.warnings

    @property
    def poses(self) -> list[Optional[np.ndarray]]:
        """For each scan the 4 x 4 matrix into the common frame; None where it is unregistered."""
        return [scan.pose for scan in self.scans]

    @property
    def all_registered(self) -> bool:
        """Whether every scan has a pose."""
        return self._core.all_registered()

    def write(self, folder: Union[str, "os.PathLike[str]"], *, overwrite: bool = False, format: str = "ply",
              each: bool = False, voxel_m: float = 0, progress: Optional[ProgressCallback] = None) -> None:
        """Writes what `tcm-icp register` writes: poses, merged cloud, report.json and report.html.

        The points are read a second time. The folder appears when it is complete.

        Args:
            folder: must not exist, unless `overwrite` is set and it is an earlier result.
            format: of the merged cloud: ply, las, pcd, text or e57.
            each: every registered scan in a file of its own, too.
            voxel_m: [m] the merged cloud keeps one point in each cube of this edge; 0: all.
            progress: as for `register`.

        Raises:
            OutputError: it cannot be written. InputError: a scan cannot be read again.
        """
        _core.write(os.fspath(folder), overwrite, format, each, voxel_m, self._scans, self._core, self._options,
                    self._threads, self._seed, progress)


def _survey(scans: _core.Scans, control: Union[None, str, "os.PathLike[str]", Sequence[ControlPoint]],
            gnss: Union[None, str, "os.PathLike[str]"], fixed: Sequence[str], crs: str,
            level_sigma_rad: float) -> _core.Survey:
    survey = _core.Survey()
    if isinstance(control, (str, os.PathLike)):
        survey.add_control_file(os.fspath(control), scans)
    else:
        for point in control or ():
            survey.add_point(point)
    if gnss is not None:
        survey.add_scanner_positions(os.fspath(gnss), scans)
    survey.fixed = [fixed] if isinstance(fixed, str) else list(fixed)
    has_frame = control is not None or gnss is not None or len(survey.fixed) > 0
    if not has_frame and (crs or level_sigma_rad):
        raise InvalidOptions(("crs" if crs else "level_sigma_rad") +
                             ": without control, gnss or fixed poses are in the frame of a scan")
    survey.crs, survey.sigma_level_rad = crs, level_sigma_rad
    return survey


def register(scans: Union[Sequence[ScanLike], Mapping[str, ScanLike]], *, profile: Profile = Profile.ROBUST,
             confidence: float = 0.8, reference: str = "", level: bool = False,
             outliers: OutlierMethod = OutlierMethod.KMEANS,
             control: Union[None, str, "os.PathLike[str]", Sequence[ControlPoint]] = None,
             gnss: Union[None, str, "os.PathLike[str]"] = None, fixed: Sequence[str] = (), crs: str = "",
             level_sigma_rad: float = 0,
             initial_poses: Optional[Sequence[Optional[np.ndarray]]] = None, coarse_voxels: int = 60000,
             fine_voxels: int = 100000, threads: int = 0, seed: int = 42,
             progress: Optional[ProgressCallback] = None) -> Registration:
    """Registers scans: no initial poses are needed.

    Args:
        scans: two or more, each a file name or an array of the shape (N, 3) [m]; a mapping gives arrays names of their
            own, otherwise they are "cloud_0", "cloud_1", ... Arrays of doubles are read in place, others copied. They
            must not change while the result is used.
        profile: the robust method, or the published one.
        confidence: 0 to 1; least probability of its place for a scan to count as registered.
        reference: name or number of the scan whose frame the result is in; empty: chosen.
        level: z points up in every scan, within 10 degrees.
        outliers: what is left out of each scan, and of the merged cloud.
        control: control points and check points: a file as `--control` takes it, or ControlPoints. The poses are into
            their frame then, as with `gnss` and `fixed`; points that contradict the others are left out.
        gnss: a file of the scanners' positions, as `--gnss` takes it.
        fixed: names of scans that stay where `initial_poses` has them.
        crs: coordinate system of that frame for the files of a result: "EPSG:n", or well-known text.
        level_sigma_rad: [rad] standard deviation of each scan's z axis from the vertical, in the adjustment to that
            frame; 0: not known to be upright.
        initial_poses: one 4 x 4 matrix or None for each scan, into any common frame.
        coarse_voxels, fine_voxels: resolution scans are registered and adjusted with, as voxels of a typical scan.
        threads: 0: all. The number changes the time, never the result.
        seed: of all random numbers.
        progress: called with stage, done and total (0: not known), from the calling thread. Answering False stops the
            run with Cancelled; what it raises comes out. Ctrl-C raises KeyboardInterrupt at the next step.

    Raises:
        InvalidOptions: an option out of its bounds, fewer than two scans. InputError: a file that cannot be read.
        InvalidInput: an array of another shape, fewer than three points, the same scan twice. Cancelled: see `progress`.
    """
    options = _core.Options()
    options.profile, options.confidence, options.reference = profile, confidence, str(reference)
    options.level, options.coarse_voxels, options.fine_voxels = level, coarse_voxels, fine_voxels
    options.outliers = outliers
    if initial_poses is not None:
        options.set_initial_poses([None if pose is None else np.asarray(pose, dtype=float) for pose in initial_poses])
    core_scans = _core.Scans()
    named = scans.items() if isinstance(scans, Mapping) else (("", scan) for scan in scans)
    for name, scan in named:
        if isinstance(scan, (str, os.PathLike)):
            core_scans.add_file(os.fspath(scan))
        else:
            core_scans.add_array(name or f"cloud_{len(core_scans)}", scan)
    options.set_survey(_survey(core_scans, control, gnss, fixed, crs, level_sigma_rad))
    core = _core.register(core_scans, options, threads, seed, progress)
    return Registration(core, core_scans, options, threads, seed)


def read_points(file: Union[str, "os.PathLike[str]"]) -> np.ndarray:
    """The finite points of a scan in a file, as an array of the shape (N, 3) [m].

    Raises:
        InputError: naming file, place and remedy.
    """
    return _core.read_points(os.fspath(file))


def find_scans(inputs: Union[str, "os.PathLike[str]", Sequence[Union[str, "os.PathLike[str]"]]]) -> list[str]:
    """Names of all scans in files, folders and patterns, for `register`: folders with all below them, in natural order.

    Raises:
        InputError: a pattern or folder without a scan, a file that is none.
    """
    if isinstance(inputs, (str, os.PathLike)):
        inputs = [inputs]
    return _core.find_scans([os.fspath(path) for path in inputs])


def linked_libraries() -> dict[str, str]:
    """Name and version of each library that this one is built on."""
    return _core.linked_libraries()
