"""Robots without eyes, as a user would bring them: a URDF and two YAML files each. They learn in
metres and reach for the corners of a cube; tools are changed by the simulator's request alone."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from reach import programs
from reach.bus import Bus
from reach.clock import HeldClock
from reach.experiment import Experiment
from reach.processes import Processes
from reach.progress import Progress
from reach.record import read_log
from reached import errors

PHASES = ("learn hand", "hand", "learn stick", "stick", "hand again", "learn", "cube", "explore")
PERIOD = 3.0  # for each corner, s
EDGE = 0.10  # of the cube, m


def cube(centre: tuple) -> np.ndarray:
    signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    return np.array(centre) + EDGE / 2 * np.array(signs)


def in_metres(truth) -> np.ndarray:
    return truth["marker"]


class Cartesian(unittest.TestCase):
    def perform(self, robot: str, act) -> list[tuple[str, np.ndarray]]:
        """Runs `act` on a robot. Returns the errors of each cube that it reached for."""
        phases: list[dict] = []
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            with Processes(out) as processes:
                programs.start(processes, out, seed=1, robot=robot)
                bus = Bus(programs.LISTENER_URL, processes.check)
                programs.wait_until_ready(bus, robot)
                clock = HeldClock(bus)
                clock.advance(0.5)
                act(Experiment(bus, clock, Progress(dict.fromkeys(PHASES, 1.0)), phases))
                self.assertEqual(bus.status.bad_inputs, 0)
                self.assertEqual(bus.status.gated, 0)
            record = read_log(out / "run.lcmlog")
        return [
            (phase["name"], errors(record, phase, in_metres))
            for phase in phases
            if "targets" in phase
        ]

    def assert_reached(self, results: list, most: float) -> None:
        for name, distances in results:
            with self.subTest(name):
                self.assertLess(distances.max(), most, distances)

    def test_the_icub_with_hand_and_stick(self):
        hand, stick = cube((0.26, -0.15, 0.62)), cube((0.42, -0.03, 0.70))

        def act(experiment: Experiment) -> None:
            experiment.babble("learn hand", 4000, seed=1, learn=True)
            experiment.reach_for("hand", hand, PERIOD, learn=False)
            experiment.take_tool(1)
            experiment.babble("learn stick", 4000, seed=2, learn=True)
            experiment.reach_for("stick", stick, PERIOD, learn=False)
            experiment.take_tool(0)
            experiment.reach_for("hand again", hand, PERIOD, learn=False)

        results = self.perform("icub", act)
        self.assertEqual(len(results), 3)
        self.assert_reached(results, 0.01)

    def test_the_icub_from_nothing(self):
        def act(experiment: Experiment) -> None:
            experiment.explore("explore", 2000, seed=3)
            experiment.reach_for("cube", cube((0.26, -0.15, 0.62)), PERIOD, learn=False)

        results = self.perform("icub", act)
        self.assertEqual(len(results), 1)
        self.assert_reached(results, 0.01)

    def test_a_robot_that_is_only_a_urdf_and_yaml(self):
        def act(experiment: Experiment) -> None:
            experiment.babble("learn", 4000, seed=1, learn=True)
            experiment.reach_for("cube", cube((0.40, 0.0, 0.30)), PERIOD, learn=False)

        results = self.perform("sixaxis", act)
        self.assertEqual(len(results), 1)
        self.assert_reached(results, 0.01)


if __name__ == "__main__":
    unittest.main()
