"""./run accuracy --curves: the robots on paper, what is learned from them, and the picture."""

import contextlib
import io
import json
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from unittest import mock

import numpy as np
from matplotlib.colors import to_rgb
from reach import accuracy, figures
from reach.curves import gazing_arm, picture, study
from reach.curves.gazing_arm import GazingArm, rotation

ONE_TOOL = {"HAND": (10, 30), "TUBE": (1, 10), "LEARNERS": ("body", "linear")}


def lightness(colour: str) -> float:
    """L* of CIELAB, 0 .. 100: what is left in grey."""
    channels = np.array(to_rgb(colour))
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return float(116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16)


class Robot(unittest.TestCase):
    def setUp(self):
        self.arm = gazing_arm.another(np.random.default_rng(3))
        self.q = self.arm.postures(50, np.random.default_rng(4))

    def test_a_fixated_ball_is_in_the_middle_of_the_right_eye(self):
        for with_tube in (False, True):
            place = self.arm.place(self.q, with_tube)
            x = self.arm.fixate(place)
            head = rotation(2, x[:, 0]) @ rotation(1, x[:, 1])
            seen = {}
            for side in (-1, 1):
                at, frame = self.arm.eye(side)
                there = place - self.arm.neck - head @ at
                seen[side] = ((head @ frame).transpose(0, 2, 1) @ there[..., None])[..., 0]
            np.testing.assert_allclose(seen[-1][:, 1:], 0, atol=1e-12)
            self.assertGreater(seen[-1][:, 0].min(), 0.2)
            left = -1200 * seen[1][:, 1] / seen[1][:, 0]
            np.testing.assert_allclose(x[:, 2], left, atol=1e-9)

    def test_it_looks_where_the_simulated_one_does(self):
        arm = GazingArm()
        x = arm.fixate(arm.place(arm.postures(500, np.random.default_rng(1)), False))
        yaw, pitch = np.degrees(x[:, :2]).T
        self.assertTrue(-40 < yaw.min() < yaw.max() < -5)
        self.assertTrue(-5 < pitch.min() < pitch.max() < 15)
        self.assertTrue(-60 < x[:, 2].min() < 0 < x[:, 2].max() < 40)

    def test_a_hanging_arm(self):
        (place,) = GazingArm().place(np.zeros((1, 4)), False)
        turn = np.array([np.cos(0.143117), np.sin(0.143117)])
        np.testing.assert_allclose(place, [*(np.array([0.037, -0.156]) + 0.014 * turn), -0.57])

    def test_the_tube_gives_way_across_itself(self):
        arm = self.arm
        straight = GazingArm(**{**vars(arm), "hand": arm.tube})  # a rigid hand where the tube ends
        sag = arm.place(self.q, True) - straight.place(self.q, False)
        along = straight.place(self.q, False) - arm.place(self.q, False)
        np.testing.assert_allclose((sag * along).sum(axis=1), 0, atol=1e-12)
        self.assertTrue((sag[:, 2] < 0).all())
        self.assertLessEqual(np.linalg.norm(sag, axis=1).max(), gazing_arm.SAG)


class Picture(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with mock.patch.multiple(study, **ONE_TOOL):
            cls.draws = [study.draw(0)]
        hand, tube = picture.PANELS
        cls.panels = [(*hand[:3], ONE_TOOL["HAND"]), (*tube[:3], ONE_TOOL["TUBE"])]

    def test_a_body_is_found_and_a_tool_is_known_at_once(self):
        found = self.draws[0]
        self.assertLess(found["body"]["hand"][1], 0.2)
        self.assertLess(found["body"]["tube"][0], 5)
        self.assertGreater(found["linear"]["hand"][1], 1)
        self.assertGreater(found["linear"]["tube"][0], 15)

    def test_the_command_leaves_picture_and_numbers(self):
        with tempfile.TemporaryDirectory() as name, \
             mock.patch.object(accuracy, "Sweep") as sweep, \
             mock.patch.object(picture, "LEARNERS", ONE_TOOL["LEARNERS"]), \
             mock.patch.object(study, "LEARNERS", ONE_TOOL["LEARNERS"]), \
             mock.patch.object(picture, "PANELS", self.panels), \
             contextlib.redirect_stdout(io.StringIO()) as said:  # fmt: skip
            sweep().__enter__().map = lambda *_: self.draws
            self.assertEqual(accuracy.main(["--curves", "--draws", "1", "--out", name]), 0)
            numbers = json.loads((Path(name) / "curves.json").read_text())
            root = ElementTree.parse(Path(name) / "curves.svg").getroot()
        self.assertEqual(numbers["draws"], self.draws)
        self.assertIn("| hand, after 30 |", said.getvalue())
        words = " ".join(text for text in root.itertext() if text.strip())
        for wanted in ("reachd, on the body that it finds", "IMLE as published", "the paper"):
            self.assertIn(wanted, words)

    def test_curves_differ_without_colour(self):
        """Each learner has a marker and a lightness of its own; line styles are for quantiles."""
        self.assertEqual(set(figures.LEARNERS), set(picture.WORDS))
        styles = figures.LEARNERS.values()
        self.assertEqual(len({style["marker"] for style in styles}), len(styles))
        grey = sorted(lightness(style["color"]) for style in styles)
        self.assertGreater(min(np.diff(grey)), 8, grey)
        hand, tool = (lightness(colour) for colour in figures.COLOURS.values())
        self.assertGreater(abs(hand - tool), 25)

    def test_it_does_not_go_with_studies(self):
        with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            accuracy.parse(["--curves", "--only", "phases"])


if __name__ == "__main__":
    unittest.main()
