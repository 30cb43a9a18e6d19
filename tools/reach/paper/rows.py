"""The table: what is asked of each number, and whether the runs' mean meets it."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ..programs import OURS


@dataclass(frozen=True)
class Row:
    """`key` names the number in a run's summary. `paper` is the paper's number or words. The mean
    is to be at most `bar`, with `at_least` no less; None: it is only reported."""

    id: str
    metric: str
    unit: str
    paper: float | str | None = None
    bar: float | None = None
    at_least: bool = False
    learner: str = OURS
    key: str = ""

    @property
    def number(self) -> str:
        return self.key or self.id

    @property
    def experiment(self) -> str:
        return self.id.split(".")[0]

    def met(self, mean: float | None) -> bool | None:
        """None: nothing is asked. What was not measured is not met."""
        if self.bar is None:
            return None
        if mean is None or not math.isfinite(mean):
            return False
        return bool(mean >= self.bar if self.at_least else mean <= self.bar)


def lost(experiment: str) -> Row:
    """Nothing that is measured may rest on a log with gaps."""
    return Row(f"{experiment}.lost_ticks", "control steps that the log lacks", "", bar=0)


def of_learner(rows: Iterable[Row], learner: str, always: bool = False) -> list[Row]:
    """The same numbers of another learner: K1.s1.yaw_pct becomes K1.lwpr.s1.yaw_pct, with nothing
    asked. With `always`, ours is named too, and keeps what is asked."""
    result = []
    for row in rows:
        head, _, tail = row.id.partition(".")
        named = f"{head}.{learner}.{tail}"
        if learner == OURS:
            result.append(replace(row, id=named, key=row.id) if always else row)
        else:
            result.append(replace(row, id=named, key=row.id, learner=learner, bar=None,
                                  metric=f"{row.metric}, {learner}"))  # fmt: skip
    return result


def aggregate(rows: Iterable[Row], summaries: Iterable[dict]) -> list[dict]:
    """Mean and spread of each row over the runs of its learner that have the number."""
    values: dict[tuple[str, str], list[float]] = {}
    for summary in summaries:
        for key, value in summary["metrics"].items():
            if value is not None:
                values.setdefault((summary["learner"], key), []).append(value)
    return [_filled(row, values.get((row.learner, row.number), [])) for row in rows]


def _filled(row: Row, values: list[float]) -> dict:
    mean = float(np.mean(values)) if values else None
    return {
        "id": row.id,
        "experiment": row.experiment,
        "metric": row.metric,
        "unit": row.unit,
        "paper": row.paper,
        "mean": mean,
        "std": float(np.std(values)) if values else None,
        "n": len(values),
        "bar": row.bar,
        "met": row.met(mean),
    }
