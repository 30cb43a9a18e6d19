"""The daemon as an object, for scripts and notebooks."""

import time
from collections.abc import Sequence

from .bus import DEFAULT_URL, Bus, NoAnswerError
from .messages import reach
from .metrics import star_targets
from .simulator import Simulator

MAX_TARGETS = 32
RESEND_SECONDS = 0.5
_SILENT_DAEMON = "reachd in {:g} s: it does not run, or no robot state reaches it"
_RESULTS = {
    reach.status_t.REFUSED_STATE: "refused, not in this state",
    reach.status_t.REFUSED_VALUE: "refused, a value is out of range",
    reach.status_t.FAILED: "failed, see its log",
}


class RefusedError(Exception):
    """The daemon will not do it, or has given it up."""


class Reach:
    """A client of a running reachd.

        robot = Reach()
        robot.babble(200)                  # teach it its arm
        status = robot.reach(-50, 20, 3)   # px, px, px; or x, y, z in metres
        print(status.error)

    Calls that start a behaviour return when it has ended, with the daemon's status and the last
    error of the behaviour; with wait=False as soon as it was accepted. RefusedError says why
    something was not done, NoAnswerError that nobody is there.
    """

    def __init__(self, url: str = DEFAULT_URL, timeout: float = 5.0):
        # Numbers of requests must differ from those of every client before.
        self._bus = Bus(url, request_seq=time.time_ns() // 1000)
        self._timeout = timeout
        self.sim = Simulator(self._bus, self._handle_until)

    @property
    def status(self) -> reach.status_t:
        """The daemon's next status."""
        self._bus.status = None
        self._handle_until(lambda: self._bus.status is not None)
        return self._bus.status

    def babble(self, samples: int, *, seed: int = 1, learn: bool = True, wait: bool = True):
        """Collects samples at random configurations, to learn from or (learn=False) to test."""
        return self._behave("BABBLE", wait, count=samples, seed=seed, learn=int(learn))

    def explore(self, samples: int, *, seed: int = 1, wait: bool = True):
        """Learns to reach from nothing, by goals of the robot's own."""
        return self._behave("EXPLORE", wait, count=samples, seed=seed, learn=1)

    def star(self, *, period: float = 4.0, learn: bool = True, wait: bool = True):
        """Reaches for 8 directions and back, from the centre of the babbled range."""
        return self._pursue("REACH", star_targets(), period, learn, wait, count=1)

    def reach(self, u: float, v: float, d: float, *, period: float = 4.0, learn: bool = True,
              wait: bool = True):  # fmt: skip
        """Brings the end-effector to (u, v) in the right image and disparity d, px; a robot whose
        task space is Cartesian takes x, y, z in m."""
        return self.reach_all([(u, v, d)], period=period, learn=learn, wait=wait)

    def reach_all(self, targets: Sequence[Sequence[float]], *, period: float = 4.0,
                  learn: bool = True, wait: bool = True):  # fmt: skip
        """One target after the other, each for `period` seconds; at most 32."""
        return self._pursue("REACH", targets, period, learn, wait)

    def coordinate(self, targets: Sequence[Sequence[float]], *, period: float = 2.0,
                   learn: bool = True, wait: bool = True):  # fmt: skip
        """The head looks at the targets, the arm keeps the ball where it looks."""
        return self._pursue("COORDINATE", targets, period, learn, wait)

    def stop(self):
        """Ends what it does."""
        return self._ask("STOP")

    def emergency(self):
        """Stops the arm at once; a fault until reset_fault."""
        return self._ask("EMERGENCY")

    def reset_fault(self):
        """Returns when the fault is left; RefusedError says that it is still there."""
        status = self._ask("RESET_FAULT")
        end = time.monotonic() + self._timeout
        while status.state == status.FAULT:
            if time.monotonic() > end:
                raise RefusedError("reachd is still in its fault state; reachctl status says why")
            status = self.status
        return status

    def body(self):
        """The body_t that the daemon goes by: the robot as it was found."""
        self._bus.body = None
        self._ask("TELL_BODY")
        self._handle_until(lambda: self._bus.body is not None)
        return self._bus.body

    def forget_body(self):
        """Gives up the body that was found, and has it searched for anew."""
        return self._ask("FORGET_BODY")

    def save(self, number: int):
        """Keeps the model under this number."""
        return self._ask("SAVE", count=number)

    def load(self, number: int):
        return self._ask("LOAD", count=number)

    def _pursue(self, kind: str, targets, period: float, learn: bool, wait: bool, **fields):
        rows = [[float(value) for value in target] for target in targets]
        if not 1 <= len(rows) <= MAX_TARGETS or any(len(row) != 3 for row in rows):
            raise ValueError(f"1 to {MAX_TARGETS} targets of three numbers are wanted")
        rows += [[0.0] * 3] * (MAX_TARGETS - len(rows))
        return self._behave(kind, wait, n_targets=len(targets), target=rows, period=period,
                            learn=int(learn), **fields)  # fmt: skip

    def _behave(self, kind: str, wait: bool, **fields):
        status = self._ask(kind, **fields)
        if not wait:
            return status
        number, at_work = status.request_seq, status
        while status.behaviour != status.NONE:
            at_work, status = status, self.status
            if status.request_seq != number:
                raise RefusedError("another request has replaced this one")
            if status.state == status.FAULT:
                raise RefusedError("reachd is in its fault state; reset_fault() leaves it")
        status.error = at_work.error  # the daemon's is 0 again: it has no target any more
        return status

    def _ask(self, kind: str, **fields):
        """Sends a request; returns the status that accepts it."""
        request = self._bus.prepare(getattr(reach.request_t, kind), **fields)
        # Repeats change nothing: the daemon may just be starting.
        self._bus.send(request)
        self._handle_until(
            lambda: self._bus.result_of(request) != reach.status_t.PENDING,
            lambda: self._send_again(request),
        )
        result = self._bus.result_of(request)
        if result != reach.status_t.ACCEPTED:
            raise RefusedError(f"reachd: {_RESULTS.get(result, 'unknown result')}")
        return self._bus.status

    def _send_again(self, request) -> None:
        # Numbers are of the clock: a greater one is somebody's later wish, not to be undone.
        if self._bus.status is None or self._bus.status.request_seq <= request.seq:
            self._bus.send(request)

    def _handle_until(self, done, send=lambda: None, who: str = _SILENT_DAEMON) -> None:
        """Until done(), sending now and then; `who` is silent otherwise, and perhaps why."""
        now = sent = time.monotonic()
        end = now + self._timeout
        while not done():
            now = time.monotonic()
            if now - sent > RESEND_SECONDS:
                send()
                sent = now
            if now > end:
                raise NoAnswerError(f"no answer from {who.format(self._timeout)}")
            self._bus.handle(0.01)
