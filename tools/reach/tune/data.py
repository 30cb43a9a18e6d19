"""Samples from a user's files: CSV in the shapes that programs and spreadsheets write, or logs."""

import gzip
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MOST_INPUTS, MOST_OUTPUTS = 16, 8  # what a learner takes
_GUESSED_OUTPUTS = 3  # a place in space


class DataError(Exception):
    """One line for the user."""


@dataclass(frozen=True)
class Samples:
    """In the order in which they were taken."""

    names: list[str]  # of the columns, inputs first
    z: np.ndarray  # (n, inputs)
    x: np.ndarray  # (n, outputs)

    def __len__(self) -> int:
        return len(self.z)

    @property
    def inputs(self) -> int:
        return self.z.shape[1]

    @property
    def outputs(self) -> int:
        return self.x.shape[1]

    @property
    def dimensions(self) -> tuple[int, int]:
        return self.inputs, self.outputs

    def rows(self, which) -> "Samples":
        return Samples(self.names, self.z[which], self.x[which])

    def write(self, path: Path) -> Path:
        """As reach-eval reads it."""
        header = ",".join(re.sub(r"[^\x21-\x7e]|,", "_", name) or "_" for name in self.names)
        rows = np.hstack([self.z, self.x])
        np.savetxt(path, rows, fmt="%.9g", delimiter=",", header=header, comments="")
        return path


def read(paths: list[Path], inputs: int | None, outputs: int | None) -> Samples:
    """The rows of all files, one after the other. Numbers that are not given: the last three
    columns are outputs, as many as there are; a log says itself."""
    parts = [_read_log(p) if p.suffix == ".lcmlog" else _read_table(p) for p in paths]
    widths = {table.shape[1] for _, table, _ in parts}
    if len(widths) > 1:
        raise DataError(f"the files have different numbers of columns: {sorted(widths)}")
    names, _, said = parts[0]
    rows = np.vstack([table for _, table, _ in parts])
    d, D = _dimensions(rows.shape[1], inputs or (said or (None,))[0], outputs)
    if len(rows) < 50:
        raise DataError(f"{len(rows)} samples are too few to choose parameters: 50 at least")
    return Samples(names, rows[:, :d], rows[:, d : d + D])


def _dimensions(width: int, inputs: int | None, outputs: int | None) -> tuple[int, int]:
    d = inputs or width - (outputs or min(_GUESSED_OUTPUTS, width - 1))
    D = outputs or width - d
    if d < 1 or D < 1 or d + D > width:
        raise DataError(f"{width} columns are no {d} inputs and {D} outputs")
    if d + D < width and not (inputs and outputs):
        raise DataError(f"{width} columns: give both --inputs and --outputs")
    if d > MOST_INPUTS or D > MOST_OUTPUTS:
        raise DataError(f"{d} inputs and {D} outputs: at most {MOST_INPUTS} and {MOST_OUTPUTS}; "
                        "say with --inputs and --outputs which columns they are")  # fmt: skip
    return d, D


def _read_log(path: Path) -> tuple[list[str], np.ndarray, tuple[int, int]]:
    """The samples that reachd gathered, in its units: rad; rad and px, or m."""
    from ..record import read_log  # wants the message bindings, which tables do not

    try:
        rows = read_log(path)["REACH_SAMPLE"]
    except OSError as error:
        raise DataError(f"{path}: {error.strerror}") from None
    if not len(rows):
        raise DataError(f"{path}: no REACH_SAMPLE in this log")
    d, D = int(rows["n_inputs"][0]), int(rows["n_outputs"][0])
    names = [f"q{i + 1}" for i in range(d)] + [f"x{i + 1}" for i in range(D)]
    return names, np.hstack([rows["q"][:, :d], rows["x"][:, :D]]), (d, D)


def _read_table(path: Path) -> tuple[list[str], np.ndarray, None]:
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise DataError(f"{path}: {error.strerror}") from None
    try:
        text = (gzip.decompress(raw) if raw[:2] == b"\x1f\x8b" else raw).decode("utf-8-sig")
    except (OSError, EOFError, UnicodeDecodeError):
        raise DataError(f"{path}: no text, or a damaged gzip file") from None
    lines = [line.strip() for line in text.splitlines()]
    if not any(lines):
        raise DataError(f"{path}: no row of numbers")
    separator, decimal = _separator(lines)
    names, first = _names(_cells(lines[0], separator), decimal)
    table = [
        _row(path, number, _cells(line, separator), len(names), decimal)
        for number, line in enumerate(lines[first:], first + 1)
        if line
    ]
    if not table:
        raise DataError(f"{path}: no row of numbers")
    return names, np.array(table), None


def _separator(lines: list[str]) -> tuple[str | None, str]:
    """What separates cells (None: white space), and the decimal sign."""
    line = lines[min(1, len(lines) - 1)]
    if ";" in line:
        return ";", "," if "," in line else "."
    return ("," if "," in line else None), "."


def _cells(line: str, separator: str | None) -> list[str]:
    return [cell.strip().strip('"') for cell in line.split(separator)]


def _number(cell: str, decimal: str) -> float:
    return float(cell.replace(decimal, "."))


def _names(cells: list[str], decimal: str) -> tuple[list[str], int]:
    """The columns' names, and how many lines they take."""
    try:
        for cell in cells:
            _number(cell, decimal)
    except ValueError:
        return cells, 1
    return [f"column {i + 1}" for i in range(len(cells))], 0


def _row(path: Path, number: int, cells: list[str], width: int, decimal: str) -> list[float]:
    if len(cells) != width:
        raise DataError(f"{path}:{number}: {len(cells)} columns, the first line has {width}")
    row = []
    for column, cell in enumerate(cells, 1):
        try:
            row.append(_number(cell, decimal))
        except ValueError:
            row.append(float("nan"))
        if not np.isfinite(row[-1]):
            raise DataError(f"{path}:{number}: column {column}: '{cell[:24]}' is no finite number")
    return row
