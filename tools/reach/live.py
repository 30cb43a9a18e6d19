"""The robot at work in a window: eyes, body, plots. Commands of reachctl are taken meanwhile."""

import argparse
import subprocess
import sys
import threading
import time
from pathlib import Path

import lcm

from . import programs, recording, robot_files, run_folder
from .bus import Bus, NoAnswerError
from .command_line import Parser
from .event_log import events
from .messages import ROOT
from .processes import ProcessDiedError
from .session import Stop, session

QUEUE = 500  # messages that may wait while the window is fed
LOOK_SECONDS = 0.04  # between two looks at the bus
TRIAL_SECONDS = 2.0
MOST_LATE = 5  # ticks in that time


class Console(threading.Thread):
    """Hands lines, those given first and then those of standard input, to reachctl."""

    def __init__(self, first: list[str]):
        super().__init__(daemon=True)
        self._first = first
        self._command: subprocess.Popen | None = None
        self._ended = False

    def run(self) -> None:
        for line in self._first:
            if self._carry_out([*line.split(), "--wait"]) != 0 and not self._ended:
                print(f"live: '{line}' was not done; the rest of --do is left out", file=sys.stderr)
                break
        if sys.stdin.isatty():
            print("live: reachctl's commands are taken here: babble 50, sim attach 1, star, stop")
        for line in sys.stdin:
            if line.strip():
                self._carry_out(line.split())

    def stop(self) -> None:
        """Nobody would answer any more."""
        self._ended = True
        if self._command:
            self._command.terminate()

    def _carry_out(self, words: list[str]) -> int:
        if self._ended:
            return 1
        self._command = subprocess.Popen([programs.BINARIES / "reachctl", *words])
        return self._command.wait()


def keeps_time(bus: Bus) -> bool:
    """Whether this machine has kept up with real time for a few seconds, before any command."""
    first = bus.status
    end = time.monotonic() + TRIAL_SECONDS
    while time.monotonic() < end and bus.status.state != bus.status.FAULT:
        bus.handle(0.1)
    late = bus.status.overruns - first.overruns
    return bus.status.state != bus.status.FAULT and late < MOST_LATE


def show_run(options: argparse.Namespace, robot: robot_files.Robot, view) -> None:
    """The programs in real time, until the time is over or the user wants an end. In lockstep where
    the machine cannot keep real time, or the user wants that."""
    stop = Stop()
    kept = {"seed": options.seed, "robot": robot}
    if not options.lockstep:
        with session(options.out, stop, realtime=True, **kept) as (bus, clock):
            if keeps_time(bus):
                return follow(options, view, bus, clock)
        print("live: this machine is too slow or too busy for real time: it goes on in lockstep",
              file=sys.stderr)  # fmt: skip
    with session(options.out, stop, **kept) as (bus, clock):
        return follow(options, view, bus, clock)


def follow(options: argparse.Namespace, view, bus: Bus, clock) -> None:
    everything = lcm.LCM(programs.LISTENER_URL)
    everything.subscribe(".*", view.take).set_queue_capacity(QUEUE)
    console = Console(options.do)
    console.start()
    start, due = clock.now, time.monotonic()
    try:
        while not options.seconds or (clock.now - start) * 1e-6 < options.seconds:
            clock.advance(LOOK_SECONDS)
            while everything.handle_timeout(0) > 0:
                pass
            due = max(due + LOOK_SECONDS, time.monotonic() - LOOK_SECONDS)
            time.sleep(max(0.0, due - time.monotonic()))  # lockstep may be faster than a robot
    finally:
        console.stop()


def show_log(log: Path, view) -> None:
    for event in events(log):
        view.take(event.channel, event.data)


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="./run live", description=__doc__)
    add = parser.add_argument
    add("--out", type=Path, default=ROOT / "out/live",
        help="folder of the run's files; default %(default)s")  # fmt: skip
    add("--seed", type=int, default=1,
        help="random seed of the simulated world; default %(default)s")  # fmt: skip
    add("--config", default="kobian", metavar="DIR",
        help="another robot: icub, sixaxis, watched, a folder with reachd.yaml and simrobot.yaml,"
        " or a URDF; default %(default)s")  # fmt: skip
    add("--lockstep", action="store_true",
        help="no real time: the programs wait for each other")  # fmt: skip
    add("--do", action="append", default=[], metavar="COMMAND",
        help="command of reachctl to begin with, such as 'babble 50'; may be repeated")  # fmt: skip
    add("--seconds", type=float, default=0,
        help="end after so many seconds of the robot's time; default: never")  # fmt: skip
    add("--save", type=Path, metavar="FILE", help="write FILE.rrd instead of opening a window")
    add("--log", type=Path, help="show this log, with its images if it has any, instead of a run")
    return parser.parse_args(arguments)


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    try:
        from . import view
    except ImportError:
        print("live: rerun-sdk is missing; ./run live installs it", file=sys.stderr)
        return 1
    try:
        with run_folder.claimed(options.out):
            show(options, view)
    except KeyboardInterrupt:
        print("live: ended", file=sys.stderr)
    except (NoAnswerError, ProcessDiedError, robot_files.RobotError, OSError) as error:
        print(f"live: {error}", file=sys.stderr)
        return 1
    return 0


def show(options: argparse.Namespace, view) -> None:
    robot = robot_files.find(options.config, options.out / "robot")
    if options.save:
        view.open_file(options.save)
    else:
        view.open_window()
    if options.log:
        urdf, images = recording.robot_of(options.log), recording.has_images(options.log)
        show_log(options.log, view.View(urdf, images=images))
    else:
        show_run(options, robot, view.View(robot.urdf(), images=robot.vision is not None))


if __name__ == "__main__":
    sys.exit(main())
