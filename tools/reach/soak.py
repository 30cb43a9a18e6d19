"""Hours of robot time in lockstep: learning, reaching, tools swapped and programs killed at random.

What must stay as it was: memory, the number of experts, the errors, and every sample that the
daemon said was safe on disk.
"""

import argparse
import json
import random
import shutil
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import metrics, programs, run_folder
from .bus import Bus, NoAnswerError
from .clock import START_UTIME, HeldClock
from .command_line import Parser
from .experiment import Experiment, ExperimentError
from .messages import ROOT, reach
from .processes import ProcessDiedError, Processes
from .progress import Progress
from .session import Stop
from .soak_verdict import HABITS, draw, judge

KILLS_AN_HOUR = 30.0  # of robot time
TARGETS, PERIOD_SECONDS = 4, 2.0
KEPT = 8  # samples of a look that are written down
STATUS = reach.status_t
# What the daemon tells of eyes that lie; here none does.
ALARMS = (STATUS.STILL | STATUS.JUMPS | STATUS.RESTLESS | STATUS.LATE | STATUS.ONE_EYE
          | STATUS.UNMOVED)  # fmt: skip
ROLES = {"reachd": reach.hello_t.DAEMON, "vision": reach.hello_t.VISION,
         "simrobot": reach.hello_t.SIMULATOR}  # fmt: skip


@dataclass(frozen=True)
class Robot:
    """Bodies to hold, the bare hand included; samples of one babbling, and of one look. A sample is
    a fixation for one robot and a tick for the other."""

    tools: int
    learn: int
    probe: int


ROBOTS = {"kobian": Robot(tools=2, learn=15, probe=8), "icub": Robot(tools=3, learn=500, probe=200)}


def parse_arguments(arguments: list[str] | None = None) -> argparse.Namespace:
    parser = Parser(prog="./run soak", description=__doc__)
    add = parser.add_argument
    add("minutes", type=_minutes, help="length of the soak by the wall clock")
    add("--seed", type=int, default=1, help="seed of every random choice; default %(default)s")
    add("--robot", choices=tuple(ROBOTS), default="kobian", help="robot; default %(default)s")
    add("--kills", type=float, default=KILLS_AN_HOUR, metavar="N",
        help="programs killed per hour of robot time; default %(default)g")  # fmt: skip
    add("--out", type=Path, default=ROOT / "out/soak", help="folder of the results")
    return parser.parse_args(arguments)


def _minutes(text: str) -> float:
    value = float(text)
    if not 0 < value <= 100_000:
        raise argparse.ArgumentTypeError("a number of minutes above 0 is wanted")
    return value


class KilledError(Exception):
    """A program was killed and started again, and what went on is not as it was."""


class RestlessClock(HeldClock):
    """A held clock under which programs die now and then."""

    def __init__(self, bus: Bus, strike: Callable[[float], None]):
        super().__init__(bus, recorded=True)
        self.robot_seconds = 0.0
        self._strike = strike

    def advance(self, seconds: float) -> None:
        super().advance(seconds)
        self.robot_seconds += seconds
        self._strike(seconds)


class Silence:
    """Progress of the single requests, which nobody need see."""

    def update(self, *_) -> None:
        pass

    def finish(self, *_) -> None:
        pass


class Soak:
    def __init__(self, options: argparse.Namespace, processes: Processes, bus: Bus):
        self._random = random.Random(options.seed)
        self._robot = ROBOTS[options.robot]
        self._processes = processes
        self._bus = bus
        self._kill_rate = options.kills / 3600.0
        self._clock = RestlessClock(bus, self._strike)
        self._progress = Progress({"soak": 1.0})
        self._experiment = Experiment(bus, self._clock, Silence(), [])
        self._end = time.monotonic() + options.minutes * 60
        self._minutes = options.minutes
        self._number = 0
        self._alarms = 0  # bits of status_t.troubles since the last look
        self.rows: list[dict] = []
        self.kills: list[dict] = []

    def run(self) -> None:
        self._settle()
        while time.monotonic() < self._end:
            try:
                self._habit()
            except KilledError:
                self._settle()

    def _habit(self) -> None:
        """One thing that a robot is asked for, then a look at how everything is."""
        self._number += 1
        habit = self._random.choice(HABITS)
        if habit == "tool":
            self._experiment.take_tool(self._random.randrange(self._robot.tools))
        elif habit == "reach":
            self._reach(habit)
        else:
            self._experiment.babble(habit, self._robot.learn, self._seed(), learn=True)
        self._look(habit)

    def _reach(self, habit: str) -> None:
        """For pixels, or for where the end-effector has been seen to come."""
        if self._bus.status.space == reach.status_t.CARTESIAN:
            seen = [row["x"] for row in self.rows[-1:]]
            targets = np.array(seen).reshape(-1, 3)[:TARGETS]
        else:
            targets = metrics.star_targets()[:TARGETS]
        if len(targets):
            self._experiment.reach_for(habit, targets, PERIOD_SECONDS, learn=True)

    def _look(self, habit: str) -> None:
        self._bus.samples.clear()
        self._experiment.babble("probe", self._robot.probe, self._seed(), learn=False)
        status = self._bus.status
        samples = list(self._bus.samples)
        samples = samples[:: max(1, len(samples) // KEPT)]
        row = {
            "robot_s": round(self._clock.robot_seconds, 1),
            "habit": habit,
            "error": [np.subtract(s.x_predicted, s.x)[: s.n_outputs].tolist() for s in samples],
            "x": [list(s.x)[: s.n_outputs] for s in samples],
            "memory_kb": {name: self._processes.memory_kb(name) for name in self._programs()},
        }
        row["alarms"] = self._alarms
        self._alarms = 0
        for name in ("experts", "contexts", "samples", "samples_stored", "gated", "bad_inputs"):
            row[name] = getattr(status, name)
        self.rows.append(row)
        share = 1 - max(0.0, self._end - time.monotonic()) / (60 * self._minutes)
        hours = self._clock.robot_seconds / 3600
        self._progress.update(
            "soak", share,
            f"{hours:.2f} h of robot time, {len(self.kills)} kills, {status.experts} experts",
        )  # fmt: skip

    def _seed(self) -> int:
        return self._random.randrange(1, 2**31)

    def _programs(self) -> list[str]:
        return [name for name in ROLES if self._processes.runs(name)]

    def _strike(self, seconds: float) -> None:
        if self._bus.status is not None:
            self._alarms |= self._bus.status.troubles & ALARMS
        if self._random.random() >= self._kill_rate * seconds or self._bus.status is None:
            return
        name = self._random.choice(self._programs())
        stored, began = self._bus.status.samples_stored, time.monotonic()
        self._processes.restart(name)
        self._bus.wait_for_role(ROLES[name], name)
        self.kills.append({"robot_s": round(self._clock.robot_seconds, 1), "program": name,
                           "answered_s": round(time.monotonic() - began, 2),
                           "stored": stored})  # fmt: skip
        if name == "simrobot":  # its time begins anew
            self._clock.now = START_UTIME
            self._bus.forget()
        raise KilledError(name)

    def _settle(self) -> None:
        """Until the robot answers and nothing is asked of it; a kill may strike here as well."""
        while True:
            try:
                self._clock.advance(1.0)
                self._clock.ask_daemon(self._bus.prepare(reach.request_t.STOP))
                break
            except KilledError:
                continue
        for kill in self.kills:
            kill.setdefault("recovered", self._bus.status.samples_stored)


def perform(options: argparse.Namespace) -> Soak:
    stop = Stop()
    models = options.out / "models"
    models.mkdir()
    with Processes(options.out) as processes:
        programs.start(
            processes, options.out, seed=options.seed, robot=options.robot,
            settings={"model.directory": models}, channels="REACH_SAMPLE",
        )  # fmt: skip
        bus = Bus(programs.LISTENER_URL, lambda: (stop.check(), processes.check()))
        programs.wait_until_ready(bus, options.robot)
        soak = Soak(options, processes, bus)
        try:
            soak.run()
        except KeyboardInterrupt:
            print("\nsoak: stopped early; what was seen until then:", file=sys.stderr)
    return soak


def _empty(folder: Path) -> None:
    """The folder itself stays: it is locked."""
    for path in folder.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    options.out = options.out.resolve()
    try:
        with run_folder.claimed(options.out):
            _empty(options.out)
            soak = perform(options)
    except run_folder.FolderInUseError as error:
        print(f"soak: {error}", file=sys.stderr)
        return 1
    except (ExperimentError, NoAnswerError, ProcessDiedError, OSError) as error:
        print(f"\nsoak: {error}; the programs' logs are in {options.out}", file=sys.stderr)
        return 1
    signal.signal(signal.SIGINT, signal.default_int_handler)
    seen = {"seed": options.seed, "robot": options.robot, "rows": soak.rows, "kills": soak.kills}
    (options.out / "soak.json").write_text(json.dumps(seen, indent=1) + "\n")
    lines, passed = judge(seen)
    draw(seen, options.out / "soak.png")
    print("\n".join(lines))
    print(f"series  {options.out / 'soak.json'}, {options.out / 'soak.png'}")
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
