"""Which rows are learned, which choose the parameters, and which judge the outcome."""

from dataclasses import dataclass

import numpy as np

from .data import Samples

BLOCKS = 25  # of neighbouring rows
_EVERY = 5  # of five blocks one chooses, one judges
_MOST_HELD_OUT = 1500


@dataclass(frozen=True)
class Parts:
    learn: Samples
    choose: Samples
    both: Samples  # the two above, in order: learned before it is judged
    judge: Samples  # seen by no trial


def split(samples: Samples) -> Parts:
    """Whole blocks, spread over the stream: neighbours of a walk are alike, so that a single row
    that is held out would be known already; and what came late, such as another tool, must be in
    every part."""
    block = np.arange(len(samples)) * BLOCKS // len(samples) % _EVERY
    choose, judge = block == 1, block == 3
    return Parts(
        samples.rows(~choose & ~judge), _some(samples, choose),
        samples.rows(~judge), _some(samples, judge),
    )  # fmt: skip


def _some(samples: Samples, which: np.ndarray) -> Samples:
    rows = np.flatnonzero(which)
    return samples.rows(rows[:: -(-len(rows) // _MOST_HELD_OUT)])


def thin(samples: Samples, most: int) -> Samples:
    """At most so many rows: stretches of neighbours, in order, spread over the whole stream."""
    if len(samples) <= most:
        return samples
    stretches = 40
    length = max(1, most // stretches)
    starts = np.linspace(0, len(samples) - length, stretches).astype(int)
    return samples.rows(np.unique((starts[:, None] + np.arange(length)).ravel()))


def counts_up_to(n: int, points: int = 12) -> list[int]:
    """After how many samples to measure, for a curve."""
    return sorted({int(c) for c in np.geomspace(min(20, n), n, points).round()})
