"""The studies of `./run accuracy --only hard`: streams on which a mixture of polynomial experts is
easily led astray. Bars are those of the polynomials; the body learns the same files beside them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from .arm import PERIOD, Arm
from .body_stream import BENT, BODY, HAND, NO_BAR, POLYNOMIAL, STICK, BodyStudy, Stream
from .body_trouble import SHOULDER, SLIP, Shifted, make_slip
from .curves.gazing_arm import NOISE as SIGHT
from .curves.gazing_arm import GazingArm
from .studies import QUERIES, Bar, Files, rmse, solutions, write

WRONG = 0.2  # m, how far a false detection is off
RUN = 10  # rows
SWAP = 150  # rows with a tool: 3 s
FREQUENCY, DAMPING, DROOP = 2.0, 0.05, 0.03  # of a tool that swings: Hz, share of critical, m


@dataclass
class HardStudy(BodyStudy):
    columns: tuple[str, str] = (POLYNOMIAL, BODY)
    files: tuple[str, str] = ("learner-icub.yaml", "learner-icub-body.yaml")


@dataclass
class RatioBar(Bar):
    """What `value` is at `at`, over what `before` was at `start`."""

    before: Callable[[dict], float] | None = None
    start: int = 0

    def of(self, results: dict[int, dict]) -> float:
        return super().of(results) / self.before(results[self.start])


def experts(result: dict) -> float:
    return result["experts"]


def calibration(test: str, key: str) -> Callable[[dict], float]:
    return lambda result: result["test"][test]["calibration"][key]


def worst(result: dict) -> float:
    return max(rmse(name)(result) for name in result["test"] if name != "held")


def stated(at: int, test: str) -> list[Bar]:
    """On samples that were held out. Of a Gaussian error the two are 0.67 and 1.96."""
    return [
        Bar("error / stated sd, median", at, calibration(test, "median"), 0.2, "", 0.7),
        Bar("95 % point", at, calibration(test, "p95"), 0.75, "", 2.25),
    ]


def hold_out(stream: Stream, tool: np.ndarray) -> None:
    q = stream.arm.uniform(QUERIES, stream.rng)
    stream.files.test["held"] = write(stream.folder / "held.csv", q, stream.seen(q, tool))


def wrong_in_runs(share: float, run: int, stream: Stream, x: np.ndarray) -> np.ndarray:
    """That share of the rows lies elsewhere, `run` rows in a row at one place."""
    for start in run * np.flatnonzero(stream.rng.uniform(size=len(x) // run) < share):
        direction = stream.rng.standard_normal(3)
        x[start : start + run] += WRONG * direction / np.linalg.norm(direction)
    return x


def make_postures(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    for count, tool in ((300, HAND), (3000, STICK)):
        stream.learn_with(stream.arm.uniform(count, rng), tool)
    stream.test("hand", HAND)
    stream.test("stick", STICK)
    hold_out(stream, STICK)
    return stream.files


def make_wrong(share: float, run: int, hand: int, folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    for count, tool in ((hand, HAND), (20000, STICK)):
        q = stream.walk(count)
        stream.learn(q, wrong_in_runs(share, run, stream, stream.seen(q, tool)))
    stream.test("hand", HAND)
    stream.test("stick", STICK)
    return stream.files


def make_recalibrated(folder: Path, rng: np.random.Generator) -> Files:
    """The shoulder's zero moves by one degree at once."""
    stream, moved = Stream(folder, rng), np.radians(1) * np.eye(7)[SHOULDER]
    for shift in (0 * moved, moved):
        q = stream.walk(20000)
        stream.learn(q, stream.seen(q + shift, HAND))
    stream.test("before", HAND)
    stream.test("after", HAND, Shifted(shift=moved))
    return stream.files


def swinging(still: np.ndarray) -> np.ndarray:
    """Places of a mass on a spring whose rest goes through `still`."""
    own = 2 * np.pi * FREQUENCY
    place, speed, out = still[0].copy(), np.zeros(3), still.copy()
    steps = 10  # of the integration in one period
    for row in range(1, len(still)):
        for step in range(1, steps + 1):
            rest = still[row - 1] + (still[row] - still[row - 1]) * step / steps
            speed += PERIOD / steps * (own**2 * (rest - place) - 2 * DAMPING * own * speed)
            place = place + PERIOD / steps * speed
        out[row] = place
    return out


def make_swing(folder: Path, rng: np.random.Generator) -> Files:
    stream, droop = Stream(folder, rng), np.array([0, 0, -DROOP])
    stream.learn_with(stream.walk(5000), HAND)
    q = stream.walk(20000)
    seen = swinging(stream.arm.tip(q, STICK) + droop)
    stream.learn(q, seen + stream.seen(q, HAND) - stream.arm.tip(q, HAND))
    stream.test("hand", HAND)
    still = stream.arm.uniform(1000, rng)
    stream.files.test["stick"] = write(
        folder / "stick.csv", still, stream.arm.tip(still, STICK) + droop
    )
    return stream.files


def make_near(apart: float, folder: Path, rng: np.random.Generator) -> Files:
    stream, direction = Stream(folder, rng), rng.standard_normal(3)
    other = STICK + apart * direction / np.linalg.norm(direction)
    for tool in (STICK, other):
        stream.learn_with(stream.walk(20000), tool)
    stream.test("S1", STICK)
    stream.test("S2", other)
    return stream.files


def make_swaps(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    tools = np.array([HAND, STICK, BENT])[np.arange(20000) // SWAP % 3]
    stream.learn_with(stream.walk(20000), tools)
    for name, tool in (("S1", HAND), ("S2", STICK), ("S3", BENT)):
        stream.test(name, tool)
    return stream.files


def make_tools(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    for number in range(1, 11):
        direction = rng.standard_normal(3)
        tool = rng.uniform(0.1, 0.5) * direction / np.linalg.norm(direction)
        stream.learn_with(stream.walk(5000), tool)
        stream.test(f"tool_{number}", tool)
    hold_out(stream, tool)
    return stream.files


def make_mixed(walk: bool, count: int, folder: Path, rng: np.random.Generator) -> Files:
    """Hand and stick by chance from the first row on."""
    stream = Stream(folder, rng)
    q = stream.walk(count) if walk else stream.arm.uniform(count, rng)
    stream.learn_with(q, np.where(rng.uniform(size=(count, 1)) < 0.5, HAND, STICK))
    stream.test("S1", HAND)
    stream.test("S2", STICK)
    return stream.files


def make_wide(folder: Path, rng: np.random.Generator) -> Files:
    arm = Arm()
    middle = arm.limits.mean(axis=1, keepdims=True)
    arm.limits = middle + 2 * (arm.limits - middle)
    stream = Stream(folder, rng, arm)
    stream.learn_with(stream.walk(60000), HAND)
    stream.test("hand", HAND)
    hold_out(stream, HAND)
    return stream.files


def make_sight(mixed: bool, folder: Path, rng: np.random.Generator) -> Files:
    """Fixations of a Kobian-like robot: yaw, pitch (deg), disparity (px)."""
    arm, files = GazingArm(), Files([], {}, {})

    def seen(q: np.ndarray, tube: bool) -> np.ndarray:
        return arm.fixate(arm.place(q, tube)) * [180 / np.pi, 180 / np.pi, 1]

    q = arm.postures(1000, rng)
    with_tube = (rng.uniform(size=1000) < 0.5 if mixed else np.arange(1000) >= 500)[:, None]
    noise = SIGHT * [180 / np.pi, 180 / np.pi, 1] * rng.standard_normal((1000, 3))
    x = np.where(with_tube, seen(q, True), seen(q, False)) + noise
    files.train.append(write(folder / "train_1.csv", q, x))
    for name, tube in (("hand", False), ("tube", True)):
        q = arm.postures(500, rng)
        files.test[name] = write(folder / f"{name}.csv", q, seen(q, tube))
    q, noise = arm.postures(500, rng), noise[:500]
    files.test["held"] = write(folder / "held.csv", q, seen(q, True) + noise)
    return files


def pixels(test: str) -> Callable[[dict], float]:
    return lambda result: result["test"][test]["closest"]["rmse"][2]


def _births() -> list[HardStudy]:
    arm = (7, 3)
    return [
        HardStudy("hard_postures", "independent postures: 300 of the hand, then of the stick", arm,
                  make_postures,
                  [Bar("hand after 100", 100, rmse("hand"), 15),
                   Bar("hand after 300", 300, rmse("hand"), 5),
                   Bar("stick after 3,000", 3300, rmse("stick"), 5),
                   Bar("experts", 3300, experts, 2, ""),
                   *stated(3300, "held")]),
        HardStudy("hard_runs", "2 % of the rows elsewhere, in runs of ten", arm,
                  partial(make_wrong, 0.02, RUN, 20000),
                  [Bar("stick after 1,000", 21000, rmse("stick"), 16),
                   Bar("stick after 20,000", 40000, rmse("stick"), 3),
                   Bar("experts", 40000, experts, 3, "")]),
        HardStudy("hard_isolated", "10 % of the rows elsewhere, one at a time", arm,
                  partial(make_wrong, 0.1, 1, 20000),
                  [Bar("hand", 40000, rmse("hand"), 2), Bar("stick", 40000, rmse("stick"), 3),
                   Bar("experts", 40000, experts, 2, "")]),
        HardStudy("hard_swaps", "hand, stick and L in turn, 3 s each, from the start", arm,
                  make_swaps,
                  [Bar("experts", 20000, experts, 0, "", 3),
                   Bar("solutions", 20000, solutions("S1"), 0.1, "", 3),
                   Bar("worst tool", 20000, worst, NO_BAR)]),
        HardStudy("hard_tools", "ten tools, 5,000 rows each", arm, make_tools,
                  [Bar("worst tool", 50000, worst, 12), Bar("experts", 50000, experts, NO_BAR, ""),
                   *stated(50000, "held")]),
        HardStudy("hard_mixed_walk", "hand and stick by chance at each row of a walk", arm,
                  partial(make_mixed, True, 20000),
                  [Bar("worst tool", 20000, worst, NO_BAR),
                   Bar("experts", 20000, experts, 0, "", 2)]),
        HardStudy("hard_mixed_postures", "the same, independent postures", arm,
                  partial(make_mixed, False, 5000),
                  [Bar("worst tool", 5000, worst, NO_BAR),
                   Bar("experts", 5000, experts, 0, "", 2)]),
    ]  # fmt: skip


def _changes() -> list[HardStudy]:
    arm = (7, 3)
    return [
        HardStudy("hard_slip", f"the stick slips by {100 * SLIP:g} cm in 20,000 rows", arm,
                  make_slip,
                  [Bar("stick at the end of it", 35000, rmse("stick"), 5),
                   Bar("stick 20,000 later", 55000, rmse("stick"), 2)]),
        HardStudy("hard_recalibrated", "the shoulder's zero moves by 1 degree after 20,000 rows",
                  arm, make_recalibrated,
                  [Bar("hand before", 20000, rmse("before"), NO_BAR),
                   Bar("hand 20,000 later", 40000, rmse("after"), NO_BAR),
                   RatioBar("the same, over before", 40000, rmse("after"), 1.2, "",
                            before=rmse("before"), start=20000)]),
        HardStudy("hard_swing", "a stick that swings: 2 Hz, 5 % damped, 3 cm of droop", arm,
                  make_swing,
                  [Bar("stick at rest after 20,000", 25000, rmse("stick"), 15),
                   Bar("experts", 25000, experts, NO_BAR, "")]),
        *(HardStudy(f"hard_near_{cm}", f"two sticks {cm} cm apart", arm,
                    partial(make_near, cm / 100),
                    [Bar("experts", 40000, experts, 0, "", 2),
                     Bar("worst stick", 40000, worst, 2)]) for cm in (1, 2)),
    ]  # fmt: skip


def _calibrations() -> list[HardStudy]:
    sight = ("learner-kobian-offline.yaml", "learner-kobian-offline-body.yaml")
    return [
        HardStudy("hard_wide", "joint ranges twice as wide, 60,000 rows", (7, 3), make_wide,
                  [Bar("hand", 60000, rmse("hand"), NO_BAR), *stated(60000, "held")]),
        HardStudy("hard_sight", "fixations in degrees and pixels: 500 of the hand, 500 of the tube",
                  (4, 3), partial(make_sight, False),
                  [Bar("disparity of the tube", 1000, pixels("tube"), NO_BAR, "px"),
                   *stated(1000, "held")], files=sight),
        HardStudy("hard_mixed_sight", "fixations of hand and tube by chance", (4, 3),
                  partial(make_sight, True),
                  [Bar("disparity of the tube", 1000, pixels("tube"), NO_BAR, "px"),
                   Bar("experts", 1000, experts, 0, "", 2)], files=sight),
    ]  # fmt: skip


def hard_studies() -> list[HardStudy]:
    return [*_births(), *_changes(), *_calibrations()]
