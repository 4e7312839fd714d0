"""The Python module on the shipped example. PYTHONPATH leads to it, TCM_ICP_TOWN to the example."""

import ast
import inspect
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import tcm_icp
from tcm_icp import _core

try:
    import open3d
except ImportError:
    open3d = None

TOWN = Path(os.environ["TCM_ICP_TOWN"])
FILES = sorted(TOWN.glob("*.ply"))
TRUTH = {scan["file"]: np.array(scan["pose"]) for scan in json.loads((TOWN / "truth.json").read_text())["scans"]}


def error_m(result, scan, points):
    """Root mean square distance of a scan's points from where the truth has them."""
    truth = np.linalg.inv(TRUTH[FILES[result.reference].name]) @ TRUTH[FILES[scan].name]
    wrong = result.scans[scan].pose - truth
    return np.sqrt(np.mean(np.sum((points @ wrong[:3, :3].T + wrong[:3, 3]) ** 2, axis=1)))


class Town(unittest.TestCase):
    """One registration from files, one from memory."""

    @classmethod
    def setUpClass(cls):
        cls.clouds = [tcm_icp.read_points(file) for file in FILES]
        cls.from_files = tcm_icp.register(FILES)
        cls.stages = []
        cls.from_memory = tcm_icp.register(cls.clouds, threads=1,
                                           progress=lambda stage, done, total: cls.stages.append((stage, done, total)))

    def test_every_scan_is_registered_where_the_truth_has_it(self):
        self.assertTrue(self.from_files.all_registered)
        for i, cloud in enumerate(self.clouds):
            self.assertLess(error_m(self.from_files, i, cloud), 0.005)  # README: 1.3 mm; the scans lie 40 m apart
            scan = self.from_files.scans[i]
            self.assertEqual(scan.name, FILES[i].name)
            self.assertEqual(scan.num_points, len(cloud))
            self.assertEqual(scan.verdict, tcm_icp.Verdict.ACCEPTED)
            self.assertGreaterEqual(scan.probability, 0.8)
            if i != self.from_files.reference:
                self.assertEqual((scan.status, scan.reason), (tcm_icp.Status.REGISTERED, tcm_icp.Reason.ACCEPTED))
                self.assertGreater(scan.sigma_position_m, 0)
        self.assertEqual(self.from_files.scans[self.from_files.reference].status, tcm_icp.Status.REFERENCE)
        self.assertGreaterEqual(len(self.from_files.links), 5)

    def test_arrays_give_the_same_bits_as_files(self):
        for a, b in zip(self.from_files.scans, self.from_memory.scans):
            np.testing.assert_array_equal(a.pose, b.pose)
            self.assertEqual(a.probability, b.probability)
        self.assertEqual(self.from_memory.scans[3].name, "cloud_3")

    def test_progress_names_stages_and_counts(self):
        self.assertIn("reading", {stage for stage, _, _ in self.stages})
        self.assertTrue(all(done <= total or total == 0 for _, done, total in self.stages))

    def test_a_result_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            self.from_memory.write(out, format="las", voxel_m=0.5)
            poses = json.loads((out / "poses.json").read_text())
            self.assertEqual([scan["file"] for scan in poses["scans"]], [f"cloud_{i}" for i in range(6)])
            np.testing.assert_array_equal(np.array(poses["scans"][2]["pose"]), self.from_memory.poses[2])
            self.assertTrue((out / "registered.las").exists() and (out / "report.html").exists())
            with self.assertRaisesRegex(tcm_icp.OutputError, "out"):
                self.from_memory.write(out)
            with self.assertRaisesRegex(tcm_icp.InvalidOptions, "choose one of"):
                self.from_memory.write(Path(folder) / "other", format="docx")


@unittest.skipUnless(open3d, "Open3D is not installed")
class BesideOpen3D(unittest.TestCase):
    """Clouds go over and back, and Open3D's own measures agree with ours."""

    def test_clouds_of_open3d_are_registered(self):
        clouds = [open3d.io.read_point_cloud(str(file)) for file in FILES]
        result = tcm_icp.register([np.asarray(cloud.points) for cloud in clouds])
        self.assertTrue(result.all_registered)
        for i, cloud in enumerate(clouds):
            self.assertLess(error_m(result, i, np.asarray(cloud.points)), 0.005)
        link = max(result.links, key=lambda k: k.overlap)
        a, b = result.poses[link.a], result.poses[link.b]
        there = open3d.pipelines.registration.evaluate_registration(clouds[link.b], clouds[link.a], 0.3,
                                                                    np.linalg.inv(a) @ b)
        elsewhere = open3d.pipelines.registration.evaluate_registration(clouds[link.b], clouds[link.a], 0.3)
        self.assertGreater(there.fitness, 0.5)
        self.assertLess(elsewhere.fitness, 0.5 * there.fitness)  # as they lie they are far apart


class Calls(unittest.TestCase):
    def setUp(self):
        self.clouds = [tcm_icp.read_points(file) for file in FILES[:3]]

    def test_other_kinds_of_arrays_are_taken(self):
        arrays = {"first": np.asfortranarray(self.clouds[0]), "second": self.clouds[1].astype(np.float32),
                  "third": self.clouds[2][::2]}
        result = tcm_icp.register(arrays, confidence=0)
        self.assertEqual([scan.name for scan in result.scans], list(arrays))
        self.assertEqual(result.scans[2].num_points, len(arrays["third"]))

    def test_initial_poses_are_used(self):
        poses = [np.linalg.inv(TRUTH[FILES[0].name]) @ TRUTH[file.name] for file in FILES[:3]]
        result = tcm_icp.register(self.clouds, profile=tcm_icp.Profile.PAPER, reference="0", initial_poses=poses)
        self.assertEqual(result.scans[1].verdict, tcm_icp.Verdict.DOUBTFUL)  # this profile does not verify
        self.assertEqual(result.scans[1].reason, tcm_icp.Reason.NOT_DECIDED)
        self.assertLess(np.abs(result.poses[1] - poses[1]).max(), 1)
        with self.assertRaisesRegex(tcm_icp.InvalidInput, "rigid"):
            tcm_icp.register(self.clouds, initial_poses=[2 * np.eye(4), None, None])
        with self.assertRaisesRegex(tcm_icp.InvalidOptions, "1 initial poses for 3"):
            tcm_icp.register(self.clouds, initial_poses=[None])

    def test_outliers_are_left_out_as_asked(self):
        counts = {}
        with tempfile.TemporaryDirectory() as folder:
            for method in (tcm_icp.OutlierMethod.NONE, tcm_icp.OutlierMethod.DISTANCE):
                out = Path(folder) / method.name
                tcm_icp.register(self.clouds, outliers=method).write(out)
                report = json.loads((out / "report.json").read_text())
                counts[method.name] = sum(s["outliers"]["working_points_removed"] for s in report["scans"])
                self.assertEqual(report["options"]["outliers"], method.name.lower())
        self.assertEqual(counts["NONE"], 0)
        self.assertGreater(counts["DISTANCE"], 0)

    def test_control_points_define_the_frame(self):
        survey = np.eye(4)  # 500 km away, turned by 30 degrees
        survey[:2, :2] = [[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]]
        survey[:3, 3] = 512345, 5412301, 287
        places = np.array([[3, 4, 1], [-8, 2, 2], [10, -6, 3], [0, 12, 1.5], [20, 3, 4]])
        points, lines = [], ["name,scan,x,y,z,X,Y,Z,sigma,sigma_scan,use"]
        for k, place in enumerate(places):
            scan = k % 3
            at = np.linalg.inv(TRUTH[FILES[scan].name]) @ [*place, 1]
            given = survey @ [*place, 1]
            points.append(tcm_icp.ControlPoint(f"T{k}", f"cloud_{scan}", at[:3], given[:3], 0.001, [0.001] * 3, is_check=k == 4))
            row = [repr(float(x)) for x in (*at[:3], *given[:3])] + ["0.001", "0.001", "check" if k == 4 else "control"]
            lines.append(",".join([f"T{k}", FILES[scan].name, *row]))
        result = tcm_icp.register(self.clouds, control=points, crs="EPSG:32632")
        for scan, file in zip(result.scans, FILES):
            wrong = scan.pose - survey @ TRUTH[file.name]
            self.assertLess(np.abs(self.clouds[0] @ wrong[:3, :3].T + wrong[:3, 3]).max(), 0.05)
        self.assertTrue(points[4].is_check and not points[0].is_check)
        np.testing.assert_array_equal(points[0].sigma_measured_m, [0.001] * 3)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "control.csv"
            file.write_text("\n".join(lines) + "\n")
            again = tcm_icp.register(FILES[:3], control=file)
            np.testing.assert_allclose(again.poses[1], result.poses[1], rtol=0, atol=1e-6)
            result.write(Path(folder) / "out")
            poses = json.loads((Path(folder) / "out" / "poses.json").read_text())
            self.assertEqual((poses["frame"], poses["crs"]), ("control points", "EPSG:32632"))
            file.write_text(lines[0] + "\nT,nowhere.ply,1,2,3,4,5,6,0.01,0.01,control\n")
            with self.assertRaisesRegex(tcm_icp.InputError, "nowhere.ply"):
                tcm_icp.register(FILES[:3], control=file)

    def test_misuse_of_a_survey_is_told(self):
        with self.assertRaisesRegex(tcm_icp.InvalidInput, "T1: sigma_m must be above 0"):
            tcm_icp.ControlPoint("T1", "cloud_0", [1, 2, 3], [4, 5, 6], 0)
        with self.assertRaisesRegex(tcm_icp.InvalidInput, "not a finite number"):
            tcm_icp.ControlPoint("T1", "cloud_0", [1, 2, np.nan], [4, 5, 6], 0.01)
        with self.assertRaisesRegex(tcm_icp.InvalidOptions, "crs: without control"):
            tcm_icp.register(self.clouds, crs="EPSG:32632")
        with self.assertRaisesRegex(tcm_icp.InvalidOptions, "cloud_9"):
            tcm_icp.register(self.clouds, control=[tcm_icp.ControlPoint("T1", "cloud_9", [1, 2, 3], [4, 5, 6], 0.01)])
        with self.assertRaisesRegex(tcm_icp.InvalidOptions, "cloud_1"):
            tcm_icp.register(self.clouds, fixed=["cloud_1"])  # without initial poses

    def test_misuse_raises_what_it_is(self):
        with self.assertRaisesRegex(tcm_icp.InputError, "missing.ply"):
            tcm_icp.register(["missing.ply", FILES[0]])
        with self.assertRaisesRegex(tcm_icp.InvalidInput, r"\(N, 3\)"):
            tcm_icp.register([np.zeros((5, 2)), self.clouds[0]])
        with self.assertRaisesRegex(tcm_icp.InvalidOptions, "at least two scans"):
            tcm_icp.register([self.clouds[0]])
        with self.assertRaisesRegex(tcm_icp.InvalidOptions, "confidence"):
            tcm_icp.register(self.clouds, confidence=2)
        with self.assertRaises(tcm_icp.InputError):
            tcm_icp.find_scans("no/such/*.ply")
        self.assertTrue(issubclass(tcm_icp.InputError, tcm_icp.Error))

    def test_progress_stops_a_run(self):
        with self.assertRaises(tcm_icp.Cancelled):
            tcm_icp.register(self.clouds, progress=lambda *_: False)

        def fail(stage, done, total):
            raise ZeroDivisionError(stage)

        with self.assertRaisesRegex(ZeroDivisionError, "reading"):
            tcm_icp.register(self.clouds, progress=fail)

    def test_other_python_threads_run_meanwhile(self):
        turns, done = 0, threading.Event()
        worker = threading.Thread(target=lambda: (tcm_icp.register(self.clouds, threads=1), done.set()))
        worker.start()
        while not done.wait(0.01):
            turns += 1
        worker.join()
        self.assertGreater(turns, 20)  # a run takes seconds; with the GIL held it would be none

    def test_folders_and_patterns_are_listed(self):
        self.assertEqual(tcm_icp.find_scans(TOWN), [str(file) for file in FILES])
        self.assertEqual(tcm_icp.find_scans([str(TOWN / "00[01].ply")]), [str(file) for file in FILES[:2]])


class Processes(unittest.TestCase):
    def test_ctrl_c_is_a_keyboard_interrupt(self):
        code = ("import sys, tcm_icp\n"
                "try:\n"
                "    while True: tcm_icp.register(sys.argv[1:], progress=lambda *a: print(*a, flush=True))\n"
                "except KeyboardInterrupt:\n"
                "    print('interrupted', flush=True)\n")
        with subprocess.Popen([sys.executable, "-c", code, *map(str, FILES)], stdout=subprocess.PIPE, text=True) as run:
            run.stdout.readline()  # it has begun
            time.sleep(0.2)
            run.send_signal(signal.SIGINT)
            rest = run.stdout.read()
        self.assertTrue(rest.endswith("interrupted\n"), rest[-500:])

    def test_the_example_runs(self):
        example = Path(os.environ["TCM_ICP_EXAMPLES"]) / "register_arrays.py"
        run = subprocess.run([sys.executable, example, *FILES], capture_output=True, text=True, check=True)
        self.assertEqual(run.stdout.count("ACCEPTED"), 6)


class Documentation(unittest.TestCase):
    def test_stubs_have_every_name_and_no_other(self):
        tree = ast.parse((Path(_core.__file__).parent / "_core.pyi").read_text())
        stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        public = {name for name in vars(_core) if not name.startswith("_")}
        self.assertEqual({name for name in stubs if not name.startswith("_")}, public)
        for name in public:
            if not inspect.isclass(getattr(_core, name)) or issubclass(getattr(_core, name), Exception):
                continue
            members = {n.name for n in stubs[name].body if isinstance(n, ast.FunctionDef)}
            members |= {n.target.id for n in stubs[name].body if isinstance(n, ast.AnnAssign)}
            inherited = {"name", "value"} if hasattr(getattr(_core, name), "__members__") else set()
            there = {m for m in vars(getattr(_core, name)) if not m.startswith("_")}
            self.assertEqual(members - {"__init__", "__len__"}, there - inherited, name)

    def test_every_public_name_has_a_docstring(self):
        for name in tcm_icp.__all__:
            item = getattr(tcm_icp, name)
            if inspect.isclass(item) and issubclass(item, Exception):
                continue
            self.assertTrue(item.__doc__, name)
            for member, value in vars(item).items() if inspect.isclass(item) else ():
                if not member.startswith("_") and member not in ("name", "value") and (isinstance(value, property) or inspect.isfunction(value)):
                    self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_versions_are_told(self):
        self.assertRegex(tcm_icp.__version__, r"^\d+\.\d+\.\d+$")
        self.assertIn("CGAL", tcm_icp.linked_libraries())


if __name__ == "__main__":
    unittest.main()
