"""K2, arm-head coordination: does the ball stay in fixation? Section 7.2, figures 17 to 20."""

from pathlib import Path

import numpy as np

from .. import summary
from ..record import Record
from . import track
from .rows import Row

STEADY_SECONDS = 1.0  # after a target's presentation the head has long arrived
PHASES = {"hand": "coordinate_hand", "tool": "coordinate_tool",
          "hand_frozen": "frozen_hand", "tool_frozen": "frozen_tool"}  # fmt: skip
_PAPER_MAX = {"hand": 3.0, "tool": 6.0}
_MAX_BAR = {"hand": 3.0, "tool": 5.0}


def measure(record: Record, run: dict, folder: Path) -> dict[str, float]:
    result = {}
    for name, phase_name in PHASES.items():
        phase = summary.phase_named(run, phase_name)
        track.write(record, phase, folder, f"k2_{name}")
        result |= {f"K2.{name}.{key}": value for key, value in _errors(record, phase).items()}
    return result


def steady(times: np.ndarray, segments: list[tuple[int, int]]) -> np.ndarray:
    """Which instants lie STEADY_SECONDS or more after the presentation of the present target."""
    keep = np.zeros(len(times), bool)
    for start, end in segments:
        keep |= (times >= start + STEADY_SECONDS * 1e6) & (times <= end)
    return keep


def _errors(record: Record, phase: dict) -> dict[str, float]:
    segments = track.segments(record, phase)
    start, end = track.span(record, phase)
    times, rows = summary.true_track(record, start, end)
    seen_at, seen = track.measured(record, start, end)
    true, measured = np.linalg.norm(rows, axis=1), np.linalg.norm(seen, axis=1)
    at_rest = true[steady(times, segments)]
    return {
        "median_px": float(np.median(at_rest)),
        "p95_px": float(np.quantile(at_rest, 0.95)),
        "max_px": float(true.max()),
        "measured_median_px": float(np.median(measured[steady(seen_at, segments)])),
        "measured_max_px": float(measured.max()),
        "targets": len(segments),
    }


def rows() -> list[Row]:
    result = []
    for name in PHASES:
        ball, frozen = name.removesuffix("_frozen"), name.endswith("_frozen")
        who = f"{ball}, model frozen" if frozen else ball
        bars = (None, None, None) if frozen else (1.5, 3.0, _MAX_BAR[ball])
        result += [
            Row(f"K2.{name}.median_px", f"true error, steady, median, {who}", "px",
                "1-2, measured", bars[0]),
            Row(f"K2.{name}.p95_px", f"true error, steady, 95th percentile, {who}", "px",
                None, bars[1]),
            Row(f"K2.{name}.max_px", f"largest true error, any time, {who}", "px",
                _PAPER_MAX[ball], bars[2]),
            Row(f"K2.{name}.measured_median_px", f"measured error, steady, median, {who}", "px",
                "1-2"),
            Row(f"K2.{name}.measured_max_px", f"largest measured error, any time, {who}", "px",
                _PAPER_MAX[ball]),
            Row(f"K2.{name}.targets", f"targets pursued, {who}", "of 16", 16),
        ]  # fmt: skip
    return result
