"""A double of pylibfranka: an arm that is in this process, follows with a lag, and ends a motion as
the real one does when a velocity leaps, or a joint leaves its range."""

import enum
import math
import time

LAG = 0.01  # s
PERIOD = 0.001  # s
ACCELERATION = 10.0 + 1e-6  # rad/s2
JERK = 5000.0 + 1e-6  # rad/s3
LOWEST = (-2.7437, -1.7837, -2.9007, -3.0421, -2.8065, 0.5445, -3.0159)
HIGHEST = (2.7437, 1.7837, 2.9007, -0.1518, 2.8065, 4.5169, 3.0159)
START = (0.0, -0.3, 0.0, -1.8, 0.0, 1.5, 0.8)


class FrankaException(Exception):  # noqa: N818
    pass


class ControlException(RuntimeError):  # noqa: N818
    pass


class RealtimeConfig(enum.Enum):
    kEnforce = 0  # noqa: N815
    kIgnore = 1  # noqa: N815


class ControllerMode(enum.Enum):
    JointImpedance = 0


class JointVelocities:
    def __init__(self, dq):
        self.dq = list(dq)
        self.motion_finished = False


class Duration:
    def __init__(self, seconds: float):
        self._seconds = seconds

    def to_sec(self) -> float:
        return self._seconds


class RobotState:
    def __init__(self, time: float):
        self.time = Duration(time)
        self.q, self.q_d = list(START), list(START)
        self.dq, self.dq_d = [0.0] * 7, [0.0] * 7
        self.O_T_EE = [0.0] * 12 + [0.3, 0.0, 0.5, 1.0]


class _Control:
    def __init__(self):
        self._state = RobotState(2.0)
        self._acceleration = [0.0] * 7
        self._due = time.monotonic()

    def readOnce(self):  # noqa: N802
        """On a busy machine it is late, and misses none: the real arm would end the motion."""
        self._due = max(self._due + PERIOD, time.monotonic())
        time.sleep(max(0.0, self._due - time.monotonic()))
        self._move()
        return self._state, Duration(PERIOD)

    def _move(self) -> None:
        state, share = self._state, 1 - math.exp(-PERIOD / LAG)
        state.time = Duration(state.time.to_sec() + PERIOD)
        for i in range(7):
            state.q_d[i] += state.dq_d[i] * PERIOD
            state.dq[i] = share * (state.q_d[i] - state.q[i]) / PERIOD
            state.q[i] += state.dq[i] * PERIOD

    def writeOnce(self, command: JointVelocities) -> None:  # noqa: N802
        for i in range(7):
            acceleration = (command.dq[i] - self._state.dq_d[i]) / PERIOD
            jerk = (acceleration - self._acceleration[i]) / PERIOD
            if not abs(acceleration) <= ACCELERATION or not abs(jerk) <= JERK:
                raise ControlException("joint_motion_generator_velocity_discontinuity")
            if not LOWEST[i] <= self._state.q_d[i] <= HIGHEST[i]:
                raise ControlException("joint_position_limits_violation")
            self._acceleration[i] = acceleration
            self._state.dq_d[i] = command.dq[i]
        if command.motion_finished and any(command.dq):
            raise ControlException("a motion ends while the arm moves")


class Robot:
    def __init__(self, address: str, config: RealtimeConfig):
        if address != "pretended":
            raise FrankaException(f"nobody is at {address}")

    def start_joint_velocity_control(self, mode: ControllerMode) -> _Control:
        return _Control()
