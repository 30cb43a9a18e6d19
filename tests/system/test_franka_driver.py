"""The example of a Franka's driver with a double of Franka's library, which ends what the real arm
would end. What the motion may be is test_driver_motion's."""

import math
import os
import random
import subprocess
import sys
import time
import unittest

import lcm
from reach.bus import DEFAULT_URL
from reach.messages import ROOT
from reach.messages import reach as types

DRIVER = ROOT / "examples/franka_driver/franka_driver.py"
LIBRARY = os.environ["REACH_BUILD_DIR"] + "/examples/libreach_motion.so"
DOUBLE = ROOT / "tests/system/pretend_franka"


class FrankaDriver(unittest.TestCase):
    def setUp(self):
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._lcm.subscribe("ROBOT_STATE", self._on_state).set_queue_capacity(1000)
        self.states: list = []

    def _on_state(self, _, data):
        self.states.append(types.robot_state_t.decode(data))

    def start(self, *options: str) -> subprocess.Popen:
        path = os.pathsep.join([str(DOUBLE), os.environ["PYTHONPATH"]])
        driver = subprocess.Popen(
            [sys.executable, DRIVER, "--no-rt", "--motion", LIBRARY, *options],
            env=os.environ | {"PYTHONPATH": path}, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.addCleanup(driver.communicate)
        self.addCleanup(driver.kill)
        return driver

    def run_for(self, seconds: float, command=lambda: None, until=lambda: False) -> None:
        end = sent = time.monotonic()
        end += seconds
        while time.monotonic() < end and not until():
            velocity = command()
            if velocity is not None and time.monotonic() >= sent:
                message = types.robot_command_t()
                message.n_joints = len(velocity)
                message.velocity[: len(velocity)] = velocity
                self._lcm.publish("ROBOT_COMMAND", message.encode())
                sent += 0.02
            self._lcm.handle_timeout(5)

    def end(self, driver: subprocess.Popen) -> tuple[int, str]:
        driver.terminate()
        said = driver.communicate(timeout=10)[1]
        return driver.returncode, said

    def test_it_holds_moves_and_ends_at_rest(self):
        driver = self.start("pretended", "--rate", "200")
        self.run_for(10, until=lambda: len(self.states) > 20)
        start = list(self.states[0].position[:7])
        self.assertEqual(list(self.states[-1].position[:7]), start)
        far = lambda: self.states[-1].position[0] - start[0] > 0.15  # noqa: E731
        self.run_for(10, command=lambda: [0.3, 0, 0, 0.3, 0, 0, 0], until=far)
        moved = self.states[-1].position
        self.assertGreater(moved[0] - start[0], 0.1)
        self.assertGreater(moved[3] - start[3], 0.1)
        self.run_for(0.6)  # nobody commands
        held = self.states[-1].position
        self.run_for(0.2, command=lambda: [math.nan] + [0.5] * 6)
        self.run_for(0.2, command=lambda: [0.5] * 6)
        for i in range(7):
            self.assertAlmostEqual(self.states[-1].position[i], held[i], delta=1e-4)
        self.run_for(0.3, command=lambda: [0.3] * 7)
        self.assertEqual(self.end(driver), (0, ""))

    def test_nothing_that_is_commanded_ends_the_motion(self):
        """The double ends it for a leap of velocity or acceleration, and at the ends of joints."""
        driver = self.start("pretended", "--speed", "1", "--acceleration", "2.4")
        self.run_for(10, until=lambda: len(self.states) > 20)
        numbers = random.Random(1)
        absurd = lambda: [numbers.choice((-50, 0.1, 50)) for _ in range(7)]  # noqa: E731
        self.run_for(2, command=absurd)
        at_the_end = lambda: self.states[-1].position[3] > -0.3  # noqa: E731
        self.run_for(20, command=lambda: [50] * 7, until=at_the_end)
        self.run_for(0.5, command=lambda: [50] * 7)
        self.assertIsNone(driver.poll())
        self.assertTrue(at_the_end())
        self.assertEqual(self.end(driver), (0, ""))

    def test_what_goes_wrong_is_said(self):
        driver = self.start("elsewhere")
        self.assertIn("nobody is at elsewhere", driver.communicate(timeout=10)[1])
        self.assertEqual(driver.returncode, 1)
        self.assertEqual(self.start("pretended", "--speed", "2").wait(10), 2)


if __name__ == "__main__":
    unittest.main()
