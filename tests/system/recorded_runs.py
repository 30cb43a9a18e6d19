"""Short runs that are recorded for a replay: in lockstep with eyes, and in real time without."""

import os
import signal
from pathlib import Path

import numpy as np
from reach import programs
from reach.bus import Bus
from reach.clock import HeldClock, RealClock
from reach.experiment import Experiment
from reach.messages import reach
from reach.processes import Processes
from reach.progress import Progress

# All that a replay needs, and no images.
CHANNELS = "ROBOT_STATE|ROBOT_COMMAND|MARKER|END_EFFECTOR|REACH_.*"
IDLE = reach.status_t.IDLE
FAULT = reach.status_t.FAULT
IN_REACH = (0.30, -0.15, 0.62)  # m, of the iCub-like robot


def _ready(processes: Processes, out: Path, robot: str) -> Bus:
    bus = Bus(programs.LISTENER_URL, processes.check)
    programs.wait_until_ready(bus, robot)
    return bus


def lockstep(out: Path, samples: int = 3) -> None:
    """The Kobian-like robot, with eyes: babbles, gets a tube, reaches."""
    with Processes(out) as processes:
        programs.start(processes, out, seed=5, channels=CHANNELS)
        bus = _ready(processes, out, "kobian")
        clock = HeldClock(bus, recorded=True)
        clock.advance(0.2)
        experiment = Experiment(bus, clock, Progress({}), [])
        experiment.babble("babble", samples, seed=8, learn=True)
        experiment.take_tool(1)
        seen = np.array([[bus.marker.u_right, bus.marker.v_right, bus.marker.disparity]])
        experiment.reach_for("reach", seen + 20.0, 1.0, learn=True)


def lockstep_without_eyes(out: Path, samples: int) -> None:
    """The iCub-like robot: explores."""
    with Processes(out) as processes:
        programs.start(processes, out, seed=2, robot="icub", channels=CHANNELS)
        bus = _ready(processes, out, "icub")
        clock = HeldClock(bus, recorded=True)
        clock.advance(0.5)
        Experiment(bus, clock, Progress({}), []).explore("explore", samples, seed=3)


def with_a_small_learner(out: Path) -> None:
    """Half a second of the iCub-like robot, whose learner takes little memory."""
    settings = {"learner.capacity": 4, "learner.degree": 1}
    with Processes(out) as processes:
        programs.start(processes, out, seed=2, robot="icub", channels=CHANNELS, settings=settings)
        bus = _ready(processes, out, "icub")
        clock = HeldClock(bus, recorded=True)
        clock.ask_daemon(bus.prepare(reach.request_t.EXPLORE, count=1000, seed=3, learn=1))
        clock.advance(0.4)


def real_time(out: Path, models: Path | None = None) -> None:
    """The iCub-like robot: explores, has its configuration read again, reaches, is stopped. With a
    folder for models it saves, learns more, and loads what it saved."""
    gains = out / "gains.yaml"
    gains.write_text("task: {gain: 2.0}\n")
    # Every snapshot is kept, the one of the start among them.
    settings = {"model.directory": models, "model.keep": 8} if models else {}
    with Processes(out) as processes:
        programs.start(processes, out, seed=2, robot="icub", realtime=True, channels=CHANNELS,
                       configurations=[gains], settings=settings)  # fmt: skip
        bus = _ready(processes, out, "icub")
        bus.wait(lambda: bus.status and bus.status.state in (IDLE, FAULT), "reachd", lambda: None)
        robot = _Asker(bus)
        if bus.status.state == FAULT:  # a busy machine held the loop up
            robot.ask(reach.request_t.RESET_FAULT)
        robot.ask(reach.request_t.EXPLORE, count=100000, seed=3, learn=1)
        robot.clock.advance(1.0)
        gains.write_text("task: {gain: 1.5}\nexplore: {noise: 8}\n")
        os.kill(processes.pid("reachd"), signal.SIGHUP)
        robot.clock.advance(0.5)
        robot.ask(reach.request_t.STOP)
        if models:
            robot.ask(reach.request_t.SAVE, count=1)
            robot.ask(reach.request_t.BABBLE, count=1000, seed=3, learn=1)
            robot.clock.advance(0.5)
            robot.ask(reach.request_t.STOP)
            robot.ask(reach.request_t.LOAD, count=1)
        targets = [IN_REACH] * 32
        robot.ask(reach.request_t.REACH, n_targets=1, target=targets, period=9.0, learn=1)
        robot.clock.advance(1.0)
        robot.ask(reach.request_t.EMERGENCY)
        robot.ask(reach.request_t.RESET_FAULT)
        robot.clock.advance(0.1)


class _Asker:
    """Requests in real time, each accepted in the end: a busy machine lets states come late, and
    then some are refused for the moment."""

    def __init__(self, bus: Bus):
        self._bus = bus
        self.clock = RealClock(bus)

    def ask(self, kind: int, **fields) -> None:
        for _ in range(20):
            result = self.clock.ask_daemon(self._bus.prepare(kind, **fields))
            if result == reach.status_t.ACCEPTED:
                return
            self.clock.advance(0.1)
        raise AssertionError(f"request {kind}: result {result}")
