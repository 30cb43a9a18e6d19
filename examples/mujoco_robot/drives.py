"""The drives and encoders of a robot, good and bad ones."""

import mujoco
import numpy as np

VELOCITY_GAIN = 200.0  # 1/s, over a joint's inertia
DAMPING_RATIO = 1.0  # of position drives


class Drive:
    """Torques that make an arm follow velocities, within what its motors have.

    Velocity drives by themselves, as in the robots that the paper used, or position drives of a
    stiffness (1/s2, over inertia) that follow the velocities' integral, as in most that are sold.
    """

    def __init__(self, arm, stiffness: float | None, sags: bool):
        self._arm, self._stiffness, self._sags = arm, stiffness, sags
        self._wanted = arm.positions.copy()

    def push(self, velocities: np.ndarray) -> None:
        """For the next step of the physics."""
        arm = self._arm
        inertia = _inertia(arm)
        if self._stiffness is None:
            torques = inertia @ (VELOCITY_GAIN * (velocities - arm.velocities))
        else:
            self._wanted += velocities * arm.step_length
            damping = 2 * DAMPING_RATIO * np.sqrt(self._stiffness)
            spring = self._stiffness * (self._wanted - arm.positions)
            torques = inertia @ (spring + damping * (velocities - arm.velocities))
        if not self._sags:
            torques = torques + arm.data.qfrc_bias[arm.dofs]
        arm.data.qfrc_applied[arm.dofs] = np.clip(torques, -arm.effort, arm.effort)


def _inertia(arm) -> np.ndarray:
    """Of the driven joints in the present posture: with it none feels what the others do."""
    full = np.zeros((arm.model.nv, arm.model.nv))
    mujoco.mj_fullM(arm.model, arm.data, full)
    return full[np.ix_(arm.dofs, arm.dofs)]


class Encoder:
    """Reads a motor's side of the gear, in rad: the joint is anywhere within the backlash."""

    def __init__(self, count: int, rng: np.random.Generator, noise: float, step: float,
                 backlash: float):  # fmt: skip
        self._rng, self._noise, self._step, self._play = rng, noise, step, backlash / 2
        self._motor = np.full(count, np.nan)

    def read(self, positions: np.ndarray) -> np.ndarray:
        motor = np.where(np.isnan(self._motor), positions, self._motor)
        self._motor = np.clip(motor, positions - self._play, positions + self._play)
        reading = self._motor + self._noise * self._rng.standard_normal(len(positions))
        return np.round(reading / self._step) * self._step if self._step > 0 else reading
