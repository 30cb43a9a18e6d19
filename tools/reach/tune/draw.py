"""The figures of the page."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from ..figures import COLOURS, MARKERS, PAPER, canvas
from .data import Samples
from .rivals import Rival
from .trial import Bench, Measured

_BINS = 12
OURS = COLOURS["hand"]
_BEFORE, _PROPOSED = ({"color": COLOURS[ball], "marker": MARKERS[ball], "ms": 4}
                      for ball in ("tool", "hand"))  # fmt: skip
_DASHES = ("-", "--", ":")


def curve(found: Measured, before: Measured, rivals: list[Rival], bench: Bench) -> Figure:
    """Median error of held-out rows against the samples that were learned."""
    figure, axes = canvas(1, 1, 3.6)
    axis = axes[0, 0]
    for measured, name, shown in ((before, "before", _BEFORE), (found, "proposed", _PROPOSED)):
        points = [(n, result["test"]["held-out"]) for n, result in measured.results.items()]
        for kind, style in (("closest", "-"), ("strongest", "--")):
            medians = [test[kind]["median"] or np.nan for _, test in points]
            axis.plot([n for n, _ in points], medians, style, label=f"{name}, {kind}", **shown)
    for rival, dashes in zip(rivals, _DASHES, strict=False):
        axis.axhline(np.median(bench.distance(rival.predicted)), color=PAPER, ls=dashes,
                     label=rival.name)  # fmt: skip
    axis.set(xscale="log", yscale="log", xlabel="samples learned", ylabel="median error")
    figure.legend(*axis.get_legend_handles_labels(), ncols=4, loc="outside upper center")
    return figure


def residuals(distance: np.ndarray, test: Samples) -> Figure:
    """Errors against each input: where a joint is badly known."""
    columns = min(4, test.inputs)
    rows = -(-test.inputs // columns)
    figure, axes = canvas(rows, columns, 2.3 * rows, sharey=True)
    for i, axis in enumerate(axes.flat):
        if i >= test.inputs:
            axis.set_visible(False)
            continue
        _one_input(axis, test.z[:, i], distance)
        axis.set(yscale="log", xlabel=test.names[i])
    for row in axes:
        row[0].set_ylabel("error")
    return figure


def _one_input(axis, values: np.ndarray, distance: np.ndarray) -> None:
    axis.plot(values, distance, ".", color="#b5b5b5", ms=2)
    edges = np.unique(np.quantile(values, np.linspace(0, 1, _BINS + 1)))
    if len(edges) < 3:
        return
    inside = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)
    bins = [distance[inside == b] for b in range(len(edges) - 1)]
    middles = (edges[:-1] + edges[1:]) / 2
    for share, style in ((0.5, "-"), (0.95, "--")):
        heights = [np.nanquantile(part, share) if len(part) else np.nan for part in bins]
        axis.plot(middles, heights, style, color=OURS)


def branches(found: Measured, before: Measured) -> Figure:
    """How many experts there are, and how many solutions a posture has."""
    figure, axes = canvas(1, 2, 2.9)
    for measured, name, shown in ((before, "before", _BEFORE), (found, "proposed", _PROPOSED)):
        n = list(measured.results)
        experts = [result["experts"] for result in measured.results.values()]
        solutions = [
            result["test"]["held-out"]["solutions"] for result in measured.results.values()
        ]
        for axis, values in zip(axes[0], (experts, solutions), strict=True):
            axis.plot(n, values, label=name, **shown)
    for axis, what in zip(axes[0], ("experts", "solutions of a posture, mean"), strict=True):
        axis.set(xscale="log", xlabel="samples learned", ylabel=what)
        axis.set_ylim(bottom=0)
        axis.xaxis.set_minor_formatter(NullFormatter())
    axes[0, 0].legend()
    return figure


def history(scores: list[float]) -> Figure:
    """What the search tried."""
    figure, axes = canvas(1, 1, 2.6)
    numbers = np.arange(1, len(scores) + 1)
    axes[0, 0].plot(numbers, 100 * np.array(scores), ".", color="#8a8a8a")
    axes[0, 0].plot(numbers, 100 * np.minimum.accumulate(scores), color=OURS)
    axes[0, 0].set(yscale="log", xlabel="trial", ylabel="error, % of the range")
    return figure
