"""Studies of `./run accuracy --only body --data DIR`: recorded samples, which the project does not
contain."""

import csv
import gzip
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from .batch_body import fit
from .body_stream import BodyStudy, NeverWorse
from .studies import Bar, Files, rmse, write

TUBE = "kobian_tube_samples.csv.gz"
EYES = ("learner-kobian-offline-body.yaml", "learner-kobian-offline.yaml")
# What S1 and S2 go through together, in the units of COMPONENTS: mean of the ten robots.
RANGES = (39.1, 50.3, 44.3)
PIXEL = (0.095, 0.095, 1.0)  # what a pixel of noise is in a fixation: deg, deg, px
COMPONENTS = (("yaw", "deg"), ("pitch", "deg"), ("disparity", "px"))


def component(test: str, k: int, unit: float = 1.0) -> Callable[[dict], float]:
    return lambda result: result["test"][test]["closest"]["rmse"][k] / unit


def make_reference(data: Path, folder: Path, rng: np.random.Generator) -> Files:
    train = [data / f"train_{n}_{tool}.csv.gz"
             for n, tool in enumerate(("none", "stick", "none", "L"), 1)]  # fmt: skip
    return Files(train, {f"S{n}": data / f"S{n}.csv.gz" for n in (1, 2, 3)}, {})


def _fixations(path: Path) -> dict[str, np.ndarray]:
    """Rows by their phase: joints (rad), yaw and pitch (deg), disparity (px)."""
    keys = ("q0_rad", "q1_rad", "q2_rad", "q3_rad", "yaw_rad", "pitch_rad", "disparity_px")
    phases: dict[str, list] = {}
    with gzip.open(path, "rt") as file:
        for row in csv.DictReader(file):
            phases.setdefault(row["phase"], []).append([float(row[key]) for key in keys])
    rows = {phase: np.array(values) for phase, values in phases.items()}
    for values in rows.values():
        values[:, 4:6] = np.degrees(values[:, 4:6])
    return rows


def make_tube(data: Path, folder: Path, rng: np.random.Generator) -> Files:
    """The fixations in an order of each draw's own; the tube after 20 of the hand."""
    rows = _fixations(data / TUBE)
    train = [write(folder / "hand.csv", rng.permutation(rows["train_hand"])[:20]),
             write(folder / "tube.csv", rng.permutation(rows["train_tube"])[:20])]  # fmt: skip
    tests = {name: write(folder / f"test_{name}.csv", rows[f"test_{name}"])
             for name in ("hand", "tube")}  # fmt: skip
    return Files(train, tests, {})


def make_tube_recorded(data: Path, folder: Path, rng: np.random.Generator) -> Files:
    """In the order in which the robot met them."""
    rows = _fixations(data / TUBE)
    train = [write(folder / f"{name}.csv", rows[f"train_{name}"][:20]) for name in ("hand", "tube")]
    tests = {name: write(folder / f"test_{name}.csv", rows[f"test_{name}"])
             for name in ("hand", "tube")}  # fmt: skip
    return Files(train, tests, {})


def tube_bars() -> list[Bar]:
    wanted = [("hand after 20 fixations", "hand", 20, (0.05, 0.04, 0.25)),
              ("tube after 1", "tube", 21, (0.5, 0.6, 5)),
              ("tube after 5", "tube", 25, (0.08, 0.08, 0.5)),
              ("tube after 20", "tube", 40, (0.04, 0.04, 0.3))]  # fmt: skip
    return [Bar(f"{what}, {name}", at, component(test, k), most[k], unit)
            for what, test, at, most in wanted
            for k, (name, unit) in enumerate(COMPONENTS)]  # fmt: skip


def make_robot(data: Path, folder: Path, rng: np.random.Generator, number: int) -> Files:
    """Ten robots: a draw is one of them."""
    number %= 10
    train = [data / f"kobian_{number}_train_{phase}.csv.gz" for phase in (1, 2)]
    return Files(train, {f"S{n}": data / f"kobian_{number}_S{n}.csv.gz" for n in (1, 2)}, {})


def robot_bars() -> list[Bar]:
    at = (
        ("hand after 100", "S1", 100),
        ("tool after 25", "S2", 525),
        ("hand after 500 of each", "S1", 1000),
        ("tool after 500 of each", "S2", 1000),
    )
    return [NeverWorse(f"{what}, {name}", n, component(test, k), 0, unit)
            for what, test, n in at for k, (name, unit) in enumerate(COMPONENTS)]  # fmt: skip


def k1_bars() -> list[Bar]:
    """Of K1 of the paper: 1,000 samples, percent of the range; half of what polynomials had."""
    wanted = {"S1": (0.0175, 0.0365, 0.0505), "S2": (0.026, 0.07, 0.101)}
    return [Bar(f"{test}, {name}", 1000, component(test, k, RANGES[k] / 100), wanted[test][k], "%")
            for test in wanted for k, (name, _) in enumerate(COMPONENTS)]  # fmt: skip


def k1_batch(files: Files) -> dict[str, float]:
    """The true structure, fitted to all rows of both tools, which it is told."""
    rows = [np.loadtxt(path, delimiter=",", skiprows=1) for path in files.train]
    found = fit(rows, PIXEL)
    numbers = {}
    for tool, (name, path) in enumerate(files.test.items()):
        test = np.loadtxt(path, delimiter=",", skiprows=1)
        q, x = test[:, :4], test[:, 4:]
        apart = ((rows[tool][:, None, :4] - q[None]) ** 2).sum(axis=2)
        near = rows[tool][apart.argmin(axis=0), 4:]
        error = np.sqrt(np.mean((found.predict(q, tool, near) - x) ** 2, axis=0))
        for k, (what, _) in enumerate(COMPONENTS):
            numbers[f"{name}, {what}"] = float(100 * error[k] / RANGES[k])
    return numbers


def data_studies(data: Path | None) -> list[BodyStudy]:
    where = data or Path()
    return [
        BodyStudy("body_reference", "reference data of the iCub-like arm, four phases of 100,000",
                  (7, 3), partial(make_reference, where),
                  [Bar(f"{test} at the end", 400000, rmse(test), most)
                   for test, most in (("S1", 0.3), ("S2", 0.4), ("S3", 0.6))],
                  quick=False, most_draws=1, wants_data=True),
        BodyStudy("body_tube", "fixations of the Kobian's hand, then of its flexible tube", (4, 3),
                  partial(make_tube, where), tube_bars(), files=EYES, wants_data=True),
        BodyStudy("body_tube_recorded", "the same in the order of the robot's day", (4, 3),
                  partial(make_tube_recorded, where), tube_bars(), files=EYES, most_draws=1,
                  wants_data=True),
        BodyStudy("body_robots", "reference data of Kobian-like robots, 1 px of noise",
                  (4, 3), partial(make_robot, where), robot_bars(), ("noise_share=0.1",),
                  files=EYES, wants_data=True, numbered=True),
        BodyStudy("body_k1", "the same, 500 of hand and 500 of tool, % of the range", (4, 3),
                  partial(make_robot, where), k1_bars(), ("noise_share=0.1",),
                  files=EYES, wants_data=True, numbered=True, batch=k1_batch),
    ]  # fmt: skip
