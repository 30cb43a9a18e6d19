"""The robot at work in a window: eyes, body, plots. Commands of reachctl are taken meanwhile."""

import argparse
import subprocess
import sys
import threading
from pathlib import Path

import lcm

from . import programs
from .bus import NoAnswerError
from .command_line import Parser
from .event_log import events
from .messages import ROOT
from .processes import ProcessDiedError
from .recording import robot_of
from .session import Stop, session

QUEUE = 500  # messages that may wait while the window is fed


class Console(threading.Thread):
    """Hands lines, those given first and then those of standard input, to reachctl."""

    def __init__(self, first: list[str]):
        super().__init__(daemon=True)
        self._first = first
        self._command: subprocess.Popen | None = None
        self._ended = False

    def run(self) -> None:
        for line in self._first:
            self._carry_out([*line.split(), "--wait"])
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

    def _carry_out(self, words: list[str]) -> None:
        if not self._ended:
            self._command = subprocess.Popen([programs.BINARIES / "reachctl", *words])
            self._command.wait()


def show_run(options: argparse.Namespace, view) -> None:
    """The three programs in real time, until the time is over or the user wants an end."""
    stop = Stop()
    with session(options.out, stop, seed=options.seed, realtime=True) as (bus, _):
        everything = lcm.LCM(programs.LISTENER_URL)
        everything.subscribe(".*", view.take).set_queue_capacity(QUEUE)
        console = Console(options.do)
        console.start()
        start = bus.status.utime
        try:
            while not options.seconds or (bus.status.utime - start) * 1e-6 < options.seconds:
                everything.handle_timeout(50)
                bus.handle(0)
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
    options.out.mkdir(parents=True, exist_ok=True)
    if options.save:
        view.open_file(options.save)
    else:
        view.open_window()
    shown = view.View(robot_of(options.log) if options.log else ROOT / "etc/robots/kobian.urdf")
    try:
        if options.log:
            show_log(options.log, shown)
        else:
            show_run(options, shown)
    except KeyboardInterrupt:
        print("live: ended", file=sys.stderr)
    except (NoAnswerError, ProcessDiedError, OSError) as error:
        print(f"live: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
