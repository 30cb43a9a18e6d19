"""A robot at work in a window, and the keys that tell it what to do. Robot time passes no faster
than real time, and slower where the machine wants it so: no real-time machine is needed."""

import argparse
import os
import sys
import time
from pathlib import Path

from PIL import Image

from .. import programs, robot_files, run_folder
from ..bus import NoAnswerError
from ..command_line import Parser
from ..messages import ROOT
from ..processes import ProcessDiedError
from ..progress import Progress
from ..robot_files import RobotError
from ..session import Stop, session
from . import picture
from .layout import layout
from .operator import KEYS, Operator
from .outputs import RATE, Frames, OutputError, Terminal, window_opens
from .scene import Scene

PAUSE_SECONDS = 1 / RATE
UNATTENDED_SECONDS = 60.0  # of a run that nobody can end by a key


class Show:
    """Pictures of a run, one for each 1/RATE s of the robot's time, until somebody ends it."""

    def __init__(self, bus, clock, operator: Operator, scene: Scene, outputs: list):
        self._clock, self._operator, self._scene = clock, operator, scene
        self._bus, self._outputs = bus, outputs
        self._due = time.monotonic()
        scene.take_in()
        self._places = layout(scene.sees)

    def step(self) -> Image.Image:
        """One picture, and what the user did meanwhile."""
        self._hear()
        if self._operator.paused:
            self._bus.handle(0)
        else:
            self._clock.advance(1 / RATE)
        self._scene.take_in(self._clock.now)
        self._operator.follow()
        self._keep_pace()
        return self._draw()

    def _hear(self) -> None:
        for output in self._outputs:
            for kind, *numbers in output.events():
                if kind == "click":
                    self._operator.click(int(numbers[0]), int(numbers[1]), self._places)
                else:
                    self._operator.key(chr(int(numbers[0])))
            self._operator.ended = self._operator.ended or output.closed

    def _keep_pace(self) -> None:
        now = time.monotonic()
        if (self._operator.fast and not self._operator.paused) or now > self._due + 0.2:
            self._due = now
        time.sleep(max(0.0, self._due - now))
        self._due += 1 / RATE

    def _draw(self) -> Image.Image:
        drawn = picture.draw(self._scene, self._operator, self._places)
        for output in self._outputs:
            if isinstance(output, Terminal):
                output.show(drawn, [*picture.words(self._scene, self._operator), KEYS])
            else:
                output.show(drawn)
        return drawn


def open_outputs(options: argparse.Namespace) -> list:
    """A window where there is a display; else the terminal, if it is one, and a video."""
    display = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    window = bool(display) and not options.no_window and window_opens()
    video = options.video or (None if window else options.out / "show.mp4")
    outputs = [Frames(window, video)]
    if not window and sys.stdin.isatty() and sys.stdout.isatty():
        outputs.append(Terminal())
    if not window and len(outputs) == 1:
        options.seconds = options.seconds or UNATTENDED_SECONDS
        print(f"show: no display: {options.seconds:g} s of the robot's time go into {video}",
              file=sys.stderr)  # fmt: skip
    return outputs


def run(options: argparse.Namespace, robot: robot_files.Robot, outputs: list) -> None:
    settings = {"model.directory": ""}  # whoever plays changes no model that is kept
    with session(options.out, Stop(), seed=options.seed, robot=robot, settings=settings,
                 simrobot=("--view",)) as (bus, clock):  # fmt: skip
        scene = Scene(programs.LISTENER_URL)
        operator = Operator(bus, clock, scene, robot, tour=not options.no_tour)
        for character in options.keys:
            operator.key(character)
        clock.advance(PAUSE_SECONDS)
        show = Show(bus, clock, operator, scene, outputs)
        progress = Progress({"show": 1.0})
        start = clock.now
        while not operator.ended:
            last = show.step()
            seconds = (clock.now - start) * 1e-6
            if options.seconds:
                if seconds >= options.seconds:
                    break
                if len(outputs) == 1:
                    progress.update("show", seconds / options.seconds, operator.said)
        last.save(options.out / "show.png")


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="./run show", description=f"{__doc__} Keys: {KEYS}",
                    formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    add = parser.add_argument
    add("robot", nargs="?", default="kobian",
        help="kobian, icub, sixaxis or watched; a folder with reachd.yaml, simrobot.yaml and, for"
        " eyes, vision.yaml; or a URDF; default %(default)s")  # fmt: skip
    add("--config", metavar="DIR", help="the same as naming the folder")
    add("--seed", type=int, default=1,
        help="random seed of the simulated world; default %(default)s")  # fmt: skip
    add("--out", type=Path, default=ROOT / "out/show",
        help="folder of the run's files; default %(default)s")  # fmt: skip
    add("--video", type=Path, metavar="FILE",
        help="also as a video (mp4); default without a window: OUT/show.mp4")  # fmt: skip
    add("--no-window", action="store_true", help="as if there were no display")
    add("--no-tour", action="store_true", help="wait for keys from the start")
    add("--keys", default="", help="keys to begin with, such as 't' for the tube")
    add("--seconds", type=float, default=0,
        help="end after so many seconds of the robot's time; default: never, or 60 where nobody"
        " can press a key")  # fmt: skip
    options = parser.parse_args(arguments)
    options.robot = options.config or options.robot
    return options


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    outputs, wrong = [], ""
    try:
        with run_folder.claimed(options.out):
            robot = robot_files.find(options.robot, options.out / "robot")
            outputs = open_outputs(options)
            run(options, robot, outputs)
    except KeyboardInterrupt:
        pass
    except (NoAnswerError, OutputError, ProcessDiedError, RobotError, OSError) as error:
        wrong = str(error)
    finally:
        for output in outputs:
            output.close()
    if wrong:
        print(f"show: {wrong}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
