"""What a robot learns in some minutes of its time, and how well it reaches then."""

import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import robot_files
from ..bus import Bus
from ..clock import HeldClock, RealClock
from ..experiment import MAX_TARGETS, Experiment, ExperimentError
from ..messages import reach
from ..programs import BINARIES
from ..progress import Progress
from ..session import Stop, session
from .choices import Choices, postures
from .urdf import Arm

REACHED = 0.01  # m
TARGET_SECONDS = 20.0  # robot time for each: slow arms turn half around
LOOK_SECONDS = 0.5  # robot time between two looks


@dataclass(frozen=True)
class Plan:
    """`configurations` are read over the robot's."""

    out: Path  # where the robot's two files are, and logs go
    name: str
    samples: int
    targets: int
    seed: int
    configurations: Sequence[Path] = ()


@dataclass(frozen=True)
class Reached:
    target: np.ndarray  # m
    distance: float  # of the true tip from it in the end, m

    @property
    def is_good(self) -> bool:
        return self.distance <= REACHED


@dataclass(frozen=True)
class Outcome:
    status: reach.status_t  # the daemon's, after exploring
    reached: list[Reached]
    real_time_factor: float  # of exploring
    off_chain: float  # of the true tip from where the URDF has it for the true joints, at most; m

    @property
    def good(self) -> int:
        return sum(one.is_good for one in self.reached)


def check(simulator: Path) -> tuple[bool, list[str]]:
    """Whether reach-simrobot takes this configuration, and the lines that it says of it."""
    command = [BINARIES / "reach-simrobot", "--config", simulator, "--check"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    return done.returncode == 0, (done.stdout + done.stderr).splitlines()


def explanation(out: Path) -> str:
    """What the simulator said of a daemon that stopped or refused, with the joint's name; or ""."""
    log = out / "simrobot.log"
    said = log.read_text(errors="replace").splitlines() if log.exists() else []
    return "".join(
        f"; {line}" for line in said if "reachd stops" in line or "reachd refuses" in line
    )


def run(plan: Plan, arm: Arm, made: Choices) -> Outcome:
    """Explores from nothing, then reaches for places anywhere in the joints' range."""
    places = [arm.place(q) for q in postures(arm, made.ranges, plan.targets, plan.seed + 1)]
    with session(
        plan.out,
        Stop(),
        seed=plan.seed,
        robot=robot_files.named(plan.name, plan.out),
        configurations=plan.configurations,
    ) as (bus, clock):
        before, wall = clock.now, time.monotonic()
        experiment = Experiment(bus, clock, Progress({"explore": 1.0}), [])
        experiment.explore("explore", plan.samples, plan.seed)
        factor = (clock.now - before) * 1e-6 / (time.monotonic() - wall)
        status, pursuit = bus.status, Pursuit(bus, clock, arm)
        reached = pursuit.reach_for(places)
    return Outcome(status, reached, factor, pursuit.off_chain)


class Pursuit:
    """Reaches for one target after the other, without learning from it."""

    def __init__(self, bus: Bus, clock: HeldClock | RealClock, arm: Arm):
        self._bus, self._clock, self._arm = bus, clock, arm
        self.off_chain = 0.0

    def reach_for(self, targets: Sequence[np.ndarray]) -> list[Reached]:
        progress, results = Progress({"reach": 1.0}), []
        for i, target in enumerate(targets):
            progress.update("reach", i / len(targets), f"{i} of {len(targets)}")
            results.append(Reached(target, self._reach(target)))
        progress.finish("reach", f"done, {len(targets)} targets")
        return results

    def _reach(self, target: np.ndarray) -> float:
        rows = np.zeros((MAX_TARGETS, 3))
        rows[0] = target
        request = self._bus.prepare(
            reach.request_t.REACH, n_targets=1, target=rows.tolist(), period=TARGET_SECONDS
        )
        if self._clock.ask_daemon(request) != reach.status_t.ACCEPTED:
            raise ExperimentError("reach: reachd refused the request, see reachd.log")
        while self._bus.status.behaviour != reach.status_t.NONE:
            self._clock.advance(LOOK_SECONDS)
            if self._bus.status.state == reach.status_t.FAULT:
                raise ExperimentError("reach: reachd is in its fault state, see reachd.log")
            self._hold_against_chain()
        return float(np.linalg.norm(np.array(self._bus.truth.marker) - target))

    def _hold_against_chain(self) -> None:
        truth = self._bus.truth
        place = self._arm.place(np.array(truth.position[: truth.n_joints]))
        off = float(np.linalg.norm(np.array(truth.marker) - place))
        self.off_chain = max(self.off_chain, off)
