"""E1, E2: reaching from nothing, by goals of the robot's own and without babbling."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import metrics, summary
from ..experiment import Experiment
from ..record import Record
from . import icub, k3, kobian, replay, track
from .drawing import Shown
from .rows import Row, of_learner

SAMPLES = 2000
MIDDLE = np.array([0.26, -0.15, 0.62])  # of the box that the iCub-like robot's hand draws, m


@dataclass(frozen=True)
class Explore:
    """Explores, then reaches for 16 targets with what it knows; a group of runs like kobian."""

    robot: str
    experiment: str
    unit: str
    per_unit: float  # people's units in one of the track's
    within: float  # of a target counts as reached; unit
    seconds: float  # robot time of a sample, about, times the pace at which it passes

    @property
    def NAME(self) -> str:  # noqa: N802 - what other groups have as a constant
        return f"explore-{self.robot}"

    @property
    def EXPERIMENTS(self) -> tuple[str, ...]:  # noqa: N802
        return (self.experiment,)

    def settings(self, quick: bool, learner: str) -> dict:
        return {"samples": SAMPLES // 4 if quick else SAMPLES,
                "seconds": 2.0 if quick else 4.0}  # fmt: skip

    def overlays(self, learner: str) -> list[Path]:
        return replay.overlays(replay.ICUB if self.robot == "icub" else replay.KOBIAN, learner)

    def configurations(self) -> list[Path]:
        group = icub if self.robot == "icub" else kobian
        return group.configurations()

    def programs(self, folder: Path) -> dict:
        return {"robot": self.robot}

    def weights(self, sizes: dict) -> dict[str, float]:
        return {"explore": sizes["samples"] * self.seconds, "reach": 17 * sizes["seconds"]}

    def targets(self) -> np.ndarray:
        """After a first one that does not count."""
        if self.robot == "icub":
            return np.vstack([icub.i2.start(MIDDLE), icub.i2.targets(MIDDLE)])
        return np.vstack([track.LEAD_IN, metrics.star_targets()])

    def perform(self, experiment: Experiment, sizes: dict, seed: int) -> None:
        experiment.explore("explore", sizes["samples"], seed * 100 + 21)
        if self.robot == "icub":
            experiment.reach_for("reach", self.targets(), sizes["seconds"], learn=False)
        else:
            experiment.star("reach", self.targets(), sizes["seconds"])

    def analyse(self, record: Record, run: dict, folder: Path) -> dict[str, float]:
        phase = summary.phase_named(run, "reach")
        wanted = self.targets()[1:]
        true = icub.i2.true_track if self.robot == "icub" else summary.true_track
        tracks = [true(record, *segment) for segment in track.segments(record, phase)]
        within = self.within / self.per_unit
        numbers = k3.lines(tracks, wanted, within, within)
        name = self.experiment
        return {
            f"{name}.reached_pct": 100 * numbers["reached"] / len(wanted),
            f"{name}.final_error_median_{self.unit}": self.per_unit * numbers["final_error_median"],
            f"{name}.final_error_max_{self.unit}": self.per_unit * numbers["final_error_max"],
            f"{name}.seconds": (run["phases"][0]["end"] - run["phases"][0]["start"]) * 1e-6,
        }

    def rows(self, learners: tuple[str, ...]) -> list[Row]:
        where = f"from nothing, {SAMPLES:,} samples, {self.robot}"
        name, unit = self.experiment, self.unit
        own = [
            Row(f"{name}.reached_pct", f"targets within {self.within:g} {unit}, {where}", "%", None,
                90, at_least=True),
            Row(f"{name}.final_error_median_{unit}", f"final error, median, {where}", unit),
            Row(f"{name}.final_error_max_{unit}", f"final error, worst, {where}", unit),
            Row(f"{name}.seconds", f"the robot's time that exploring took, {where}", "s"),
        ]  # fmt: skip
        return [row for learner in learners for row in of_learner(own, learner)]

    def figures(self, experiments: tuple[str, ...]) -> list[Shown]:
        """The paper has none."""
        return []


ICUB = Explore("icub", "E1", "mm", 1e3, 10.0, 0.002)
KOBIAN = Explore("kobian", "E2", "px", 1.0, 5.0, 0.06)
