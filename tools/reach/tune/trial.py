"""One configuration, learned and measured by reach-eval on rows that it has not seen."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..evaluation import reach_eval
from ..studies import Files
from .data import Samples

_KEPT = 0.95  # of the rows: wrong ones in the data shall not choose the parameters


@dataclass(frozen=True)
class Measured:
    """Predictions of held-out rows (NaN where there is none), and what reach-eval says."""

    closest: np.ndarray  # (rows, outputs)
    strongest: np.ndarray
    solutions: np.ndarray  # (rows,)
    results: dict[int, dict]  # after so many samples
    warnings: list[str]

    @property
    def last(self) -> dict:
        return self.results[max(self.results)]


@dataclass(frozen=True)
class Bench:
    """What trials share: files of the rows, and where to write."""

    folder: Path
    train: Path
    backward: Path  # the same rows from the last to the first
    test: Path
    truth: np.ndarray  # outputs of the test rows
    ranges: np.ndarray  # of the outputs, in which errors are counted
    dimensions: tuple[int, int]

    @staticmethod
    def of(folder: Path, train: Samples, test: Samples, ranges) -> "Bench":
        folder.mkdir(parents=True, exist_ok=True)
        return Bench(
            folder, train.write(folder / "train.csv"),
            train.rows(slice(None, None, -1)).write(folder / "backward.csv"),
            test.write(folder / "test.csv"), test.x,
            np.where(np.asarray(ranges) > 0, ranges, 1.0), train.dimensions,
        )  # fmt: skip

    def measure(self, config: Path, counts: list[int], *, timeout: float | None = None,
                backward: bool = False) -> Measured:  # fmt: skip
        files = Files([self.backward if backward else self.train], {"held-out": self.test}, {})
        rows, report = self.folder / "rows.csv", self.folder / "report.json"
        results = reach_eval(self.dimensions, files, counts, report, config, rows=rows,
                             timeout=timeout)  # fmt: skip
        table = list(csv.DictReader(rows.read_text().splitlines()))
        return Measured(
            _numbers(table, "closest", self.dimensions[1]),
            _numbers(table, "strongest", self.dimensions[1]),
            np.array([int(row["solutions"]) for row in table]), results,
            json.loads(report.read_text())["warnings"],
        )  # fmt: skip

    def distance(self, predicted: np.ndarray) -> np.ndarray:
        """Of each row to the truth, in the outputs' units."""
        return np.linalg.norm(predicted - self.truth, axis=1)

    def score(self, measured: Measured) -> float:
        """The error of the closest solution in shares of the range, root of the mean square of the
        best 95 % of the rows, times the mean number of solutions: of many solutions the closest is
        near by chance alone, so one more must pay for itself."""
        error = (measured.closest - self.truth) / self.ranges
        squares = np.where(np.isnan(error), 1.0, error**2).mean(axis=1)
        kept = np.sort(squares)[: max(1, int(_KEPT * len(squares)))]
        solutions = max(1.0, measured.solutions.mean())
        return float(np.sqrt(kept.mean()) * solutions)


def _numbers(table: list[dict], group: str, outputs: int) -> np.ndarray:
    names = [f"{group}{i + 1}" for i in range(outputs)]
    return np.array([[float(row[name] or "nan") for name in names] for row in table])
