"""An iCub-like arm on paper: the kinematics behind the reference data, and samples of it.

Inputs: waist yaw, roll, pitch; shoulder pitch, abduction, axial rotation; elbow (rad). Output: the
position of the tool's tip (m).
"""

from dataclasses import dataclass, field

import numpy as np

# Where the tip lies from the palm: along the stick's axis a, and b across it (m).
_A = np.array([np.cos(np.radians(20)), np.sin(np.radians(20)), 0])
_B = np.array([-np.sin(np.radians(20)), np.cos(np.radians(20)), 0])
TOOLS = {"none": 0 * _A, "stick": 0.28 * _A, "L": 0.48 * _A + 0.30 * _B}

_LIMITS = np.radians([[-30, 30], [-30, 30], [-10, 30], [-80, 0], [0, 80], [0, 80], [20, 80]])
PERIOD = 0.02  # s, of the control loop: a sample a tick


def _turn(v: np.ndarray, angle: np.ndarray, i: int, k: int) -> np.ndarray:
    """Turns the plane of axes i and k, from i towards k."""
    turned = v.copy()
    turned[..., i] = np.cos(angle) * v[..., i] - np.sin(angle) * v[..., k]
    turned[..., k] = np.sin(angle) * v[..., i] + np.cos(angle) * v[..., k]
    return turned


@dataclass
class Arm:
    forearm: float = 0.197
    upper_arm: float = 0.152
    shoulder: tuple[float, float, float] = (0, -0.11, 0.18)  # from the waist
    limits: np.ndarray = field(default_factory=lambda: _LIMITS.copy())  # 7 x 2, rad
    speed: float = np.radians(40)  # rad/s, of the fastest joint

    def tip(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        """q: n x 7 (real or complex). Rotation about x goes from y to z, about y from z to x."""
        v = np.zeros((*q.shape[:-1], 3), q.dtype) + tool + np.array([0, 0, -self.forearm])
        v = _turn(v, -q[..., 6], 2, 0)
        v = _turn(v, -q[..., 5], 0, 1) + np.array([0, 0, -self.upper_arm])
        v = _turn(v, -q[..., 4], 1, 2)
        v = _turn(v, q[..., 3], 2, 0) + np.array(self.shoulder)
        v = _turn(v, q[..., 2], 2, 0)
        v = _turn(v, q[..., 1], 1, 2)
        return _turn(v, q[..., 0], 0, 1)

    def jacobian(self, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
        """n x 3 x 7, by complex steps: exact to rounding."""
        step = 1e-30
        columns = [self.tip(q + 1j * step * np.eye(7)[k], tool).imag / step for k in range(7)]
        return np.stack(columns, axis=-1)

    def uniform(self, n: int, rng: np.random.Generator) -> np.ndarray:
        return rng.uniform(self.limits[:, 0], self.limits[:, 1], (n, len(self.limits)))

    def walk(self, n: int, rng: np.random.Generator, start: np.ndarray | None = None) -> np.ndarray:
        """From one random configuration to the next, all joints arriving together."""
        q = self.limits.mean(axis=1) if start is None else start
        parts, total = [], 0
        while total < n:
            goal = self.uniform(1, rng)[0]
            steps = int(np.ceil(np.abs(goal - q).max() / (self.speed * PERIOD)))
            parts.append(q + (goal - q) * (np.arange(1, steps + 1) / steps)[:, None])
            q, total = goal, total + steps
        return np.concatenate(parts)[:n]

    def swing(self, n: int, rng: np.random.Generator) -> np.ndarray:
        """A smooth trajectory: three slow sines a joint."""
        t = np.arange(n)[:, None, None] * PERIOD
        frequency, phase = rng.uniform(0.03, 0.15, (7, 3)), rng.uniform(0, 2 * np.pi, (7, 3))
        share = np.sin(2 * np.pi * frequency * t + phase).mean(axis=2)
        return self.limits.mean(axis=1) + share * np.diff(self.limits, axis=1)[:, 0] / 2
