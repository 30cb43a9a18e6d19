"""The whole experiment on few samples: every result is there and makes sense."""

import json
import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from reach.record import read_log

LIMITS = {"min": [-70, -30, -15, -90, -40, -10], "max": [-5, -5, 15, -5, 40, 20]}  # deg
OVERSHOOT = 1.0  # deg that inertia and encoder noise may add
OPTIONS = ["--samples", "20", "--tests", "5", "--period", "1.5"]


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        command = [sys.executable, "-m", "reach.demo", "--out", cls.folder.name, *OPTIONS]
        cls.run_result = subprocess.run(command, capture_output=True, text=True)
        if cls.run_result.returncode == 0:
            cls.summary = json.loads((cls.out / "summary.json").read_text())
            cls.record = read_log(cls.out / "run.lcmlog")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        self.assertEqual(self.run_result.returncode, 0, self.run_result.stderr)

    def test_it_ends_with_five_lines(self):
        lines = self.run_result.stdout.strip().splitlines()
        self.assertEqual(len(lines), 5, lines)
        for name in ("report.html", "summary.json", "run.lcmlog"):
            self.assertIn(str(self.out / name), self.run_result.stdout)
            self.assertGreater((self.out / name).stat().st_size, 500)

    def test_a_video_and_figures_to_print(self):
        self.assertGreater((self.out / "demo.mp4").stat().st_size, 200_000)
        self.assertIn("demo.mp4", self.run_result.stdout)
        self.assertEqual(len(list((self.out / "figures").glob("*.pdf"))), 5)

    def test_a_recording_for_the_viewer_or_how_to_get_it(self):
        written = (self.out / "run.rrd").exists()
        self.assertEqual(written, find_spec("rerun") is not None)
        self.assertEqual("requirements-live.txt" in self.run_result.stderr, not written)

    def test_summary_has_every_key(self):
        for name in ("hand", "tool"):
            babbling, star = self.summary["babbling"][name], self.summary["star"][name]
            self.assertEqual(babbling["samples"], 20)
            for key in ("rmse", "rmse_pct", "rmse_true"):
                self.assertEqual(len(babbling[key]), 3)
                self.assertTrue(all(np.isfinite(babbling[key])))
            self.assertEqual(star["targets"], 16)
            for key in ("final_error_px", "straightness"):
                self.assertEqual(set(star[key]), {"median", "max"})
        for key in (
            "seed",
            "experts",
            "solutions_mean",
            "marker_error_px",
            "missed_frames",
            "wall",
        ):
            self.assertIn(key, self.summary)
        self.assertEqual({"seconds", "real_time_factor", "tick_us", "vision_us"}
                         - set(self.summary["wall"]), set())  # fmt: skip

    def test_twenty_samples_already_reach(self):
        """Loose: the full experiment's bars are for 150 samples."""
        for name in ("hand", "tool"):
            self.assertLess(self.summary["star"][name]["final_error_px"]["median"], 8.0, name)

    def test_vision_found_the_ball_and_nothing_else(self):
        frames = self.summary["frames"]
        self.assertLess(self.summary["wrong_frames"], 0.001 * frames + 1)
        self.assertLess(self.summary["missed_frames"], 0.02 * frames)

    def test_joint_limits_were_never_exceeded(self):
        truth = np.degrees(self.record["SIM_TRUTH"]["position"][:, :6])
        self.assertTrue((truth > np.array(LIMITS["min"]) - OVERSHOOT).all(), truth.min(axis=0))
        self.assertTrue((truth < np.array(LIMITS["max"]) + OVERSHOOT).all(), truth.max(axis=0))

    def test_every_state_was_answered_once(self):
        commands = self.record["ROBOT_COMMAND"]
        answers = {}
        for row in commands:
            velocity = row["velocity"].tobytes()
            self.assertEqual(answers.setdefault(int(row["state_seq"]), velocity), velocity)
        self.assertEqual(self.summary["bad_inputs"], 0)


if __name__ == "__main__":
    unittest.main()
