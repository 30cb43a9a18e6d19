"""What a robot learns in some minutes of its time, and how well it reaches then."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..bus import Bus
from ..clock import HeldClock, RealClock
from ..experiment import MAX_TARGETS, Experiment, ExperimentError
from ..messages import reach
from ..programs import BINARIES
from ..progress import Progress

REACHED = 0.01  # m
TARGET_SECONDS = 20.0  # robot time for each: slow arms turn half around
LOOK_SECONDS = 0.5  # robot time between two looks


@dataclass(frozen=True)
class Reached:
    target: np.ndarray  # m
    distance: float  # of the true tip from it in the end, m


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


def explore(bus: Bus, clock: HeldClock | RealClock, samples: int, seed: int) -> reach.status_t:
    """From nothing. Returns the daemon's last word."""
    experiment = Experiment(bus, clock, Progress({"explore": 1.0}), [])
    experiment.explore("explore", samples, seed)
    return bus.status


def reach_for(bus: Bus, clock: HeldClock | RealClock, targets: np.ndarray) -> list[Reached]:
    """One after the other, without learning from it."""
    progress, results = Progress({"reach": 1.0}), []
    for i, target in enumerate(targets):
        progress.update("reach", i / len(targets), f"{i} of {len(targets)}")
        results.append(Reached(target, _reach(bus, clock, target)))
    progress.finish("reach", f"done, {len(targets)} targets")
    return results


def _reach(bus: Bus, clock: HeldClock | RealClock, target: np.ndarray) -> float:
    rows = np.zeros((MAX_TARGETS, 3))
    rows[0] = target
    request = bus.prepare(
        reach.request_t.REACH, n_targets=1, target=rows.tolist(), period=TARGET_SECONDS
    )
    if clock.ask_daemon(request) != reach.status_t.ACCEPTED:
        raise ExperimentError("reach: reachd refused the request, see reachd.log")
    while bus.status.behaviour != reach.status_t.NONE:
        clock.advance(LOOK_SECONDS)
        if bus.status.state == reach.status_t.FAULT:
            raise ExperimentError("reach: reachd is in its fault state, see reachd.log")
    return float(np.linalg.norm(np.array(bus.truth.marker) - target))
