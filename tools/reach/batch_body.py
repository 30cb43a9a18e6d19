"""A batch fit of a robot's true structure to labelled samples, with numpy: what a learner on a body
is measured against, where the samples alone decide how good it can be.

The structure is that of docs/body.md, for robots of the Kobian's kind: four joints that turn, a tip
for each tool, a head that fixates. Samples are joints (rad), yaw, pitch (deg) and disparity (px).
"""

from dataclasses import dataclass

import numpy as np

from .curves.gazing_arm import GazingArm, rotation

LOOK = 80  # samples of the first tool, on which the chain is found
STEP = 1e-6


@dataclass
class Fit:
    """`unknowns` in the order of `_split`; residuals are over `noise` (deg, deg, px)."""

    noise: np.ndarray
    middle: np.ndarray  # of the joints
    disparity: tuple[float, float]  # middle and unit
    tools: int
    unknowns: np.ndarray

    def _split(self, v: np.ndarray) -> tuple[np.ndarray, ...]:
        n = len(self.middle)
        ends = np.cumsum([3 * n, 3 * n, 10, 3 * self.tools])
        axes, offsets, eyes, tips = np.split(v[: ends[-1]], ends[:-1])
        axes = axes.reshape(n, 3)
        axes = axes / np.linalg.norm(axes, axis=1)[:, None]
        return axes, offsets.reshape(n, 3), eyes, tips.reshape(self.tools, 3)

    def tip(self, v: np.ndarray, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        axes, offsets, _, tips = self._split(v)
        place = tips[tool]
        for i in reversed(range(len(axes))):
            a, w = (q[:, i] - self.middle[i])[:, None], axes[i]
            along = (place @ w)[:, None] * w
            place = (
                offsets[i] + along + np.cos(a) * (place - along) + np.sin(a) * np.cross(w, place)
            )
        return place

    def tip_of(self, q: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Of another tool, on the chain as it is."""
        hand, only = np.zeros(len(q), int), self.unknowns.copy()
        ends = []
        for tip in (np.zeros(3), *np.eye(3)):
            only[-3:] = tip
            ends.append(self.tip(only, q, hand))
        R = np.stack([end - ends[0] for end in ends[1:]], axis=2)
        return np.mean(np.einsum("nij,ni->nj", R, self.seen(only, x) - ends[0]), axis=0)

    def seen(self, v: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Where what the eyes say is, in their own unit of length."""
        eyes = self._split(v)[2]
        yaw, pitch = np.radians(x[:, 0]), np.radians(x[:, 1])
        d = (x[:, 2] - self.disparity[0]) / self.disparity[1]
        axis = np.array([1, eyes[6], eyes[7]]) / np.sqrt(1 + eyes[6] ** 2 + eyes[7] ** 2)
        depth = 1 / np.maximum(2 + d * (eyes[8] + d * eyes[9]), 0.02)
        p = eyes[3:6] + depth[:, None] * axis
        c, s = np.cos(pitch), np.sin(pitch)
        p = eyes[:3] + np.column_stack(
            [c * p[:, 0] + s * p[:, 2], p[:, 1], c * p[:, 2] - s * p[:, 0]]
        )
        c, s = np.cos(yaw), np.sin(yaw)
        return np.column_stack([c * p[:, 0] - s * p[:, 1], s * p[:, 0] + c * p[:, 1], p[:, 2]])

    def off(self, v: np.ndarray, q: np.ndarray, x: np.ndarray, tool: np.ndarray) -> np.ndarray:
        """What the tip is off by from x, as x would have to move, to first order."""
        here, J = self.seen(v, x), np.empty((len(x), 3, 3))
        for k, step in enumerate((1e-4, 1e-4, 1e-3)):
            moved = x.copy()
            moved[:, k] += step
            J[:, :, k] = (self.seen(v, moved) - here) / step
        J += 1e-12 * np.eye(3)
        return np.linalg.solve(J, (self.tip(v, q, tool) - here)[..., None])[..., 0]

    def predict(self, q: np.ndarray, tool: int, x: np.ndarray) -> np.ndarray:
        """Newton's steps from x on."""
        x, tools = x.copy(), np.full(len(q), tool)
        for _ in range(20):
            x += np.clip(self.off(self.unknowns, q, x, tools), -10, 10)
        return x

    def _left(self, v: np.ndarray, rows: tuple) -> np.ndarray:
        """Over the noise; behind it weak priors, which settle what no sample can."""
        n = len(self.middle)
        length = np.linalg.norm(v[: 3 * n].reshape(n, 3), axis=1) - 1
        eyes = v[6 * n : 6 * n + 10] - np.r_[np.zeros(8), 0.5, 0]
        rest = np.r_[v[3 * n : 6 * n], v[6 * n + 10 :]]
        return np.concatenate([(self.off(v, *rows) / self.noise).ravel(),
                               0.1 * length, 0.1 * rest, eyes])  # fmt: skip

    def improve(self, rows: tuple, steps: int) -> float:
        """Levenberg and Marquardt; returns what is left, rms, in units of the noise."""
        v, damping = self.unknowns, 1e-2
        left = self._left(v, rows)
        for _ in range(steps):
            J = np.empty((len(left), len(v)))
            for k in range(len(v)):
                moved = v.copy()
                moved[k] += STEP
                J[:, k] = (self._left(moved, rows) - left) / STEP
            H, g, before = J.T @ J, J.T @ left, left @ left
            for _ in range(8):
                other = v - np.linalg.solve(H + damping * np.diag(np.diag(H) + 1e-9), g)
                there = self._left(other, rows)
                if there @ there < before:
                    v, left, damping = other, there, damping / 5
                    break
                damping *= 5
            if not left @ left < before * (1 - 1e-7):
                break
        self.unknowns = v
        return float(np.sqrt(np.mean((self.off(v, *rows) / self.noise) ** 2)))


def _nominal(fit: Fit) -> np.ndarray:
    """Where to begin: a robot of the same kind on paper, in the eyes' unit of length. Half of it is
    the depth at the middle of all disparities."""
    arm, q = GazingArm(), fit.middle
    turned = [rotation(2, np.array(0.143117))]
    for axis, angle in zip((1, 0, 2, 1), q, strict=True):
        turned.append(turned[-1] @ rotation(axis, np.array(angle)))
    axes = [turned[i][:, axis] for i, axis in enumerate((1, 0, 2, 1))]
    elbow = turned[3] @ np.array([0, 0, -arm.upper_arm])
    depths, (right, ahead), (left, frame) = np.linspace(0.2, 0.8, 50), arm.eye(-1), arm.eye(1)
    seen = (right + depths[:, None] * ahead[:, 0] - left) @ frame
    d = (-arm.pixels * seen[:, 1] / seen[:, 0] - fit.disparity[0]) / fit.disparity[1]
    law = np.polyfit(d, 1 / depths, 2)[::-1]
    unit = law[0] / 2
    lengths = unit * np.concatenate([arm.shoulder, np.zeros(6), elbow, arm.neck, right])
    tip = unit * (turned[4] @ arm.hand)
    return np.concatenate([np.concatenate(axes), lengths, ahead[1:, 0] / ahead[0, 0],
                           law[1:] / unit, tip])  # fmt: skip


def fit(samples: list[np.ndarray], noise: tuple[float, ...]) -> Fit:
    """To the rows of each tool: four joints, then yaw, pitch and disparity."""
    q, x = ([rows[:, part] for rows in samples] for part in (slice(0, 4), slice(4, 7)))
    d = np.concatenate(x)[:, 2]
    best = Fit(np.array(noise), q[0].mean(axis=0), (d.mean(), 2 * d.std()), 1, np.empty(0))
    best.unknowns = _nominal(best)
    first = (q[0][:LOOK], x[0][:LOOK], np.zeros(min(LOOK, len(q[0])), int))
    best.improve(first, 100)
    for rows, seen in zip(q[1:], x[1:], strict=True):
        best.unknowns = np.r_[best.unknowns, best.tip_of(rows, seen)]
    best.tools = len(samples)
    tool = np.concatenate([np.full(len(rows), k) for k, rows in enumerate(samples)])
    best.improve((np.concatenate(q), np.concatenate(x), tool), 30)
    return best
