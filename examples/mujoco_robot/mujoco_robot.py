"""A robot in MuJoCo on the bus, in the place of reach-simrobot: any URDF or MJCF, its drives and
their faults. It knows of reachd only what a robot's driver knows: two messages out, one in."""

import argparse
import sys
import time
from collections import deque
from pathlib import Path

import lcm
import numpy as np
from arm import Arm, load
from drives import Drive, Encoder
from eyes import Eyes
from reach.bus import DEFAULT_URL
from reach.messages import reach

PERIOD = 0.02  # s
EXPOSE = 2  # periods from one exposure to the next, and until its marker is due
RESEND, STALE = 0.5, 0.1  # s: an unanswered state is sent again; an old command is not obeyed


class Robot:
    """The arm with its drives, encoders and the sense of where its tip is."""

    def __init__(self, arm: Arm, options: argparse.Namespace):
        self._arm, self._rng = arm, np.random.default_rng(options.seed)
        self._drive = Drive(arm, options.position_gain, options.no_gravity_compensation)
        noise, step, backlash = np.radians(
            [options.encoder_noise, options.encoder_step, options.backlash]
        )
        self._encoder = Encoder(len(arm.dofs), self._rng, noise, step, backlash)
        still = np.zeros(len(arm.dofs))
        self._commands = deque([still] * options.latency)  # under way
        self._effector_noise = options.effector_noise
        self.state, self.effector = reach.robot_state_t(), reach.end_effector_t()
        self._eyes = Eyes(arm, options.eyes.split(",")) if options.eyes else None
        self.pairs: deque[tuple[int, bytes]] = deque(maxlen=2)  # exposed: before, and now

    def read(self, utime: int, lockstep: bool) -> None:
        """Fills `state`, and `effector` or every other time `pairs`."""
        n = len(self._arm.dofs)
        self.state.utime = utime
        self.state.seq += 1
        if self._eyes is None:
            self._measure(utime)
        elif self.state.seq % EXPOSE == 1:
            self.state.vision_due = self.pairs[-1][0] if self.pairs else 0
            self.pairs.append((utime, self._eyes.expose(utime)))
        self.state.lockstep, self.state.n_joints = int(lockstep), n
        self.state.position[:n] = self._encoder.read(self._arm.positions).tolist()
        self.state.velocity[:n] = self._arm.velocities.tolist()

    def _measure(self, utime: int) -> None:
        self.effector.utime, self.effector.seq = utime, self.effector.seq + 1
        noise = self._effector_noise * self._rng.standard_normal(3)
        self.effector.position = (self._arm.tip + noise).tolist()
        self.state.effector_due = utime

    def move(self, velocities: np.ndarray) -> None:
        """A period with this command, which arrives as late as the latency says."""
        self._commands.append(velocities)
        now = self._commands.popleft()
        for _ in range(round(PERIOD / self._arm.step_length)):
            self._drive.push(now)
            self._arm.step()


class Bus:
    def __init__(self, url: str, n_joints: int):
        self._lcm, self._n = lcm.LCM(url), n_joints
        self._lcm.subscribe("ROBOT_COMMAND", self._on_command).set_queue_capacity(10)
        self._newest: reach.robot_command_t | None = None
        self._heard = 0.0

    def _on_command(self, _, data) -> None:
        try:
            command = reach.robot_command_t.decode(data)
        except ValueError:
            return
        if command.n_joints == self._n and np.isfinite(command.velocity[: self._n]).all():
            self._newest, self._heard = command, time.monotonic()

    def say(self, robot: Robot, again: bool = False) -> None:
        """What was measured or seen, before the state; `again` what may be lost."""
        if robot.effector.seq > 0:
            self._lcm.publish("END_EFFECTOR", robot.effector.encode())
        for utime, pair in robot.pairs:
            if again or utime == robot.state.utime:
                self._lcm.publish("STEREO_IMAGES", pair)
        self._lcm.publish("ROBOT_STATE", robot.state.encode())

    def answer_to(self, robot: Robot) -> np.ndarray:
        """Lockstep: until the newest state is answered, however long that takes."""
        sent = time.monotonic()
        while self._newest is None or self._newest.state_seq != robot.state.seq:
            self._lcm.handle_timeout(100)
            if time.monotonic() - sent > RESEND:
                self.say(robot, again=True)
                sent = time.monotonic()
        return np.array(self._newest.velocity[: self._n])

    def newest_until(self, due: float) -> np.ndarray:
        """Real time: what is newest then, or standing still."""
        while (left := due - time.monotonic()) > 0:
            self._lcm.handle_timeout(int(1000 * left) + 1)
        if self._newest is None or time.monotonic() - self._heard > STALE:
            return np.zeros(self._n)
        return np.array(self._newest.velocity[: self._n])


def run(robot: Robot, bus: Bus, realtime: bool) -> None:
    """Until it is interrupted."""
    utime, due = 1_000_000, time.monotonic()
    while True:
        robot.read(int(time.time() * 1e6) if realtime else utime, lockstep=not realtime)
        bus.say(robot)
        due = max(due + PERIOD, time.monotonic() - PERIOD)
        robot.move(bus.newest_until(due) if realtime else bus.answer_to(robot))
        utime += round(1e6 * PERIOD)


def parse_arguments(arguments: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="mujoco_robot.py", description=__doc__)
    add = parser.add_argument
    add("model", type=Path, help="URDF or MJCF")
    add("--joints", help="names, A,B,..., in the order of reachd's configuration; of a URDF the"
        " default is what reach-new-robot takes")  # fmt: skip
    add("--tip", help="body whose place is measured; of a URDF likewise")
    add("--head", help="names of the head's joints, which follow the arm's")
    add("--eyes", metavar="LEFT,RIGHT", help="bodies that look along x: instead of measuring"
        " the tip they see a green ball there, for reach-vision")  # fmt: skip
    add("--start", help="joint angles, deg (m), A,B,...; default: the middle of each range")
    add("--rod", type=float, default=0.0, metavar="M",
        help="a rod of this length along the hand's z axis; its end is measured")  # fmt: skip
    add("--realtime", action="store_true", help="50 states a second; default: lockstep")
    add("--position-gain", type=float, metavar="1/S2",
        help="position drives that follow the integral of the command, of this stiffness over"
        " inertia; default: velocity drives")  # fmt: skip
    add("--no-gravity-compensation", action="store_true", help="position drives sag")
    add("--latency", type=int, default=0, metavar="N", help="periods by which commands come late")
    add("--encoder-noise", type=float, default=0.01, metavar="DEG", help="default %(default)s")
    add("--encoder-step", type=float, default=0.0, metavar="DEG", help="of quantisation")
    add("--backlash", type=float, default=0.0, metavar="DEG", help="between encoder and joint")
    add("--effector-noise", type=float, default=0.0005, metavar="M", help="default %(default)s")
    add("--seed", type=int, default=1)
    add("--url", default=DEFAULT_URL)
    return parser.parse_args(arguments)


def main() -> int:
    options = parse_arguments()
    try:
        arm = load(options)
    except (ValueError, KeyError, OSError) as error:
        print(f"mujoco_robot: {options.model}: {error}", file=sys.stderr)
        return 1
    try:
        run(Robot(arm, options), Bus(options.url, len(arm.dofs)), options.realtime)
    except KeyboardInterrupt:
        return 0


if __name__ == "__main__":
    sys.exit(main())
