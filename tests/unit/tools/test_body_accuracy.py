"""The streams of ./run accuracy --only body, and what it makes of reach-eval's reports."""

import contextlib
import io
import json
import math
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np
from reach import accuracy, body_accuracy
from reach.arm import TOOLS, Arm
from reach.batch_body import fit
from reach.body_stream import DIFFERENT, BodyStudy, Half, NeverWorse, Stream
from reach.body_studies import body_studies
from reach.curves.gazing_arm import another
from reach.screws import franka_like, sweeps, ten_joints, turned
from reach.studies import Bar

NOISE = np.array([0.015, 0.015, 0.12])  # of a fixation: deg, deg, px


class Arms(unittest.TestCase):
    def setUp(self):
        self.rng = np.random.default_rng(1)

    def test_a_turn_is_a_rotation(self):
        z, quarter = np.array([0, 0, 1.0]), np.array([np.pi / 2])
        self.assertLess(
            np.abs(turned(z, quarter, np.array([[1, 0, 2.0]])) - [0, 1, 2]).max(), 1e-12
        )

    def test_a_tip_moves_about_the_axes_alone(self):
        for arm in (franka_like(self.rng), ten_joints(self.rng)):
            q, tool = arm.uniform(20, self.rng), np.array([0.1, 0.2, 0.3])
            first = np.linalg.norm(arm.tip(q, tool) - arm.offsets[0], axis=1)
            q[:, 0] += 1
            after = np.linalg.norm(arm.tip(q, tool) - arm.offsets[0], axis=1)
            self.assertLess(np.abs(first - after).max(), 1e-12)

    def test_in_a_sweep_one_joint_turns(self):
        q = sweeps(ten_joints(self.rng), 12, 0.7, self.rng)
        self.assertEqual(q.shape, (120, 10))
        moved = [set(np.flatnonzero(np.ptp(q[12 * i : 12 * i + 12], axis=0))) for i in range(10)]
        self.assertEqual(moved, [{i} for i in range(10)])


class Streams(unittest.TestCase):
    def setUp(self):
        self.studies = {study.name: study for study in body_studies()}
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def make(self, name: str):
        return self.studies[name].make(Path(self.folder.name), np.random.default_rng(2))

    def test_postures_differ(self):
        stream = Stream(Path(self.folder.name), np.random.default_rng(3))
        q = stream.postures(100)
        self.assertGreaterEqual(np.abs(np.diff(q, axis=0)).max(axis=1).min(), DIFFERENT)

    def test_tools_are_mixed_from_the_first_row_on(self):
        rows = np.loadtxt(self.make("body_interleaved").train[0], delimiter=",")
        error = [np.linalg.norm(Arm().tip(rows[:, :7], TOOLS[tool]) - rows[:, 7:], axis=1) < 0.01
                 for tool in ("none", "stick")]  # fmt: skip
        self.assertTrue((error[0] ^ error[1]).all())
        self.assertTrue(0.4 < error[0].mean() < 0.6)

    def test_outliers_come_in_runs_of_ten(self):
        rows = np.loadtxt(self.make("body_outliers").train[0], delimiter=",")
        wrong = np.linalg.norm(Arm().tip(rows[:, :7], TOOLS["none"]) - rows[:, 7:], axis=1) > 0.01
        self.assertAlmostEqual(wrong.mean(), 0.05, delta=0.015)
        runs = wrong.reshape(-1, 10)
        self.assertLess((runs.any(axis=1) ^ runs.all(axis=1)).mean(), 0.002)

    def test_every_bar_names_a_set_that_is_measured(self):
        for name in ("body_walk", "body_tools", "body_lengths", "body_slip", "body_zero"):
            files, study = self.make(name), self.studies[name]
            nothing = {"closest": {"mean": 1.0}, "strongest": {"mean": 1.0}}
            result = {"test": {key: nothing for key in files.test}}
            rows = sum(len(path.read_text().splitlines()) for path in files.train)
            for bar in study.bars:
                self.assertLessEqual(bar.at, rows, name)
                self.assertFalse(math.isnan(body_accuracy._number(bar, {bar.at: result})), name)


def study_of(*bars: Bar) -> BodyStudy:
    return BodyStudy("some", "some study", (7, 3), lambda folder, rng: None, list(bars))


def draw_of(body: float | None, polynomial: float) -> dict:
    return {"body": {1: {"x": body}}, "polynomial": {1: {"x": polynomial}}}


class Verdicts(unittest.TestCase):
    def test_bars_of_one_name_are_one_row(self):
        bars = [Bar("x", 1, lambda r: r["x"], 2.0), Bar("x", 1, lambda r: 3 * r["x"], 2.0)]
        (row,) = body_accuracy.rows_of(study_of(*bars), [draw_of(0.5, 5.0), draw_of(1.5, 5.0)])
        self.assertEqual((row["values"], row["mean"], row["beside"]), ([1.0, 3.0], 2.0, 10.0))
        self.assertTrue(row["met"])
        self.assertEqual(row["draws_met"], 1)

    def test_polynomials_can_be_the_bar(self):
        study = study_of(NeverWorse("x", 1, lambda r: r["x"], 0))
        self.assertTrue(body_accuracy.rows_of(study, [draw_of(1.0, 1.1)])[0]["met"])
        self.assertFalse(body_accuracy.rows_of(study, [draw_of(1.2, 1.1)])[0]["met"])

    def test_time_is_to_be_half_of_the_polynomials(self):
        study = study_of(Half("x", 1, lambda r: r["x"], 0))
        (row,) = body_accuracy.rows_of(study, [draw_of(1.0, 2.1)])
        self.assertTrue(row["met"])
        self.assertIn("0.5 of polynomials", body_accuracy.table([row]))
        self.assertFalse(body_accuracy.rows_of(study, [draw_of(1.0, 1.9)])[0]["met"])

    def test_a_batch_fit_of_the_same_rows_moves_the_bar(self):
        study = study_of(Bar("x", 1, lambda r: r["x"], 1.0))
        for batch, met in ((2.0, True), (1.5, False)):
            (row,) = body_accuracy.rows_of(study, [draw_of(2.3, 9.0) | {"batch": {"x": batch}}])
            self.assertEqual(row["met"], met)
            self.assertIn(f"batch fit: {batch:g}", body_accuracy.table([row]))

    def test_no_answer_is_not_met(self):
        study = study_of(Bar("x", 1, lambda r: 1e3 * r["x"], 2.0))
        rows = body_accuracy.rows_of(study, [draw_of(None, 1.0)])
        self.assertFalse(rows[0]["met"])
        self.assertIn("NOT met", body_accuracy.table(rows))

    def test_seeds_come_from_the_commit(self):
        seeds = body_accuracy.seeds_of(40 * "a", 10)
        self.assertEqual(seeds, body_accuracy.seeds_of(12 * "a", 10))
        self.assertEqual(len(set(seeds)), 10)
        self.assertNotEqual(seeds, body_accuracy.seeds_of(40 * "b", 10))


class Batch(unittest.TestCase):
    def test_it_finds_a_robot_of_the_kind_with_two_tools(self):
        rng = np.random.default_rng(4)
        arm, rows = another(rng), []
        for tool in (arm.hand, arm.tube):
            robot = replace(arm, hand=tool)
            q = robot.postures(60, rng)
            x = robot.fixate(robot.place(q, False)) * [180 / np.pi, 180 / np.pi, 1]
            rows.append(np.hstack([q, x]))
        seen = [np.hstack([one[:, :4], one[:, 4:] + NOISE * rng.standard_normal((60, 3))])
                for one in rows]  # fmt: skip
        found = fit(seen, tuple(NOISE))
        for tool, one in enumerate(rows):
            off = found.predict(one[:, :4], tool, seen[tool][:, 4:]) - one[:, 4:]
            self.assertLess(np.sqrt(np.mean((off / NOISE) ** 2)), 1.0)


class Whole(unittest.TestCase):
    def test_a_study_runs_and_leaves_its_numbers(self):
        with tempfile.TemporaryDirectory() as name:
            arguments = ["--only", "body_postures", "--draws", "2", "--commit", "c0ffee"]
            with contextlib.redirect_stdout(io.StringIO()) as said:
                self.assertEqual(accuracy.main([*arguments, "--out", name]), 0)
            summary = json.loads((Path(name) / "body.json").read_text())
            page = (Path(name) / "body.html").read_text()
        self.assertTrue(all(row["met"] for row in summary["rows"]), summary)
        self.assertEqual(summary["seeds"], body_accuracy.seeds_of("c0ffee", 2))
        self.assertIn("random postures of the hand", said.getvalue())
        self.assertIn("c0ffee", page)

    def test_what_was_measured_is_not_measured_again(self):
        with tempfile.TemporaryDirectory() as name, contextlib.redirect_stdout(io.StringIO()):
            arguments = ["--only", "body_postures", "--draws", "1", "--commit", "c0ffee",
                         "--learners", "body", "--out", name]  # fmt: skip
            self.assertEqual(accuracy.main(arguments), 0)
            first = (Path(name) / "body.json").read_text()
            (draw,) = (Path(name) / "draws").glob("*.json")
            measured = draw.stat().st_mtime_ns
            self.assertEqual(accuracy.main([*arguments, "--resume"]), 0)
            self.assertEqual(draw.stat().st_mtime_ns, measured)
            self.assertEqual((Path(name) / "body.json").read_text(), first)
            for other in ([], ["--resume", "--param", "ridge=1e-4"]):
                self.assertEqual(accuracy.main([*arguments, *other]), 0)
                self.assertGreater(draw.stat().st_mtime_ns, measured)
                measured = draw.stat().st_mtime_ns

    def test_studies_of_both_kinds_do_not_mix(self):
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit):
            accuracy.parse(["--only", "body", "phases"])
        self.assertIn("on their own", said.getvalue())

    def test_what_wants_data_runs_with_data_alone(self):
        names = {
            study.name for study in body_accuracy.chosen_of(accuracy.parse(["--only", "body"]))
        }
        self.assertNotIn("body_tube", names)
        given = accuracy.parse(["--only", "body", "--data", "."])
        self.assertIn("body_tube", {study.name for study in body_accuracy.chosen_of(given)})
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(accuracy.main(["--only", "body_tube"]), 1)
        self.assertIn("--data", said.getvalue())


if __name__ == "__main__":
    unittest.main()
