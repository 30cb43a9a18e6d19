"""I2, the cube: control in Cartesian space with hand, stick and L, section 6.2, figures 6 to 13."""

from pathlib import Path

import numpy as np

from .. import summary
from ..record import Record
from . import k3, series
from .rows import Row

REACHED_M = 0.01
# Name of a cube: what holds it, what was learned before it.
CUBES = {
    "hand": "hand, after babbling with it",
    "stick_new_1": "stick never babbled with, iteration 1",
    "stick_new_2": "stick never babbled with, iteration 2",
    "stick_new_3": "stick never babbled with, iteration 3",
    "stick": "stick, after babbling with it",
    "hand_after_stick": "hand, after babbling with the stick",
    "hand_third": "hand, after a third babbling",
    "stick_third": "stick, after a third babbling with the hand",
    "L": "L, after babbling with it",
    "L_later": "L, after more babbling with the hand",
}
_ASKED = set(CUBES) - {"stick_new_1", "stick_new_2"}

# The order in which a line from (0, 0, 0) visits corners: all twelve edges, two diagonals of the
# cube and one of a side. A corner is (x, y, z), 0 or 1.
_PATH = [
    (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
    (0, 0, 1), (1, 1, 0), (1, 1, 1), (0, 0, 0), (0, 1, 0), (0, 1, 1), (1, 0, 1), (1, 0, 0),
]  # fmt: skip
# Edges in metres: with them the sum of components is 0.05 before the shorter edge and 0.25 before a
# diagonal, as in the paper's figure 7.
EDGES = np.array([0.05, 0.10, 0.10])


def targets(middle: np.ndarray) -> np.ndarray:
    """The 16 targets about a middle, m; the first line begins at corner (0, 0, 0)."""
    return middle + (np.array(_PATH, float) - 0.5) * EDGES


def start(middle: np.ndarray) -> np.ndarray:
    """The corner that is reached before the first target counts."""
    return middle - EDGES / 2


def true_track(record: Record, begin: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Instants (us) and true positions of the end-effector, m."""
    truth = record.between("SIM_TRUTH", begin, end)
    truth = truth[truth["exposure"] == 0]
    return truth["utime"], truth["marker"]


def measure(record: Record, run: dict, folder: Path) -> dict[str, float]:
    result = {}
    for name in CUBES:
        phase = summary.phase_named(run, f"cube_{name}")
        wanted = np.array(phase["targets"])
        segments = summary.star_segments(record, phase)[1:]
        tracks = [true_track(record, *segment) for segment in segments]
        numbers = k3.lines(tracks, wanted[1:], REACHED_M, REACHED_M)
        result |= {f"I2.{name}.{key}": value for key, value in _scaled(numbers).items()}
        _write(folder / f"i2_{name}.csv", tracks, wanted[1:])
    return result


def _scaled(numbers: dict[str, float]) -> dict[str, float]:
    return {
        "corners_within_1cm": numbers["reached"],
        "final_error_median_mm": 1e3 * numbers["final_error_median"],
        "final_error_max_mm": 1e3 * numbers["final_error_max"],
        "straightness_median": numbers["straightness_median"],
        "straightness_max": numbers["straightness_max"],
    }


def _write(path: Path, tracks: list, wanted: np.ndarray) -> None:
    """Time from the first target, position, the target's position, error as in figure 7."""
    times = np.concatenate([t for t, _ in tracks])
    rows = np.concatenate([x for _, x in tracks])
    goals = np.concatenate([np.tile(goal, (len(t), 1))
                            for (t, _), goal in zip(tracks, wanted, strict=False)])  # fmt: skip
    series.write(path, t=(times - times[0]) * 1e-6, x=rows, target=goals,
                 error=np.abs(rows - goals).sum(axis=1))  # fmt: skip


def rows() -> list[Row]:
    result = []
    for name, words in CUBES.items():
        asked = name in _ASKED
        pictures = "straight" if name != "stick_new_1" else None
        result += [
            Row(f"I2.{name}.corners_within_1cm", f"targets within 1 cm, {words}", "of 16",
                "pictures", 16 if asked else None, at_least=True),
            Row(f"I2.{name}.final_error_median_mm", f"final true error, median, {words}", "mm"),
            Row(f"I2.{name}.final_error_max_mm", f"final true error, worst, {words}", "mm"),
            Row(f"I2.{name}.straightness_median",
                f"largest deviation from the line / its length, median, {words}", "", pictures,
                0.08 if asked else None),
            Row(f"I2.{name}.straightness_max",
                f"largest deviation from the line / its length, worst, {words}", "", pictures,
                0.2 if asked else None),
        ]  # fmt: skip
    return result
