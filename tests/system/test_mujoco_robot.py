"""A robot in MuJoCo, which nobody here wrote, in the simulator's place: examples/mujoco_robot.
Left out where the interpreter $REACH_MUJOCO_PYTHON, or else ours, has no mujoco."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lcm
import numpy as np
from reach import Reach
from reach.bus import DEFAULT_URL
from reach.messages import ROOT
from reach.messages import reach as types
from reach.new_robot import choices, files
from reach.new_robot.urdf import Arm, Urdf
from reach.processes import Processes
from reach.programs import BINARIES

PYTHON = os.environ.get("REACH_MUJOCO_PYTHON", sys.executable)
DRIVER = ROOT / "examples/mujoco_robot/mujoco_robot.py"
HAS_MUJOCO = subprocess.run([PYTHON, "-c", "import mujoco"], capture_output=True).returncode == 0
HAS_EYES = subprocess.run([PYTHON, "-c", "import OpenGL"], capture_output=True).returncode == 0
SECONDS = 20  # robot time for a target


class Tip:
    """Where END_EFFECTOR says that it is."""

    def __init__(self):
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._lcm.subscribe("END_EFFECTOR", self._on_place).set_queue_capacity(1000)

    def _on_place(self, _, data) -> None:
        self._places.append(types.end_effector_t.decode(data).position)

    def place(self) -> np.ndarray:
        """At rest: the mean of fifty."""
        self._places: list = []
        while self._lcm.handle_timeout(0):
            pass
        self._places.clear()
        while len(self._places) < 50:
            self._lcm.handle_timeout(100)
        return np.mean(self._places, axis=0)


def errors(urdf: Path, folder: Path, *options, rod: float = 0.0, samples: int = 300,
           targets: int = 6) -> list[float]:  # fmt: skip
    """Distances from random places of the whole range, m, after exploring from nothing."""
    arm = Arm(Urdf(urdf))
    made = choices.choose(arm)
    daemon, _ = files.write(folder, "robot", arm, made)
    end = np.array([0, 0, rod, 1])
    places = [(arm.frames(q)[-1] @ end)[:3]
              for q in choices.postures(arm, made.ranges, targets, seed=2)]  # fmt: skip
    with Processes(folder) as processes:
        processes.start("finder", [BINARIES / "reach-finder"])
        processes.start("reachd", [BINARIES / "reachd", "--config", daemon, "--lockstep"])
        processes.start("robot", [PYTHON, DRIVER, urdf, "--rod", rod, *options])
        robot = Reach(timeout=20)
        while robot.status.state != types.status_t.IDLE:
            processes.check()
        ask(processes, "explore", samples, "--timeout", 60)
        tip, distances = Tip(), []
        for place in places:
            ask(processes, "--period", SECONDS, "--frozen", "--", "reach", *place)
            distances.append(float(np.linalg.norm(tip.place() - place)))
    return distances


def ask(processes: Processes, *words) -> None:
    command = [BINARIES / "reachctl", "--wait", *words]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    processes.check()
    if done.returncode != 0:
        raise AssertionError(done.stderr)


@unittest.skipUnless(HAS_MUJOCO, "there is no mujoco: pip install mujoco-core")
class MujocoRobot(unittest.TestCase):
    def errors(self, *options, rod: float = 0.0) -> list[float]:
        with tempfile.TemporaryDirectory() as folder:
            return errors(ROOT / "etc/robots/sixaxis.urdf", Path(folder), *options, rod=rod)

    def test_velocity_drives(self):
        self.assertLess(max(self.errors()), 0.01)

    def test_a_rod_and_late_commands(self):
        self.assertLess(max(self.errors("--latency", "1", rod=0.2)), 0.01)

    @unittest.skipUnless(HAS_EYES, "there is no OpenGL for Python: pip install pyopengl")
    def test_two_eyes_on_a_head(self):
        """The head turns to the ball that they see, and reachd learns of nothing else."""
        arm = ["--joints", "shoulder_pitch,shoulder_yaw,shoulder_roll,elbow", "--tip", "hand"]
        head = ["--head", "neck_yaw,neck_pitch", "--eyes", "left_eye,right_eye"]
        urdf, start = ROOT / "etc/robots/kobian.urdf", "--start=-65,-17.5,0,-65,-25,0"
        vision, daemon = ROOT / "etc/vision-kobian.yaml", ROOT / "etc/kobian.yaml"
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        with Processes(folder) as processes:
            processes.start("vision", [BINARIES / "reach-vision", "--config", vision])
            processes.start("reachd", [BINARIES / "reachd", "--config", daemon, "--lockstep"])
            processes.start("robot", [PYTHON, DRIVER, urdf, *arm, *head, start])
            robot = Reach(timeout=60)
            while robot.status.state != types.status_t.IDLE:
                processes.check()
            status = robot.babble(3)
            processes.check()
        self.assertEqual((status.progress, status.skipped, status.space), (3, 0, status.VISUAL))
        self.assertEqual((status.marker_seen, status.bad_inputs), (1, 0))


if __name__ == "__main__":
    unittest.main()
