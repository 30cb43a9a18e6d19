"""The samples of a run as reach-eval takes them: a row has the inputs, then the outputs, in the
units of its files: angles of joints in rad, positions in m; angles of the head in degrees and the
disparity in px."""

import csv
from contextlib import suppress
from pathlib import Path

import numpy as np

from .log_stream import Group, counted
from .messages import reach

CHANNEL, STATUS = "REACH_SAMPLE", "REACH_STATUS"
_OF_THE_HEAD = 2  # outputs of a robot that sees: yaw and pitch, then the disparity


class SamplesError(Exception):
    """One line for the user."""


class SamplesFile:
    """Of the samples that were handed to the learner, or of those that were not. Written beside
    its place; `finish` moves it there."""

    def __init__(self, path: Path, learned: bool):
        self._path, self._beside = path, path.with_name(f"{path.name}.new")
        self._learned = learned
        self._file = self._beside.open("w", newline="")
        self._writer = csv.writer(self._file)
        self._shape: tuple[int, int] | None = None  # inputs and outputs
        self._space: int | None = None  # status_t.space
        self._rows = 0
        self._left_out = 0  # with a number that is not finite, or no numbers

    def take(self, groups: list[Group]) -> None:
        for group in groups:
            if group.channel == STATUS:
                self._space = int(group.rows["space"][-1])
        for group in groups:
            if group.channel == CHANNEL:
                self._take(group.rows[(group.rows["learned"] != 0) == self._learned])

    def _take(self, rows: np.ndarray) -> None:
        shapes = np.stack([rows["n_inputs"], rows["n_outputs"]], axis=1)
        most = (rows["q"].shape[1], rows["x"].shape[1])
        sound = ((shapes > 0) & (shapes <= most)).all(axis=1)
        for n_inputs, n_outputs in np.unique(shapes[sound], axis=0).tolist():
            self._begin(n_inputs, n_outputs)
        if self._shape and sound.any():
            cells = self._cells(rows)
            sound &= np.isfinite(cells).all(axis=1)
            self._writer.writerows(cells[sound].tolist())
        self._rows += int(sound.sum())
        self._left_out += int((~sound).sum())

    def _begin(self, inputs: int, outputs: int) -> None:
        if self._shape is None:
            self._shape = (inputs, outputs)
            names = [*(f"q{i + 1}" for i in range(inputs)), *(f"x{i + 1}" for i in range(outputs))]
            self._writer.writerow(names)
        if self._shape != (inputs, outputs):
            raise SamplesError(
                f"its samples have {self._shape[0]} inputs and {self._shape[1]} outputs, and then"
                f" {inputs} and {outputs}: cut the log (reach-log cut) where the robot changes"
            )

    def _cells(self, rows: np.ndarray) -> np.ndarray:
        if self._space is None:
            raise SamplesError(f"no {STATUS} before its first {CHANNEL} tells the units")
        inputs, outputs = self._shape
        x = rows["x"][:, :outputs].copy()
        if self._space == reach.status_t.VISUAL:
            x[:, :_OF_THE_HEAD] = np.degrees(x[:, :_OF_THE_HEAD])
        return np.hstack([rows["q"][:, :inputs], x])

    def told(self) -> list[str]:
        left = f", {self._left_out} left out that hold no finite numbers" if self._left_out else ""
        return [counted(self._rows, "sample") + left]

    def finish(self) -> None:
        if self._rows == 0:
            kind = "was learned" if self._learned else "was gathered with a frozen model"
            raise SamplesError(f"there is no {CHANNEL} in it that {kind}")
        self._file.close()
        self._beside.replace(self._path)

    def discard(self) -> None:
        with suppress(OSError):  # the full disk that ended it
            self._file.close()
        self._beside.unlink(missing_ok=True)
