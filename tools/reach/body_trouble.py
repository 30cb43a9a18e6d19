"""Studies of `./run accuracy --only body` in which the robot is not quite a chain of screws, its
samples lie, or it changes while it learns."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from .arm import Arm
from .body_stream import BENT, HAND, STICK, BodyStudy, NeverWorse, Stream
from .studies import NOISE, Files, rmse

ROWS = 20000
SLOW, SLIP = ROWS, 0.03  # rows over which something moves; m


def outliers(stream: Stream, q: np.ndarray) -> np.ndarray:
    """5 % of the samples, ten in a row, lie at a place where something else is."""
    x = stream.seen(q, HAND)
    for run in np.flatnonzero(stream.rng.uniform(size=len(q) // 10) < 0.05):
        wrong = x.mean(axis=0) + 0.2 * stream.rng.standard_normal(3)
        x[10 * run : 10 * run + 10] = wrong + NOISE * stream.rng.standard_normal((10, 3))
    return x


def student(stream: Stream, q: np.ndarray) -> np.ndarray:
    """Noise of Student's distribution with three degrees of freedom."""
    return stream.arm.tip(q, HAND) + NOISE * stream.rng.standard_t(3, (len(q), 3))


def backlash(stream: Stream, q: np.ndarray) -> np.ndarray:
    """Each joint follows its encoder with a play that is worth 1 mm at half a metre."""
    play, true = 0.001 / 0.5 / 2, q.copy()
    for row in range(1, len(q)):
        true[row] = np.clip(true[row - 1], q[row] - play, q[row] + play)
    return stream.seen(true, HAND)


@dataclass
class Bent(Arm):
    """Encoders that are not centred, and a shoulder that gives way to the arm's weight."""

    eccentric: float = 0.0  # rad
    phase: np.ndarray | None = None
    droop: float = 0.0  # rad, of the arm held out level

    def tip(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        true = q + self.eccentric * np.sin(q + (0 if self.phase is None else self.phase))
        if self.droop:
            place = super().tip(true, tool)
            true = true + 0.0
            true[..., 3] += self.droop * place[..., 0] / 0.35
        return super().tip(true, tool)


def make_trouble(seen: Callable, folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    q = stream.walk(ROWS)
    stream.learn(q, seen(stream, q))
    stream.test("hand", HAND)
    return stream.files


def make_bent(eccentric: float, droop: float, folder: Path, rng: np.random.Generator) -> Files:
    phase = rng.uniform(0, 2 * np.pi, 7)
    stream = Stream(folder, rng, Bent(eccentric=eccentric, phase=phase, droop=droop))
    stream.learn_with(stream.walk(ROWS), HAND)
    stream.test("hand", HAND)
    return stream.files


def trouble(name: str, what: str, make: Callable) -> BodyStudy:
    bars = [NeverWorse(f"hand after {n:,} rows", n, rmse("hand"), 0) for n in (500, 3000, ROWS)]
    return BodyStudy(name, what, (7, 3), make, bars, quick=False)


def make_zero(folder: Path, rng: np.random.Generator) -> Files:
    """The elbow's zero moves while the hand is in use; the stick is not touched again."""
    stream, moved = Stream(folder, rng), np.radians(1) * np.eye(7)[6]
    stream.learn_with(stream.walk(5000), HAND)
    stream.learn_with(stream.walk(5000), STICK)
    for share in (np.linspace(0, 1, SLOW), np.ones(SLOW)):
        q = stream.walk(SLOW)
        stream.learn(q, stream.seen(q + share[:, None] * moved, HAND))
    after = Shifted(shift=moved)
    stream.test("hand", HAND, after)
    stream.test("stick", STICK, after)
    return stream.files


@dataclass
class Shifted(Arm):
    shift: np.ndarray | None = None

    def tip(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        return super().tip(q + self.shift, tool)


def make_slip(folder: Path, rng: np.random.Generator) -> Files:
    """The stick slips across itself; hand and L are not touched again."""
    stream = Stream(folder, rng)
    across = SLIP * np.cross(STICK, [0, 0, 1]) / np.linalg.norm(STICK)
    for tool in (HAND, BENT, STICK):
        stream.learn_with(stream.walk(5000), tool)
    for share in (np.linspace(0, 1, SLOW), np.ones(SLOW)):
        stream.learn_with(stream.walk(SLOW), STICK + share[:, None] * across)
    for name, tool in (("hand", HAND), ("L", BENT), ("stick", STICK + across)):
        stream.test(name, tool)
    return stream.files


def trouble_studies() -> list[BodyStudy]:
    end, later = 10000 + SLOW, 10000 + 2 * SLOW
    slipped, long_after = end + 5000, later + 5000
    return [
        trouble("body_outliers", "5 % of the rows elsewhere, in runs of ten",
                partial(make_trouble, outliers)),
        trouble("body_student", "noise with heavy tails (Student, three degrees of freedom)",
                partial(make_trouble, student)),
        trouble("body_encoders", "encoders 0.5 % off centre", partial(make_bent, 0.005, 0.0)),
        trouble("body_backlash", "1 mm of backlash", partial(make_trouble, backlash)),
        trouble("body_droop", "an arm that droops by 5 mm", partial(make_bent, 0.0, 0.005 / 0.35)),
        BodyStudy("body_zero", "the elbow's zero moves by 1 degree in 20,000 rows of the hand",
                  (7, 3), make_zero,
                  [NeverWorse("hand at the end of it", end, rmse("hand"), 0),
                   NeverWorse("hand 20,000 later", later, rmse("hand"), 0),
                   NeverWorse("stick 20,000 later", later, rmse("stick"), 0)], quick=False),
        BodyStudy("body_slip", "the stick slips by 3 cm in 20,000 rows", (7, 3), make_slip,
                  [NeverWorse("stick at the end of it", slipped, rmse("stick"), 0),
                   NeverWorse("stick 20,000 later", long_after, rmse("stick"), 0),
                   NeverWorse("hand 20,000 later", long_after, rmse("hand"), 0),
                   NeverWorse("L 20,000 later", long_after, rmse("L"), 0)], quick=False),
    ]  # fmt: skip
