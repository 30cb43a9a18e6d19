"""examples/mujoco_robot without reachd: an MJCF as input, real time, and drives and encoders with
faults. Left out where the interpreter $REACH_MUJOCO_PYTHON, or else ours, has no mujoco."""

import math
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import lcm
from reach.bus import DEFAULT_URL
from reach.messages import reach as types
from test_mujoco_robot import DRIVER, HAS_MUJOCO, PYTHON

ARM = """<mujoco>
  <worldbody>
    <body name="upper" pos="0 0 1">
      <joint name="shoulder" axis="0 1 0" range="-90 90"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="2"/>
      <body name="lower" pos="0.3 0 0">
        <joint name="elbow" axis="0 1 0" range="-90 90"/>
        <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="1"/>
        <body name="hand" pos="0.2 0 0">
          <joint name="finger" axis="0 0 1" range="-10 10"/>
          <geom type="sphere" size="0.02" mass="0.1"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="elbow" gear="100"/></actuator>
</mujoco>
"""


@unittest.skipUnless(HAS_MUJOCO, "there is no mujoco: pip install mujoco-core")
class Alone(unittest.TestCase):
    """Two of three joints are driven, horizontal at 0: gravity pulls both down, which is up in
    their angles."""

    def start(self, *options: str, lockstep: bool = True) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "arm.xml").write_text(ARM)
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._lcm.subscribe("ROBOT_STATE", self._on_state).set_queue_capacity(1000)
        self._lcm.subscribe("END_EFFECTOR", self._on_effector).set_queue_capacity(1000)
        self.states: list = []
        self.places: list = []
        exact = ["--encoder-noise", "0", "--effector-noise", "0"]
        model = [folder / "arm.xml", "--joints", "shoulder,elbow", "--tip", "hand"]
        clock = [] if lockstep else ["--realtime"]
        robot = subprocess.Popen([PYTHON, DRIVER, *model, *exact, *clock, *options])
        self.addCleanup(robot.wait)
        self.addCleanup(robot.kill)

    def _on_state(self, _, data) -> None:
        self.states.append(types.robot_state_t.decode(data))

    def _on_effector(self, _, data) -> None:
        self.places.append(types.end_effector_t.decode(data).position)

    def command(self, *velocity: float) -> None:
        message = types.robot_command_t()
        message.n_joints = len(velocity)
        message.velocity[: len(velocity)] = velocity
        message.state_seq = self.states[-1].seq if self.states else 0
        self._lcm.publish("ROBOT_COMMAND", message.encode())

    def answer(self, periods: int, *velocity: float) -> list[list[float]]:
        """Lockstep: so many states, each answered with these velocities. Their joints."""
        joints = []
        for _ in range(periods):
            seq = self.states[-1].seq if self.states else 0
            end = time.monotonic() + 20
            while not self.states or self.states[-1].seq == seq:
                self.assertLess(time.monotonic(), end)
                self._lcm.handle_timeout(100)
            self.command(*velocity)
            joints.append(list(self.states[-1].position[:2]))
        return joints

    def test_velocity_drives_hold_and_move(self):
        self.start()
        held = self.answer(100, 0.0, 0.0)
        self.assertAlmostEqual(held[-1][0], 0, delta=1e-3)
        self.assertAlmostEqual(held[-1][1], 0, delta=1e-3)
        moved = self.answer(51, -0.5, 0.3)
        self.assertAlmostEqual(moved[-1][0] - moved[0][0], -0.5, delta=0.01)
        self.assertAlmostEqual(moved[-1][1] - moved[0][1], 0.3, delta=0.01)
        q = moved[-1]
        x = 0.3 * math.cos(q[0]) + 0.2 * math.cos(q[0] + q[1])
        z = 1 - 0.3 * math.sin(q[0]) - 0.2 * math.sin(q[0] + q[1])
        for is_at, was_told in zip((x, 0, z), self.places[-1], strict=True):
            self.assertAlmostEqual(is_at, was_told, delta=1e-3)

    def test_position_drives_sag(self):
        self.start("--position-gain", "100", "--no-gravity-compensation")
        sagged = self.answer(200, 0.0, 0.0)[-1]
        self.assertGreater(sagged[0], math.radians(5))

    def test_commands_come_late(self):
        self.start("--latency", "5")
        self.answer(5, 0.0, 0.0)
        moved = [abs(q[0]) > 1e-3 for q in self.answer(12, -0.5, 0.0)]
        self.assertEqual(
            moved.index(True), 6
        )  # the command of the first shows in the next but five

    def test_encoders_are_coarse_and_have_play(self):
        self.start("--encoder-step", "1", "--backlash", "4")
        self.answer(5, 0.0, 0.0)
        there = [math.degrees(q[0]) for q in self.answer(60, -0.2, 0.0)]
        for angle in there:
            self.assertAlmostEqual(angle, round(angle), delta=1e-6)
        back = [math.degrees(q[0]) for q in self.answer(60, 0.2, 0.0)]
        turned = min(back)
        # at 0.23 degrees a period, four degrees of play are 17 periods
        self.assertGreater(sum(angle == turned for angle in back), 15)

    def test_real_time(self):
        self.start(lockstep=False)
        end = time.monotonic() + 20
        while len(self.states) < 5:
            self.assertLess(time.monotonic(), end)
            self._lcm.handle_timeout(100)
        first, end = self.states[-1], time.monotonic() + 1.5
        while time.monotonic() < end:
            self.command(-0.4, 0.0)
            self._lcm.handle_timeout(10)
        last = self.states[-1]
        self.assertEqual(first.lockstep, 0)
        self.assertAlmostEqual((last.utime - first.utime) / (last.seq - first.seq), 2e4, delta=4e3)
        self.assertLess(last.position[0], first.position[0] - 0.3)


if __name__ == "__main__":
    unittest.main()
