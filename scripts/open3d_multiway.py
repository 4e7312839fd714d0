#!/usr/bin/env python3
"""Registers scans with Open3D as its tutorials do, for scripts/compare_registration.py.

  open3d_multiway.py SCAN.ply... --out POSES.json --variant ransac|fgr [--seed N] [--cpu-limit S]

Voxel sampling, normals, FPFH, RANSAC (or FGR) for all pairs, point-to-plane ICP; numbers are the tutorials' multiples
of the voxel size. A pair is a link by the rule of Open3D's own reconstruction system: correspondences of 0.3 of the
smaller cloud. Links are refined by ICP on voxels of a quarter of the size, and go with their information matrices into
a pose graph, all edges uncertain, for global optimisation. Scans that no kept edge ties to the reference are
"unregistered". Voxel sizes are 4, 8, 16 and 32 times the spacing as far as they leave
1,000 to 30,000 points of the median scan, coarse ones first; the one that connects most scans wins, among equals the
one of the best mean fitness.
"""

import argparse
import itertools
import json
import sys
import time
from pathlib import Path

import numpy as np

try:
    import open3d as o3d
except ImportError:
    sys.exit("open3d_multiway.py: Open3D is missing: apt install python3-open3d, and run it with /usr/bin/python3")

registration = o3d.pipelines.registration
MULTIPLES, LEAST_POINTS, MOST_POINTS = (32, 16, 8, 4), 1000, 30000
LEAST_SHARE = 0.3  # of the smaller cloud, for a link


class OutOfTime(Exception):
    pass


def spacing_of(clouds):
    return float(np.median([np.median(c.compute_nearest_neighbor_distance()) for c in clouds]))


def sizes_to_try(clouds, spacing):
    counts = {m: np.median([len(c.voxel_down_sample(m * spacing).points) for c in clouds]) for m in MULTIPLES}
    fitting = [m for m in MULTIPLES if LEAST_POINTS <= counts[m] <= MOST_POINTS]
    return fitting or [min(MULTIPLES, key=lambda m: abs(np.log(counts[m] / 4000)))]


def surface(cloud, voxel):
    down = cloud.voxel_down_sample(voxel)
    down.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(radius=2 * voxel, max_nn=30))
    # FPFH reads the normals' signs; the place of the scanner is not in the files.
    down.orient_normals_towards_camera_location(down.get_center())
    return down


def prepare(cloud, voxel):
    down = surface(cloud, voxel)
    return down, registration.compute_fpfh_feature(
        down, o3d.geometry.KDTreeSearchParamHybrid(radius=5 * voxel, max_nn=100))


def icp(source, target, reach, T):
    return registration.registration_icp(source, target, reach, T,
                                         registration.TransformationEstimationPointToPlane()).transformation


def align_pair(source, target, voxel, variant):
    """(T_target_source, correspondences as a share of the smaller cloud)."""
    (a, fa), (b, fb) = source, target
    reach = 1.5 * voxel
    if variant == "ransac":
        checks = [registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
                  registration.CorrespondenceCheckerBasedOnDistance(reach)]
        coarse = registration.registration_ransac_based_on_feature_matching(
            a, b, fa, fb, True, reach, registration.TransformationEstimationPointToPoint(False), 3, checks,
            registration.RANSACConvergenceCriteria(100000, 0.999))
    else:
        coarse = registration.registration_fgr_based_on_feature_matching(
            a, b, fa, fb, registration.FastGlobalRegistrationOption(maximum_correspondence_distance=0.5 * voxel))
    T = icp(a, b, reach, coarse.transformation)
    information = registration.get_information_matrix_from_point_clouds(a, b, reach, T)
    return T, information[5, 5] / min(len(a.points), len(b.points))


def refine(links, clouds, voxel):
    """The links with poses and information from surfaces four times as fine."""
    fine = [surface(c, voxel / 4) for c in clouds]
    out = []
    for i, j, T, _, share in links:
        for reach in (voxel, 1.5 * voxel / 4):
            T = icp(fine[i], fine[j], reach, T)
        information = registration.get_information_matrix_from_point_clouds(fine[i], fine[j], 1.5 * voxel / 4, T)
        out.append((i, j, T, information, share))
    return out


def best_tree(count, links):
    """Greedy maximum spanning forest by share: [(i, j, T_j_i, share)], and each scan's component."""
    component, tree = list(range(count)), []
    for i, j, T, _, share in sorted(links, key=lambda link: -link[4]):
        if component[i] != component[j]:
            old, new = component[j], component[i]
            component = [new if c == old else c for c in component]
            tree.append((i, j, T, share))
    return tree, component


def poses_from_tree(count, tree, root):
    """T_root_scan by walking the tree; None where it does not lead."""
    poses = [None] * count
    poses[root] = np.eye(4)
    for _ in range(count):
        for i, j, T_j_i, _ in tree:
            if poses[i] is None and poses[j] is not None:
                poses[i] = poses[j] @ T_j_i
            elif poses[j] is None and poses[i] is not None:
                poses[j] = poses[i] @ np.linalg.inv(T_j_i)
    return poses


def optimise(count, links, voxel):
    """Poses (None: not connected) and the reference, a scan of most links in the largest component."""
    tree, component = best_tree(count, links)
    largest = max(component, key=component.count)
    degree = [sum(component[k] == largest and k in link[:2] for link in links) for k in range(count)]
    root = int(np.argmax(degree)) if links else 0
    start = poses_from_tree(count, tree, root)
    members = [k for k in range(count) if start[k] is not None]
    graph = registration.PoseGraph()
    for k in members:
        graph.nodes.append(registration.PoseGraphNode(start[k]))
    for i, j, T, information, _ in links:
        if i in members and j in members:
            graph.edges.append(registration.PoseGraphEdge(members.index(i), members.index(j), T, information,
                                                          uncertain=True))
    if graph.edges:
        registration.global_optimization(
            graph, registration.GlobalOptimizationLevenbergMarquardt(),
            registration.GlobalOptimizationConvergenceCriteria(),
            registration.GlobalOptimizationOption(max_correspondence_distance=1.5 * voxel, edge_prune_threshold=0.25,
                                                  preference_loop_closure=2.0, reference_node=members.index(root)))
    kept = [(members[e.source_node_id], members[e.target_node_id], None, None, 1) for e in graph.edges]
    _, component = best_tree(count, kept)
    poses = [None] * count
    for position, k in enumerate(members):
        if component[k] == component[root]:
            poses[k] = np.array(graph.nodes[position].pose)
    return poses, root


def links_at(clouds, voxel, variant, deadline):
    prepared = [prepare(c, voxel) for c in clouds]
    links = []
    for i, j in itertools.combinations(range(len(clouds)), 2):
        if time.process_time() > deadline:
            raise OutOfTime
        T, share = align_pair(prepared[i], prepared[j], voxel, variant)
        if share >= LEAST_SHARE:
            links.append((i, j, T, None, share))
    return links


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("scans", nargs="+", type=Path)
    ap.add_argument("--out", type=Path, required=True)
    ap.add_argument("--variant", choices=("ransac", "fgr"), required=True)
    ap.add_argument("--seed", type=int, default=1)
    ap.add_argument("--cpu-limit", type=float, default=float("inf"), help="[s] no pair of another size than the first is begun later")
    a = ap.parse_args()
    o3d.utility.random.seed(a.seed)
    o3d.utility.set_verbosity_level(o3d.utility.VerbosityLevel.Error)
    clouds = [o3d.io.read_point_cloud(str(p), remove_nan_points=True, remove_infinite_points=True) for p in a.scans]
    spacing = spacing_of(clouds)
    best, tried = None, []
    for multiple in sizes_to_try(clouds, spacing):
        begin = time.process_time()
        try:
            # The first size is finished whatever it takes: a late answer says more than none.
            links = links_at(clouds, multiple * spacing, a.variant, a.cpu_limit if best else float("inf"))
        except OutOfTime:
            tried.append({"multiple": multiple, "out_of_time": True, "cpu_s": time.process_time() - begin})
            break
        tree, component = best_tree(len(clouds), links)
        connected = max(component.count(c) for c in component)
        fitness = float(np.mean([link[3] for link in tree])) if tree else 0.0
        tried.append({"multiple": multiple, "voxel": multiple * spacing, "connected": connected, "fitness": fitness,
                      "cpu_s": time.process_time() - begin})
        if best is None or (connected, fitness) > best[0]:
            best = ((connected, fitness), multiple, links)
    _, multiple, links = best
    voxel = multiple * spacing
    poses, root = optimise(len(clouds), refine(links, clouds, voxel), voxel / 4)
    to_root = np.linalg.inv(poses[root])
    scans = []
    for k, path in enumerate(a.scans):
        status = "unregistered" if poses[k] is None else "reference" if k == root else "registered"
        scans.append({"file": path.name, "status": status,
                      "pose": None if poses[k] is None else (to_root @ poses[k]).tolist()})
    a.out.write_text(json.dumps({"reference": a.scans[root].name, "scans": scans, "chosen_multiple": multiple,
                                 "tried": tried}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
