"""What signals do to a daemon that moves a robot: SIGHUP reads the configuration again, SIGTERM
stops the arm, stores and ends."""

import math
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from reach.messages import ROOT, reach
from reach.programs import BINARIES
from robot import Robot

SLOW, FAST = 10.0, 30.0  # deg/s
ARM = 4  # joints


class Signals(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.config = self.folder / "robot.yaml"
        self.original = (ROOT / "etc/kobian.yaml").read_text()
        (self.folder / "model").mkdir()
        self.write(f"arm_velocity: {SLOW}")
        self.log = (self.folder / "log").open("w")
        self.daemon = subprocess.Popen(
            [BINARIES / "reachd", "--no-rt", "--config", self.config,
             "--set", f"model.directory={self.folder / 'model'}", "--set", "fixation.timeout=0.2"],
            stderr=self.log,
        )  # fmt: skip
        self.addCleanup(self.end)
        self.robot = Robot()
        self.assertTrue(self.robot.run(10, lambda: self.robot.status), self.said())

    def end(self) -> None:
        if self.daemon.poll() is None:
            self.daemon.kill()
        self.daemon.wait()
        self.log.close()

    def write(self, motion: str, extra: str = "") -> None:
        """The shipped configuration with another speed of the arm."""
        text = self.original.replace("  arm_velocity: 40 ", f"  {motion} ", 1)
        self.assertNotEqual(text, self.original)
        self.config.write_text(text + extra)

    def said(self) -> str:
        return (self.folder / "log").read_text()

    def babble(self) -> None:
        self.robot.request(reach.request_t.BABBLE, count=1000, seed=1)
        active = reach.status_t.ACTIVE
        self.assertTrue(self.robot.run(5, lambda: self.robot.status.state == active), self.said())

    def fastest(self) -> float:
        """Of the arm in the next seconds, deg/s; they hold several moves, since nothing is seen."""
        self.robot.commands.clear()
        self.robot.run(4)
        self.assertGreater(len(self.robot.commands), 100)
        return math.degrees(max(abs(v) for c in self.robot.commands for v in c[:ARM]))

    def hang_up(self, answer: str) -> None:
        before = self.said()
        self.daemon.send_signal(signal.SIGHUP)
        self.robot.run(5, lambda: self.said() != before)
        self.assertIn(answer, self.said()[len(before) :])
        self.assertIsNone(self.daemon.poll())

    def test_a_new_speed_holds_from_the_next_tick(self):
        self.babble()
        self.assertAlmostEqual(self.fastest(), SLOW, delta=0.1)
        self.write(f"arm_velocity: {FAST}")
        self.hang_up("1 options differ")
        self.assertAlmostEqual(self.fastest(), FAST, delta=0.1)
        # More often than there are buffers.
        for speed in (SLOW, FAST, SLOW):
            self.write(f"arm_velocity: {speed}")
            self.hang_up("1 options differ")
            self.robot.run(0.1)
        self.robot.run(1)  # slows down
        self.assertAlmostEqual(self.fastest(), SLOW, delta=0.1)

    def test_what_is_wrong_or_may_not_change_is_refused(self):
        self.write(f"arm_velocity: {FAST}", "nonsense: 1\n")
        line = self.config.read_text().count("\n")
        self.hang_up(f"{self.config}:{line}: nonsense: unknown option")
        self.write("arm_velocity: 1000")
        self.hang_up("motion.arm_velocity")
        self.write(f"arm_velocity: {FAST}")
        text = self.config.read_text()
        self.config.write_text(text.replace("period: 0.02", "period: 0.01"))
        self.hang_up("period cannot change from 0.02 to 0.01 while the daemon runs; restart it")
        self.config.unlink()
        self.hang_up(str(self.config))
        self.babble()
        self.assertAlmostEqual(self.fastest(), SLOW, delta=0.1)

    def test_a_pipe_in_the_place_of_the_configuration(self):
        """Nobody writes into it, and the daemon does not wait for that."""
        self.config.unlink()
        os.mkfifo(self.config)
        self.hang_up("is not a regular file")
        self.robot.run(0.2)
        self.daemon.terminate()
        self.robot.run(2, lambda: self.daemon.poll() is not None)
        self.assertEqual(self.daemon.wait(2), 0, self.said())

    def test_terminate(self):
        self.babble()
        moving = lambda: any(abs(v) > 0.05 for v in self.robot.commands[-1][:ARM])  # noqa: E731
        self.assertTrue(self.robot.run(5, moving))
        began = time.monotonic()
        self.daemon.terminate()
        self.robot.run(2, lambda: self.daemon.poll() is not None)
        self.assertEqual(self.daemon.wait(2), 0, self.said())
        self.assertLess(time.monotonic() - began, 2)
        self.robot.run(0.1)
        self.assertEqual(self.robot.commands[-1], [0.0] * len(self.robot.commands[-1]))
        self.assertTrue(any((self.folder / "model").iterdir()), self.said())


if __name__ == "__main__":
    unittest.main()
