"""K3, the STAR: reaching under a resting head, section 7.3, figures 21 to 26."""

from pathlib import Path

import numpy as np

from .. import metrics, summary
from ..record import Record
from . import track
from .rows import Row

REACHED_PX = 4.0
SETTLED_PX = 5.0
BALLS = ("hand", "tool")


def measure(record: Record, run: dict, folder: Path) -> dict[str, float]:
    result = {}
    for ball in BALLS:
        phase = summary.phase_named(run, f"star_{ball}")
        track.write(record, phase, folder, f"k3_{ball}")
        start, end = track.span(record, phase)
        numbers = lines(_tracks(record, phase), metrics.star_targets(), REACHED_PX, SETTLED_PX)
        numbers["jerk_rms"] = track.rms_jerk(*track.joints(record, start, end))
        result |= {f"K3.{ball}.{_NAMES.get(key, key)}": value for key, value in numbers.items()}
    return result


_NAMES = {"final_error_median": "final_error_median_px", "final_error_max": "final_error_max_px"}


def _tracks(record: Record, phase: dict) -> list[tuple[np.ndarray, np.ndarray]]:
    return [summary.true_track(record, *segment) for segment in track.segments(record, phase)]


def lines(tracks: list, targets: np.ndarray, reached: float, settled: float) -> dict[str, float]:
    """Numbers of reaching one target after the other along straight lines; a target that was
    never pursued counts as not reached. Each track: instants (us), positions."""
    final, straight, ratio, settling = [], [], [], []
    for (times, rows), target in zip(tracks, targets, strict=False):
        final.append(metrics.final_error(times, rows, target))
        straight.append(metrics.line_deviation(rows, rows[0], target))
        ratio.append(metrics.path_length(rows) / np.linalg.norm(target - rows[0]))
        settling.append(metrics.settling_time(times, rows, target, settled))
    return {
        "reached": float(np.sum(np.array(final) <= reached)),
        "final_error_median": float(np.median(final)),
        "final_error_max": float(np.max(final)),
        "straightness_median": float(np.median(straight)),
        "straightness_max": float(np.max(straight)),
        "path_ratio_median": float(np.median(ratio)),
        "settling_median_s": float(np.median(settling)),
    }


def rows() -> list[Row]:
    result = []
    for ball in BALLS:
        result += [
            Row(f"K3.{ball}.reached", f"targets within {REACHED_PX:g} px, {ball}", "of 16", 16, 16,
                at_least=True),
            Row(f"K3.{ball}.final_error_median_px", f"final true error, median of 16, {ball}", "px",
                "reached", 1.5),
            Row(f"K3.{ball}.final_error_max_px", f"final true error, worst of 16, {ball}", "px",
                "reached", 4.0),
            Row(f"K3.{ball}.straightness_median",
                f"largest deviation from the line / its length, median, {ball}", "",
                "almost straight", 0.08),
            Row(f"K3.{ball}.straightness_max",
                f"largest deviation from the line / its length, worst, {ball}", "",
                "almost straight", 0.2),
            Row(f"K3.{ball}.path_ratio_median", f"path length / line length, median, {ball}", ""),
            Row(f"K3.{ball}.settling_median_s",
                f"until it stays within {SETTLED_PX:g} px, median, {ball}", "s"),
            Row(f"K3.{ball}.jerk_rms", f"RMS jerk of the joints, {ball}", "deg/s3", "smooth"),
        ]  # fmt: skip
    return result
