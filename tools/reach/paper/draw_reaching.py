"""Figures 17 to 27."""

import numpy as np

from .. import figures, metrics
from ..figures import canvas
from . import series
from .drawing import COLOURS, MEASURED, Data, Shown, legend

_ARM = ("shoulder pitch", "shoulder yaw", "shoulder roll", "elbow")
_HEAD = ("neck yaw", "neck pitch")
_IMAGE = ("u", "v", "disparity")


def coordination_error(ball: str):
    def draw(data: Data):
        figure, axes = canvas()
        axis = axes[0, 0]
        for name, colour, label in ((f"k2_{ball}_measured", MEASURED, "measured by vision"),
                                    (f"k2_{ball}", COLOURS[ball], "true")):  # fmt: skip
            rows = data.first(name)
            axis.plot(rows["t"], np.linalg.norm(series.wide(rows, "x"), axis=1), color=colour,
                      label=label, lw=1.0)  # fmt: skip
        axis.axhline({"hand": 3.0, "tool": 6.0}[ball], color="#777777", ls="--", lw=1,
                     label="the paper's largest, measured")  # fmt: skip
        axis.set(xlabel="time, s", ylabel="error norm, px", ylim=(0, None))
        legend(figure, axis)
        return figure

    return draw


def _joints(name: str, which: slice, words: tuple[str, ...]):
    def draw(data: Data):
        figure, axes = canvas(height=3.4)
        rows = data.first(name)
        angles = series.wide(rows, "q")[:, which].T
        for number, (angle, joint) in enumerate(zip(angles, words, strict=True)):
            axes[0, 0].plot(rows["t"], angle, label=joint, **figures.series(number))
        axes[0, 0].set(xlabel="time, s", ylabel="joint angle, deg")
        legend(figure, axes[0, 0])
        return figure

    return draw


def star(ball: str):
    def draw(data: Data):
        figure, axes = canvas(height=5.6)
        axis, targets = axes[0, 0], metrics.star_targets()
        seen = series.wide(data.first(f"k3_{ball}_measured"), "x")
        true = series.wide(data.first(f"k3_{ball}"), "x")
        axis.plot(seen[:, 0], seen[:, 1], ".", color=MEASURED, ms=2.5, label="measured by vision")
        axis.plot(true[:, 0], true[:, 1], color=COLOURS[ball], label="true")
        axis.plot(targets[:, 0], targets[:, 1], "k+", ms=11, mew=1.3, label="targets")
        axis.set(
            xlabel="u, px (right image)", ylabel="v, px (down)", xlim=(-65, 65), ylim=(65, -65)
        )
        axis.set_aspect("equal")
        legend(figure, axis)
        return figure

    return draw


def star_series(ball: str):
    def draw(data: Data):
        figure, axes = canvas(height=3.4)
        rows = data.first(f"k3_{ball}")
        columns = series.wide(rows, "x").T
        for number, (column, name) in enumerate(zip(columns, _IMAGE, strict=True)):
            axes[0, 0].plot(rows["t"], column, label=name, **figures.series(number))
        axes[0, 0].set(xlabel="time, s", ylabel="true position, px", ylim=(-65, 65))
        legend(figure, axes[0, 0])
        return figure

    return draw


def head_estimate(data: Data):
    figure, axes = canvas(3, 2, 6.6, sharex=True, sharey="row")
    for column, (name, title) in enumerate((("daemon_", "corrected at each fixation"),
                                            ("alone_", "equation 14 alone"))):  # fmt: skip
        rows = data.first(f"k4_{name}head")
        head, estimate = series.wide(rows, "head"), series.wide(rows, "estimate")
        for i, joint in enumerate(("yaw", "pitch")):
            axis = axes[i, column]
            axis.plot(rows["t"], head[:, i], label="true head", **figures.series(0))
            axis.plot(rows["t"], estimate[:, i], label="estimate", **figures.series(2))
            axes[i, 0].set_ylabel(f"{joint}, deg")
        error = np.linalg.norm(head - estimate, axis=1)
        axes[2, column].plot(rows["t"], error, color="#444444", lw=1)
        axes[2, column].axhline(0.27, color="#777777", ls="--", lw=1)
        axes[2, column].set(xlabel="time, s", ylim=(0, None))
        axes[0, column].set_title(title)
    axes[2, 0].set_ylabel("error, deg")
    legend(figure, axes[0, 0])
    return figure


def _error_rows(ball: str) -> tuple[str, ...]:
    return tuple(f"K2.{ball}{kind}" for kind in (".median_px", ".p95_px", ".max_px",
                 ".measured_median_px", ".measured_max_px", "_frozen.p95_px",
                 "_frozen.max_px"))  # fmt: skip


def _star_rows(ball: str) -> tuple[str, ...]:
    return tuple(f"K3.{ball}.{key}" for key in ("reached", "final_error_median_px",
                 "final_error_max_px", "straightness_median", "straightness_max",
                 "path_ratio_median"))  # fmt: skip


FIGURES = [
    *(Shown(number, f"Arm-head coordination, {ball}: error",
            "Norm of (u, v, disparity) of the ball while the head turns to a new target every 2 s,"
            " learning on. Dashed: the largest that the paper measured.", _error_rows(ball),
            (f"k2_{ball}", f"k2_{ball}_measured"), coordination_error(ball))
      for number, ball in (("17", "hand"), ("18", "tool"))),
    Shown("19", "Arm-head coordination, hand: head joints", "True angles.", (), ("k2_hand_joints",),
          _joints("k2_hand_joints", slice(4, 6), _HEAD)),
    Shown("20", "Arm-head coordination, hand: arm joints", "True angles.", (), ("k2_hand_joints",),
          _joints("k2_hand_joints", slice(0, 4), _ARM)),
    *(Shown(number, f"STAR, {ball}: the ball in the right image",
            "Eight ends, each followed by the centre, the head at rest. The true track is the"
            " simulator's.", _star_rows(ball), (f"k3_{ball}", f"k3_{ball}_measured"), star(ball))
      for number, ball in (("21", "hand"), ("22", "tool"))),
    Shown("23", "STAR, hand: image position", "u, v and disparity against time.",
          ("K3.hand.settling_median_s",), ("k3_hand",), star_series("hand")),
    Shown("24", "STAR, hand: arm joints", "True angles.", ("K3.hand.jerk_rms",),
          ("k3_hand_joints",), _joints("k3_hand_joints", slice(0, 4), _ARM)),
    Shown("25", "STAR, tool: image position", "u, v and disparity against time.",
          ("K3.tool.settling_median_s",), ("k3_tool",), star_series("tool")),
    Shown("26", "STAR, tool: arm joints", "True angles.", ("K3.tool.jerk_rms",),
          ("k3_tool_joints",), _joints("k3_tool_joints", slice(0, 4), _ARM)),
    Shown("27", "Estimated head motion",
          "Equation 14's estimate against the true head during coordination with the hand: as the"
          " daemon has it, and from the first fixation alone (model frozen). Dashed: the largest"
          " error in the paper.", ("K4.",), ("k4_daemon_head", "k4_alone_head"), head_estimate),
]  # fmt: skip
