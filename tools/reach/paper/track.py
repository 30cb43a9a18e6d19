"""The ball's true and measured image while targets are pursued, and the joints meanwhile."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from .. import metrics, summary
from ..record import Record
from . import series

IMAGE = ("u_right", "v_right", "disparity")


LEAD_IN = np.zeros((1, 3))  # before the targets that count: the ball comes to disparity 0


def star() -> np.ndarray:
    """The STAR's targets, after the lead-in."""
    return np.vstack([LEAD_IN, metrics.star_targets()])


def segments(record: Record, phase: dict) -> list[tuple[int, int]]:
    """First and last instant of each target that counts; us."""
    return summary.star_segments(record, phase)[len(LEAD_IN) :]


def segment(record: Record, phase: dict, number: int) -> tuple[int, int] | None:
    """First and last instant of one target; us. None when it was never pursued."""
    status = record["REACH_STATUS"]
    mine = (status["request_seq"] == phase["request_seq"]) & (status["phase"] == summary.TRACK)
    times = status["utime"][mine & (status["progress"] == number)]
    return (int(times[0]), int(times[-1])) if len(times) > 1 else None


def final_errors(record: Record, phase: dict, targets: np.ndarray, true: Callable) -> np.ndarray:
    """Of each target that counts; infinite where it was never pursued. `true` is the true track
    from one instant to another, in the targets' unit."""
    errors = []
    for number, target in enumerate(targets[len(LEAD_IN) :], start=len(LEAD_IN)):
        ends = segment(record, phase, number)
        errors.append(metrics.final_error(*true(record, *ends), target) if ends else np.inf)
    return np.array(errors)


def span(record: Record, phase: dict) -> tuple[int, int]:
    """From the first target's presentation to the last one's end; us. A ball that was lost and
    searched meanwhile is inside."""
    counted = segments(record, phase)
    return counted[0][0], counted[-1][1]


def measured(record: Record, start: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Exposures (us) and rows [u, v, disparity] of what vision saw."""
    rows = record.between("MARKER", start, end)
    rows = rows[rows["seen"] == 1]
    return rows["utime"], np.stack([rows[name] for name in IMAGE], axis=-1)


def joints(record: Record, start: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Instants (us) and true joint angles, deg."""
    rows = record.between("SIM_TRUTH", start, end)
    rows = rows[rows["exposure"] == 0]
    return rows["utime"], np.degrees(rows["position"][:, : rows["n_joints"][0]])


def seconds(times: np.ndarray, start: int) -> np.ndarray:
    return (times - start) * 1e-6


def rms_jerk(times: np.ndarray, angles: np.ndarray) -> float:
    """Root mean square of the third derivative over all joints and instants; deg/s3."""
    step = np.median(np.diff(times)) * 1e-6
    return float(np.sqrt(np.mean((np.diff(angles, 3, axis=0) / step**3) ** 2)))


def write(record: Record, phase: dict, folder: Path, name: str) -> None:
    """NAME.csv, NAME_measured.csv and NAME_joints.csv; times from the first target on."""
    start, end = span(record, phase)
    times, track = summary.true_track(record, start, end)
    series.write(folder / f"{name}.csv", t=seconds(times, start), x=track)
    times, seen = measured(record, start, end)
    series.write(folder / f"{name}_measured.csv", t=seconds(times, start), x=seen)
    times, angles = joints(record, start, end)
    series.write(folder / f"{name}_joints.csv", t=seconds(times, start), q=angles)
