"""Studies of `./run accuracy` that show where no body is found, or where it errs: run when they are
asked for by name."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from .arm import PERIOD, Arm
from .body_stream import HAND, BodyStudy, NeverWorse, Stream
from .screws import ten_joints
from .studies import Files, rmse


def make_unaided(folder: Path, rng: np.random.Generator) -> Files:
    """Ten joints that were never turned alone."""
    arm = ten_joints(rng)
    stream = Stream(folder, rng, arm)
    stream.learn_with(arm.uniform(1000, rng), HAND)
    stream.test("hand", HAND)
    return stream.files


def make_narrow(share: float, folder: Path, rng: np.random.Generator) -> Files:
    arm = Arm()
    middle = arm.limits.mean(axis=1, keepdims=True)
    arm.limits = middle + share * (arm.limits - middle)
    stream = Stream(folder, rng, arm)
    stream.learn_with(stream.walk(3000), HAND)
    stream.test("hand", HAND)
    return stream.files


def make_noisy(noise: float, folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    q = stream.walk(3000)
    stream.learn(q, stream.arm.tip(q, HAND) + noise * rng.standard_normal((len(q), 3)))
    stream.test("hand", HAND)
    return stream.files


@dataclass
class Soft(Arm):
    """No joints: three sections that bend, each an arc of 0.2 m; the seventh input turns the hand.
    Bends are those of the iCub-like arm's joints, for the same walk."""

    def tip(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        v = np.zeros((len(q), 3)) + tool + np.array([0, 0, 0.1])
        for section in (2, 1, 0):
            bend = q[:, [2 * section, 2 * section + 1]]
            angle = np.maximum(np.linalg.norm(bend, axis=1), 1e-9)
            e = np.column_stack([bend / angle[:, None], np.zeros(len(q))])
            up, along = np.array([0, 0, 1.0]), np.sum(e * v, axis=1)[:, None]
            c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
            across = v - along * e - v[:, 2:] * up
            end = 0.2 * ((1 - c) * e + s * up) / angle[:, None]
            v = end + across + (c * along + s * v[:, 2:]) * e + (c * v[:, 2:] - s * along) * up
        return v


def make_soft(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng, Soft())
    stream.learn_with(stream.walk(int(100 / PERIOD)), HAND)
    stream.test("hand", HAND)
    return stream.files


def limit_studies() -> list[BodyStudy]:
    def study(name, what, make, counts, dimensions=(7, 3), parameters=()):
        bars = [NeverWorse(f"hand after {n:,}", n, rmse("hand"), 0) for n in counts]
        return BodyStudy(name, what, dimensions, make, bars, parameters, kept=False)

    return [
        study("body_unaided", "ten joints over +-170 degrees, random postures alone", make_unaided,
              (300, 1000), (10, 3), ("reference=0", "degree=3")),
        study("body_half_range", "a walk over half of the joints' ranges",
              partial(make_narrow, 0.5), (500, 3000)),
        study("body_fifth_range", "over a fifth", partial(make_narrow, 0.2), (500, 3000)),
        study("body_noise_2", "a walk with 2 mm of noise", partial(make_noisy, 0.002), (500, 3000)),
        study("body_noise_10", "10 mm of noise", partial(make_noisy, 0.01), (500, 3000)),
        study("body_soft", "an arm without joints: three sections that bend", make_soft,
              (500, 3000, 5000)),
    ]  # fmt: skip
