"""The numbers that a robot's configuration needs, from its URDF."""

from dataclasses import dataclass

import numpy as np

from .urdf import Arm, Joint

MOTION_SHARE = 2 / 3  # of the speed at which the safety gate cuts, as in the shipped configurations
USUAL_SPEED = 60.0  # deg/s, of the safety gate
USUAL_NOISE = 30.0  # deg/s, of explore.noise
WIDEST = 360.0  # deg: all that a joint which turns can do
POSTURES = 500  # for the arm's reach


@dataclass(frozen=True)
class Range:
    """Of a joint: deg; for one that slides m, with `unit` telling how many deg the daemon counts
    for one."""

    lower: float
    upper: float
    unit: float  # deg in the daemon's configuration for one of these
    remark: str

    @property
    def middle(self) -> float:
        return (self.lower + self.upper) / 2


def range_of(joint: Joint) -> Range:
    if joint.slides:
        return Range(
            joint.lower,
            joint.upper,
            float(np.degrees(1)),
            f"slides, {joint.lower:g} .. {joint.upper:g} m; a radian means a metre",
        )
    lower, upper = np.degrees([joint.lower, joint.upper])
    if not np.isfinite(upper - lower):
        return Range(-WIDEST / 2, WIDEST / 2, 1, "turns without end; one turn is all that it needs")
    if upper - lower > WIDEST + 0.01:
        middle = (lower + upper) / 2
        return Range(
            middle - WIDEST / 2,
            middle + WIDEST / 2,
            1,
            f"{lower:.0f} .. {upper:.0f} in the URDF; one turn is all that it needs",
        )
    return Range(float(lower), float(upper), 1, "as in the URDF")


@dataclass(frozen=True)
class Choices:
    ranges: list[Range]
    slowest: Joint
    safety_speed: float  # deg/s
    motion_speed: float
    explore_noise: float
    arm_reach: float  # m, half of how far apart the places of its tip lie
    scale_position: float  # m


def choose(arm: Arm, seed: int = 1) -> Choices:
    ranges = [range_of(joint) for joint in arm.joints]
    slowest = min(arm.joints, key=lambda joint: joint.velocity)
    safety = min(USUAL_SPEED, float(np.degrees(slowest.velocity)))
    motion = MOTION_SHARE * safety
    places = np.array([arm.place(q) for q in postures(arm, ranges, POSTURES, seed)])
    spread = float(np.ptp(places, axis=0).max() / 2)
    return Choices(
        ranges,
        slowest,
        safety,
        motion,
        min(USUAL_NOISE, 0.75 * motion),
        spread,
        float(f"{max(2 / 3 * spread, 0.01):.2g}"),
    )


def postures(arm: Arm, ranges: list[Range], count: int, seed: int) -> np.ndarray:
    """Random ones, anywhere in the range less what the daemon keeps from limits; rad, m."""
    rng = np.random.default_rng(seed)
    turning = np.array([not joint.slides for joint in arm.joints])
    to_si = np.where(turning, np.pi / 180, 1.0)
    ends = np.array([[r.lower, r.upper] for r in ranges])
    margin = np.minimum(0.01 * np.ptp(ends, axis=1), 1.0)
    return rng.uniform(ends[:, 0] + margin, ends[:, 1] - margin, (count, len(ranges))) * to_si
