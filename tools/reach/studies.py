"""The studies of `./run accuracy`: what each learns, where it is measured, and what it should show.

All data are made here from seeds, with the reference data's kinematics but draws, arms and tools of
their own.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .arm import TOOLS, Arm

NOISE = 0.0005  # m
QUERIES, TRACK = 1000, 3000  # rows of a test set and of a track


@dataclass
class Bar:
    """One number of the table. `value` takes reach-eval's result at `at` samples; it should not
    exceed `most`, or, with `target`, lie within `most` of that."""

    name: str
    at: int
    value: Callable[[dict], float]
    most: float
    unit: str = "mm"
    target: float | None = None

    def of(self, results: dict[int, dict]) -> float:
        """The number, from reach-eval's results by number of samples."""
        return float(self.value(results[self.at]))

    def met(self, mean: float) -> bool:
        return mean <= self.most if self.target is None else abs(mean - self.target) <= self.most


@dataclass
class Files:
    """reach-eval's arguments."""

    train: list[Path]
    test: dict[str, Path]
    track: dict[str, Path]


@dataclass
class Study:
    name: str
    what: str
    dimensions: tuple[int, int]
    make: Callable[[Path, np.random.Generator], Files]
    bars: list[Bar]
    parameters: tuple[str, ...] = ()
    kept: bool = True  # False: an idea that was tried and not kept, run when asked for by name


def rmse(test: str) -> Callable[[dict], float]:
    """Of the solution nearest to the truth, mean of the components, mm."""
    return lambda result: 1e3 * result["test"][test]["closest"]["mean"]


def solutions(test: str = "S1") -> Callable[[dict], float]:
    return lambda result: result["test"][test]["solutions"]


def wrong_branch(result: dict) -> float:
    return 100 * max(track["wrong_branch"] for track in result["track"].values())


def jacobian(test: str) -> Callable[[dict], float]:
    """Relative Frobenius error, median."""
    return lambda result: result["test"][test]["jacobian"]["median"]


def worst_tool(result: dict) -> float:
    return max(rmse(name)(result) for name in result["test"] if name != "S1")


def write(path: Path, *columns: np.ndarray) -> Path:
    np.savetxt(path, np.column_stack(columns), "%.9g", ",")
    return path


def _train(folder, rng, arm, tools, lengths, noise, outliers) -> list[Path]:
    """A continuous walk through changing tools, a file a phase."""
    files, start = [], None
    for tool, length in zip(tools, lengths, strict=True):
        q = arm.walk(length, rng, start)
        start = q[-1]
        x = arm.tip(q, tool) + noise * rng.standard_normal((length, 3))
        direction = rng.standard_normal((length, 3))
        direction *= 0.2 / np.linalg.norm(direction, axis=1)[:, None]
        wrong = rng.uniform(size=length) < outliers
        x[wrong] += direction[wrong]
        files.append(write(folder / f"train_{len(files) + 1}.csv", q, x))
    return files


def _rehearsed(path: Path, rng: np.random.Generator, times: int) -> Path:
    """The same stream, each sample followed by `times` of those that came before it."""
    rows = np.loadtxt(path, delimiter=",")
    earlier = (rng.uniform(size=(len(rows), times)) * (1 + np.arange(len(rows)))[:, None]).astype(
        int
    )
    order = np.column_stack([np.arange(len(rows)), earlier]).ravel()
    return write(path, rows[order])


def _with_rehearsal(length: int, times: int):
    def make(folder: Path, rng: np.random.Generator) -> Files:
        files = _arm_files(folder, rng, Arm(), [TOOLS["none"], TOOLS["stick"]], 2 * [length])
        for path in files.train:
            _rehearsed(path, rng, times)
        return files

    return make


def _arm_files(folder, rng, arm, tools, lengths, noise=NOISE, outliers=0.0) -> Files:
    """Test sets and tracks are those of each tool in the order of its first use."""
    train = _train(folder, rng, arm, tools, lengths, noise, outliers)
    points, swing = arm.uniform(QUERIES, rng), arm.swing(TRACK, rng)
    files = Files(train, {}, {})
    for number, tool in enumerate({tuple(tool): tool for tool in tools}.values(), 1):
        true = arm.jacobian(points, tool).reshape(QUERIES, -1)
        test, track = folder / f"S{number}.csv", folder / f"T{number}.csv"
        files.test[f"S{number}"] = write(test, points, arm.tip(points, tool), true)
        files.track[f"T{number}"] = write(track, swing, arm.tip(swing, tool))
    return files


def _another_arm(rng: np.random.Generator) -> Arm:
    def about(length: float) -> float:
        return length * rng.uniform(0.85, 1.15)

    return Arm(about(0.197), about(0.152), (0.0, about(-0.11), about(0.18)),
               speed=np.radians(rng.uniform(30, 60)))  # fmt: skip


def _tool(rng: np.random.Generator, length: float) -> np.ndarray:
    direction = rng.standard_normal(3)
    return length * direction / np.linalg.norm(direction)


def _four_phases(length: int, outliers=0.0):
    tools = [TOOLS[name] for name in ("none", "stick", "none", "L")]
    return lambda folder, rng: _arm_files(folder, rng, Arm(), tools, 4 * [length], NOISE, outliers)


def _other_phases(length: int):
    def make(folder: Path, rng: np.random.Generator) -> Files:
        hand = np.zeros(3)
        tools = [hand, _tool(rng, 0.3), hand, _tool(rng, 0.5)]
        noise = rng.uniform(0.0003, 0.001)
        return _arm_files(folder, rng, _another_arm(rng), tools, 4 * [length], noise)

    return make


def _six_tools(folder: Path, rng: np.random.Generator) -> Files:
    tools = [np.zeros(3)] + [_tool(rng, rng.uniform(0.2, 0.5)) for _ in range(5)]
    return _arm_files(folder, rng, Arm(), tools, [20000] + 5 * [5000])


def _wide(length: int):
    arm = Arm()
    middle = arm.limits.mean(axis=1, keepdims=True)
    arm.limits = middle + 2 * (arm.limits - middle)
    return lambda folder, rng: _arm_files(folder, rng, arm, [TOOLS["none"]], [length])


def _one_input(branches, low: float, high: float, keep):
    """Samples fall on either branch by chance, noise 0.1; queries where `keep` says so."""

    def make(folder: Path, rng: np.random.Generator) -> Files:
        z, query = rng.uniform(low, high, 4000), np.linspace(low, high, 200)
        x = branches(z, rng.uniform(size=4000) < 0.5) + 0.1 * rng.standard_normal(4000)
        query = query[keep(query)]
        tests = {"Q": write(folder / "Q.csv", query, branches(query, np.ones(len(query), bool)))}
        return Files([write(folder / "train.csv", z, x)], tests, {})

    return make


def _not_two(result: dict) -> float:
    histogram = result["test"]["Q"]["solutions_histogram"]
    return sum(histogram) - histogram[2]


def _over_two(result: dict) -> float:
    return sum(result["test"]["Q"]["solutions_histogram"][3:])


ONE_INPUT = ("experts=linear", "psi0=0.01", "hyper_psi=.inf", "prior_psi=.inf", "sigma0=0.1",
             "clustering=leader", "leader_level=0.9", "kappa=1")  # fmt: skip


def _progress_bars(n: int) -> list[Bar]:
    """Hand, stick, hand, L, n samples each."""
    three = (("S1", 2.0), ("S2", 3.0), ("S3", 4.5))
    return [
        *(Bar(f"hand after {at:,}", at, rmse("S1"), most)
          for at, most in ((1000, 25), (5000, 6), (20000, 3), (100000, 2)) if at <= n),
        *(Bar(f"stick after {at:,} with it", n + at, rmse("S2"), most)
          for at, most in ((1000, 30), (5000, 8), (20000, 4)) if at <= n),
        *(Bar(f"{test} at the end", 4 * n, rmse(test), most) for test, most in three),
        Bar("solutions after one tool", n, solutions(), 0.02, "", 1),
        Bar("after two", 3 * n, solutions(), 0.02, "", 2),
        Bar("after three", 4 * n, solutions(), 0.02, "", 3),
        Bar("wrong branch while tracking", 4 * n, wrong_branch, 0.05, "%"),
        *(Bar(f"Jacobian, {test}", 4 * n, jacobian(test), 0.03, "") for test, _ in three),
    ]  # fmt: skip


def _rehearsal_bars(n: int, rows: int) -> list[Bar]:
    """As the phases', at `rows` learned for each sample that the robot made."""
    return [
        Bar("hand after 1,000", 1000 * rows, rmse("S1"), 25),
        Bar("hand after 5,000", 5000 * rows, rmse("S1"), 6),
        Bar("stick after 1,000 with it", (n + 1000) * rows, rmse("S2"), 30),
        Bar("stick after 5,000 with it", (n + 5000) * rows, rmse("S2"), 8),
    ]


def _psi_bars(n: int) -> list[Bar]:
    return [
        Bar("hand at the end", 4 * n, rmse("S1"), 3.0),
        Bar("stick at the end", 4 * n, rmse("S2"), 4.5),
        Bar("solutions after three tools", 4 * n, solutions(), 0.02, "", 3),
    ]


def studies(quick: bool) -> list[Study]:
    n = 20000 if quick else 100000
    crossing = _one_input(lambda z, up: np.where(up, z, -z), -2, 2, lambda z: np.abs(z) >= 0.15)
    sines = _one_input(lambda z, up: np.sin(z) + up, -np.pi, np.pi, lambda z: z == z)
    counted = [Bar("queries without exactly two solutions", 4000, _not_two, 2, ""),
               Bar("queries with more than two", 4000, _over_two, 0, "")]  # fmt: skip
    return [
        Study("phases", f"hand, stick, hand, L: {n:,} samples each", (7, 3), _four_phases(n),
              _progress_bars(n)),
        Study("other_arms", "the same with other lengths, tools, speeds and noise", (7, 3),
              _other_phases(n), _progress_bars(n)),
        Study("outliers", "1 % of the samples 20 cm off", (7, 3), _four_phases(n, 0.01),
              [Bar("hand", 2 * n, rmse("S1"), 3), Bar("stick", 2 * n, rmse("S2"), 5)]),
        Study("tools", "five tools, 5,000 samples each, after 20,000 of the hand", (7, 3),
              _six_tools,
              [Bar("hand", 45000, rmse("S1"), 2.5), Bar("worst tool", 45000, worst_tool, 10),
               Bar("solutions", 45000, solutions(), 0.05, "", 6)]),
        Study("wide", "joint ranges twice as wide", (7, 3), _wide(200000),
              [Bar("hand after 200,000", 200000, rmse("S1"), 15)],
              ("births=published",)),  # which is some percent better there (docs/learner.md)
        Study("half_psi", "Psi_0 half as wide (standard deviation)", (7, 3), _four_phases(20000),
              _psi_bars(20000), ("psi0=0.25e-4",)),
        Study("double_psi", "Psi_0 twice as wide", (7, 3), _four_phases(20000), _psi_bars(20000),
              ("psi0=4e-4",)),
        *(Study(f"rehearsal_{times}", f"{times} earlier samples learned again with each", (7, 3),
                _with_rehearsal(5000, times), _rehearsal_bars(5000, 1 + times), kept=False)
          for times in (0, 1, 3)),
        Study("sines", "sin z and sin z + 1, 200 queries", (1, 1), sines, counted, ONE_INPUT),
        Study("crossing", "z and -z, queries where they are 0.3 apart", (1, 1), crossing, counted,
              ONE_INPUT),
    ]  # fmt: skip
