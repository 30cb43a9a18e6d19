"""The studies of `./run accuracy --only body`: what `experts: body` reaches, beside polynomials.

Both learn the same files. A row of a walk is one tick of a robot that moves at 40 degrees a second;
what is called a posture differs from the others. All errors are against the truth.
"""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from .body_data import data_studies
from .body_limits import limit_studies
from .body_stream import HAND, NO_BAR, STICK, BodyStudy, Half, Stream, strongest
from .body_trouble import trouble_studies
from .screws import franka_like, sweeps, ten_joints
from .studies import Bar, Files, rmse

PICKED, PICKS = 250, 30  # rows with each length of the stick, and how many


def worst(result: dict) -> float:
    return max(rmse(name)(result) for name in result["test"] if name.startswith("tool"))


def microseconds(call: str, quantile: str) -> Callable[[dict], float]:
    return lambda result: result[f"{call}_us"][quantile]


def found(key: str) -> Callable[[dict], float]:
    """NaN for polynomials, and before a body was found."""

    def value(result: dict) -> float:
        number = result.get("body", {}).get(key)
        return float("nan") if number is None else float(number)

    return value


def a_tool(rng: np.random.Generator) -> np.ndarray:
    direction = rng.standard_normal(3)
    return rng.uniform(0.1, 0.5) * direction / np.linalg.norm(direction)


def make_postures(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    stream.learn_with(stream.arm.uniform(100, rng), HAND)
    stream.test("hand", HAND)
    return stream.files


def make_walk(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    stream.learn_with(stream.walk(3000), HAND)
    stream.learn_with(stream.walk(20), STICK)
    stream.test("hand", HAND)
    stream.test("stick", STICK)
    return stream.files


def make_ten_tools(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    stream.learn_with(stream.postures(500), HAND)
    tools = [a_tool(rng) for _ in range(10)]
    for number, tool in enumerate(tools, 1):
        stream.learn_with(stream.postures(50), tool)
        stream.test(f"tool_{number}", tool)
    stream.learn_with(stream.postures(50), tools[0])
    return stream.files


def make_lengths(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    stream.learn_with(stream.walk(1000), HAND)
    for number in range(PICKS):
        length = rng.uniform(0.1, 0.6) * STICK / np.linalg.norm(STICK)
        stream.learn_with(stream.walk(PICKED), length)
        stream.test(f"length_{number}", length, rows=50)
    return stream.files


def lengths_bars() -> list[Bar]:
    """Bars of one name are averaged."""
    return [Bar("1 s after each pick-up", 1000 + PICKED * n + 50, strongest(f"length_{n}"), 2)
            for n in range(PICKS)]  # fmt: skip


def make_franka(folder: Path, rng: np.random.Generator) -> Files:
    arm = franka_like(rng)
    stream, tool = Stream(folder, rng, arm), a_tool(rng)
    stream.learn_with(arm.uniform(150, rng), HAND)
    stream.learn_with(arm.uniform(5, rng), tool)
    stream.test("hand", HAND)
    stream.test("tool", tool)
    return stream.files


def make_ten_joints(folder: Path, rng: np.random.Generator) -> Files:
    arm = ten_joints(rng)
    stream = Stream(folder, rng, arm)
    stream.learn_with(sweeps(arm, 12, np.radians(40), rng), HAND)
    stream.learn_with(arm.uniform(100, rng), HAND)
    stream.test("hand", HAND)
    return stream.files


def make_ordered(shuffled: bool, folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    for tool in (HAND, STICK):
        q = stream.walk(1000)
        stream.learn_with(rng.permutation(q) if shuffled else q, tool)
    stream.test("hand", HAND)
    stream.test("stick", STICK)
    return stream.files


def make_interleaved(folder: Path, rng: np.random.Generator) -> Files:
    stream = Stream(folder, rng)
    q = rng.permutation(stream.walk(2000))
    with_stick = rng.uniform(size=len(q)) < 0.5
    stream.learn_with(q, np.where(with_stick[:, None], STICK, HAND))
    stream.test("hand", HAND)
    stream.test("stick", STICK)
    return stream.files


def place_bars() -> list[Bar]:
    return [Bar("hand after 1,000", 1000, rmse("hand"), 0.6),
            Bar("stick after 1,000", 2000, rmse("stick"), 0.6)]  # fmt: skip


def _studies_of_learning() -> list[BodyStudy]:
    arm = (7, 3)
    return [
        BodyStudy("body_postures", "random postures of the hand", arm, make_postures,
                  [Bar("hand after 50", 50, rmse("hand"), 0.6),
                   Bar("hand after 100", 100, rmse("hand"), 0.4)]),
        BodyStudy("body_walk", "a walk at 50 Hz, then the stick", arm, make_walk,
                  [Bar("hand after 500 rows (10 s)", 500, rmse("hand"), 0.6),
                   Bar("hand after 3,000 rows (60 s)", 3000, rmse("hand"), 0.2),
                   *(Bar(f"stick after {n} rows", 3000 + n, rmse("stick"), at_most)
                     for n, at_most in ((1, 1.5), (5, 1.0), (20, 0.8)))]),
        BodyStudy("body_tools", "ten tools, 50 postures each, after 500 of the hand", arm,
                  make_ten_tools,
                  [Bar("worst tool", 1000, worst, 1.0),
                   Bar("the first again", 1050, strongest("tool_1"), 1.0)]),
        BodyStudy("body_lengths", "thirty lengths of a stick, 5 s each", arm, make_lengths,
                  lengths_bars(), quick=False),
        BodyStudy("body_franka", "the Franka's proportions, whole joint ranges", arm,
                  make_franka,
                  [Bar("hand after 60", 60, rmse("hand"), 0.5),
                   Bar("hand after 150", 150, rmse("hand"), 0.4),
                   Bar("a tool after 1", 151, rmse("tool"), 1.5),
                   Bar("a tool after 5", 155, rmse("tool"), 1.0)], ("reference=0",)),
        BodyStudy("body_ten_joints", "ten joints over +-170 degrees, each turned alone first",
                  (10, 3), make_ten_joints,
                  [Bar("hand after 120 of single joints", 120, rmse("hand"), NO_BAR),
                   Bar("hand after 30 random postures more", 150, rmse("hand"), 0.5),
                   Bar("hand after 100", 220, rmse("hand"), 0.2)],
                  ("reference=0", "degree=3")),
        BodyStudy("body_in_order", "a walk of the hand, a walk of the stick", arm,
                  partial(make_ordered, False), place_bars()),
        BodyStudy("body_shuffled", "the same, rows of each in random order", arm,
                  partial(make_ordered, True), place_bars()),
        BodyStudy("body_interleaved", "hand and stick by chance from the first row on", arm,
                  make_interleaved,
                  [Bar("hand after 2,000", 2000, rmse("hand"), 0.6),
                   Bar("stick after 2,000", 2000, rmse("stick"), 0.6)]),
        BodyStudy("body_time", "the same walk, one at a time: cost on one core", arm, make_walk,
                  [*(Half(f"{call}, {name}", 3000, microseconds(call, q), 0, "us")
                     for call in ("update", "predict") for q, name in (("p50", "median"),
                                                                      ("p999", "99.9 %"))),
                   Bar("first body after", 3000, found("found_at"), NO_BAR, "rows"),
                   Bar("processor time up to then", 3000, found("found_seconds"), 10, "s")],
                  quick=False, alone=True),
    ]  # fmt: skip


def body_studies(data: Path | None = None) -> list[BodyStudy]:
    learning = [*_studies_of_learning(), *trouble_studies(), *data_studies(data)]
    return [*learning, *limit_studies()]
