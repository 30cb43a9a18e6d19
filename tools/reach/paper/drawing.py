"""What the figures share: where the series are, colours, axes. The style is reach.figures'."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from .. import figures
from ..programs import OURS
from . import series

COLOURS = figures.COLOURS
MEASURED = "#b5b5b5"
LEARNERS = figures.LEARNERS
LEARNER_WORDS = {OURS: "ours", "polynomial": "polynomials", "linear": "IMLE as published",
                 "lwpr": "LWPR"}  # fmt: skip


@dataclass
class Data:
    """Folders of series of the complete runs, by learner, in the order of seeds. Figures of one run
    are of the first seed."""

    folders: dict[str, list[Path]] = field(default_factory=dict)

    def has(self, learner: str) -> bool:
        return bool(self.folders.get(learner))

    def first(self, name: str, learner: str = OURS) -> dict[str, np.ndarray]:
        return series.read(self.path(name, learner))

    def path(self, name: str, learner: str = OURS) -> Path:
        return self.folders[learner][0] / f"{name}.csv"

    def all(self, name: str, learner: str = OURS) -> list[dict[str, np.ndarray]]:
        """Of every seed that has it."""
        paths = [folder / f"{name}.csv" for folder in self.folders.get(learner, [])]
        return [series.read(path) for path in paths if path.exists()]


@dataclass(frozen=True)
class Shown:
    """A figure of the report. `number` is the paper's; `rows`: beginnings of the ids of the rows
    beside it; `series`: names of its CSV files."""

    number: str
    title: str
    caption: str
    rows: tuple[str, ...]
    series: tuple[str, ...]
    draw: Callable[[Data], Figure]
    learner: str = OURS  # without whose runs it cannot be drawn


def legend(figure, axis, columns: int = 5) -> None:
    """One for the whole figure, above it."""
    figure.legend(*axis.get_legend_handles_labels(), ncols=columns, loc="outside upper center")


def band(axis, x: np.ndarray, curves: np.ndarray, **options) -> None:
    """Mean over the rows of `curves`, and from least to largest about it."""
    axis.plot(x, np.nanmean(curves, axis=0), **(figures.SPARSE | options))
    if len(curves) > 1:
        low, high = np.nanmin(curves, axis=0), np.nanmax(curves, axis=0)
        axis.fill_between(x, low, high, color=options.get("color"), alpha=0.18, lw=0)
