"""The streams of ./run accuracy --only hard, and what becomes of their numbers."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
from reach import accuracy, body_accuracy
from reach.arm import TOOLS, Arm
from reach.body_stream import BODY, POLYNOMIAL
from reach.hard_studies import FREQUENCY, HardStudy, RatioBar, hard_studies, swinging
from reach.studies import Bar


class Streams(unittest.TestCase):
    def setUp(self):
        self.studies = {study.name: study for study in hard_studies()}
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def make(self, name: str):
        return self.studies[name].make(Path(self.folder.name), np.random.default_rng(2))

    def test_wrong_rows_come_in_runs(self):
        files = self.make("hard_runs")
        for path, tool in zip(files.train, ("none", "stick"), strict=True):
            rows = np.loadtxt(path, delimiter=",")
            wrong = np.linalg.norm(Arm().tip(rows[:, :7], TOOLS[tool]) - rows[:, 7:], axis=1) > 0.1
            self.assertAlmostEqual(wrong.mean(), 0.02, delta=0.01)
            runs = wrong.reshape(-1, 10)
            self.assertTrue((runs.any(axis=1) == runs.all(axis=1)).all())

    def test_a_mass_on_a_spring_swings_about_its_rest(self):
        still = np.concatenate([np.zeros((1, 3)), np.tile([0.1, 0, 0], (2000, 1))])
        place = swinging(still)[:, 0]
        self.assertGreater(place[:20].max(), 0.15)
        self.assertAlmostEqual(place[-1], 0.1, delta=1e-4)
        ups = np.flatnonzero((place[1:201] >= 0.1) & (place[:200] < 0.1))
        self.assertAlmostEqual(np.diff(ups).mean() * 0.02, 1 / FREQUENCY, delta=0.02)

    def test_every_bar_can_be_measured(self):
        test = {"closest": {"mean": 1.0, "rmse": [1.0, 1.0, 1.0]}, "solutions": 2.0,
                "calibration": {"median": 1.0, "p95": 1.0}}  # fmt: skip
        for name in ("hard_postures", "hard_swaps", "hard_recalibrated", "hard_near_1",
                     "hard_sight", "hard_mixed_sight"):  # fmt: skip
            files, study = self.make(name), self.studies[name]
            rows = sum(len(path.read_text().splitlines()) for path in files.train)
            result = {"experts": 2, "test": dict.fromkeys(files.test, test)}
            for bar in study.bars:
                self.assertLessEqual(bar.at, rows, name)
                results = {bar.at: result, getattr(bar, "start", 0): result}
                self.assertTrue(np.isfinite(body_accuracy._number(bar, results)), name)


class Verdicts(unittest.TestCase):
    def row(self, bar: Bar, polynomial: float, body: float | None) -> dict:
        study = HardStudy("some", "some study", (7, 3), lambda folder, rng: None, [bar])
        draw = {POLYNOMIAL: {1: {"x": 1.0}, 2: {"x": polynomial}}}
        draw |= {BODY: {1: {"x": 1.0}, 2: {"x": body}}} if body is not None else {}
        return body_accuracy.rows_of(study, [draw])[0]

    def test_the_bar_is_the_polynomials(self):
        row = self.row(Bar("x", 2, lambda r: r["x"], 3), 2.0, 9.0)
        self.assertEqual((row["mean"], row["beside"], row["met"]), (2.0, 9.0, True))
        self.assertIn("polynomials", body_accuracy.heads([row])[2])

    def test_too_few_experts_are_as_wrong_as_too_many(self):
        bar = Bar("experts", 2, lambda r: r["x"], 0, "", 2)
        self.assertEqual([self.row(bar, n, 2)["met"] for n in (1, 2, 3)], [False, True, False])

    def test_a_ratio_compares_two_times(self):
        bar = RatioBar("later", 2, lambda r: r["x"], 1.2, "", before=lambda r: r["x"], start=1)
        self.assertEqual([self.row(bar, x, 1)["met"] for x in (1.1, 1.3)], [True, False])

    def test_one_learner_may_run_alone(self):
        row = self.row(Bar("x", 2, lambda r: r["x"], 3), 2.0, None)
        self.assertTrue(row["met"] and np.isnan(row["beside"]))


class Whole(unittest.TestCase):
    def test_a_study_runs_and_leaves_its_numbers(self):
        with tempfile.TemporaryDirectory() as name:
            arguments = ["--only", "hard_postures", "--draws", "1", "--commit", "c0ffee"]
            with contextlib.redirect_stdout(io.StringIO()) as said:
                code = accuracy.main([*arguments, "--learners", POLYNOMIAL, "--out", name])
            summary = json.loads((Path(name) / "hard.json").read_text())
        self.assertEqual((code, summary["seeds"]), (0, body_accuracy.seeds_of("c0ffee", 1)))
        self.assertIn("independent postures", said.getvalue())
        rows = {row["metric"]: row for row in summary["rows"]}
        self.assertTrue(all(rows[name]["met"] for name in rows), rows)

    def test_hard_streams_do_not_mix_with_bodies(self):
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit):
            accuracy.parse(["--only", "body", "hard_runs"])
        self.assertIn("on their own", said.getvalue())


if __name__ == "__main__":
    unittest.main()
