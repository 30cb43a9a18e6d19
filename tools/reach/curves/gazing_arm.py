"""A Kobian-like robot on paper: an arm of four joints whose ball two eyes fixate.

Proportions are those of etc/robots/kobian.urdf. A fixation is exact: the head turns until the ball
lies on the right eye's axis, and the left eye sees how far it is.
"""

from dataclasses import dataclass, field

import numpy as np

# Standard deviations of a fixation's yaw, pitch (rad) and disparity (px), as in ./run demo.
NOISE = np.array([np.radians(0.015), np.radians(0.015), 0.12])
# Where it babbles: shoulder pitch, yaw and roll, elbow; rad.
RANGE = np.radians([[-70, -60], [-30, -5], [-15, 15], [-90, -40]])
HAND = np.array([0.014, 0, -0.25])  # from the elbow, m
TUBE = HAND + 0.35 * np.array([0.209, 0.975, -0.078])
SAG = 0.03  # m, what the tube gives way to gravity when it lies across
_DOWN = np.array([0, 0, -1.0])


def rotation(axis: int, angle) -> np.ndarray:
    """About x, y or z, for every angle: (..., 3, 3)."""
    i, k = (axis + 1) % 3, (axis + 2) % 3
    result = np.zeros((*np.shape(angle), 3, 3))
    result[..., axis, axis] = 1
    result[..., i, i] = result[..., k, k] = np.cos(angle)
    result[..., k, i], result[..., i, k] = np.sin(angle), -np.sin(angle)
    return result


@dataclass
class GazingArm:
    upper_arm: float = 0.32
    hand: np.ndarray = field(default_factory=HAND.copy)
    tube: np.ndarray = field(default_factory=TUBE.copy)
    shoulder: np.ndarray = field(default_factory=lambda: np.array([0.037, -0.156, 0]))
    neck: np.ndarray = field(default_factory=lambda: np.array([-0.038, 0, 0.270]))
    eyes: np.ndarray = field(default_factory=lambda: np.array([0.077, 0, 0.032]))  # from the neck
    half_base: float = 0.045  # m, of an eye from the middle
    tilt: float = np.radians(23.4)  # of both eyes, downwards
    inward: float = np.radians(5.122)  # of each eye
    pixels: float = 1200.0  # in a radian

    def place(self, q: np.ndarray, with_tube: bool) -> np.ndarray:
        """Of the ball, n x 3, m."""
        frame = rotation(2, np.array(0.143117)) @ rotation(1, q[:, 0]) @ rotation(0, q[:, 1])
        frame = frame @ rotation(2, q[:, 2])
        fore = frame @ rotation(1, q[:, 3])
        tip = self.tube if with_tube else self.hand
        down = fore.transpose(0, 2, 1) @ _DOWN
        if with_tube:
            along = (self.tube - self.hand) / np.linalg.norm(self.tube - self.hand)
            tip = tip + SAG * (down - np.outer(down @ along, along))
        upper = frame @ np.array([0, 0, -self.upper_arm])
        return self.shoulder + upper + (fore @ np.broadcast_to(tip, down.shape)[..., None])[..., 0]

    def eye(self, side: int) -> tuple[np.ndarray, np.ndarray]:
        """Where it is in the head, and its frame there, x ahead; side 1 is left, -1 right."""
        at = self.eyes + rotation(1, self.tilt) @ np.array([0, side * self.half_base, 0])
        return at, rotation(1, self.tilt) @ rotation(2, -side * self.inward)

    def fixate(self, place: np.ndarray) -> np.ndarray:
        """Head yaw and pitch (rad) and the disparity (px) with which the ball is seen: n x 3."""
        right, axis = self.eye(-1)[0], self.eye(-1)[1][:, 0]
        v = place - self.neck
        half = right @ axis  # |right + s axis| = |v|
        s = -half + np.sqrt(half**2 + (v**2).sum(axis=1) - right @ right)
        gaze = right + s[:, None] * axis
        pitch = np.arccos(v[:, 2] / np.hypot(gaze[:, 0], gaze[:, 2]))
        pitch -= np.arctan2(gaze[:, 0], gaze[:, 2])
        ahead = np.cos(pitch) * gaze[:, 0] + np.sin(pitch) * gaze[:, 2]
        yaw = np.arctan2(v[:, 1], v[:, 0]) - np.arctan2(gaze[:, 1], ahead)
        left, frame = self.eye(1)
        seen = (gaze - left) @ frame
        disparity = -self.pixels * seen[:, 1] / seen[:, 0]  # u grows to the right
        return np.stack([yaw, pitch, disparity], axis=1)

    def postures(self, n: int, rng: np.random.Generator) -> np.ndarray:
        return rng.uniform(RANGE[:, 0], RANGE[:, 1], (n, len(RANGE)))


def another(rng: np.random.Generator) -> GazingArm:
    """Lengths up to a tenth off."""
    arm = GazingArm()
    arm.upper_arm *= rng.uniform(0.9, 1.1)
    arm.hand = arm.hand * rng.uniform(0.9, 1.1)
    arm.tube = arm.hand + (TUBE - HAND) * rng.uniform(0.9, 1.1)
    return arm
