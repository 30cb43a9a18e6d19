"""Each learner as it ships learns fixations of the robots on paper, and is measured after so
many."""

import numpy as np

from .. import metrics
from ..paper import replay
from .gazing_arm import NOISE, GazingArm, another

TESTS = 200
HAND = (3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300, 500)  # samples of the hand
TUBE = (1, 2, *HAND)  # of the tube, after all of the hand
LEARNERS = replay.learners(replay.KOBIAN)
SEED = 20


def stream(arm: GazingArm, n: int, with_tube: bool, noise: np.ndarray,
           rng: np.random.Generator) -> np.ndarray:  # fmt: skip
    """Rows of joints and what the eyes see at them."""
    q = arm.postures(n, rng)
    x = arm.fixate(arm.place(q, with_tube))
    return np.hstack([q, x + noise * rng.standard_normal(x.shape)])


def percent(errors: np.ndarray, span: np.ndarray) -> list[float]:
    """Of the outputs' ranges, their mean, for every row of RMSE."""
    return np.mean(100 * errors / span, axis=1).tolist()


def draw(number: int) -> dict[str, dict[str, list[float]]]:
    """By learner and by what the hand holds: an error after each count, of the solution that is
    closest to the truth, in percent of the range that both test sets have together."""
    rng = np.random.default_rng([SEED, number])
    arm, found = another(rng), {}
    phases = [stream(arm, counts[-1], with_tube, NOISE, rng)
              for with_tube, counts in ((False, HAND), (True, TUBE))]  # fmt: skip
    tests = {name: stream(arm, TESTS, with_tube, 0 * NOISE, rng)
             for name, with_tube in (("hand", False), ("tube", True))}  # fmt: skip
    span = metrics.union_range(*(rows[:, 4:] for rows in tests.values()))
    at = np.array([*HAND, *(HAND[-1] + count for count in TUBE)])
    for learner in LEARNERS:
        errors = replay.curve(replay.KOBIAN, learner, phases, tests, at)
        found[learner] = {"hand": percent(errors["hand"][: len(HAND)], span),
                          "tube": percent(errors["tube"][len(HAND) :], span)}  # fmt: skip
    return found
