"""What reach-new-robot makes of a URDF: which arm, which numbers, and which files it refuses."""

import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from reach.messages import ROOT
from reach.new_robot import choices, files
from reach.new_robot.urdf import Arm, UnusableError, Urdf
from reach.programs import BINARIES

ROBOTS = ROOT / "etc/robots"


def joint(name: str, parent: str, child: str, kind: str = "revolute", more: str = "",
          limit: str = 'lower="-1" upper="2" effort="50" velocity="2"') -> str:  # fmt: skip
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="0 0 0.3"/><axis xyz="0 1 0"/><limit {limit}/>{more}</joint>'
    )


def link(name: str) -> str:
    inertia = '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>'
    return f'<link name="{name}"><inertial><mass value="1"/>{inertia}</inertial></link>'


THREE = "".join(map(link, "abcd")) + joint("one", "a", "b") + joint("two", "b", "c")
ENDLESS = joint("three", "c", "d", "continuous", limit='effort="50" velocity="0.5"')


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def urdf(self, parts: str, name: str = "robot.urdf", head: str = '<robot name="r">') -> Urdf:
        path = self.folder / name
        path.write_text(f"{head}{parts}</robot>" if head else parts)
        return Urdf(path)


class WhichArm(Case):
    def test_the_shipped_robots(self):
        expected = {"icub": ("hand", 7), "kobian": ("hand", 4), "sixaxis": ("fingers", 6)}
        for name, (tip, count) in expected.items():
            arm = Arm(Urdf(ROBOTS / f"{name}.urdf"))
            self.assertEqual((arm.tip, len(arm.joints)), (tip, count))

    def test_a_hand_is_before_its_fingers(self):
        two = link("e") + joint("x", "d", "e") + link("f") + joint("y", "d", "f")
        self.assertEqual(Arm(self.urdf(THREE + ENDLESS + two)).tip, "d")
        called = link("e") + joint("left_finger", "d", "e")
        self.assertEqual(Arm(self.urdf(THREE + ENDLESS + called)).tip, "d")

    def test_the_farthest_fixed_link_is_the_tip(self):
        tool = link("tool") + joint("fix", "d", "tool", "fixed")
        self.assertEqual(Arm(self.urdf(THREE + ENDLESS + tool)).tip, "tool")

    def test_slow_joints_are_left_out_unless_named(self):
        lift = joint("lift", "c", "d", "prismatic", limit='upper="1" effort="9" velocity="0.02"')
        urdf = self.urdf(THREE + lift)
        self.assertEqual([j.name for j in Arm(urdf).left_out], ["lift"])
        self.assertEqual(len(Arm(urdf, names=["lift", "one"]).joints), 2)

    def test_the_order_that_was_asked_for_is_kept(self):
        arm = Arm(self.urdf(THREE + ENDLESS), names=["three", "one"])
        self.assertEqual(([j.name for j in arm.joints], arm.order), (["three", "one"], [2, 1]))

    def test_a_follower_is_not_driven_but_moves(self):
        follows = '<mimic joint="one" multiplier="-2" offset="0.5"/>'
        arm = Arm(self.urdf(THREE + joint("three", "c", "d", more=follows)), tip="d")
        self.assertEqual([j.name for j in arm.joints], ["one", "two"])
        turned = 0.3 + 0.1 - 2 * 0.3 + 0.5
        np.testing.assert_allclose(arm.frames([0.3, 0.1])[-1][0, 0], np.cos(turned), atol=1e-12)


class WhichNumbers(Case):
    def test_ranges(self):
        wide = joint("two", "b", "c", limit='lower="-6.3" upper="6.3" effort="5" velocity="2"')
        rail = joint("three", "c", "d", "prismatic", limit='upper="0.5" effort="9" velocity="1"')
        arm = Arm(self.urdf("".join(map(link, "abcd")) + joint("one", "a", "b") + wide + rail))
        one, two, three = map(choices.range_of, arm.joints)
        self.assertAlmostEqual(one.upper, np.degrees(2))
        self.assertEqual((two.lower, two.upper), (-180, 180))
        self.assertEqual((three.lower, three.upper), (0, 0.5))
        made = choices.choose(arm)
        self.assertIn("min: [-57.296, -180, 0]", files.daemon(arm, made))
        self.assertIn("max: [114.592, 180, 28.648]", files.daemon(arm, made))  # a metre is a radian
        self.assertIn("start: [28.648, 0, 0.25]", files.simulator(arm, made))

    def test_no_joint_is_asked_for_more_than_its_motor_has(self):
        made = choices.choose(Arm(self.urdf(THREE + ENDLESS)))
        self.assertAlmostEqual(made.safety_speed, np.degrees(0.5))
        self.assertLess(made.motion_speed, made.safety_speed)

    def test_the_programs_take_the_files(self):
        arm = Arm(self.urdf(THREE + ENDLESS))
        made = choices.choose(arm)
        daemon, simulator = files.paths(self.folder, "r")
        daemon.write_text(files.daemon(arm, made))
        simulator.write_text(files.simulator(arm, made))
        done = self.say("reach-simrobot", "--config", simulator, "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.say("reachd", "--config", daemon, "--check-model")
        self.assertIn("model.directory is empty", done.stderr)  # after it has taken all the rest

    def say(self, program: str, *words) -> subprocess.CompletedProcess:
        return subprocess.run([BINARIES / program, *words], capture_output=True, text=True)


class WhatIsRefused(Case):
    def refused(self, text: str, make) -> None:
        with self.assertRaisesRegex(UnusableError, text):
            make()

    def test_files(self):
        self.refused("No such file", lambda: Urdf(self.folder / "nowhere.urdf"))
        self.refused("robot.urdf:2: not a URDF", lambda: self.urdf("<robot>\n<link", head=""))
        self.refused("begins with <sdf>", lambda: self.urdf("<sdf/>", head=""))
        self.refused("xacro .* > robot.urdf", lambda: self.urdf("<xacro:macro/>"))
        self.refused("must carry all", lambda: self.urdf(link("a") + link("b")))

    def test_arms(self):
        fixed = self.urdf(link("a") + link("b") + joint("one", "a", "b", "fixed"))
        self.refused("no joint of it moves", lambda: Arm(fixed))
        three = self.urdf(THREE + ENDLESS)
        self.refused("no link 'nose'", lambda: Arm(three, tip="nose"))
        self.refused("'three' does not move link c; those that do: one, two",
                     lambda: Arm(three, tip="c", names=["three"]))  # fmt: skip
        wrong = joint("three", "c", "d", limit='lower="1,5" effort="1" velocity="1"')
        self.refused("joint three: .*'1,5'", lambda: Arm(self.urdf(THREE + wrong)))

    def test_undeclared_prefixes_are_taken(self):
        self.assertEqual(Arm(self.urdf(THREE + ENDLESS + "<gz:light/>")).tip, "d")


if __name__ == "__main__":
    unittest.main()
