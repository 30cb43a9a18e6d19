"""The picture: two panels, hand and tube, logarithmic axes; readable without colour."""

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.ticker import FuncFormatter

from .. import figures, metrics
from ..programs import OURS
from .study import HAND, LEARNERS, TUBE

WORDS = {OURS: "reachd, on the body that it finds", "polynomial": "reachd with polynomials",
         "linear": "IMLE as published", "lwpr": "LWPR"}  # fmt: skip
PANELS = (("hand", "hand", "samples with the hand", HAND),
          ("tube", "tool", "samples with a flexible tube, after those", TUBE))  # fmt: skip
PAPER_SAMPLES = 500  # of each, in the paper


def curve(draws: list[dict], learner: str, name: str) -> np.ndarray:
    """One row a draw."""
    return np.array([found[learner][name] for found in draws])


def _panel(axis, draws: list[dict], name: str, ball: str, label: str, counts) -> None:
    for learner in LEARNERS:
        rows = curve(draws, learner, name)
        style = figures.LEARNERS[learner]
        axis.plot(counts, rows.mean(axis=0), ms=4.5,
                  label=WORDS[learner], zorder=3 if learner == OURS else 2, **style)  # fmt: skip
        axis.fill_between(counts, rows.min(axis=0), rows.max(axis=0), color=style["color"],
                          alpha=0.13, lw=0)  # fmt: skip
    paper = float(np.mean(metrics.PAPER_RMSE_PCT[ball]))
    axis.plot(PAPER_SAMPLES, paper, "*", color="#111111", ms=11, label="the paper, a real robot")
    axis.set(xscale="log", yscale="log", xlabel=label)
    for which in (axis.xaxis, axis.yaxis):
        which.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def write(path: Path, draws: list[dict]) -> None:
    with matplotlib.rc_context({"svg.fonttype": "none", "font.family": "sans-serif"}):
        figure, axes = figures.canvas(1, 2, 4.2, sharey=True)
        for axis, panel in zip(axes[0], PANELS, strict=True):
            _panel(axis, draws, *panel)
        axes[0, 0].set_ylabel("error, % of the range of yaw, pitch, disparity")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=5,
                      loc="outside upper center", columnspacing=1.2)  # fmt: skip
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, metadata={"Date": None})
