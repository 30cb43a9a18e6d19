"""K4: equation 14's estimate against the true head while it moves, section 7.3.1, figure 27.

Twice: the estimate that the daemon has, which every fixation corrects, and what equation 14 alone
would have made of the first fixation. The daemon does not publish its Jacobians, but the solution
that it follows at each tick, and the integral of a solution's Jacobian along the arm's way is that
solution's change; where the daemon changes solutions, the change of that tick is left out. With
the model frozen, so that the solution changes by the arm's motion alone.
"""

from pathlib import Path

import numpy as np

from .. import metrics, summary
from ..record import Record
from . import series, track
from .rows import Row

_PAPER = {"mean": 0.09, "max": 0.27, "std": 0.05}


def measure(record: Record, run: dict, folder: Path) -> dict[str, float]:
    result = {}
    for name, phase_name in (("", "coordinate_hand"), ("alone_", "frozen_hand")):
        phase = summary.phase_named(run, phase_name)
        start, end = track.span(record, phase)
        status = record.between("REACH_STATUS", start, end)
        if name:
            estimate = integrated(status["x_predicted"], status["solution"],
                                  status["x_estimated"][0])  # fmt: skip
        else:
            estimate = status["x_estimated"]
        estimate = np.degrees(estimate[:, :2])
        times, angles = track.joints(record, start, end)
        head = metrics.interpolate(times, angles[:, -2:], status["utime"])
        seconds = track.seconds(status["utime"], start)
        path = folder / f"k4_{name or 'daemon_'}head.csv"
        series.write(path, t=seconds, head=head, estimate=estimate)
        error = np.linalg.norm(head - estimate, axis=1)
        result |= {f"K4.{name}mean_deg": float(error.mean()),
                   f"K4.{name}max_deg": float(error.max()),
                   f"K4.{name}std_deg": float(error.std())}  # fmt: skip
    return result


def integrated(values: np.ndarray, solution: np.ndarray, first: np.ndarray) -> np.ndarray:
    """From `first` on, the changes of the solution followed, but those from one solution to
    another."""
    steps = np.diff(values, axis=0)
    steps[np.diff(solution) != 0] = 0
    return first + np.vstack([np.zeros_like(first), np.cumsum(steps, axis=0)])


def rows() -> list[Row]:
    result = []
    for name, words in (("", "corrected at each fixation"), ("alone_", "equation 14 alone")):
        for key, bar in (("mean", 0.09), ("max", 0.27), ("std", None)):
            result.append(Row(f"K4.{name}{key}_deg", f"estimated head motion, {key} error, {words}",
                              "deg", _PAPER[key], bar))  # fmt: skip
    return result
