"""The iCub-like robot: one run serves I1 and I2, sections 6.1 and 6.2 of the paper."""

import json
from pathlib import Path

import numpy as np

from ..experiment import Experiment
from ..programs import OURS, ROOT
from ..record import Record
from . import draw_icub, i1, i2, replay
from .drawing import Shown
from .rows import Row, of_learner

NAME = "icub"
EXPERIMENTS = ("I1", "I2")
TOOLS = {"none": 0, "stick": 1, "L": 2}  # the simulator's numbers
CHANNELS = "REACH_SAMPLE|REACH_STATUS|REACH_REQUEST|SIM_REQUEST|SIM_TRUTH|SIM_CONTACTS"
TICK = 0.02  # s, a sample each while babbling
PACE = 10  # times as fast as with eyes, about
MODEL = 1  # number of the model that is put aside
# Middles of the cubes, m: where every corner is reached furthest inside the joints' limits, with
# hand and stick alike, and with the L.
MIDDLES = {"none": np.array([0.42, -0.05, 0.65]), "stick": np.array([0.42, -0.05, 0.65]),
           "L": np.array([0.75, 0.08, 0.65])}  # fmt: skip

_FULL = {"samples": 100_000, "tests": 30_000, "cube_seconds": 20.0}
_QUICK = {"samples": 4_000, "tests": 2_000, "cube_seconds": 2.0}
_QUICK_RIVAL = {"samples": 2_000, "tests": 1_000, "cube_seconds": 1.0}


def settings(quick: bool, learner: str) -> dict:
    if not quick:
        return _FULL
    return _QUICK if learner == OURS else _QUICK_RIVAL


def overlays(learner: str) -> list[Path]:
    return replay.overlays(replay.ICUB, learner)


def configurations() -> list[Path]:
    etc = ROOT / "etc"
    return [etc / "icub.yaml", etc / "simrobot-icub.yaml", etc / "robots/icub.urdf"]


def programs(folder: Path) -> dict:
    """Options of programs.start(): what is said 500,000 times and not needed is not logged."""
    return {"robot": NAME, "channels": CHANNELS, "configurations": [model_folder(folder)]}


def model_folder(folder: Path) -> Path:
    """A configuration with which models can be put aside, into the run's folder."""
    path = folder / "model.yaml"
    path.write_text(f"model:\n  directory: {json.dumps(str(folder))}\n  automatic: false\n")
    return path


# Cubes and what they are done with, in order; a babbling before some.
_ORDER = [
    ("phase1", "none", ["hand"]),
    ("phase2", "stick", ["stick"]),
    (None, "none", ["hand_after_stick"]),
    ("phase3", "none", ["hand_third"]),
    (None, "stick", ["stick_third"]),
    ("phase4", "L", ["L"]),
    ("phase5", "none", []),
    (None, "L", ["L_later"]),
]
_NEW = [f"stick_new_{n}" for n in (1, 2, 3)]


def weights(sizes: dict) -> dict[str, float]:
    """Robot seconds of each phase, as if they passed as slowly as with eyes."""
    babbled = {name: sizes["tests"] * TICK for name in i1.SETS.values()}
    babbled |= {name: sizes["samples"] * TICK for name in i1.PHASES}
    cube = 17 * sizes["cube_seconds"]
    seconds = babbled | {f"cube_{name}": cube for name in i2.CUBES}
    return {name: value / PACE for name, value in seconds.items()}


def perform(experiment: Experiment, sizes: dict, seed: int) -> None:
    base = seed * 100
    for name, tool in zip(i1.SETS.values(), ("none", "stick"), strict=True):
        experiment.take_tool(TOOLS[tool])
        experiment.babble(name, sizes["tests"], base + 11, learn=False)
    for number, (phase, tool, cubes) in enumerate(_ORDER, start=1):
        experiment.take_tool(TOOLS[tool])
        if phase:
            experiment.babble(phase, sizes["samples"], base + number, learn=True)
        for name in cubes:
            _cube(experiment, sizes, name, tool, learn=False)
        if phase == "phase1":
            _new_stick(experiment, sizes)


def _new_stick(experiment: Experiment, sizes: dict) -> None:
    """Learning while reaching, and then all of that forgotten."""
    experiment.save(MODEL)
    experiment.take_tool(TOOLS["stick"])
    for name in _NEW:
        _cube(experiment, sizes, name, "stick", learn=True)
    experiment.load(MODEL)


def _cube(experiment: Experiment, sizes: dict, name: str, tool: str, learn: bool) -> None:
    middle = MIDDLES[tool]
    wanted = np.vstack([i2.start(middle), i2.targets(middle)])
    experiment.reach_for(f"cube_{name}", wanted, sizes["cube_seconds"], learn)


def analyse(record: Record, run: dict, folder: Path) -> dict[str, float]:
    return i1.measure(record, run, folder) | i2.measure(record, run, folder)


def rows(learners: tuple[str, ...]) -> list[Row]:
    """The learner of I1 is always named."""
    return [
        *(row for name in learners for row in of_learner(i1.rows(), name, always=True)),
        *(row for name in learners for row in of_learner(i2.rows(), name)),
    ]


def figures(experiments: tuple[str, ...]) -> list[Shown]:
    shown = draw_icub.FIGURES
    return [f for f in shown if ("I1" if f.number == "5" else "I2") in experiments]
