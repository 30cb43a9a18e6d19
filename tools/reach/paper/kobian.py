"""The Kobian-like robot: one run serves K1 to K4, sections 7.1 to 7.3 of the paper."""

from pathlib import Path

import numpy as np

from .. import metrics
from ..demo import BABBLE_SECONDS
from ..experiment import Experiment
from ..programs import OURS, ROOT
from ..record import Record
from . import draw_babbling, draw_reaching, k1, k2, k3, k4, replay, track
from .drawing import Shown
from .rows import Row, of_learner

NAME = "kobian"
EXPERIMENTS = ("K1", "K2", "K3", "K4")
PARTS = (k1, k2, k3, k4)
TUBE = 1  # the simulator's first tool
PREPARE_SECONDS = 4.0  # robot time before the first target, about; for the time left

# Sizes: samples with hand, tool, hand; tests each time; seconds for each target of K2 and K3.
_FULL = {"hand": 500, "tool": 500, "again": 300, "tests": 100, "turn_seconds": 2.0,
         "star_seconds": 4.0}  # fmt: skip
_QUICK = {"hand": 30, "tool": 10, "again": 5, "tests": 4, "turn_seconds": 1.15,
          "star_seconds": 2.0}  # fmt: skip
_QUICK_RIVAL = {"hand": 6, "tool": 6, "again": 1, "tests": 2, "turn_seconds": 1.15,
                "star_seconds": 0.6}  # fmt: skip


def settings(quick: bool, learner: str) -> dict:
    if not quick:
        return _FULL
    return _QUICK if learner == OURS else _QUICK_RIVAL


def overlays(learner: str) -> list[Path]:
    return replay.overlays(replay.KOBIAN, learner)


def configurations() -> list[Path]:
    """What the run depends on besides the learner's overlay."""
    etc = ROOT / "etc"
    return [etc / "kobian.yaml", etc / "vision-kobian.yaml", etc / "simrobot-kobian.yaml",
            etc / "robots/kobian.urdf"]  # fmt: skip


def programs(folder: Path) -> dict:
    """Options of programs.start()."""
    return {"robot": NAME}


def weights(sizes: dict) -> dict[str, float]:
    """Robot seconds of each phase."""
    targets = len(track.LEAD_IN) + len(metrics.star_targets())
    coordinate = PREPARE_SECONDS + targets * sizes["turn_seconds"]
    star = PREPARE_SECONDS + targets * sizes["star_seconds"]
    samples = {"learn_hand": sizes["hand"], "learn_tool": sizes["tool"],
               "learn_again": sizes["again"]}  # fmt: skip
    samples |= {name: sizes["tests"] for name in k1.TESTS} | {"look_hand": 1, "look_tool": 1}
    seconds = {name: count * BABBLE_SECONDS for name, count in samples.items()}
    for ball in ("hand", "tool"):
        seconds |= {f"frozen_{ball}": coordinate, f"coordinate_{ball}": coordinate}
        seconds[f"star_{ball}"] = star
    return seconds


def perform(experiment: Experiment, sizes: dict, seed: int) -> None:
    """Babbling seeds differ between phases and runs; each test set is the same all through."""
    base = seed * 100
    tests = {"hand": base + 11, "tool": base + 12}

    def test(name: str, ball: str) -> None:
        experiment.babble(name, sizes["tests"], tests[ball], learn=False)

    def hold(tool: int, ball: str) -> None:
        """The daemon is not told; it sees what it holds at its first fixation, once, untested."""
        experiment.take_tool(tool)
        experiment.babble(f"look_{ball}", 1, base + 13, learn=False)

    experiment.babble("learn_hand", sizes["hand"], base + 1, learn=True)
    test("test_hand_500", "hand")
    experiment.take_tool(TUBE)
    experiment.babble("learn_tool", sizes["tool"], base + 2, learn=True)
    test("test_tool_1000", "tool")
    hold(0, "hand")
    test("test_hand_1000", "hand")
    experiment.babble("learn_again", sizes["again"], base + 3, learn=True)
    test("test_hand_1300", "hand")
    _reach(experiment, sizes, "hand")
    hold(TUBE, "tool")
    test("test_tool_1300", "tool")
    _reach(experiment, sizes, "tool")


def _reach(experiment: Experiment, sizes: dict, ball: str) -> None:
    """K2 with the model frozen and learning, then K3."""
    turns = np.vstack([track.LEAD_IN, metrics.coordination_targets()])
    experiment.coordinate(f"frozen_{ball}", turns, sizes["turn_seconds"], learn=False)
    experiment.coordinate(f"coordinate_{ball}", turns, sizes["turn_seconds"], learn=True)
    experiment.star(f"star_{ball}", track.star(), sizes["star_seconds"])


def analyse(record: Record, run: dict, folder: Path) -> dict[str, float]:
    """The numbers of the table; the series go into the folder."""
    numbers = {}
    for part in PARTS:
        numbers |= part.measure(record, run, folder)
    return numbers


def rows(learners: tuple[str, ...]) -> list[Row]:
    return [
        row for part in PARTS for learner in learners for row in of_learner(part.rows(), learner)
    ]


def figures(experiments: tuple[str, ...]) -> list[Shown]:
    """Those of these experiments."""
    wanted = {"K1": ("14", "15", "16"), "K2": ("17", "18", "19", "20"),
              "K3": ("21", "22", "23", "24", "25", "26"), "K4": ("27",)}  # fmt: skip
    numbers = {number for name in experiments for number in wanted.get(name, ())}
    shown = [*draw_babbling.FIGURES, *draw_reaching.FIGURES]
    return [figure for figure in shown if figure.number in numbers]
