"""The Python module: what it returns is what the program writes. Run by CTest with PYTHONPATH, SAHL_PROGRAM and
SAHL_STUBS."""

import ast
import json
import os
import signal
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np
import sahl

PROGRAM = os.environ["SAHL_PROGRAM"]
BALL = {
    "title": "a ball",
    "trace": {"min_power": 1e-4, "log": True},
    "object": [{"name": "ball", "shape": {"sphere": {"radius_mm": 5}}, "medium": "N-BK7"}],
    "source": [{"name": "beam", "lines": ["F", "d"],
                "beam": {"from_mm": [0, 0, -10], "toward": [0, 0, 1], "radius_mm": 4, "pattern": "random", "rays": 300}}],
    "detector": [{"name": "screen", "at_mm": [0, 0, 20], "facing": [0, 0, -1], "size_mm": [30, 30]}],
}


def without_time(summary):
    different = ("seconds", "segments_per_second", "threads", "experiment_sha256", "options")
    return {key: value for key, value in summary.items() if key not in different}


class Module(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        (self.path / "ball.json").write_text(json.dumps(BALL))

    def tearDown(self):
        self.folder.cleanup()

    def program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)

    def test_a_file_gives_the_summary_that_the_program_prints(self):
        printed = self.program("trace", self.path / "ball.json", "--out", self.path / "out", "--json")
        summary, failures = sahl.run(self.path / "ball.json", out=self.path / "again")
        self.assertEqual(without_time(summary), without_time(json.loads(printed.stdout)))
        self.assertEqual(failures, [])

    def test_a_dict_gives_what_its_file_gives(self):
        from_dict = sahl.run(BALL, set=["trace.seed=5"])[0]
        from_file = sahl.run(str(self.path / "ball.json"), set=["trace.seed=5"])[0]
        self.assertEqual(without_time(from_dict), without_time(from_file))
        self.assertEqual(from_dict["seed"], 5)

    def test_columns_are_those_of_the_file_bit_by_bit(self):
        import h5py
        sahl.run(BALL, out=self.path / "out")
        log = sahl.read_log(self.path / "out")
        with h5py.File(self.path / "out" / "rays.h5") as file:
            self.assertEqual(set(log.columns), set(file["segments"]))
            for name, column in file["segments"].items():
                self.assertEqual(log[name].dtype, column.dtype)
                self.assertEqual(log[name].tobytes(), column[:].tobytes(), name)
            self.assertEqual(log.surfaces, list(file["surfaces/name"].asstr()[:]))
        self.assertGreater(len(log), 1000)
        self.assertEqual(log.sources, ["beam"])

    def test_columns_are_not_copied(self):
        sahl.run(BALL, out=self.path / "out")
        log = sahl.read_log(self.path / "out")
        column = log["x_mm"]
        self.assertFalse(column.flags.owndata)
        self.assertIs(column, log["x_mm"])
        first = column[0]
        del log  # the array keeps its memory
        self.assertEqual(column[0], first)

    def test_a_filter_leaves_the_rows_of_its_paths(self):
        sahl.run(BALL, out=self.path / "out")
        whole, some = sahl.read_log(self.path / "out"), sahl.read_log(self.path / "out", where="ends(screen)")
        self.assertTrue(0 < len(some) < len(whole))
        detected = sahl.events.index("detected")
        self.assertEqual(np.sum(some["ended"] == detected), np.sum(whole["ended"] == detected))

    def test_paths_are_those_of_the_program(self):
        sahl.run(BALL, out=self.path / "out")
        self.assertEqual(sahl.paths(self.path / "out", share=0.01),
                         json.loads(self.program("paths", self.path / "out", "--share", 0.01, "--json").stdout))

    def test_an_error_is_an_exception_with_the_text_of_the_program(self):
        wrong = dict(BALL, surroundings="water vapor")
        (self.path / "wrong.json").write_text(json.dumps(wrong))
        said = self.program("trace", self.path / "wrong.json", "--out", self.path / "out")
        self.assertEqual(said.returncode, 3)
        with self.assertRaises(sahl.InputError) as caught:
            sahl.run(self.path / "wrong.json")
        self.assertEqual("sahl: " + str(caught.exception) + "\n", said.stderr)
        self.assertIsInstance(caught.exception, ValueError)
        sahl.run(BALL, out=self.path / "out")
        with self.assertRaisesRegex(sahl.InputError, r"where: .*'bal'.*\n.*hits\(bal\)\n +\^\^\^"):
            sahl.read_log(self.path / "out", where="hits(bal)")
        with self.assertRaises(KeyError):
            sahl.read_log(self.path / "out")["no such column"]

    def test_other_threads_of_python_go_on_meanwhile(self):
        done = threading.Event()
        counted = 0

        def count():
            nonlocal counted
            while not done.is_set():
                counted += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = counted
        sahl.run(BALL, set=["source.beam.beam.rays=400000", "trace.log=false"])
        during = counted - before
        done.set()
        thread.join()
        self.assertGreater(during, 5)

    def test_ctrl_c_stops_a_run_and_leaves_nothing(self):
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            sahl.run(BALL, set=["source.beam.beam.rays=20000000", "trace.log=false"], out=self.path / "out")
        self.assertEqual([entry.name for entry in self.path.iterdir()], ["ball.json"])
        self.assertEqual(sahl.run(BALL)[1], [])  # and the module works on

    def test_the_stubs_name_what_the_module_has(self):
        tree = ast.parse(Path(os.environ["SAHL_STUBS"]).read_text())
        named = {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        named |= {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
        there = {name for name in dir(sahl) if not name.startswith("__")} | {"__version__"}
        self.assertEqual(named, there)
        methods = {node.name for owner in tree.body if isinstance(owner, ast.ClassDef) and owner.name == "Log"
                   for node in owner.body if isinstance(node, ast.FunctionDef)}
        self.assertTrue(all(hasattr(sahl.Log, method) for method in methods))


if __name__ == "__main__":
    unittest.main()
