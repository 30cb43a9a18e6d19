"""Studies of `./run accuracy --only body` in which the robot is not quite a chain of screws, its
samples lie, or it changes while it learns."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from .arm import Arm
from .body_stream import BENT, HAND, STICK, BodyStudy, NeverWorse, Stream
from .studies import NOISE, Bar, Files, rmse

ROWS = 20000
SLOW, SLIP = ROWS, 0.03  # rows over which something moves; m
SHOULDER, ELBOW = 3, 6  # joints
SOON, AGAIN = 200, 100  # rows


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


def make_zero(joint: int, slow: int, folder: Path, rng: np.random.Generator) -> Files:
    """A joint's zero moves by one degree in `slow` rows of the hand. The stick comes back for
    AGAIN rows at the very end."""
    stream, moved = Stream(folder, rng), np.radians(1) * np.eye(7)[joint]
    stream.learn_with(stream.walk(5000), HAND)
    stream.learn_with(stream.walk(5000), STICK)
    for tool, share in ((HAND, np.linspace(0, 1, slow)), (HAND, np.ones(5000)),
                        (STICK, np.ones(AGAIN))):  # fmt: skip
        q = stream.walk(len(share))
        stream.learn(q, stream.seen(q + share[:, None] * moved, tool))
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


def zero(name: str, what: str, joint: int, slow: int, most: tuple) -> BodyStudy:
    """`most`: of the hand right after, of the hand and the untouched stick later, of the stick with
    AGAIN rows; None: what polynomials have."""
    at = (10000 + slow + SOON, 15000 + slow, 15000 + slow, 15000 + slow + AGAIN)
    names = (f"hand {SOON} rows later", "hand 5,000 later", "stick, not touched since",
             f"stick after {AGAIN} rows")  # fmt: skip
    bars = [NeverWorse(n, k, rmse(n.split()[0].strip(",")), 0) if m is None
            else Bar(n, k, rmse(n.split()[0].strip(",")), m)
            for n, k, m in zip(names, at, most, strict=True)]  # fmt: skip
    return BodyStudy(name, what, (7, 3), partial(make_zero, joint, slow), bars, quick=False)


def trouble_studies() -> list[BodyStudy]:
    slipped = 15000 + SLOW
    long_after = slipped + SLOW
    return [
        trouble("body_outliers", "5 % of the rows elsewhere, in runs of ten",
                partial(make_trouble, outliers)),
        trouble("body_student", "noise with heavy tails (Student, three degrees of freedom)",
                partial(make_trouble, student)),
        trouble("body_encoders", "encoders 0.5 % off centre", partial(make_bent, 0.005, 0.0)),
        trouble("body_backlash", "1 mm of backlash", partial(make_trouble, backlash)),
        trouble("body_droop", "an arm that droops by 5 mm", partial(make_bent, 0.0, 0.005 / 0.35)),
        zero("body_zero", "the elbow's zero moves by 1 degree in 20,000 rows of the hand",
             ELBOW, SLOW, (0.6, 0.3, None, 0.6)),
        zero("body_zero_shoulder", "the same of the shoulder, which a tool does not explain",
             SHOULDER, SLOW, (0.6, 0.3, 0.6, 0.6)),
        zero("body_zero_sudden", "the shoulder's zero moves by 1 degree at once",
             SHOULDER, 1, (0.6, 0.3, 0.6, 0.6)),
        BodyStudy("body_slip", "the stick slips by 3 cm in 20,000 rows", (7, 3), make_slip,
                  [NeverWorse("stick at the end of it", slipped, rmse("stick"), 0),
                   NeverWorse("stick 20,000 later", long_after, rmse("stick"), 0),
                   NeverWorse("hand 20,000 later", long_after, rmse("hand"), 0),
                   NeverWorse("L 20,000 later", long_after, rmse("L"), 0)], quick=False),
    ]  # fmt: skip
