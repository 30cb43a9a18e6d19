"""E3: more babbling where reaching is poor: two runs with the same seed, one whose robot may
practise and one whose robot may not.

After a few babbled samples the Kobian-like robot's hand reaches for the STAR twice, learning. What
counts is the second round.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import summary
from ..demo import BABBLE_SECONDS
from ..experiment import Experiment
from ..programs import OURS, ROOT
from ..record import Record
from . import kobian, series, track
from .drawing import Shown
from .rows import Row, of_learner

WITHIN = 5.0  # px, of a target that counts as reached
ROUNDS = ("first", "second")


@dataclass(frozen=True, eq=False)
class Practice:
    """A group of runs like kobian."""

    word: str  # in the run's name and in the rows'
    allowed: bool

    EXPERIMENTS = ("E3",)
    LEARNERS = (OURS,)

    @property
    def NAME(self) -> str:  # noqa: N802 - what other groups have as a constant
        return f"practice-{self.word}"

    def settings(self, quick: bool, learner: str) -> dict:
        """Babbled samples, and seconds for each target."""
        return {"samples": 3, "seconds": 1.5 if quick else 3.0}

    def overlays(self, learner: str) -> list[Path]:
        return [ROOT / "etc/practice.yaml"] if self.allowed else []

    def configurations(self) -> list[Path]:
        return kobian.configurations()

    def programs(self, folder: Path) -> dict:
        return kobian.programs(folder)

    def weights(self, sizes: dict) -> dict[str, float]:
        star = kobian.PREPARE_SECONDS + len(track.star()) * sizes["seconds"]
        return {"babbled": sizes["samples"] * BABBLE_SECONDS, **dict.fromkeys(ROUNDS, star)}

    def perform(self, experiment: Experiment, sizes: dict, seed: int) -> None:
        experiment.babble("babbled", sizes["samples"], seed * 100 + 41, learn=True)
        for name in ROUNDS:
            experiment.star(name, track.star(), sizes["seconds"], learn=True)

    def analyse(self, record: Record, run: dict, folder: Path) -> dict[str, float]:
        targets, result = track.star(), {}
        for name in ROUNDS:
            phase = summary.phase_named(run, name)
            errors = track.final_errors(record, phase, targets, summary.true_track)
            series.write(folder / f"E3_{self.word}_{name}.csv", target=targets[1:], error=errors)
            result[f"E3.{self.word}.{name}_reached_pct"] = 100 * np.mean(errors <= WITHIN)
        end = record.between("REACH_STATUS", run["phases"][0]["start"], phase["end"])
        result[f"E3.{self.word}.samples"] = end["samples"][-1]
        result[f"E3.{self.word}.seconds"] = (end["utime"][-1] - end["utime"][0]) * 1e-6
        return result

    def rows(self, learners: tuple[str, ...]) -> list[Row]:
        start = f"E3.{self.word}"
        words = "more babbling where reaching is poor" if self.allowed else "no more babbling"
        own = [Row(f"{start}.{name}_reached_pct", f"targets within {WITHIN:g} px, {name} round,"
                   f" {words}", "%") for name in ROUNDS]  # fmt: skip
        own += [Row(f"{start}.samples", f"learned samples in the end, {words}", ""),
                Row(f"{start}.seconds", f"the robot's time, {words}", "s")]  # fmt: skip
        return [row for learner in learners for row in of_learner(own, learner)]

    def figures(self, experiments: tuple[str, ...]) -> list[Shown]:
        return []


WITH = Practice("with", True)
WITHOUT = Practice("without", False)
