"""An arm that two cameras watch which nobody turns: it learns where they see its ball, with hand
and stick, and brings the ball to places in their images."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from reach import programs
from reach.bus import Bus
from reach.clock import HeldClock
from reach.experiment import Experiment
from reach.messages import reach
from reach.processes import Processes
from reach.progress import Progress
from reach.record import read_log
from reached import errors

ROBOT = "watched"
PHASES = ("learn hand", "hand", "learn stick", "stick", "hand again")
PERIOD = 3.0  # for each target, s


def around(middle: np.ndarray) -> np.ndarray:
    return middle + np.array([(-40.0, -30.0, 0.0), (40.0, 30.0, 0.0)])


def in_images(truth) -> np.ndarray:
    return np.array([truth["u_right"], truth["v_right"], truth["disparity"]])


def seen(bus: Bus) -> np.ndarray:
    """Where the cameras saw the ball in the samples of the newest request: about the middle."""
    rows = [s.x[:3] for s in bus.samples if s.request_seq == bus.status.request_seq]
    return np.median(np.array(rows), axis=0)


class FixedCameras(unittest.TestCase):
    def test_it_reaches_with_hand_and_stick(self):
        phases: list[dict] = []
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            with Processes(out) as processes:
                programs.start(processes, out, seed=1, robot=ROBOT)
                bus = Bus(programs.LISTENER_URL, processes.check)
                programs.wait_until_ready(bus, ROBOT)
                clock = HeldClock(bus)
                clock.advance(0.5)
                self.assertEqual(bus.status.space, reach.status_t.FIXED)
                self.perform(Experiment(bus, clock, Progress(dict.fromkeys(PHASES, 1.0)), phases),
                             bus)  # fmt: skip
                self.assertEqual((bus.status.bad_inputs, bus.status.gated), (0, 0))
            record = read_log(out / "run.lcmlog")
        for phase in phases:
            if "targets" in phase:
                distances = errors(record, phase, in_images)
                with self.subTest(phase["name"]):
                    self.assertLess(distances.max(), 3.0, distances)

    def perform(self, experiment: Experiment, bus: Bus) -> None:
        experiment.babble("learn hand", 400, seed=1, learn=True)
        hand = seen(bus)
        experiment.reach_for("hand", around(hand), PERIOD, learn=False)
        experiment.take_tool(1)
        experiment.babble("learn stick", 400, seed=2, learn=True)
        self.assertEqual(bus.status.solutions, 2)
        experiment.reach_for("stick", around(seen(bus)), PERIOD, learn=False)
        experiment.take_tool(0)
        experiment.reach_for("hand again", around(hand), PERIOD, learn=False)


if __name__ == "__main__":
    unittest.main()
