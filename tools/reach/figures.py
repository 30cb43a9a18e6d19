"""The figures of the report; one style, readable in print and on the screen."""

import json
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from . import metrics, summary
from .programs import OURS
from .record import Record

# What is drawn has a lightness and a marker of its own, so that it is told apart in grey. Line
# styles are for quantiles.
COLOURS = {"hand": "#123f7a", "tool": "#e08214"}  # lightness 27 and 63 of 100
MARKERS = {"hand": "o", "tool": "^"}
LEARNERS = {
    OURS: {"color": "#0b2f5c", "marker": "o"},  # lightness 20
    "polynomial": {"color": "#a85a00", "marker": "s"},  # 46
    "linear": {"color": "#4fa877", "marker": "^"},  # 63
    "lwpr": {"color": "#e8a0a0", "marker": "D"},  # 74
}
_SERIES = (("#0b2f5c", "o"), ("#a85a00", "s"), ("#4fa877", "^"),
           ("#d0669c", "D"), ("#7a7a7a", "v"), ("#c8b400", "x"))  # fmt: skip
PAPER = "#777777"
COMPONENTS = ("yaw, deg", "pitch, deg", "disparity, px")
JOINTS = ("shoulder pitch", "shoulder yaw", "shoulder roll", "elbow", "neck yaw", "neck pitch")
WINDOWS = 3, 10  # samples of the running error: a tenth of a phase's, within these bounds
SPARSE = {"markevery": 0.09, "markersize": 4}  # markers of curves with many points: of the diagonal
STYLE = {
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "lines.linewidth": 1.3,
    "axes.formatter.min_exponent": 4,  # 0.1 and 100, not powers of ten
    "svg.hashsalt": "reach",
}
matplotlib.rcParams.update(STYLE)


def series(number: int) -> dict:
    """How the curve of this number is drawn where some share an axis, as joints do."""
    colour, marker = _SERIES[number % len(_SERIES)]
    return {"color": colour, "marker": marker, **SPARSE}


def canvas(rows: int = 1, columns: int = 1, height: float = 3.2, **options):
    figure = Figure(figsize=(9.0, height), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def _eye(axis, folder: Path, name: str, side: str) -> None:
    """One picture, and the ball where vision found it."""
    found = json.loads((folder / f"{name}.json").read_text())
    picture = matplotlib.image.imread(folder / f"{name}-{side}.png")
    height, width = picture.shape[:2]
    axis.imshow(picture, extent=(-width / 2, width / 2, height / 2, -height / 2))
    axis.set(title=f"{side} eye, {name}", xlabel="u, px", ylabel="v, px")
    axis.grid(visible=False)
    if found["seen"]:
        place = (found["u_right"] + (found["disparity"] if side == "left" else 0), found["v_right"])
        axis.add_patch(Circle(place, found["radius"], fill=False, color="#ffffff", lw=1.6))
        axis.plot(*place, "+", color="#ff2fd0", markersize=9)


def _names(folder: Path) -> list[str]:
    return [name for name in ("hand", "tool") if (folder / f"{name}.json").exists()]


def eyes(folder: Path) -> Figure | None:
    """Both eyes, with the hand and with the tool."""
    names = _names(folder)
    if not names:
        return None
    figure, axes = canvas(len(names), 2, 3.4 * len(names))
    for row, name in zip(axes, names, strict=True):
        for axis, side in zip(row, ("left", "right"), strict=True):
            _eye(axis, folder, name, side)
    return figure


def result(record: Record, run: dict, folder: Path) -> Figure | None:
    """The run in one picture: what the right eye saw, and the STARs."""
    names = _names(folder)
    if len(names) < 2:
        return None
    figure, axes = canvas(2, 2, 7.6, height_ratios=(3.2, 4.2))
    for column, name in enumerate(names):
        _eye(axes[0, column], folder, name, "right")
        _star(axes[1, column], record, run, name)
    return figure


def window(samples: int) -> int:
    return int(np.clip(samples // 10, *WINDOWS))


def learning(record: Record, run: dict, result: dict) -> Figure:
    """Errors of predictions made before each sample was learned, and those of the test sets."""
    figure, axes = canvas(3, 1, 6.6, sharex=True)
    first = 0
    for name in ("hand", "tool"):
        rows = summary.samples_of(record, summary.phase_named(run, f"learn_{name}"))
        error = metrics.to_people(rows["x_predicted"]) - metrics.to_people(rows["x"])
        last = first + len(rows)
        numbers = np.arange(first + 1, last + 1)
        running = metrics.running_rms(error, window(len(rows)))
        for component, axis in enumerate(axes[:, 0]):
            colour = COLOURS[name]
            axis.plot(numbers, np.abs(error[:, component]), MARKERS[name], color=colour,
                      alpha=0.35, ms=3, mew=0)  # fmt: skip
            axis.plot(numbers, running[:, component], color=colour, marker=MARKERS[name],
                      label=f"{name}, learning", **SPARSE)  # fmt: skip
            axis.plot(last, result["babbling"][name]["rmse"][component], "D", color=colour, ms=7,
                      mec="#222222", label=f"{name}, test set")  # fmt: skip
            axis.plot([first, last], [metrics.PAPER_RMSE_PCT[name][component] / 100
                      * result["babbling"]["range"][component]] * 2, "--", color=PAPER,
                      label="the paper's percentage" if name == "hand" else None)  # fmt: skip
        first = last
    for axis, component in zip(axes[:, 0], COMPONENTS, strict=True):
        axis.set(ylabel=f"error of {component}", yscale="log")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=5, loc="outside upper center")
    axes[2, 0].set_xlabel("training samples")
    return figure


def _star(axis, record: Record, run: dict, name: str) -> None:
    targets = metrics.star_targets()
    segments = summary.star_segments(record, summary.phase_named(run, f"star_{name}"))
    start, end = segments[0][0], segments[-1][1]
    marker = record.between("MARKER", start, end)
    marker = marker[marker["seen"] == 1]
    _, track = summary.true_track(record, start, end)
    axis.plot(marker["u_right"], marker["v_right"], ".", color="#b5b5b5", ms=2.5,
              label="measured by vision")  # fmt: skip
    axis.plot(track[:, 0], track[:, 1], color=COLOURS[name], label="true")
    axis.plot(targets[:, 0], targets[:, 1], "k+", ms=11, mew=1.4, label="targets")
    axis.set(title=f"STAR, {name}", xlabel="u, px", ylabel="v, px", xlim=(-65, 65), ylim=(65, -65))
    axis.set_aspect("equal")


def stars(record: Record, run: dict) -> Figure:
    """The ball in the right image during both STARs."""
    figure, axes = canvas(1, 2, 4.7, sharex=True, sharey=True)
    for axis, name in zip(axes[0], ("hand", "tool"), strict=True):
        _star(axis, record, run, name)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=3, loc="outside upper center")
    return figure


def star_series(record: Record, run: dict) -> Figure:
    """Error to the target and joints against time, both STARs."""
    figure, axes = canvas(2, 2, 5.4, sharex="col", sharey="row")
    targets = metrics.star_targets()
    for column, name in enumerate(("hand", "tool")):
        segments = summary.star_segments(record, summary.phase_named(run, f"star_{name}"))
        begin = segments[0][0]
        for target, (start, end) in zip(targets, segments, strict=False):
            times, track = summary.true_track(record, start, end)
            error = np.linalg.norm(track - target, axis=1)
            axes[0, column].plot((times - begin) * 1e-6, error, color=COLOURS[name])
        rows = record.between("ROBOT_STATE", begin, segments[-1][1])
        angles = np.degrees(rows["position"][:, : len(JOINTS)])
        for number, (angle, joint) in enumerate(zip(angles.T, JOINTS, strict=True)):
            axes[1, column].plot((rows["utime"] - begin) * 1e-6, angle - angle[0], label=joint,
                                 **series(number))  # fmt: skip
        axes[0, column].set(title=name, yscale="log")
        axes[0, column].axhline(5, color=PAPER, ls="--", lw=1)
        axes[1, column].set_xlabel("time, s")
    axes[0, 0].set_ylabel("true error, px")
    axes[1, 0].set_ylabel("joints from their start, deg")
    figure.legend(*axes[1, 1].get_legend_handles_labels(), ncols=6, loc="outside lower center")
    return figure


def times(record: Record) -> Figure:
    """How long ticks and stereo pairs took."""
    figure, axes = canvas(1, 2, 2.9)
    shown = (("a tick of the daemon", record["REACH_STATUS"]["compute_us"]),
             ("a stereo pair in vision", record["MARKER"]["compute_us"]))  # fmt: skip
    for axis, (title, values) in zip(axes[0], shown, strict=True):
        values = values[values > 0]
        if len(values):
            edges = np.geomspace(values.min() * 0.9, values.max() * 1.1, 60)
            axis.hist(values, edges, color="#5c5c5c")
        axis.set(title=title, xscale="log", yscale="log", xlabel="processor time, µs")
    axes[0, 0].set_ylabel("how often")
    return figure
