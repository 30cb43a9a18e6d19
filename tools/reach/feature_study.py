"""What feature maps can do on the iCub-like arm: batch ridge regressions on one walk a draw.

    python -m reach.feature_study [--draws N] [--wide]

Prints the error on random configurations, in mm, of the best ridge of a grid: the tables of
docs/accuracy.md. Not the learner: no mixture, no order of samples.
"""

from itertools import combinations_with_replacement
from math import factorial

import numpy as np

from .arm import TOOLS, Arm
from .command_line import Parser

RIDGES = (1e-6, 1e-5, 1e-4, 1e-3)
CHUNK = 4000


def powers(d: int, degree: int) -> np.ndarray:
    """Every monomial up to the degree, a row of powers each."""
    rows = []
    for order in range(degree + 1):
        for chosen in combinations_with_replacement(range(d), order):
            rows.append(np.bincount(np.array(chosen, int), minlength=d))
    return np.array(rows)


def monomials(arm: Arm, length: float, gaussian: bool, degree: int = 4):
    """u^a / a!, or u^a / sqrt(a!) under a Gaussian: the learner's features."""
    rows = powers(7, degree)
    factorials = np.array([factorial(k) for k in range(degree + 1)], float)[rows].prod(axis=1)
    per = 1 / (np.sqrt(factorials) if gaussian else factorials)
    middle = arm.limits.mean(axis=1)

    def features(q: np.ndarray) -> np.ndarray:
        u = (q - middle) / length
        table = u[None] ** np.arange(degree + 1)[:, None, None]
        phi = np.ones((len(q), len(rows))) * per
        for i in range(7):
            phi *= table[rows[:, i], :, i].T
        return phi * np.exp(-0.5 * (u**2).sum(axis=1))[:, None] if gaussian else phi

    return features


def waves(arm: Arm, count: int):
    """Products of sines and cosines about the middle, those of largest variance over the range."""
    half, middle = np.diff(arm.limits, axis=1)[:, 0] / 2, arm.limits.mean(axis=1)
    mean = np.sin(half) / half
    double = np.sin(2 * half) / (2 * half)
    variance = np.stack([np.ones(7), (1 - double) / 4, ((1 + double) / 2 - mean**2) / 2])
    rows = np.stack(np.meshgrid(*7 * [np.arange(3)], indexing="ij"), -1).reshape(-1, 7)
    rows = rows[np.argsort(-variance[rows, np.arange(7)].prod(axis=1), kind="stable")[:count]]

    def features(q: np.ndarray) -> np.ndarray:
        angle = q - middle
        table = np.stack([np.ones_like(angle), np.sin(angle), np.cos(angle) - mean])
        table[1:] *= np.sqrt(0.5)
        phi = np.ones((len(q), len(rows)))
        for i in range(7):
            phi *= table[rows[:, i], :, i].T
        return phi

    return features


def errors(arm: Arm, features, counts: tuple[int, ...], draws: int) -> list[float]:
    """At each count of samples: mean over the draws, best ridge."""
    found = np.zeros((len(counts), len(RIDGES)))
    for draw in range(draws):
        rng = np.random.default_rng(draw)
        q, test = arm.walk(counts[-1], rng), arm.uniform(1000, rng)
        x = arm.tip(q, TOOLS["none"]) + 0.0005 * rng.standard_normal((len(q), 3))
        truth, phi = arm.tip(test, TOOLS["none"]), features(test)
        p = phi.shape[1]
        square, cross, total, outputs = np.zeros((p, p)), np.zeros((p, 3)), np.zeros(p), np.zeros(3)
        done = 0
        for row, n in enumerate(counts):
            for begin in range(done, n, CHUNK):
                part = features(q[begin : min(begin + CHUNK, n)])
                square += part.T @ part
                cross += part.T @ x[begin : min(begin + CHUNK, n)]
                total += part.sum(axis=0)
                outputs += x[begin : min(begin + CHUNK, n)].sum(axis=0)
            done = n
            centred = square - np.outer(total, total) / n
            slope = cross - np.outer(total, outputs) / n
            for column, ridge in enumerate(RIDGES):
                w = np.linalg.solve(centred + ridge * np.eye(p), slope)
                error = (phi - total / n) @ w + outputs / n - truth
                found[row, column] += 1e3 * np.sqrt((error**2).mean(axis=0)).mean() / draws
    return list(found.min(axis=1))


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=3)
    parser.add_argument("--wide", action="store_true", help="joint ranges twice as wide")
    options = parser.parse_args()
    arm, counts = Arm(), (1000, 5000, 20000, 60000)
    if options.wide:
        middle = arm.limits.mean(axis=1, keepdims=True)
        arm.limits, counts = middle + 2 * (arm.limits - middle), (20000, 60000)
    maps = {"330 monomials, u^a / a!": monomials(arm, 1.0, False)}
    for length in (1.2, 1.5, 2.0):
        maps[f"330 under a Gaussian, length {length} rad"] = monomials(arm, length, True)
    for count in (330, 500):
        maps[f"{count} products of sines and cosines"] = waves(arm, count)
    if options.wide:
        maps["792 under a Gaussian, length 1.5 rad"] = monomials(arm, 1.5, True, 5)
    print("features | " + " | ".join(f"{n:,} samples" for n in counts))
    for name, features in maps.items():
        row = errors(arm, features, counts, options.draws)
        print(f"{name} | " + " | ".join(f"{value:.1f}" for value in row), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
