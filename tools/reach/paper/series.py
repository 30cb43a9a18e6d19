"""The raw series of a run, one CSV file each with a line of names on top."""

from pathlib import Path

import numpy as np


def write(path: Path, **columns: np.ndarray) -> None:
    """Columns of equal length; a matrix becomes NAME1, NAME2, ..."""
    names, parts = [], []
    for name, values in columns.items():
        values = np.asarray(values, float)
        wide = values.ndim == 2
        names += [f"{name}{i + 1}" for i in range(values.shape[1])] if wide else [name]
        parts.append(values if wide else values[:, None])
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = np.hstack(parts)
    np.savetxt(path, rows, "%.9g", ",", header=",".join(names), comments="")


def read(path: Path) -> dict[str, np.ndarray]:
    """One array a column."""
    with path.open() as lines:
        names = lines.readline().strip().split(",")
        rows = np.loadtxt(lines, delimiter=",", ndmin=2).reshape(-1, len(names))
    return dict(zip(names, rows.T, strict=True))


def wide(columns: dict[str, np.ndarray], name: str) -> np.ndarray:
    """The matrix that was written under this name."""
    numbers = range(1, 1 + sum(key.startswith(name) and key[len(name):].isdigit()
                               for key in columns))  # fmt: skip
    return np.stack([columns[f"{name}{i}"] for i in numbers], axis=-1)
