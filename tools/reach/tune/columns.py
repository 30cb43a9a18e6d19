"""What the columns look like: units, ranges, constants, duplicates, order. Guesses are said to be
guesses; nothing here changes a sample."""

from dataclasses import dataclass

import numpy as np

from .data import Samples

_TURN = 2 * np.pi
_WALK = 0.1  # of the range, a step of a walk; independent postures make steps of a third
_ALIKE = 0.9999  # correlation of two columns that say the same


@dataclass(frozen=True)
class Column:
    name: str
    low: float  # 1 % and 99 % points: a few wild numbers do not count
    high: float
    least: float
    most: float
    guess: str

    @property
    def range(self) -> float:
        return self.high - self.low

    @property
    def middle(self) -> float:
        return (self.low + self.high) / 2


@dataclass(frozen=True)
class Look:
    inputs: list[Column]
    outputs: list[Column]
    is_walk: bool
    remarks: list[str]  # a line each

    @property
    def widest(self) -> float:
        return max(column.range for column in self.inputs)

    @property
    def one_unit_in(self) -> bool:
        """Whether inputs seem to be of one unit, as the angles of joints are."""
        return _alike(self.inputs)

    @property
    def one_unit_out(self) -> bool:
        return _alike(self.outputs)

    @property
    def may_be_a_body(self) -> bool:
        """Joints in radians, and a place in space."""
        in_rad = all(column.guess == "rad" for column in self.inputs)
        return in_rad and len(self.inputs) >= 2 and len(self.outputs) == 3 and self.one_unit_out


def _alike(columns: list[Column]) -> bool:
    ranges = [column.range for column in columns if column.range > 0]
    return bool(ranges) and max(ranges) <= 6 * min(ranges)


def look_at(samples: Samples) -> Look:
    names = samples.names
    inputs = [_column(name, values, is_input=True)
              for name, values in zip(names, samples.z.T, strict=False)]  # fmt: skip
    outputs = [_column(name, values, is_input=False)
               for name, values in zip(names[samples.inputs:], samples.x.T, strict=False)
              ]  # fmt: skip
    step = np.median(np.abs(np.diff(samples.z, axis=0)), axis=0)
    spread = np.ptp(samples.z, axis=0)
    moving = spread > 0
    is_walk = bool(any(moving) and np.median(step[moving] / spread[moving]) < _WALK)
    return Look(inputs, outputs, is_walk, list(_remarks(samples, inputs + outputs)))


def _column(name: str, values: np.ndarray, *, is_input: bool) -> Column:
    low, high = np.quantile(values, [0.01, 0.99])
    least, most = values.min(), values.max()
    guess = _unit(values) if is_input else ""
    return Column(name, float(low), float(high), float(least), float(most), guess)


def _unit(values: np.ndarray) -> str:
    most = np.abs(values).max()
    if np.ptp(values) == 0:
        return "constant"
    if most > _TURN and np.all(values == np.round(values)):
        return "whole numbers: encoder ticks?"
    if most <= _TURN:
        return "rad"
    return "degrees?" if most <= 400 else "ticks?"


def _remarks(samples: Samples, columns: list[Column]):
    table = np.hstack([samples.z, samples.x])
    for column in columns:
        if column.least == column.most:
            yield f"{column.name} is {column.least:g} in all rows: nothing can be learned of it"
        elif column.range > 0 and column.most - column.least > 5 * column.range:
            yield (f"{column.name} has wild values: {column.least:g} to {column.most:g}, 98 % "
                   f"of them between {column.low:g} and {column.high:g}")  # fmt: skip
    yield from _same(table, columns)
    doubled = len(table) - len(np.unique(table, axis=0))
    if doubled:
        yield f"{doubled} rows are there twice"
    units = {column.guess for column in columns[: samples.inputs]} - {"constant", ""}
    if len(units) > 1:
        yield f"inputs seem to be in different units: {', '.join(sorted(units))}"


def _same(table: np.ndarray, columns: list[Column]):
    moving = [i for i in range(table.shape[1]) if np.ptp(table[:, i]) > 0]
    if len(moving) < 2:
        return
    correlation = np.abs(np.corrcoef(table[:, moving].T))
    for a, i in enumerate(moving):
        for b in range(a + 1, len(moving)):
            if correlation[a, b] > _ALIKE:
                yield f"{columns[i].name} and {columns[moving[b]].name} say the same"
