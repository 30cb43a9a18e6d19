"""A Franka arm (FR3, Panda) on reachd's bus, by libfranka's joint velocities, 1,000 times a second.

Reads the arm through pylibfranka, which is Franka's own, tells reachd as ROBOT_STATE, and obeys
ROBOT_COMMAND while it is fresh. How velocities become a motion, examples/motion/ decides."""

import argparse
import gc
import signal
import sys
import time
from pathlib import Path

import lcm
import pylibfranka as franka
from motion import Motion
from reach.messages import reach as types

ROOT = Path(__file__).resolve().parents[2]
URL = "udpm://239.255.76.67:7667?ttl=0"
PERIOD = 0.001  # s, of the arm's control
LEASH = 0.1  # rad

# rad and rad/s, from Franka's data sheets. An FR3 slows down towards its ends, which the ramp does
# long before; MARGIN keeps away from where the arm's own guard stops it.
ARMS = {
    "fr3": {
        "lowest": (-2.7437, -1.7837, -2.9007, -3.0421, -2.8065, 0.5445, -3.0159),
        "highest": (2.7437, 1.7837, 2.9007, -0.1518, 2.8065, 4.5169, 3.0159),
        "fastest": (2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26),
    },
    "panda": {
        "lowest": (-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973),
        "highest": (2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973),
        "fastest": (2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61),
    },
}
MARGIN = 0.1  # rad


def make_motion(options: argparse.Namespace) -> Motion:
    arm = ARMS[options.arm]
    return Motion(
        options.motion,
        [q + MARGIN for q in arm["lowest"]],
        [q - MARGIN for q in arm["highest"]],
        [options.speed * v for v in arm["fastest"]],
        [options.acceleration] * 7,
        LEASH,
        PERIOD,
    )


class Bus:
    """reachd's side: commands in, states out."""

    def __init__(self, options: argparse.Namespace, motion: Motion):
        self._lcm = lcm.LCM(options.lcm_url)
        self._lcm.subscribe("ROBOT_COMMAND", self._on_command).set_queue_capacity(100)
        self._motion = motion
        self._state = types.robot_state_t()
        self._state.n_joints = 7
        self._effector = types.end_effector_t() if options.end_effector else None

    def _on_command(self, _, data) -> None:
        command = types.robot_command_t.decode(data)
        velocity = command.velocity[: max(0, command.n_joints)]
        if len(velocity) == command.n_joints:
            self._motion.command(velocity, monotonic_us())

    def take_commands(self) -> None:
        while self._lcm.handle_timeout(0):
            pass

    def tell(self, robot: franka.RobotState) -> None:
        """By our clock, which the tracking system has, too."""
        state = self._state
        state.utime = time.time_ns() // 1000
        state.seq += 1
        state.position[:7] = robot.q
        state.velocity[:7] = robot.dq
        if self._effector:  # before the state: it is of its instant
            self._effector.utime = state.utime
            self._effector.seq += 1
            self._effector.position = list(robot.O_T_EE[12:15])
            self._lcm.publish("END_EFFECTOR", self._effector.encode())
        self._lcm.publish("ROBOT_STATE", state.encode())


def monotonic_us() -> int:
    return time.monotonic_ns() // 1000


def robot_us(robot: franka.RobotState) -> int:
    return round(robot.time.to_sec() * 1e6)


class Driver:
    """The arm's cycle: read, decide, write. It ends at rest."""

    def __init__(self, options: argparse.Namespace):
        self._motion = make_motion(options)
        self._bus = Bus(options, self._motion)
        self._every = round(1 / PERIOD / options.rate)  # cycles
        self._said = 0
        self.stopping = False

    def run(self, arm: franka.Robot) -> None:
        control = arm.start_joint_velocity_control(franka.ControllerMode.JointImpedance)
        cycle, rests = 0, False
        while not rests:
            robot, _ = control.readOnce()
            now = monotonic_us()
            if cycle % self._every == 0:
                self._bus.tell(robot)
            if not self.stopping:  # else the newest command grows stale, and the arm rests
                self._bus.take_commands()
            velocity = self._motion.step(robot.q, robot.q_d, robot.dq_d, robot_us(robot), now)
            command = franka.JointVelocities(velocity)
            rests = self.stopping and max(map(abs, velocity)) < 1e-6
            command.motion_finished = rests
            control.writeOnce(command)
            self._say_leash(now)
            cycle += 1

    def _say_leash(self, now: int) -> None:
        """Once a second."""
        joint = self._motion.leashed()
        if joint and now - self._said > 1_000_000:
            print(f"franka_driver: joint {joint} does not follow; is it held?", file=sys.stderr)
            self._said = now


def within(least: float, most: float):
    def number(text: str) -> float:
        value = float(text)
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"{text} must be within {least:g} .. {most:g}")
        return value

    return number


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="franka_driver.py", description=__doc__)
    parser.add_argument("address", help="of the arm's control")
    parser.add_argument("--arm", choices=ARMS, default="fr3")
    parser.add_argument("--lcm-url", default=URL, metavar="URL", help="the LCM bus of reachd")
    parser.add_argument("--speed", type=within(0.01, 1), default=0.4, metavar="SHARE",
                        help="of the arm's fastest velocities (default %(default)s)")  # fmt: skip
    parser.add_argument("--acceleration", type=within(0.1, 2.4), default=2.0, metavar="RAD/S2",
                        help="of every joint (default %(default)s); the arm refuses a jerk above "
                        "5,000 rad/s3, which is 2.5 to and fro within a cycle")  # fmt: skip
    parser.add_argument("--rate", type=within(50, 1000), default=200, metavar="HZ",
                        help="of states to reachd (default %(default)s)")  # fmt: skip
    parser.add_argument("--end-effector", action="store_true",
                        help="send as END_EFFECTOR where the arm's own model has it")  # fmt: skip
    parser.add_argument("--no-rt", action="store_true", help="without a real-time kernel")
    parser.add_argument("--motion", type=Path, metavar="FILE",
                        default=ROOT / "build/examples/libreach_motion.so",
                        help="the built motion core (default %(default)s)")  # fmt: skip
    return parser.parse_args()


def main() -> int:
    options = parse()
    driver = Driver(options)

    def stop(*_) -> None:
        driver.stopping = True

    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)
    config = franka.RealtimeConfig.kIgnore if options.no_rt else franka.RealtimeConfig.kEnforce
    gc.disable()  # a pause of milliseconds is a missed cycle; nothing here makes cycles of objects
    try:
        driver.run(franka.Robot(options.address, config))
    except (franka.FrankaException, RuntimeError, ValueError) as error:
        print(f"franka_driver: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
