"""A robot in a few lines: joints that do what they are told, 50 times a second, and no eyes."""

import math
import time

import lcm
from reach.bus import DEFAULT_URL
from reach.messages import reach

PERIOD = 0.02  # s
START = [math.radians(x) for x in (-65, -17.5, 0, -65, -22, 3)]
_RESULTS = {
    reach.status_t.ACCEPTED: "accepted",
    reach.status_t.REFUSED_STATE: "refused, not in this state",
    reach.status_t.REFUSED_VALUE: "refused, a value is out of range",
    reach.status_t.FAILED: "failed",
}


class Robot:
    """Moves while `run` runs. `commands` are all that came, oldest first."""

    def __init__(self):
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._position = list(START)
        self._velocity = [0.0] * len(START)
        self._seq = 0
        self.commands: list[list[float]] = []
        self.status = None
        self._lcm.subscribe("ROBOT_COMMAND", self._on_command)
        self._lcm.subscribe("REACH_STATUS", self._on_status)

    def _on_command(self, _, data):
        command = reach.robot_command_t.decode(data)
        self._velocity = list(command.velocity[: command.n_joints])
        self.commands.append(self._velocity)

    def _on_status(self, _, data):
        self.status = reach.status_t.decode(data)

    def run(self, seconds: float, done=lambda: False) -> bool:
        """So long, or until done(). Returns what done() said last."""
        end = time.monotonic() + seconds
        due = time.monotonic()
        while time.monotonic() < end and not done():
            self._publish_state()
            due += PERIOD
            while (left := due - time.monotonic()) > 0:
                self._lcm.handle_timeout(int(left * 1000) + 1)
            self._position = [
                q + v * PERIOD for q, v in zip(self._position, self._velocity, strict=True)
            ]
        return done()

    def stand(self, done) -> None:
        """Says where it is until done(), and listens to nobody."""
        due = time.monotonic()
        while not done():
            self._publish_state()
            due += PERIOD
            time.sleep(max(0.0, due - time.monotonic()))

    def request(self, kind: int, **fields) -> int:
        """Sends it; its number."""
        request = reach.request_t()
        request.utime = request.seq = time.time_ns() // 1000
        request.kind = kind
        for name, value in fields.items():
            setattr(request, name, value)
        self._lcm.publish("REACH_REQUEST", request.encode())
        return request.seq

    def refusals(self, channel: str, data: bytes) -> str:
        """How many messages the daemon has refused after this one came, more than before."""
        before = self.status.bad_inputs
        self._lcm.publish(channel, data)
        self.run(0.2)
        return f"{self.status.bad_inputs - before} refused"

    def answer(self, **fields) -> str:
        """What the daemon makes of a request."""
        sent = self.request(**fields)
        self.run(2, lambda: self.status.request_seq == sent)
        return _RESULTS[self.status.request_result]

    def idle(self) -> bool:
        return self.run(1, lambda: self.status.state == reach.status_t.IDLE)

    def _publish_state(self) -> None:
        self._lcm.publish("ROBOT_STATE", self.state_message())

    def state_message(self) -> bytes:
        self._seq += 1
        state = reach.robot_state_t()
        state.utime = time.time_ns() // 1000
        state.seq = self._seq
        state.n_joints = len(START)
        state.position[: len(START)] = self._position
        state.velocity[: len(START)] = self._velocity
        return state.encode()
