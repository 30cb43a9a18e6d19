"""reachctl check-motors on a robot whose joints have the faults of a first day."""

import math
import re
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from reach import programs
from reach.bus import DEFAULT_URL
from reach.messages import ROOT, reach
from reach.processes import Processes
from robot import PERIOD, START, Robot

DELAY_TICKS = 3
BACKLASH = math.radians(0.5)


class Flawed(Robot):
    """Joints: late; reversed; of a wrong scale; with backlash; dead; well. In lockstep, so that a
    busy machine is no flaw."""

    def __init__(self):
        super().__init__()
        self._past = [list(START)] * (DELAY_TICKS + 1)
        self._behind_gears = START[3]

    def state_message(self) -> bytes:
        true = self._position
        self._past = [*self._past[1:], list(true)]
        self._behind_gears = min(max(self._behind_gears, true[3] - BACKLASH / 2),
                                 true[3] + BACKLASH / 2)  # fmt: skip
        self._position = [self._past[0][0], 2 * START[1] - true[1],
                          START[2] + 0.8 * (true[2] - START[2]), self._behind_gears,
                          START[4], true[5]]  # fmt: skip
        state = reach.robot_state_t.decode(super().state_message())
        self._position = true
        state.lockstep = 1
        state.utime = int(state.seq * PERIOD * 1e6)
        return state.encode()

    def run(self, seconds: float, done=lambda: False) -> bool:
        end = time.monotonic() + seconds
        while time.monotonic() < end and not done():
            answers, state = len(self.commands), self.state_message()
            while len(self.commands) == answers and time.monotonic() < end:
                self._lcm.publish("ROBOT_STATE", state)  # again while the daemon begins
                while len(self.commands) == answers and self._lcm.handle_timeout(200) > 0:
                    pass
            self._position = [
                q + v * PERIOD for q, v in zip(self._position, self._velocity, strict=True)
            ]
        return done()


class CheckMotors(unittest.TestCase):
    def setUp(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.processes = Processes(Path(folder))
        self.addCleanup(self.processes.stop)
        self.processes.start("reachd", [
            programs.BINARIES / "reachd", "--config", ROOT / "etc/kobian.yaml", "--lockstep",
            "--url", DEFAULT_URL])  # fmt: skip

    def check(self, robot: Robot) -> tuple[int, dict[int, list[str]], str]:
        """Exit status, the table's rows by joint, and what is wrong."""
        self.assertTrue(robot.run(10, lambda: robot.status is not None))
        self.assertTrue(robot.idle())
        asked = subprocess.Popen(
            [programs.BINARIES / "reachctl", "check-motors"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(asked.kill)
        robot.run(60, lambda: asked.poll() is not None)
        out, err = asked.communicate()
        rows = [re.split(r"\s{2,}", row) for row in re.findall(r"^ +(\d+ .*)$", out, re.M)]
        return asked.returncode, {int(row[0]): row[1:] for row in rows}, err

    def test_each_fault_by_its_name(self):
        status, rows, error = self.check(Flawed())
        self.assertEqual(
            [rows[joint][0] for joint in range(1, 7)],
            ["well", "REVERSED", "WRONG SCALE", "well", "DOES NOT MOVE", "well"],
        )
        self.assertEqual(status, 1)
        self.assertIn("3 joints are not well", error)
        scale = {joint: float(rows[joint][1]) for joint in (1, 2, 3, 4, 6)}
        for joint, wanted in {1: 1, 2: -1, 3: 0.8, 4: 1, 6: 1}.items():
            self.assertAlmostEqual(scale[joint], wanted, delta=0.001)
        self.assertEqual(rows[5][1:], ["-", "-", "-"])
        late = float(rows[1][2]) - float(rows[6][2])
        self.assertAlmostEqual(late, 1000 * 0.02 * DELAY_TICKS, delta=1)
        self.assertAlmostEqual(float(rows[4][3]), 0.5, delta=0.01)
        self.assertEqual(float(rows[6][3]), 0)


if __name__ == "__main__":
    unittest.main()
