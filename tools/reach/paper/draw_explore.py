"""Reaching from nothing beside babbling: success and error against samples."""

import numpy as np

from ..figures import COLOURS, MARKERS, canvas
from .drawing import Data, Shown, band, legend

_STYLES = {
    kind: {"color": COLOURS[ball], "marker": MARKERS[ball], "markersize": 4, "markevery": None}
    for kind, ball in (("explored", "hand"), ("babbled", "tool"))
}
_WORDS = {"explored": "goals of its own, nothing babbled", "babbled": "babbling"}


def shown(experiment: str, robot: str, unit: str, within: float) -> Shown:
    def draw(data: Data):
        figure, axes = canvas(1, 3, 3.4)
        for kind, style in _STYLES.items():
            curves = data.all(f"{experiment}_{kind}")
            if not curves:
                continue
            for axis, name in zip(axes[0], ("reached_pct", "error_median", "seconds"), strict=True):
                values = np.array([curve[name] for curve in curves])
                band(axis, curves[0]["samples"], values, label=_WORDS[kind], **style)
        labels = (f"targets within {within:g} {unit}, %", f"final error, median, {unit}",
                  "the robot's time, s")  # fmt: skip
        for axis, label in zip(axes[0], labels, strict=True):
            axis.set(xlabel="learned samples", ylabel=label, xscale="log")
        axes[0, 0].set_ylim(-3, 103)
        for axis in axes[0, 1:]:
            if any((line.get_ydata() > 0).any() for line in axis.lines):  # else there is no scale
                axis.set_yscale("log")
        legend(figure, axes[0, 0])
        return figure

    return Shown(
        experiment, f"reaching from nothing, {robot}",
        "Not in the paper. After each number of samples the model rests and the robot reaches for"
        " 16 targets; mean, and least to largest over seeds.",
        (f"{experiment}.",), tuple(f"{experiment}_{kind}" for kind in _STYLES), draw,
    )  # fmt: skip
