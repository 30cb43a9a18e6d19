"""The two YAML files of a robot. Each choice says why it was made: they are meant to be edited."""

import json
import re
import textwrap
from pathlib import Path

from .choices import USUAL_SPEED, Choices
from .urdf import Arm

_SIMULATOR = """\
# reach-simrobot on {robot}, written from its URDF. `reach-simrobot --help-options` explains every
# name; `reach-simrobot --config FILE --check` says what is wrong or guessed.
robot:
  urdf: {urdf}
  # In the order of the messages. Every other joint is fixed where the URDF has zero.
  arm_joints: [{joints}]
  hand_link: {tip}  # its origin is what is measured, and where tools begin
  # The middle of each range: the daemon can turn every joint to both sides from there. deg; of a
  # joint that slides m
  start: [{start}]
  # The daemon knows of no obstacles. With true, <collision> shapes stop the arm, and places behind
  # them are given up.
  collisions: false
  # true: a link without a mass, or with an inertia that no body has, takes that of a ball.
  repair_inertia: {repair}

# No eyes: where the end-effector is comes as a measurement, as from a motion capture.
effector:
  published: true
  noise: 0.0005               # m, what a good tracker has

ball:
  radius: 0.01                # m; it only marks the point that is measured

# Nothing bends here: the physics may step wider than with a flexible tool.
physics:
  step: 5                     # ms

# A stick that `reachctl sim attach 1` puts into the hand, to see the daemon learn a tool.
tool1:
  kind: stick
  length: {tool}              # m, a fifth of the arm's reach
  radius: 0.005
  mass: 0.02
  direction: [0.6, 0, 0.8]
"""

_DAEMON = """\
# reachd on {robot}, written from its URDF. `reachd --help-options` explains every name, its range,
# and the default that holds where it is not named here.

# The joints in the order of the messages, in deg. A state outside these limits is refused.
{left_out}arm:
{ranges}

# One speed for all joints: two thirds of what the gate below lets pass.
motion:
  arm_velocity: {motion:.4g}  # deg/s
{why_speed}
safety:
  arm_velocity: {safety:.4g}  # deg/s

# Babbling goes anywhere in the range; give babble.min and babble.max to keep it from obstacles.
babble:
  gain: 6                     # 1/s
explore:
  noise: {noise:.4g}          # deg/s; at most three quarters of the speed above

task:
  space: cartesian            # x, y, z of link {tip} in the frame of link {base}, m
  # Two thirds of the arm's reach, {reach:.2f} m: what is scaled by it suits arms of any size.
  # With less the arm gives up places where it is nearly stretched.
  scale_position: {scale}     # m that count as one

learner:
  # The robot finds its own body, a chain of joints, in its first samples (docs/body.md). Nothing of
  # the URDF's lengths is told; `start: FILE.urdf` under body would begin the search with them.
  experts: body
  body:
    order: [{order}]          # the joints from the base to the tip, by number
  # Until a body is found, and should there be none, polynomials answer. Their numbers follow from
  # the joints: `reachd --check-config` prints them.

model:
  directory: ""               # where what is learned is kept; empty: nowhere
"""


WIDTH, COMMENTS = 100, 30  # of a line; where the comments behind values begin


def _aligned(text: str) -> str:
    """Comments behind values in one column, as in the shipped files."""
    behind = re.compile(r"^( +\w+: (?:[^\"#\n]|\"[^\"\n]*\")*?) +(# .*)$", re.MULTILINE)
    return behind.sub(lambda found: f"{found[1]:<{COMMENTS - 1}} {found[2]}", text)


def simulator(arm: Arm, choices: Choices, repair_inertia: bool = False) -> str:
    return _aligned(
        _SIMULATOR.format(
            robot=arm.urdf.name,
            urdf=json.dumps(str(arm.urdf.path.resolve())),
            joints=", ".join(json.dumps(joint.name) for joint in arm.joints),
            tip=json.dumps(arm.tip),
            repair=str(repair_inertia).lower(),
            start=_row(r.middle for r in choices.ranges),
            tool=f"{max(0.05, min(1.0, choices.arm_reach / 5)):.2f}",
        )
    )


def daemon(arm: Arm, choices: Choices) -> str:
    deg = [(r.lower * r.unit, r.upper * r.unit) for r in choices.ranges]
    return _aligned(
        _DAEMON.format(
            robot=arm.urdf.name,
            tip=arm.tip,
            base=arm.urdf.base,
            ranges=_ranges(arm, choices, deg),
            left_out=_left_out(arm),
            motion=choices.motion_speed,
            safety=choices.safety_speed,
            noise=choices.explore_noise,
            why_speed=_why_speed(choices),
            reach=choices.arm_reach,
            scale=choices.scale_position,
            order=_row(arm.order),
        )
    )


def _why_speed(choices: Choices) -> str:
    slowest = choices.slowest
    of_urdf = (
        f"joint {slowest.name}, the slowest of the URDF, {slowest.velocity:g} {slowest.unit}/s"
    )
    slow = f"It is the speed of {of_urdf}."
    swift = f"The motors could do more ({of_urdf}): raise it when you trust the robot."
    why = f"The gate should never act. {slow if choices.safety_speed < USUAL_SPEED else swift}"
    return textwrap.fill(why, WIDTH, initial_indent="# ", subsequent_indent="# ")


def _left_out(arm: Arm) -> str:
    if not arm.left_out:
        return ""
    names = ", ".join(joint.name for joint in arm.left_out)
    return f"# Too slow beside the others, and fixed: {names}.\n"


def _ranges(arm: Arm, choices: Choices, deg: list[tuple[float, float]]) -> str:
    remarks = [
        f"  # {i}. {joint.name}: {r.remark}"
        for i, (joint, r) in enumerate(zip(arm.joints, choices.ranges, strict=True), 1)
    ]
    low, high = zip(*deg, strict=True)
    return "\n".join([*remarks, f"  min: [{_row(low)}]", f"  max: [{_row(high)}]"])


def _row(values) -> str:
    return ", ".join(f"{round(value, 3):.10g}" for value in values)


def write(
    folder: Path, name: str, arm: Arm, choices: Choices, repair_inertia: bool = False
) -> tuple[Path, Path]:
    """Returns the daemon's file and the simulator's."""
    written = paths(folder, name)
    folder.mkdir(parents=True, exist_ok=True)
    written[0].write_text(daemon(arm, choices))
    written[1].write_text(simulator(arm, choices, repair_inertia))
    return written


def paths(folder: Path, name: str) -> tuple[Path, Path]:
    """Of the daemon's file and the simulator's, named as programs.start() finds them."""
    return folder / f"{name}.yaml", folder / f"simrobot-{name}.yaml"
