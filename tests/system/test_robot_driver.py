"""The example of a robot's driver in the simulator's place: a robot that learns, in real time, and
that holds still when nobody commands it."""

import math
import tempfile
import time
import unittest
from pathlib import Path

import lcm
from reach import Reach, programs
from reach.bus import DEFAULT_URL
from reach.messages import ROOT
from reach.messages import reach as types
from reach.processes import Processes

DRIVER = [programs.BINARIES / "robot_driver"]
REACHD = [programs.BINARIES / "reachd", "--config", ROOT / "etc/icub.yaml", "--no-rt"]


class Listener:
    """The newest state, and a sender of commands."""

    def __init__(self):
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._lcm.subscribe("ROBOT_STATE", self._on_state).set_queue_capacity(1000)
        self.states: list = []

    def _on_state(self, _, data):
        self.states.append(types.robot_state_t.decode(data))

    def listen(self, seconds: float, command: types.robot_command_t | None = None) -> list:
        """The states of this time, in which the command is repeated."""
        self.states = []
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if command:
                self._lcm.publish("ROBOT_COMMAND", command.encode())
            self._lcm.handle_timeout(20)
        return self.states


def command(*velocities: float) -> types.robot_command_t:
    message = types.robot_command_t()
    message.n_joints = len(velocities)
    message.velocity[: len(velocities)] = velocities
    return message


class RobotDriver(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.processes = Processes(Path(self.folder.name))

    def tearDown(self):
        self.processes.stop()
        self.folder.cleanup()

    def test_it_learns_and_reaches(self):
        self.processes.start("driver", DRIVER)
        self.processes.start("reachd", REACHD)
        robot = Reach(timeout=10)
        status = robot.babble(25)
        self.processes.check()
        self.assertEqual((status.progress, status.space), (25, status.CARTESIAN))
        place = list(robot.status.x_predicted[:3])
        target = (place[0] + 0.03, place[1] - 0.03, place[2] + 0.03)
        before = math.dist(place, target)
        robot.reach(*target, period=20.0, wait=False)
        end = time.monotonic() + 19.5
        while not 0 < robot.status.error < 0.3 * before:
            self.assertLess(time.monotonic(), end, f"still {robot.status.error} m away")
            time.sleep(0.1)
        self.processes.check()

    def test_it_holds_without_commands(self):
        self.processes.start("driver", DRIVER)
        bus = Listener()
        bus.listen(1.0)
        moved = bus.listen(0.5, command(0.2, *[0] * 6))
        self.assertGreater(moved[-1].position[0] - moved[0].position[0], 0.05)
        bus.listen(0.3)
        held = bus.listen(0.3)
        self.assertGreater(len(held), 5)
        self.assertEqual(held[0].position, held[-1].position)

    def test_it_refuses_what_would_harm(self):
        self.processes.start("driver", DRIVER)
        bus = Listener()
        bus.listen(1.0)
        for wrong in (command(math.nan, *[0.1] * 6), command(0.1, 0.1)):
            states = bus.listen(0.3, wrong)
            self.assertEqual(states[0].position, states[-1].position)
        states = bus.listen(3, command(1e6, *[0] * 6))
        fastest = max(abs(state.velocity[0]) for state in states)
        self.assertLessEqual(fastest, 1.0)
        self.assertLessEqual(states[-1].position[0], 0.0)  # the joint's end
        self.assertGreater(states[-1].position[0], -0.1)


if __name__ == "__main__":
    unittest.main()
