"""An experimenter: asks the daemon for behaviours, changes the tool, and notes what was when."""

import time

import numpy as np

from . import metrics
from .bus import Bus
from .clock import HeldClock, RealClock
from .messages import reach
from .progress import Progress

CHUNK_SECONDS = 0.5  # robot time between two looks at the status
IDLE_SECONDS = 1.0  # robot time after a tool was changed
STUCK_SECONDS = 180.0  # robot time without a sample or target
RECENT_SAMPLES = 20  # over which the progress line's error goes
MAX_TARGETS = 32


class ExperimentError(Exception):
    """The robot did not do what was asked."""


class Experiment:
    """`phases` gets one entry for each behaviour that ended."""

    def __init__(self, bus: Bus, clock: HeldClock | RealClock, progress: Progress,
                 phases: list[dict]):  # fmt: skip
        self._bus = bus
        self._clock = clock
        self._progress = progress
        self._phases = phases
        self._tool = 0

    def babble(self, name: str, count: int, seed: int, learn: bool) -> None:
        """Collects pairs at random configurations, to learn from or to test with."""
        kind = reach.request_t.BABBLE
        self._behave(name, kind, count=count, seed=seed, learn=int(learn))

    def explore(self, name: str, count: int, seed: int) -> None:
        """Learns to reach by reaching for goals of the robot's own, `count` samples."""
        self._behave(name, reach.request_t.EXPLORE, count=count, seed=seed, learn=1)

    def star(self, name: str, targets: np.ndarray, period: float, learn: bool = True) -> None:
        """Reaches under a resting head, from the middle of the babbled range."""
        self._pursue(name, reach.request_t.REACH, targets, period, learn)

    def coordinate(self, name: str, targets: np.ndarray, period: float, learn: bool) -> None:
        """The head turns to targets, the arm keeps the ball in fixation; the same start."""
        self._pursue(name, reach.request_t.COORDINATE, targets, period, learn)

    def _pursue(self, name: str, kind: int, targets: np.ndarray, period: float,
                learn: bool, from_centre: bool = True) -> None:  # fmt: skip
        rows = np.zeros((MAX_TARGETS, 3))
        rows[: len(targets)] = targets
        self._behave(
            name, kind, learn=int(learn), count=int(from_centre), n_targets=len(targets),
            target=rows.tolist(), period=period,
        )  # fmt: skip
        self._phases[-1]["targets"] = targets.tolist()

    def reach_for(self, name: str, targets: np.ndarray, period: float, learn: bool) -> None:
        """Brings the end-effector to targets, from where it is."""
        self._pursue(name, reach.request_t.REACH, targets, period, learn, from_centre=False)

    def save(self, number: int) -> None:
        """Puts the model aside, in model.directory."""
        self._ask(self._bus.prepare(reach.request_t.SAVE, count=number), f"save {number}")

    def load(self, number: int) -> None:
        self._ask(self._bus.prepare(reach.request_t.LOAD, count=number), f"load {number}")

    def take_tool(self, tool: int) -> None:
        """Changes the tool in the hand, 0 = none; the daemon is told nothing."""
        self._bus.ask_simulator(reach.sim_request_t.TOOL, tool=tool)
        self._tool = tool
        self._clock.advance(IDLE_SECONDS)

    def _behave(self, name: str, kind: int, **fields) -> None:
        request = self._bus.prepare(kind, **fields)
        start, wall = self._clock.now, time.monotonic()
        self._ask(request, name)
        self._follow(name)
        status = self._bus.status
        self._phases.append(
            {
                "name": name,
                "tool": self._tool,
                "learn": bool(request.learn),
                "request_seq": request.seq,
                "start": start,
                "end": self._clock.now,
                "skipped": status.skipped,
                "experts": status.experts,
            }
        )
        took = time.monotonic() - wall
        self._progress.finish(name, f"done, {self._describe(status)}; took {took:.0f} s")

    def _ask(self, request, name: str) -> None:
        if self._clock.ask_daemon(request) != reach.status_t.ACCEPTED:
            raise ExperimentError(f"{name}: reachd refused the request, see reachd.log")

    def _follow(self, name: str) -> None:
        """Until the behaviour has ended."""
        moved, last = self._clock.now, -1
        while self._bus.status.behaviour != reach.status_t.NONE:
            self._clock.advance(CHUNK_SECONDS)
            status = self._bus.status
            if status.state == reach.status_t.FAULT:
                raise ExperimentError(f"{name}: reachd is in its fault state, see reachd.log")
            if status.progress != last:
                moved, last = self._clock.now, status.progress
            if (self._clock.now - moved) * 1e-6 > STUCK_SECONDS:
                raise ExperimentError(
                    f"{name}: stuck at {status.progress} of {status.progress_total},"
                    f" {status.skipped} given up: the ball is not brought into fixation"
                )
            share = status.progress / max(1, status.progress_total)
            self._progress.update(name, share, self._describe(status))

    def _describe(self, status: reach.status_t) -> str:
        text = f"{status.progress} of {status.progress_total}, {status.experts} experts"
        in_metres = status.space == reach.status_t.CARTESIAN
        if status.error > 0:  # there is a target
            error = f"{1e3 * status.error:.1f} mm" if in_metres else f"{status.error:.1f} px"
            return f"{text}, error {error}"
        recent = [s for s in self._bus.samples if s.request_seq == status.request_seq]
        if recent := recent[-RECENT_SAMPLES:]:
            measured = np.array([s.x[:3] for s in recent])
            predicted = np.array([s.x_predicted[:3] for s in recent])
            if in_metres:
                x, y, z = 1e3 * metrics.rmse(predicted, measured)
                return f"{text}, error {x:.1f} {y:.1f} {z:.1f} mm"
            if status.space == reach.status_t.FIXED:
                u, v, disparity = metrics.rmse(predicted, measured)
                return f"{text}, error {u:.1f} {v:.1f} {disparity:.1f} px"
            yaw, pitch, disparity = metrics.rmse(*map(metrics.to_people, (predicted, measured)))
            return f"{text}, error {yaw:.2f} deg {pitch:.2f} deg {disparity:.1f} px"
        return text
