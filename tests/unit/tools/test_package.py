"""The Python package as pip installs it, its client against a scripted daemon, and its examples."""

import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lcm
import numpy as np
import synthetic
from reach import NoAnswerError, Reach, RefusedError, read_log
from reach.messages import ROOT
from reach.messages import reach as types
from scripted import Scripted


class Client(unittest.TestCase):
    def test_what_is_asked_for(self):
        with Scripted() as daemon:
            robot = Reach()
            self.assertEqual(robot.status.experts, 7)
            done = robot.babble(20, seed=9, learn=False)
            self.assertEqual(done.behaviour, done.NONE)
            self.assertEqual(robot.reach(-50, 10, 2.5).error, 1.25)
            robot.coordinate([(1, 2, 3), (4, 5, 6)], period=1.0)
            robot.save(3)
            robot.stop()
        babble, single, coordinate, save, stop = daemon.requests
        self.assertEqual((babble.kind, babble.count, babble.seed, babble.learn), (1, 20, 9, 0))
        self.assertEqual((single.kind, single.n_targets, single.count), (3, 1, 0))
        self.assertEqual(list(single.target[0]), [-50, 10, 2.5])
        self.assertEqual((coordinate.kind, coordinate.n_targets, coordinate.period), (2, 2, 1.0))
        self.assertEqual(list(coordinate.target[1]), [4, 5, 6])
        self.assertEqual((save.kind, save.count, stop.kind), (4, 3, 0))
        numbers = [request.seq for request in daemon.requests]
        self.assertEqual(numbers, sorted(set(numbers)))

    def test_every_call_of_reachctl(self):
        body = types.body_t()
        body.samples = 30
        with Scripted(also={"REACH_BODY_IN_USE": body.encode()}) as daemon:
            robot = Reach()
            robot.explore(50, seed=3)
            robot.star(period=2)
            self.assertEqual(robot.body().samples, 30)
            robot.forget_body()
            robot.sim.attach(2)
            robot.sim.detach()
            robot.sim.light(0.5)
            robot.sim.run_until(2.5)
            robot.sim.quit()
            with self.assertRaises(ValueError):
                robot.sim.attach(0)
        explore, star, tell, forget = daemon.requests
        self.assertEqual((explore.kind, explore.count, explore.seed), (8, 50, 3))
        self.assertEqual((star.kind, star.count, star.n_targets, star.period), (3, 1, 16, 2.0))
        self.assertEqual((tell.kind, forget.kind), (9, 10))
        asked = {request.seq: request for request in daemon.sim_requests}.values()
        said = [(r.kind, r.tool, r.value, r.until) for r in asked]
        self.assertEqual(said[:4], [(0, 2, 0, 0), (0, 0, 0, 0), (2, 0, 0.5, 0), (6, 0, 0, 2500000)])

    def test_a_silent_simulator(self):
        with self.assertRaisesRegex(NoAnswerError, "simrobot in 0.2 s"):
            Reach(timeout=0.2).sim.reset()

    def test_a_fault_is_left_or_told(self):
        with Scripted(faults=20):
            self.assertEqual(Reach().reset_fault().state, types.status_t.IDLE)
        with Scripted(faults=10**6), self.assertRaisesRegex(RefusedError, "still in its fault"):
            Reach(timeout=0.5).reset_fault()

    def test_a_second_client_is_not_taken_for_the_first(self):
        with Scripted() as daemon:
            Reach().stop()
            Reach().stop()
        self.assertEqual(len({request.seq for request in daemon.requests}), 2)

    def test_not_waiting(self):
        with Scripted():
            self.assertEqual(Reach().babble(20, wait=False).behaviour, types.status_t.REACH)

    def test_refusal_silence_and_nonsense(self):
        with Scripted(types.status_t.REFUSED_VALUE), self.assertRaisesRegex(RefusedError, "value"):
            Reach().babble(20)
        with self.assertRaisesRegex(NoAnswerError, "0.3 s"):
            Reach(timeout=0.3).stop()
        with self.assertRaises(ValueError):
            Reach().reach_all([(1, 2)])


class Installed(unittest.TestCase):
    """By pip into a folder of its own, without the tree and without the build."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = Path(cls.folder.name)
        cls.site = cls.work / "site"
        command = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-index",
                   "--disable-pip-version-check", "--target", cls.site, ROOT]  # fmt: skip
        subprocess.run(command, check=True, timeout=100)
        synthetic.make(cls.work)
        cls.log = cls.work / "run.lcmlog"
        cls.record = read_log(cls.log)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def python(self, *words) -> subprocess.CompletedProcess:
        environment = {**os.environ, "PYTHONPATH": str(self.site)}
        return subprocess.run([sys.executable, *map(str, words)], env=environment, cwd=self.work,
                              capture_output=True, text=True, timeout=60)  # fmt: skip

    def export(self, *words) -> subprocess.CompletedProcess:
        return self.python(self.site / "bin/reach-export", *words)

    def test_it_is_the_installed_one(self):
        result = self.python("-c", "import reach, reach_lcm; print(reach.__file__)")
        self.assertEqual(result.stdout.strip(), str(self.site / "reach/__init__.py"), result.stderr)

    def test_export_in_every_format(self):
        outputs = {"--csv": "csv", "--parquet": "parquet", "--mcap": "run.mcap",
                   "--test-samples": "samples.csv"}  # fmt: skip
        words = [word for option, name in outputs.items() for word in (option, self.work / name)]
        result = self.export(self.log, *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        with (self.work / "csv/MARKER.csv").open() as file:
            rows = list(csv.DictReader(file))
        column = [float(row["u_right"]) for row in rows]
        np.testing.assert_array_equal(column, self.record["MARKER"]["u_right"])
        for name in ("parquet/MARKER.parquet", "run.mcap", "samples.csv"):
            self.assertGreater((self.work / name).stat().st_size, 100)

    def test_a_record_iterates_and_prints_itself(self):
        self.assertIn("MARKER", self.record)
        self.assertNotIn("LEARNER_REPLY", self.record)
        self.assertIn("MARKER", list(self.record))
        self.assertIn(f"{len(self.record['MARKER'])} messages", repr(self.record))

    def test_a_log_of_another_version_is_told(self):
        path = self.work / "other.lcmlog"
        log = lcm.EventLog(str(path), "w", overwrite=True)
        log.write_event(1, "REACH_STATUS", b"another." + bytes(3000))
        log.close()
        with self.assertWarnsRegex(UserWarning, "another version.*1 of REACH_STATUS"):
            read_log(path)

    def test_export_says_what_is_wrong(self):
        self.assertEqual(self.export(self.log).returncode, 2)
        for log in (self.work / "none.lcmlog", ROOT / "README.md"):
            result = self.export(log, "--csv", self.work / "nothing")
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn(log.name, result.stderr)
        self.assertIn("usage: reach-export", self.export("--help").stdout)
        version = r"^reach-export \d+\.\d+\.\d+ \(\w+(-dirty)?\)\n$"
        self.assertRegex(self.export("--version").stdout, version)

    def test_examples(self):
        result = self.python(ROOT / "examples/reading_a_log.py", self.log)
        self.assertEqual(result.returncode, 0, result.stderr)
        ticks = len(self.record["REACH_STATUS"])
        self.assertIn(f"{ticks} ticks, ", result.stdout)
        self.assertIn("3 experts at the end", result.stdout)
        self.assertGreater((self.work / "reading_a_log.png").stat().st_size, 10_000)
        result = self.python(ROOT / "examples/learning_curve.py", self.log)
        self.assertEqual(result.returncode, 0, result.stderr)
        # Every prediction of the made-up log is off by this.
        off = f"{synthetic.YAW_ERROR:.3g} at first, {synthetic.YAW_ERROR:.3g} at last"
        self.assertIn(f"the solution in use: {off}", result.stdout)
        self.assertIn(f"the best of all: {off}", result.stdout)


if __name__ == "__main__":
    unittest.main()
