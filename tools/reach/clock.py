"""How an experiment lets robot time pass: held between its decisions, or real.

With the held clock (reach-simrobot --lockstep --hold) every request meets the robot at a definite
instant, so that seed and configuration decide the whole run.
"""

import time

from .bus import Bus, NoAnswerError
from .messages import reach

START_UTIME = 1_000_000  # where simulated time begins; us
PERIOD_US = 20_000
PIECE_US = 25 * PERIOD_US  # what is said meanwhile fits into a socket, with room to spare
SILENCE_SECONDS = 30.0


class HeldClock:
    """Simulated time that passes only in advance(); with `recorded`, only as fast as the recorder
    writes down what is said, however slow that is."""

    def __init__(self, bus: Bus, recorded: bool = False):
        self._bus = bus
        self._recorded = recorded
        self.now = START_UTIME

    def advance(self, seconds: float) -> None:
        """Lets so much robot time pass, on the grid of control periods."""
        end = self.now + round(seconds * 1e6 / PERIOD_US) * PERIOD_US
        while self.now < end:
            self.now = min(self.now + PIECE_US, end)
            self._bus.run_until(self.now)
            if self._recorded:
                self._bus.wait_for_role(reach.hello_t.RECORDER, "the recorder")

    def ask_daemon(self, request: reach.request_t) -> int:
        """Returns the request_result; the answer takes a tick or, for files, some."""
        while True:
            # Sent before each tick until it was looked at; the daemon ignores repeats.
            self._bus.send(request)
            self.advance(PERIOD_US * 1e-6)
            if (result := self._bus.result_of(request)) != reach.status_t.PENDING:
                return result


class RealClock:
    """The wall's time."""

    def __init__(self, bus: Bus):
        self._bus = bus
        self._heard = time.monotonic()

    @property
    def now(self) -> int:
        return self._bus.status.utime if self._bus.status else 0

    def advance(self, seconds: float) -> None:
        before = self.now
        self._bus.handle(seconds)
        if self.now != before:
            self._heard = time.monotonic()
        elif time.monotonic() - self._heard > SILENCE_SECONDS:
            raise NoAnswerError(f"no status from reachd in {SILENCE_SECONDS:g} s")

    def ask_daemon(self, request: reach.request_t) -> int:
        self._bus.wait(
            lambda: self._bus.result_of(request) != reach.status_t.PENDING,
            "reachd",
            lambda: self._bus.send(request),
        )
        return self._bus.result_of(request)
