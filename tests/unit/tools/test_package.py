"""The Python package as pip installs it, its client against a scripted daemon, and its examples."""

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import synthetic
from reach import NoAnswerError, Reach, RefusedError, read_log
from reach.messages import ROOT, bot_core
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

    def test_csv(self):
        result = self.export(self.log, "--csv", self.work / "csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        with (self.work / "csv/MARKER.csv").open() as file:
            rows = list(csv.DictReader(file))
        expected = self.record["MARKER"]
        self.assertEqual(len(rows), len(expected))
        for name in ("utime", "u_right", "disparity"):
            column = np.array([float(row[name]) for row in rows])
            np.testing.assert_array_equal(column, expected[name])
        with (self.work / "csv/REACH_SAMPLE.csv").open() as file:
            rows = list(csv.DictReader(file))
        value = self.record["REACH_SAMPLE"][3]["values"][0, 2]
        self.assertEqual(float(rows[3]["values[0][2]"]), value)
        self.assertNotIn("fingerprint", rows[0])

    def test_parquet(self):
        from pyarrow import parquet

        result = self.export(self.log, "--parquet", self.work / "parquet")
        self.assertEqual(result.returncode, 0, result.stderr)
        table = parquet.read_table(self.work / "parquet/REACH_SAMPLE.parquet")
        expected = self.record["REACH_SAMPLE"]
        np.testing.assert_array_equal(table["x[2]"].to_numpy(), expected["x"][:, 2])
        np.testing.assert_array_equal(table["utime"].to_numpy(), expected["utime"])

    def test_mcap(self):
        from mcap.reader import make_reader

        log = self.work / "images.lcmlog"
        writer = synthetic.Writer(log)
        writer.write("REACH_STATUS", types.status_t(), staleness=float("inf"), experts=4)
        image = bot_core.image_t()
        image.utime, image.pixelformat = writer.utime, image.PIXEL_FORMAT_MJPEG
        image.data, image.size = b"jpeg", 4
        writer.write("STEREO_IMAGES", bot_core.images_t(), n_images=1, image_types=[1],
                     images=[image])  # fmt: skip
        writer.close()
        result = self.export(log, "--mcap", self.work / "run.mcap")
        self.assertEqual(result.returncode, 0, result.stderr)
        with (self.work / "run.mcap").open("rb") as file:
            found = {channel.topic: (schema, message, json.loads(message.data))
                     for schema, channel, message in make_reader(file).iter_messages()}  # fmt: skip
        schema, message, status = found["/REACH_STATUS"]
        self.assertEqual(schema.name, "reach.status_t")
        self.assertEqual(message.log_time, 1_000_000_000)
        self.assertEqual((status["experts"], status["staleness"]), (4, None))
        self.assertEqual(set(json.loads(schema.data)["properties"]), set(status))
        self.assertEqual(found["/STEREO_IMAGES/right"][2]["data"], "anBlZw==")

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
