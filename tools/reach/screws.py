"""Arms on paper that are any chain of screws, with the same samples as the iCub-like one."""

from dataclasses import dataclass

import numpy as np

from .arm import Arm


def turned(axis: np.ndarray, angle: np.ndarray, v: np.ndarray) -> np.ndarray:
    """v (n x 3) turned about the unit vector `axis` by angle (n)."""
    across, along = np.cross(axis, v), axis * (v @ axis)[:, None]
    return v + np.sin(angle)[:, None] * across + (1 - np.cos(angle))[:, None] * (along - v)


@dataclass
class Chain(Arm):
    """Base to tip: offset, turn about an axis, offset, turn, ..., hand. Angles about `middle`."""

    axes: np.ndarray | None = None  # n x 3, unit vectors
    offsets: np.ndarray | None = None  # n x 3, m, each before its axis
    hand: np.ndarray | None = None  # from the last axis, m
    middle: np.ndarray | None = None  # rad

    def tip(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        v = np.broadcast_to(self.hand + tool, (len(q), 3))
        for i in reversed(range(len(self.axes))):
            v = self.offsets[i] + turned(self.axes[i], q[:, i] - self.middle[i], v)
        return v


def franka_like(rng: np.random.Generator) -> Chain:
    """The Franka's proportions, each length and axis a little off, over whole joint ranges."""
    axes = [[0, 0, 1], [0, 1, 0], [0, 0, 1], [0, -1, 0], [0, 0, 1], [0, -1, 0], [0, 0, -1]]
    offsets = [[0, 0, 0.333], [0, 0, 0], [0, 0, 0.316], [0.0825, 0, 0], [-0.0825, 0, 0.384],
               [0, 0, 0], [0.088, 0, 0]]  # fmt: skip
    axes = np.array(axes) + 0.02 * rng.standard_normal((7, 3))
    range_ = np.radians([166, 101, 166, 86, 166, 109, 166])
    middle = np.array([0, 0, 0, -1.6, 0, 1.9, 0])
    return Chain(
        limits=np.column_stack([middle - range_, middle + range_]),
        axes=axes / np.linalg.norm(axes, axis=1)[:, None],
        offsets=np.array(offsets) + 0.005 * rng.standard_normal((7, 3)),
        hand=np.array([0.05, 0.03, -0.207]) + 0.005 * rng.standard_normal(3),
        middle=0 * middle,
    )


def ten_joints(rng: np.random.Generator) -> Chain:
    """Random axes and lengths, every joint over +-170 degrees."""
    axes = rng.standard_normal((10, 3))
    offsets = 0.15 * rng.standard_normal((10, 3))
    offsets[0] *= 2
    return Chain(
        limits=np.radians(170) * np.tile([-1.0, 1.0], (10, 1)),
        axes=axes / np.linalg.norm(axes, axis=1)[:, None],
        offsets=offsets,
        hand=np.array([0.05, 0.08, 0.2]),
        middle=np.zeros(10),
    )


def sweeps(arm: Chain, each: int, reach: float, rng: np.random.Generator) -> np.ndarray:
    """From one posture each joint turned alone, there and back to the posture."""
    posture = 0.3 * arm.uniform(1, rng)[0]
    rows = []
    for joint in range(len(arm.limits)):
        q = np.tile(posture, (each, 1))
        q[:, joint] += np.linspace(-reach, reach, each)
        rows.append(q)
    return np.concatenate(rows)
