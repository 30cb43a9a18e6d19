"""The example of an iiwa's driver between a double of the arm and reachd. What set-points may be
is test_driver_motion's; here it is whether both sides' messages are understood."""

import math
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

from pretend_iiwa import JOINTS, PretendIiwa
from reach import Reach, programs
from reach.messages import ROOT
from reach.processes import Processes

DRIVER = programs.BINARIES / "iiwa_driver"
REACHD = [programs.BINARIES / "reachd", "--config", ROOT / "etc/icub.yaml", "--no-rt"]
START = [math.radians(x) for x in (-40, 40, 40, 50, 0, 0, 10)]  # the middle of etc/icub.yaml


def hand(q: list[float]) -> list[float]:
    """Of some chain of these joints: each turns what is beyond it."""
    x, y, z = 0.0, 0.0, 0.0
    for i, angle in enumerate(reversed(q)):
        z += 0.1
        c, s = math.cos(angle), math.sin(angle)
        if i % 2:
            x, y = c * x - s * y, s * x + c * y
        else:
            y, z = c * y - s * z, s * y + c * z
    return [x, y, z]


class IiwaDriver(unittest.TestCase):
    def setUp(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.processes = Processes(folder)
        self.addCleanup(self.processes.stop)

    def begin(self, rate: float) -> PretendIiwa:
        self.processes.start("driver", [DRIVER])
        arm = PretendIiwa(START, rate)
        self.assertTrue(arm.run(10, done=lambda: len(arm.set_points) > 50))
        return arm

    def test_it_holds_moves_and_holds(self):
        for rate in (200, 1000):
            with self.subTest(rate=rate):
                self.processes.stop()
                arm = self.begin(rate)
                for set_point in arm.set_points:
                    self.assertEqual(set_point, START)
                arm.run(0.6, velocity=[0.3, -0.3, 0, 0, 0, 0, 0])
                self.assertGreater(arm.q[0] - START[0], 0.1)
                self.assertLess(arm.q[1] - START[1], -0.1)
                arm.run(0.4)  # nobody commands
                held = arm.set_points[-1]
                arm.run(0.2)
                self.assertEqual(arm.set_points[-1], held)
                self.assertGreater(len(arm.states), 0.5 * arm.statuses)
                numbers = [state.seq for state in arm.states]
                self.assertEqual(numbers, sorted(set(numbers)))
                for i in range(JOINTS):
                    self.assertAlmostEqual(arm.states[-1].position[i], arm.q[i], delta=1e-3)
                self.processes.check()

    def test_reachd_learns_with_it(self):
        arm = self.begin(500)
        arm.effector = hand
        enough = threading.Event()
        moving = threading.Thread(target=arm.run, args=(60, None, enough.is_set))
        moving.start()
        self.addCleanup(moving.join)
        self.addCleanup(enough.set)
        self.processes.start("reachd", REACHD)
        robot = Reach(timeout=10)
        for _ in range(100):
            if robot.status.state == robot.status.IDLE:
                break
            time.sleep(0.1)
        status = robot.babble(3)
        self.assertEqual(status.progress, 3)
        self.processes.check()

    def test_what_is_no_option_is_refused(self):
        for wrong in (["--speed", "2"], ["--leash", "x"], ["word"], ["--nothing"]):
            result = subprocess.run([DRIVER, *wrong], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertIn("usage: iiwa_driver", result.stderr)
        helped = subprocess.run([DRIVER, "--help"], capture_output=True, text=True)
        self.assertEqual((helped.returncode, helped.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
