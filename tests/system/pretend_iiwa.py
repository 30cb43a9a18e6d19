"""A double of an iiwa, by the bytes of Drake's messages and not by our description of them: joints
that follow their set-points with a lag, and say where they are 200 to 1,000 times a second."""

import math
import struct
import time

import lcm
from reach.bus import DEFAULT_URL
from reach.messages import reach as types

JOINTS = 7
# As programs of others compute them from Drake's types (pydrake 1.51.1).
STATUS_FINGERPRINT = 0xF16FB804284ABCA3
COMMAND_FINGERPRINT = 0xDDC7C7738C815334
LAG = 0.02  # s


class PretendIiwa:
    """Moves while `run` runs. `set_points` are all that came, oldest first; `states` what the
    driver told of it."""

    def __init__(self, start: list[float], rate: float):
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._lcm.subscribe("IIWA_COMMAND", self._on_command).set_queue_capacity(1000)
        self._lcm.subscribe("ROBOT_STATE", self._on_state).set_queue_capacity(1000)
        self.q = list(start)
        self.period = 1 / rate
        self._commanded = list(start)
        self._velocity = [0.0] * JOINTS
        self._utime = 5_000_000
        self._seq = 0
        self.statuses = 0
        self.set_points: list[list[float]] = []
        self.states: list = []
        self.effector = None  # a function of q, for END_EFFECTOR

    def run(self, seconds: float, velocity=None, done=lambda: False) -> bool:
        """So long, or until done(); with commands of these velocities every 20 ms. All of it by the
        arm's cycles: on a busy machine it is slower, and the same."""
        due, often = time.monotonic(), max(1, round(0.02 / self.period))
        for cycle in range(round(seconds / self.period)):
            if done():
                break
            if velocity is not None and cycle % often == 0:
                self._command(velocity)
            self._tell()
            due = max(due + self.period, time.monotonic())
            while (left := due - time.monotonic()) > 0:
                self._lcm.handle_timeout(max(1, round(left * 1000)))
            while self._lcm.handle_timeout(0):
                pass
            self._follow()
        return done()

    def _command(self, velocity) -> None:
        message = types.robot_command_t()
        message.n_joints = JOINTS
        message.velocity[:JOINTS] = velocity
        self._lcm.publish("ROBOT_COMMAND", message.encode())

    def _tell(self) -> None:
        zero = [0.0] * JOINTS
        values = [*self.q, *self._velocity, *self._commanded, *self._commanded, *zero, *zero, *zero]
        self.statuses += 1
        self._lcm.publish(
            "IIWA_STATUS",
            struct.pack(">Qqi49d", STATUS_FINGERPRINT, self._utime, JOINTS, *values),
        )
        if self.effector and self.statuses % max(1, round(0.02 / self.period)) == 0:
            self._seq += 1
            measured = types.end_effector_t()
            measured.utime, measured.seq = time.time_ns() // 1000, self._seq
            measured.position = self.effector(self.q)
            self._lcm.publish("END_EFFECTOR", measured.encode())

    def _follow(self) -> None:
        share = 1 - math.exp(-self.period / LAG)
        for i in range(JOINTS):
            step = share * (self._commanded[i] - self.q[i])
            self.q[i] += step
            self._velocity[i] = step / self.period
        self._utime += round(self.period * 1e6)

    def _on_command(self, _, data) -> None:
        fingerprint, _, n, *position, torques = struct.unpack(">Qqi7di", data)
        if (fingerprint, n, torques) != (COMMAND_FINGERPRINT, JOINTS, 0):
            raise ValueError(f"no command: {fingerprint:#x}, {n} joints, {torques} torques")
        self._commanded = position
        self.set_points.append(position)

    def _on_state(self, _, data) -> None:
        self.states.append(types.robot_state_t.decode(data))
