"""E1, E2: reaching from nothing, by goals of the robot's own, beside babbling.

After each number of samples the model rests and reaches for 16 targets. Each exploration begins
with an empty model; babbling, which has no state but the model, goes on from number to number.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import summary
from ..experiment import Experiment
from ..programs import OURS
from ..record import Record
from . import draw_explore, icub, kobian, replay, series, track
from .drawing import Shown
from .rows import Row, of_learner

MIDDLE = np.array([0.26, -0.15, 0.62])  # of the box that the iCub-like robot's hand draws, m
EMPTY = 1  # number of the model that knows nothing
KINDS = ("explored", "babbled")


@dataclass(frozen=True, eq=False)
class Explore:
    """A group of runs like kobian."""

    robot: str
    experiment: str
    unit: str
    per_unit: float  # people's units in one of the track's
    within: float  # of a target counts as reached; unit
    seconds: tuple[float, float]  # of a sample, explored and babbled, about, times the pace
    full: dict
    quick: dict

    @property
    def NAME(self) -> str:  # noqa: N802 - what other groups have as a constant
        return f"explore-{self.robot}"

    @property
    def EXPERIMENTS(self) -> tuple[str, ...]:  # noqa: N802
        return (self.experiment,)

    def settings(self, quick: bool, learner: str) -> dict:
        """Numbers of samples after which it reaches, and seconds for each target."""
        sizes = self.quick if quick else self.full
        return sizes | ({"seconds": 0.5} if quick and learner != OURS else {})

    def overlays(self, learner: str) -> list[Path]:
        return replay.overlays(replay.ICUB if self.robot == "icub" else replay.KOBIAN, learner)

    def configurations(self) -> list[Path]:
        group = icub if self.robot == "icub" else kobian
        return group.configurations()

    def programs(self, folder: Path) -> dict:
        channels = {"channels": icub.CHANNELS} if self.robot == "icub" else {}
        return {"robot": self.robot, "configurations": [icub.model_folder(folder)], **channels}

    def weights(self, sizes: dict) -> dict[str, float]:
        result = {}
        for kind, seconds in zip(KINDS, self.seconds, strict=True):
            before = 0
            for count in sizes[kind]:
                result[f"{kind}_{count}"] = (count - before) * seconds
                result[f"reach_{kind}_{count}"] = 17 * sizes["seconds"] * self.seconds[0] * 25
                before = count if kind == "babbled" else 0
        return result

    def targets(self) -> np.ndarray:
        """After a first one that does not count."""
        if self.robot == "icub":
            return np.vstack([icub.i2.start(MIDDLE), icub.i2.targets(MIDDLE)])
        return track.star()

    def perform(self, experiment: Experiment, sizes: dict, seed: int) -> None:
        experiment.save(EMPTY)
        for number, count in enumerate(sizes["explored"]):
            experiment.load(EMPTY)
            experiment.explore(f"explored_{count}", count, seed * 100 + 21 + number)
            self._reach(experiment, sizes, f"explored_{count}")
        experiment.load(EMPTY)
        before = 0
        for number, count in enumerate(sizes["babbled"]):
            name = f"babbled_{count}"
            experiment.babble(name, count - before, seed * 100 + 31 + number, learn=True)
            self._reach(experiment, sizes, name)
            before = count

    def _reach(self, experiment: Experiment, sizes: dict, name: str) -> None:
        pursue = experiment.reach_for if self.robot == "icub" else experiment.star
        pursue(f"reach_{name}", self.targets(), sizes["seconds"], learn=False)

    def analyse(self, record: Record, run: dict, folder: Path) -> dict[str, float]:
        curves = {kind: self._curve(record, run, kind) for kind in KINDS}
        for kind, curve in curves.items():
            series.write(folder / f"{self.experiment}_{kind}.csv", **curve)
        explored, babbled = curves["explored"], curves["babbled"]
        at = int(np.flatnonzero(explored["samples"] == babbled["samples"][-1])[0])
        name, unit = self.experiment, self.unit
        return {
            f"{name}.reached_pct": explored["reached_pct"][-1],
            f"{name}.final_error_median_{unit}": explored["error_median"][-1],
            f"{name}.final_error_max_{unit}": explored["error_max"][-1],
            f"{name}.seconds": explored["seconds"][-1],
            **{f"{name}.{kind}.{key}": curve[column][index]
               for kind, curve, index in (("explored", explored, at), ("babbled", babbled, -1))
               for key, column in (("reached_pct", "reached_pct"), ("seconds", "seconds"),
                                   (f"final_error_median_{unit}", "error_median"))},
        }  # fmt: skip

    def _curve(self, record: Record, run: dict, kind: str) -> dict[str, np.ndarray]:
        """Share reached, errors and the robot's time spent learning, for each number of samples."""
        rows, seconds = [], 0.0
        for count in run["settings"][kind]:
            learned = summary.phase_named(run, f"{kind}_{count}")
            took = (learned["end"] - learned["start"]) * 1e-6
            seconds = took + (seconds if kind == "babbled" else 0)
            errors = self._errors(record, summary.phase_named(run, f"reach_{kind}_{count}"))
            rows.append((count, 100 * np.mean(errors <= self.within), np.median(errors),
                         errors.max(), seconds))  # fmt: skip
        names = ("samples", "reached_pct", "error_median", "error_max", "seconds")
        return dict(zip(names, np.array(rows).T, strict=True))

    def _errors(self, record: Record, phase: dict) -> np.ndarray:
        true = icub.i2.true_track if self.robot == "icub" else summary.true_track
        return self.per_unit * track.final_errors(record, phase, self.targets(), true)

    def rows(self, learners: tuple[str, ...]) -> list[Row]:
        name, unit, within = self.experiment, self.unit, f"{self.within:g} {self.unit}"
        last, both = self.full["explored"][-1], self.full["babbled"][-1]
        where = f"from nothing, {last:,} samples, {self.robot}"
        own = [
            Row(f"{name}.reached_pct", f"targets within {within}, {where}", "%", None, 90,
                at_least=True),
            Row(f"{name}.final_error_median_{unit}", f"final error, median, {where}", unit),
            Row(f"{name}.final_error_max_{unit}", f"final error, worst, {where}", unit),
            Row(f"{name}.seconds", f"the robot's time that exploring took, {where}", "s"),
        ]  # fmt: skip
        for kind in KINDS:
            where = f"{both:,} samples {kind}, {self.robot}"
            own += [
                Row(f"{name}.{kind}.reached_pct", f"targets within {within}, {where}", "%"),
                Row(f"{name}.{kind}.final_error_median_{unit}", f"final error, median, {where}",
                    unit),
                Row(f"{name}.{kind}.seconds", f"the robot's time that it took, {where}", "s"),
            ]  # fmt: skip
        return [row for learner in learners for row in of_learner(own, learner)]

    def figures(self, experiments: tuple[str, ...]) -> list[Shown]:
        """The paper has none of this."""
        return [draw_explore.shown(self.experiment, self.robot, self.unit, self.within)]


ICUB = Explore(
    "icub", "E1", "mm", 1e3, 10.0, (0.002, 0.002),
    full={"explored": [30, 60, 125, 500, 2000], "babbled": [30, 60, 125, 500, 2000],
          "seconds": 4.0},
    quick={"explored": [125, 500], "babbled": [125, 500], "seconds": 2.0},
)  # fmt: skip
# Babbling takes 1.7 s a sample here, exploring 0.04 s: its curve ends where all is reached.
KOBIAN = Explore(
    "kobian", "E2", "px", 1.0, 5.0, (0.04, 1.4),
    full={"explored": [10, 20, 50, 200, 2000], "babbled": [10, 20, 50, 200], "seconds": 3.0},
    quick={"explored": [10, 250], "babbled": [10], "seconds": 2.0},
)  # fmt: skip
