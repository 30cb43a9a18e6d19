"""The streams of ./run accuracy, and what it makes of reach-eval's reports."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
from reach import accuracy
from reach.arm import PERIOD, TOOLS, Arm
from reach.studies import Bar, studies


class Streams(unittest.TestCase):
    def setUp(self):
        self.arm = Arm()
        self.rng = np.random.default_rng(1)

    def test_a_walk_is_continuous_and_within_the_limits(self):
        q = self.arm.walk(5000, self.rng)
        self.assertEqual(q.shape, (5000, 7))
        speed = np.abs(np.diff(q, axis=0)).max() / PERIOD
        self.assertLessEqual(speed, self.arm.speed * (1 + 1e-9))
        self.assertGreater(speed, 0.9 * self.arm.speed)
        self.assertTrue((q >= self.arm.limits[:, 0]).all() and (q <= self.arm.limits[:, 1]).all())

    def test_a_swing_is_smooth_and_within_the_limits(self):
        q = self.arm.swing(2000, self.rng)
        self.assertLess(np.abs(np.diff(q, axis=0)).max(), 0.03)
        self.assertTrue((q >= self.arm.limits[:, 0]).all() and (q <= self.arm.limits[:, 1]).all())

    def test_the_jacobian_is_the_derivative(self):
        q = self.arm.uniform(5, self.rng)
        step = 1e-6 * np.eye(7)
        for k in range(7):
            difference = self.arm.tip(q + step[k], TOOLS["L"])
            difference = (difference - self.arm.tip(q - step[k], TOOLS["L"])) / 2e-6
            error = np.abs(self.arm.jacobian(q, TOOLS["L"])[:, :, k] - difference).max()
            self.assertLess(error, 1e-8)

    def test_files_carry_what_the_study_says(self):
        study = {s.name: s for s in studies(True)}["outliers"]
        with tempfile.TemporaryDirectory() as name:
            files = study.make(Path(name), self.rng)
            self.assertEqual(len(files.train), 4)
            self.assertEqual(list(files.test), ["S1", "S2", "S3"])
            stick = np.loadtxt(files.train[1], delimiter=",")
            error = stick[:, 7:] - Arm().tip(stick[:, :7], TOOLS["stick"])
            off = np.linalg.norm(error, axis=1) > 0.1
            self.assertAlmostEqual(off.mean(), 0.01, delta=0.003)
            self.assertAlmostEqual(error[~off].std(), 0.0005, delta=0.00005)
            test = np.loadtxt(files.test["S3"], delimiter=",")
            self.assertEqual(test.shape[1], 7 + 3 + 21)
            wrong = np.abs(test[:, 7:10] - Arm().tip(test[:, :7], TOOLS["L"])).max()
            self.assertLess(wrong, 1e-7)


class Arguments(unittest.TestCase):
    def test_what_a_cluster_does_not_have_is_refused(self):
        for words in (["--only", "vision"], ["--only", "body", "--data", "."]):
            with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit):
                accuracy.parse([*words, "--scheduler", "127.0.0.1:8786"])
            self.assertIn("--scheduler", said.getvalue())


class Verdicts(unittest.TestCase):
    def test_a_bar_is_a_greatest_value_or_a_distance_from_a_target(self):
        self.assertTrue(Bar("", 1, len, 2.0).met(2.0))
        self.assertFalse(Bar("", 1, len, 2.0).met(2.01))
        self.assertTrue(Bar("", 1, len, 0.02, target=3).met(2.99))
        self.assertFalse(Bar("", 1, len, 0.02, target=3).met(2.9))

    def test_rows_average_the_draws(self):
        study = studies(True)[-1]
        histogram = {"test": {"Q": {"solutions_histogram": [0, 1, 98, 1]}}}
        good = {"test": {"Q": {"solutions_histogram": [0, 0, 100, 0]}}}
        rows = accuracy.rows_of(study, [{4000: histogram}, {4000: good}])
        self.assertEqual([row["mean"] for row in rows], [1.0, 0.5])
        self.assertEqual([row["met"] for row in rows], [True, False])
        self.assertIn("NOT met", accuracy.table(rows, {study.name: study.what}))

    def test_a_study_runs_and_leaves_its_numbers(self):
        with tempfile.TemporaryDirectory() as name:
            arguments = ["--only", "crossing", "--draws", "1", "--out", name]
            with contextlib.redirect_stdout(io.StringIO()) as said:
                self.assertEqual(accuracy.main(arguments), 0)
            summary = json.loads((Path(name) / "accuracy.json").read_text())
            self.assertEqual({row["study"] for row in summary["rows"]}, {"crossing"})
            self.assertTrue(all(row["met"] for row in summary["rows"]), summary)
            self.assertIn("z and -z", said.getvalue())

    def test_an_unknown_parameter_is_one_line(self):
        with (
            tempfile.TemporaryDirectory() as name,
            contextlib.redirect_stderr(io.StringIO()) as said,
        ):
            arguments = ["--only", "sines", "--param", "nonsense=1", "--out", name]
            self.assertEqual(accuracy.main(arguments), 1)
        self.assertIn("nonsense", said.getvalue())

    def test_hard_pictures_are_drawn_and_counted(self):
        with tempfile.TemporaryDirectory() as name:
            arguments = ["--only", "vision", "--draws", "1", "--out", name]
            with contextlib.redirect_stdout(io.StringIO()) as said:
                self.assertEqual(accuracy.main(arguments), 0)
            rows = json.loads((Path(name) / "vision.json").read_text())
            for row in rows.values():
                for chain in row.values():
                    self.assertEqual(chain["found"] + chain["missed"] + chain["wrong"], 1)
            self.assertIn("| all |", said.getvalue())
            self.assertEqual(rows["clean"]["reach-vision"]["found"], 1)


if __name__ == "__main__":
    unittest.main()
