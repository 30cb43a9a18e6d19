"""What the studies of `./run accuracy --only body` are made of."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .arm import TOOLS, Arm
from .studies import NOISE, QUERIES, Bar, Files, Study, write

HAND, STICK, BENT = TOOLS["none"], TOOLS["stick"], TOOLS["L"]
NO_BAR = float("inf")
DIFFERENT = np.radians(2)
BODY, POLYNOMIAL = "body", "polynomial"


@dataclass
class BodyStudy(Study):
    """Two learners on the same files; the bars are those of the first."""

    columns: tuple[str, str] = (BODY, POLYNOMIAL)
    files: tuple[str, str] = ("learner-icub-body.yaml", "learner-icub.yaml")
    quick: bool = True  # cheap enough for --quick
    most_draws: int | None = None
    wants_data: bool = False
    numbered: bool = False  # `make` is given the draw's number, too
    alone: bool = False  # nothing else runs at the same time
    # From the files: a number for the name of each bar, which a batch fit reaches on the same rows.
    batch: Callable[[Files], dict[str, float]] | None = None


class NeverWorse(Bar):
    """A bar that the polynomials set: this share of what they have."""

    share = 1.0


class Half(NeverWorse):
    share = 0.5


def strongest(test: str) -> Callable[[dict], float]:
    return lambda result: 1e3 * result["test"][test]["strongest"]["mean"]


class Stream:
    """Training rows and test sets of one draw."""

    def __init__(self, folder: Path, rng: np.random.Generator, arm: Arm | None = None):
        self.folder, self.rng, self.arm = folder, rng, arm or Arm()
        self.files = Files([], {}, {})
        self._end: np.ndarray | None = None

    def walk(self, rows: int) -> np.ndarray:
        q = self.arm.walk(rows, self.rng, self._end)
        self._end = q[-1]
        return q

    def postures(self, count: int) -> np.ndarray:
        """Those of a walk that differ by two degrees, one after the other."""
        rows = [self.walk(1)[0]]
        while len(rows) < count:
            for q in self.walk(50):
                if np.abs(q - rows[-1]).max() >= DIFFERENT and len(rows) < count:
                    rows.append(q)
        return np.array(rows)

    def seen(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        return self.arm.tip(q, tool) + NOISE * self.rng.standard_normal((len(q), 3))

    def learn(self, q: np.ndarray, x: np.ndarray) -> None:
        name = f"train_{len(self.files.train) + 1}.csv"
        self.files.train.append(write(self.folder / name, q, x))

    def learn_with(self, q: np.ndarray, tool: np.ndarray) -> None:
        self.learn(q, self.seen(q, tool))

    def test(self, name: str, tool: np.ndarray, arm: Arm | None = None, rows=QUERIES) -> None:
        q = self.arm.uniform(rows, self.rng)
        self.files.test[name] = write(
            self.folder / f"{name}.csv", q, (arm or self.arm).tip(q, tool)
        )
