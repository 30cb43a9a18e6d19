"""Figures 14 to 16."""

import numpy as np

from .. import metrics
from ..figures import canvas
from . import series
from .drawing import COLOURS, LEARNER_WORDS, LEARNERS, Data, Shown, band, legend

_JOINTS = ("shoulder pitch, deg", "shoulder yaw, deg", "shoulder roll, deg", "elbow, deg")
_PAPER_MEAN = {"hand": 2.79, "tool": 2.74}  # section 7.1: mean of [deg, deg, px] at sample 1000


def _scatter(axis, data: Data, name: str, x: int, y: int) -> None:
    for ball in ("hand", "tool"):
        for kind, marker, size in (("train", ".", 3), ("test", "x", 4)):
            rows = series.wide(data.first(f"k1_{kind}_{ball}"), name)
            axis.plot(rows[:, x], rows[:, y], marker, color=COLOURS[ball], ms=size, mew=0.7,
                      label=f"{ball}, {'training' if kind == 'train' else 'test'}")  # fmt: skip


def arm(data: Data):
    figure, axes = canvas(1, 2, 4.2)
    for axis, (x, y) in zip(axes[0], ((0, 1), (2, 3)), strict=True):
        _scatter(axis, data, "q", x, y)
        axis.set(xlabel=_JOINTS[x], ylabel=_JOINTS[y])
    legend(figure, axes[0, 0])
    return figure


def head(data: Data):
    figure, axes = canvas(1, 1, 4.2)
    _scatter(axes[0, 0], data, "x", 0, 1)
    axes[0, 0].set(xlabel="head yaw, deg (positive left)", ylabel="head pitch, deg (positive down)")
    legend(figure, axes[0, 0])
    return figure


def _switching(curve: dict, parts: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """Counts and errors of the test set that belongs to the tool in the hand."""
    counts = curve["samples"]
    s1, s2 = series.wide(curve, "s1"), series.wide(curve, "s2")
    with_tool = (counts > parts[0]) & (counts <= parts[1])
    return counts, np.where(with_tool[:, None], s2, s1)


def _borders(data: Data) -> list[int]:
    live = data.first("k1_live_hand")
    return [int(n) for n in live["samples"]]


def errors(data: Data):
    """Left the paper's axis, a mean over units; right the same in percent of range."""
    figure, axes = canvas(2, 1, 6.4, sharex=True)
    borders = _borders(data)
    tests = [series.wide(data.first(f"k1_test_{ball}"), "x") for ball in ("hand", "tool")]
    scale = 100 / metrics.union_range(*tests)
    for learner, style in LEARNERS.items():
        curves = [_switching(curve, borders) for curve in data.all(f"k1_curve_{learner}")]
        if curves:
            counts = curves[0][0]
            for axis, factor in ((axes[0, 0], np.ones(3)), (axes[1, 0], scale)):
                means = np.array([(rows * factor).mean(axis=1) for _, rows in curves])
                band(axis, counts, means, label=LEARNER_WORDS[learner], **style)
    for ball in ("hand", "tool"):
        live = data.first(f"k1_live_{ball}")
        for kind, marker in (("true", "D"), ("measured", "o")):
            rows = series.wide(live, kind)
            for axis, factor in ((axes[0, 0], np.ones(3)), (axes[1, 0], scale)):
                axis.plot(live["samples"], (rows * factor).mean(axis=1), marker, ms=5, mfc="none",
                          color=COLOURS[ball], label=f"live, {ball}, {kind}")  # fmt: skip
    _paper(axes, borders)
    for axis in axes[:, 0]:
        for border in borders[:2]:
            axis.axvline(border, color="#999999", lw=0.8, ls=":")
    axes[0, 0].set(yscale="log", ylabel="RMSE, mean of [deg deg px]")
    axes[1, 0].set(yscale="log", ylabel="RMSE, mean, % of range", xlabel="training samples")
    legend(figure, axes[0, 0], 4)
    return figure


def _paper(axes, borders: list[int]) -> None:
    at = borders[1]
    for ball, mean in _PAPER_MEAN.items():
        pct = float(np.mean(metrics.PAPER_RMSE_PCT[ball]))
        label = "the paper's at sample 1000" if ball == "hand" else None
        axes[0, 0].plot(at, mean, "*", color="#222222", ms=9, label=label)
        axes[1, 0].plot(at, pct, "*", color="#222222", ms=9)


FIGURES = [
    Shown("14", "Arm joints during babbling",
          "Model inputs. Dots: training samples; crosses: test samples.", (),
          ("k1_train_hand", "k1_train_tool", "k1_test_hand", "k1_test_tool"), arm),
    Shown("15", "Head joints during babbling",
          "Two of the model's outputs: the same arm postures, with hand and tool, are seen with"
          " different heads.", (), ("k1_train_hand", "k1_train_tool"), head),
    Shown("16", "Errors of the forward model",
          "Test sets against the truth, the set changing with the tool in the hand. Lines: the"
          " recorded samples learned once more by each learner (mean and range over seeds),"
          " solution closest to the truth. Diamonds and circles: the robot visiting the test"
          " configurations, with the prediction that the daemon acts on, against the truth and"
          " against what was measured. The paper's mean over degrees and pixels is kept above for"
          " comparison; percent of range compare across cameras.",
          ("K1.s1.yaw_pct", "K1.s1.pitch_pct", "K1.s1.disparity_pct", "K1.s2.yaw_pct",
           "K1.s2.pitch_pct", "K1.s2.disparity_pct", "K1.s1.yaw_noise_pct",
           "K1.s1.pitch_noise_pct", "K1.s1.disparity_noise_pct", "K1.s1.yaw_measured_pct",
           "K1.s1.pitch_measured_pct", "K1.s1.disparity_measured_pct", "K1.s1.change_pct",
           "K1.tool.samples_to_2x"),
          (*(f"k1_curve_{name}" for name in LEARNERS), "k1_live_hand", "k1_live_tool"),
          errors),
]  # fmt: skip
