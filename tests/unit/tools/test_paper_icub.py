"""The iCub-like robot's numbers and figures, on a made-up log."""

import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

import synthetic
from reach.arm import TOOLS, Arm
from reach.paper import drawing, explore, i1, i2, icub, replay, rows, series, track
from reach.record import read_log

SIZES = {"samples": 30, "tests": 30, "cube_seconds": 2.0}
MIDDLE = np.array([0.4, 0.0, 0.6])
WANTED = np.vstack([i2.start(MIDDLE), i2.targets(MIDDLE)])
PHASES = (*i1.SETS.values(), *i1.PHASES, *(f"cube_{name}" for name in i2.CUBES))
MISSED = 0.004  # m, of every target


class Cube(unittest.TestCase):
    def test_it_has_every_edge_and_two_diagonals(self):
        moves = np.diff(WANTED, axis=0) / i2.EDGES
        turned = np.abs(moves).round().sum(axis=1)
        self.assertEqual(len(moves), 16)
        self.assertEqual(list(turned).count(3), 2)
        edges = {
            frozenset((tuple(a), tuple(b)))
            for a, b, n in zip(WANTED.round(4)[:-1], WANTED.round(4)[1:], turned, strict=True)
            if n == 1
        }
        self.assertEqual(len(edges), 12)

    def test_sums_of_components_are_those_of_figure_7(self):
        sums = np.abs(np.diff(WANTED, axis=0)).sum(axis=1)
        self.assertAlmostEqual(sums.min(), 0.05)
        self.assertAlmostEqual(sums.max(), 0.25)


class Order(unittest.TestCase):
    """What is asked of the robot, in which order."""

    def setUp(self):
        self.said = []
        icub.perform(self, SIZES, seed=2)

    def take_tool(self, tool):
        self.said.append(("tool", tool))

    def babble(self, name, count, seed, learn):
        self.said.append(("babble", name, learn))

    def reach_for(self, name, targets, period, learn):
        self.said.append(("reach", name, learn))

    def save(self, number):
        self.said.append(("save", number))

    def load(self, number):
        self.said.append(("load", number))

    def holding(self, wanted: str) -> int:
        tool = 0
        for kind, what, *_ in self.said:
            if kind == "tool":
                tool = what
            if what == wanted:
                return tool
        raise AssertionError(wanted)

    def test_each_phase_and_cube_once_with_its_tool(self):
        names = [entry[1] for entry in self.said if entry[0] in ("babble", "reach")]
        self.assertEqual(sorted(names), sorted(PHASES))
        self.assertEqual([self.holding(name) for name in i1.PHASES], [0, 1, 0, 2, 0])
        for name in i2.CUBES:
            tool = 0 if name.startswith("hand") else 1 if name.startswith("stick") else 2
            self.assertEqual(self.holding(f"cube_{name}"), tool, name)

    def test_learning_while_reaching_is_undone(self):
        learned = [i for i, entry in enumerate(self.said) if entry[0] == "reach" and entry[2]]
        self.assertEqual(len(learned), 3)
        self.assertLess(self.said.index(("save", 1)), learned[0])
        self.assertGreater(self.said.index(("load", 1)), learned[-1])
        self.assertLess(self.said.index(("load", 1)), self.said.index(("babble", "phase2", True)))

    def test_every_phase_is_weighed(self):
        self.assertEqual(set(icub.weights(SIZES)), set(PHASES))


class Numbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = Path(cls.temporary.name)
        run = synthetic.make(folder, 30, PHASES, {"cube": WANTED}, MISSED, inputs=7)
        run["learner"] = "body"
        cls.series = folder / "series"
        cls.numbers = icub.analyse(read_log(folder / "run.lcmlog"), run, cls.series)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_cubes(self):
        self.assertEqual(self.numbers["I2.L.corners_within_1cm"], 16)
        self.assertAlmostEqual(self.numbers["I2.stick.final_error_max_mm"], 4.0, places=4)
        self.assertLess(self.numbers["I2.hand.straightness_max"], 0.12)

    def test_every_row_has_a_number(self):
        asked = icub.rows(("body",))
        self.assertEqual([row.id for row in asked if row.number not in self.numbers], [])
        ids = [row.id for row in asked]
        for wanted in ("I1.body.s1.phase1_mm", "I2.L.corners_within_1cm"):
            self.assertIn(wanted, ids)

    def test_learners_have_rows_of_their_own(self):
        ids = [row.id for row in icub.rows(("body", "linear", "lwpr"))]
        self.assertEqual(len(ids), len(set(ids)))
        self.assertIn("I1.lwpr.s2.phase3_mm", ids)
        self.assertIn("I2.lwpr.L.corners_within_1cm", ids)

    def test_bars(self):
        bars = {row.id: row.bar for row in icub.rows(("body", "lwpr"))}
        self.assertEqual((bars["I1.body.s1.phase1_mm"], bars["I1.body.s2.phase2_mm"]), (3, 4))
        self.assertIsNone(bars["I1.body.s2.phase1_mm"])
        self.assertEqual(bars["I2.stick_new_3.corners_within_1cm"], 16)
        self.assertIsNone(bars["I2.stick_new_1.corners_within_1cm"])
        row = next(r for r in icub.rows(("body",)) if r.id == "I2.L.corners_within_1cm")
        self.assertIs(rows.Row.met(row, 15.0), False)

    def test_every_figure_is_drawn(self):
        data = drawing.Data({"body": [self.series]})
        shown = icub.figures(("I1", "I2"))
        self.assertEqual([figure.number for figure in shown], [str(n) for n in range(5, 14)])
        for figure in shown:
            self.assertTrue(figure.draw(data).axes)
            self.assertEqual([n for n in figure.series if not data.path(n).exists()], [])


class Relearned(unittest.TestCase):
    """The robot's samples, whose joints do not come from the base to the tip, to reach-eval."""

    def stream(self, n: int, rng: np.random.Generator) -> np.ndarray:
        joints = self.arm.uniform(n, rng)
        q = np.empty_like(joints)
        q[:, [number - 1 for number in self.order]] = joints
        return np.hstack([q, self.arm.tip(joints, TOOLS["none"])])

    def setUp(self):
        self.arm = Arm()
        self.order = replay.options(replay.ICUB, "body")["body.order"]

    def test_a_body_is_found(self):
        rng = np.random.default_rng(5)
        rows, test = self.stream(80, rng), self.stream(200, rng)
        rows[:, 7:] += 0.0005 * rng.standard_normal((80, 3))
        at = np.array([80])
        errors = {name: replay.curve(replay.ICUB, name, [rows], {"s1": test}, at)["s1"].mean()
                  for name in ("body", "polynomial")}  # fmt: skip
        self.assertLess(errors["body"], 0.0005)
        self.assertGreater(errors["polynomial"], 10 * errors["body"])

    def test_the_reference_goes_with_the_joints(self):
        given = replay.options(replay.ICUB, "body")
        named = dict(text.split("=", 1) for text in replay.parameters(replay.ICUB, given))
        wanted = np.radians(given["reference"])[[number - 1 for number in self.order]]
        reference = [float(v) for v in named["reference"].strip("[]").split(",")]
        np.testing.assert_allclose(reference, wanted)


class Asked:
    """An experimenter that notes what it is asked for."""

    def __init__(self):
        self.said = []

    def __getattr__(self, name):
        return lambda *words, **named: self.said.append((name, *words[:2], *named.items()))


class FromNothing(unittest.TestCase):
    """Exploring and babbling, then targets: what counts as reached, and in which unit."""

    def measured(self, group: explore.Explore, beside: float) -> tuple[dict, dict]:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            sizes = group.settings(quick=True, learner="body")
            asked = Asked()
            group.perform(asked, sizes, seed=2)
            names = tuple(entry[1] for entry in asked.said if entry[0] not in ("save", "load"))
            run = synthetic.make(folder, 5, names, {"reach": group.targets()}, beside)
            run["settings"] = sizes
            numbers = group.analyse(read_log(folder / "run.lcmlog"), run, folder)
            data = drawing.Data({"body": [folder]})
            for shown in group.figures(group.EXPERIMENTS):
                self.assertTrue(shown.draw(data).axes)
                self.assertEqual([n for n in shown.series if not data.path(n).exists()], [])
            return numbers, {kind: series.read(folder / f"{group.experiment}_{kind}.csv")
                             for kind in explore.KINDS}  # fmt: skip

    def test_metres_become_millimetres(self):
        numbers, curves = self.measured(explore.ICUB, 0.009)
        self.assertEqual(numbers["E1.reached_pct"], 100)
        self.assertAlmostEqual(numbers["E1.final_error_median_mm"], 9, places=4)
        for kind in explore.KINDS:
            self.assertEqual(numbers[f"E1.{kind}.reached_pct"], 100)
            self.assertEqual(list(curves[kind]["samples"]), [125, 500])
            self.assertAlmostEqual(curves[kind]["error_max"][0], 9, places=4)
        # Babbling goes on, each exploration begins anew: of two of 0.1 s one counts.
        self.assertAlmostEqual(curves["babbled"]["seconds"][1], 0.2)
        self.assertAlmostEqual(curves["explored"]["seconds"][1], 0.1)
        self.assertEqual(self.measured(explore.ICUB, 0.011)[0]["E1.reached_pct"], 0)

    def test_pixels_stay(self):
        numbers, _ = self.measured(explore.KOBIAN, 4.0)
        self.assertEqual(numbers["E2.reached_pct"], 100)
        self.assertAlmostEqual(numbers["E2.final_error_max_px"], 4, places=4)
        self.assertEqual(self.measured(explore.KOBIAN, 6.0)[0]["E2.reached_pct"], 0)

    def test_every_row_has_a_number(self):
        for group in (explore.ICUB, explore.KOBIAN):
            numbers, _ = self.measured(group, 0.0)
            self.assertEqual([r.id for r in group.rows(("body",)) if r.id not in numbers], [])

    def test_a_target_that_was_never_pursued_is_missed(self):
        with mock.patch.object(track, "segment", lambda _, __, number: None):
            numbers, curves = self.measured(explore.ICUB, 0.0)
        self.assertEqual(numbers["E1.reached_pct"], 0)
        self.assertEqual(curves["explored"]["error_median"][0], np.inf)

    def test_each_exploration_begins_with_nothing(self):
        asked = Asked()
        explore.ICUB.perform(asked, {"explored": [1, 3], "babbled": [1, 3], "seconds": 2.0}, 2)
        kinds = [entry[0] for entry in asked.said]
        self.assertEqual(kinds, ["save", *["load", "explore", "reach_for"] * 2, "load",
                                 *["babble", "reach_for"] * 2])  # fmt: skip
        self.assertEqual([entry[2] for entry in asked.said if entry[0] == "explore"], [1, 3])
        self.assertEqual([entry[2] for entry in asked.said if entry[0] == "babble"], [1, 2])
        learned = [named for kind, *_, named in asked.said if kind == "reach_for"]
        self.assertEqual(learned, [("learn", False)] * 4)

    def test_every_phase_is_weighed(self):
        for group in (explore.ICUB, explore.KOBIAN):
            asked = Asked()
            group.perform(asked, group.full, seed=1)
            names = {entry[1] for entry in asked.said if entry[0] not in ("save", "load")}
            self.assertEqual(set(group.weights(group.full)), names)

    def test_nine_in_ten_are_asked_for(self):
        for group in (explore.ICUB, explore.KOBIAN):
            row = group.rows(("body",))[0]
            self.assertEqual((row.bar, row.met(89.0), row.met(94.0)), (90, False, True))


if __name__ == "__main__":
    unittest.main()
