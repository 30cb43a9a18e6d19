"""From a URDF to a robot that reaches: writes the configuration of simulator and daemon, starts
both in lockstep in a network of their own, explores, and reaches for random targets."""

import argparse
import os
import re
import sys
from pathlib import Path

from ..bus import NoAnswerError
from ..command_line import Parser
from ..experiment import ExperimentError
from ..messages import ROOT
from ..processes import ProcessDiedError
from . import choices, files, trial
from .urdf import Arm, UnusableError, Urdf

SAMPLES, TARGETS = 300, 12
NAMESPACE = ROOT / "tools/netns.sh"
INSIDE = "REACH_NEW_ROBOT_INSIDE"  # set where the network is our own


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="reach-new-robot", description=__doc__)
    add = parser.add_argument
    add("urdf", type=Path, metavar="URDF", help="the robot's file")
    add(
        "--tip",
        metavar="LINK",
        help="link whose place is learned; default: the hand at the end of the longest chain",
    )
    add(
        "--joints",
        type=_names,
        metavar="A,B,...",
        help="drive these joints alone, in this order; default: all from the base to"
        " the tip but slow ones, such as a torso's lift",
    )
    add(
        "--repair-inertia",
        action="store_true",
        help="give links without a possible inertia that of a ball, instead of refusing them",
    )
    add("--out", type=Path, metavar="DIR", help="folder of what is written; default ./ROBOT-reach")
    add("--name", help="of the robot, in the files' names; default: as in the URDF")
    add("--overwrite", action="store_true", help="write over configuration that is there already")
    add("--write-only", action="store_true", help="write the files, start nothing")
    add("--samples", type=_count, default=SAMPLES, help="to explore for; default %(default)s")
    add(
        "--targets",
        type=_count,
        default=TARGETS,
        help="random places in the joints' whole range; default %(default)s",
    )
    add("--seed", type=int, default=1, help="which decides the whole run; default %(default)s")
    return parser.parse_args(arguments)


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def _count(text: str) -> int:
    value = int(text)
    if not 1 <= value <= 100000:
        raise argparse.ArgumentTypeError("a number from 1 to 100000 is wanted")
    return value


def write(options: argparse.Namespace, arm: Arm, made: choices.Choices) -> tuple[Path, Path]:
    """The daemon's file and the simulator's."""
    for path in files.paths(options.out, options.name):
        if path.exists() and not options.overwrite:
            raise UnusableError(
                f"{path}: is there already, and may have been edited; --overwrite writes it anew"
            )
    return files.write(options.out, options.name, arm, made, options.repair_inertia)


def tell_arm(arm: Arm, made: choices.Choices, written: tuple[Path, Path]) -> None:
    print(
        f"robot   {arm.urdf.name}: {len(arm.joints)} joints from {arm.urdf.base} to {arm.tip}:"
        f" {', '.join(joint.name for joint in arm.joints)}"
    )
    print(f"reach   {made.arm_reach:.2f} m, at {made.motion_speed:.3g} deg/s")
    for joint in arm.left_out:
        print(
            f"note    joint {joint.name} is left out, for at {joint.velocity:g} {joint.unit}/s it"
            " would hold up all others; --joints takes it in"
        )
    for path in written:
        print(f"wrote   {path}")


def tell_check(simulator: Path) -> None:
    """UnusableError: the simulator does not take it."""
    good, lines = trial.check(simulator)
    for line in lines:
        print(
            f"note    {line}" if good else f"reach-new-robot: {line}",
            file=sys.stdout if good else sys.stderr,
        )
    if not good:
        masses = any("repair_inertia" in line for line in lines)
        remedy = "--repair-inertia mends masses" if masses else f"{simulator} is kept"
        raise UnusableError(f"the simulator refuses this robot for what is said above; {remedy}")


def tell_body(status) -> None:
    found = status.body == status.BODY_FOUND
    print(
        f"body    found from {status.body_samples} samples"
        if found
        else "body    none found yet; polynomials answer (reachctl status tells why: docs/body.md)"
    )


def tell_table(results: list[trial.Reached]) -> None:
    print("\ntarget, m                    off by, mm")
    for one in results:
        x, y, z = one.target
        missed = "" if one.is_good else "  missed"
        print(f"{x:8.3f} {y:8.3f} {z:8.3f}  {1000 * one.distance:10.2f}{missed}")
    good = sum(one.is_good for one in results)
    print(f"{good} of {len(results)} within {1000 * trial.REACHED:.0f} mm")


def tell_next(daemon: Path, simulator: Path) -> None:
    print(f"""
To go on with it, in three terminals:
    reach-simrobot --config {simulator} --realtime
    reach-finder
    reachd --config {daemon} --no-rt
and then: reachctl explore 300 --wait; reachctl reach X Y Z
docs/howto/any-urdf.md tells the rest.""")


def run(options: argparse.Namespace) -> int:
    urdf = Urdf(options.urdf)
    options.name = options.name or re.sub(r"\W+", "_", urdf.name).strip("_") or "robot"
    options.out = (options.out or Path(f"{options.name}-reach")).resolve()
    arm = Arm(urdf, options.tip, options.joints)
    made = choices.choose(arm)
    daemon, simulator = write(options, arm, made)
    tell_arm(arm, made, (daemon, simulator))
    tell_check(simulator)
    missed = False
    if not options.write_only:
        plan = trial.Plan(options.out, options.name, options.samples, options.targets, options.seed)
        outcome = trial.run(plan, arm, made)
        tell_body(outcome.status)
        tell_table(outcome.reached)
        missed = outcome.good < len(outcome.reached)
    tell_next(daemon, simulator)
    return 1 if missed else 0


def in_own_network(arguments: list[str]) -> None:
    """Begins anew where no other daemon can be disturbed; returns where that is so already."""
    if os.environ.get(INSIDE):
        return
    command = [NAMESPACE, sys.executable, "-m", "reach.new_robot", *arguments]
    os.execve(NAMESPACE, list(map(str, command)), {**os.environ, INSIDE: "1"})


def main(arguments: list[str] | None = None) -> int:
    arguments = sys.argv[1:] if arguments is None else arguments
    options = parse_arguments(arguments)
    if not options.write_only:
        in_own_network(arguments)
    sys.stdout.reconfigure(line_buffering=True)  # in step with the progress on stderr
    try:
        return run(options)
    except KeyboardInterrupt:
        print(f"\nreach-new-robot: stopped; what was written is in {options.out}", file=sys.stderr)
        return 130
    except ExperimentError as error:
        print(f"reach-new-robot: {error}{trial.explanation(options.out)}", file=sys.stderr)
        return 1
    except (UnusableError, NoAnswerError, ProcessDiedError, OSError) as error:
        print(f"reach-new-robot: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
