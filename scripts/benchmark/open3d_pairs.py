#!/usr/bin/env python3
"""open3d_pairs.py FOLDER: registers the pair that tcm_icp_benchmark_registration --dump wrote there, from each of its starts, by
each of Open3D's methods. Prints, by method, processor times [s] and poses.

Times go from points to pose: normals, trees and covariances count, as for the others."""

import json
import sys
import time
from pathlib import Path

import numpy as np
import open3d

registration = open3d.pipelines.registration
CRITERIA = registration.ICPConvergenceCriteria(1e-6, 1e-6, 100)
NEIGHBORS = open3d.geometry.KDTreeSearchParamKNN(20)


def copy_of(cloud, normals):
    cloud = open3d.geometry.PointCloud(cloud)
    if normals:
        cloud.estimate_normals(NEIGHBORS)
    return cloud


def by_icp(source, target, start, gates, estimation, normals):
    a, b = copy_of(source, False), copy_of(target, normals)
    for gate in gates:
        start = registration.registration_icp(a, b, gate, start, estimation(), CRITERIA).transformation
    return start


def by_gicp(source, target, start, gates):
    a, b = copy_of(source, True), copy_of(target, True)
    for gate in gates:
        start = registration.registration_generalized_icp(
            a, b, gate, start, registration.TransformationEstimationForGeneralizedICP(), CRITERIA).transformation
    return start


METHODS = {
    "icp_two_gates": lambda *pair: by_icp(*pair, registration.TransformationEstimationPointToPoint, False),
    "point_to_plane_two_gates": lambda *pair: by_icp(*pair, registration.TransformationEstimationPointToPlane, True),
    "gicp_two_gates": by_gicp,
}


def main():
    folder = Path(sys.argv[1])
    pair = json.loads((folder / "pair.json").read_text(encoding="utf-8"))
    open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
    source, target = (open3d.io.read_point_cloud(str(folder / f"{name}.ply")) for name in ("source", "target"))
    out = {}
    for name, method in METHODS.items():
        out[name] = []
        for start in pair["starts"]:
            begin = time.process_time()
            T = method(source, target, np.array(start), pair["gates_m"])
            out[name].append({"cpu_s": time.process_time() - begin, "T_target_source": np.asarray(T).tolist()})
    print(json.dumps(out))


if __name__ == "__main__":
    main()
