"""A client on the bus: what daemon and simulator said last, and requests that are answered."""

import random
import time
from collections import deque
from collections.abc import Callable

import lcm

from .messages import bot_core, reach

DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
RESEND_SECONDS = 2.0  # a request that nobody looked at is sent again, which changes nothing
GIVE_UP_SECONDS = 30.0
QUEUE = 200  # messages of a channel that may wait; a full queue drops the newest
KEPT_SAMPLES = 100  # the newest


class NoAnswerError(Exception):
    """Somebody on the bus is silent."""


class Bus:
    """`check` is called after every look at the bus; it raises when there is no point in going on:
    a process has died, the user wants an end. Requests are numbered after `request_seq`."""

    def __init__(self, url: str = DEFAULT_URL, check: Callable[[], None] = lambda: None,
                 request_seq: int = 0):  # fmt: skip
        self._lcm = lcm.LCM(url)
        self._check = check
        self._request_seq = request_seq
        self._sim_seq = request_seq
        self._held_since: float | None = None  # by what the simulator says
        self._images: list = []
        self._image_subscription = None
        self.status: reach.status_t | None = None
        self.truth: reach.sim_truth_t | None = None
        self.marker: reach.marker_t | None = None
        self.body: reach.body_t | None = None
        self.samples: deque = deque(maxlen=KEPT_SAMPLES)
        self._roles: dict[int, int] = {}
        self._listen("REACH_STATUS", reach.status_t, lambda m: setattr(self, "status", m))
        self._listen("SIM_TRUTH", reach.sim_truth_t, lambda m: setattr(self, "truth", m))
        self._listen("MARKER", reach.marker_t, lambda m: setattr(self, "marker", m))
        self._listen("REACH_BODY_IN_USE", reach.body_t, lambda m: setattr(self, "body", m))
        self._listen("REACH_SAMPLE", reach.sample_t, self.samples.append)
        self._listen("REACH_HELLO", reach.hello_t, self._on_hello)

    def _listen(self, channel: str, kind, take: Callable):
        subscription = self._lcm.subscribe(channel, lambda _, data: take(kind.decode(data)))
        subscription.set_queue_capacity(QUEUE)
        return subscription

    def _on_hello(self, hello) -> None:
        if hello.answer:
            self._roles[hello.role] = hello.instance

    def handle(self, seconds: float) -> None:
        """Takes in what comes during this time, at least what is there already."""
        end = time.monotonic() + seconds
        while self._look(max(0, int((end - time.monotonic()) * 1000))):
            if time.monotonic() >= end:
                break

    def _look(self, milliseconds: int) -> bool:
        """Handles one message, when one comes in this time."""
        try:
            handled = self._lcm.handle_timeout(milliseconds) > 0
        except OSError:  # a signal broke into the call; what has failed for good is silent
            handled = False
        self._check()
        return handled

    def wait(self, done: Callable[[], bool], who: str, resend: Callable[[], None],
             progress: Callable[[], object] = lambda: None) -> None:  # fmt: skip
        """Handles messages until done(), sending again while progress() stands still.

        NoAnswerError names `who` when it has stood still for long.
        """
        moved = sent = time.monotonic()
        last = progress()
        resend()
        while not done():
            self._look(100)
            now = time.monotonic()
            if progress() != last:
                last, moved, sent = progress(), now, now
            if now - sent > RESEND_SECONDS:
                resend()
                sent = now
            if now - moved > GIVE_UP_SECONDS:
                raise NoAnswerError(f"no answer from {who} in {GIVE_UP_SECONDS:g} s")

    def wait_for_role(self, role: int, who: str) -> None:
        """Until a program of this role answers on REACH_HELLO."""
        hello = reach.hello_t()
        hello.utime, hello.role = int(time.time() * 1e6), role
        hello.instance = random.SystemRandom().getrandbits(62)
        self.wait(
            lambda: self._roles.get(role) == hello.instance,
            who,
            lambda: self._lcm.publish("REACH_HELLO", hello.encode()),
        )

    def forget(self) -> None:
        """The robot's time has begun anew: what was heard belongs to another."""
        self.status = self.truth = self.marker = None
        self.samples.clear()

    def prepare(self, kind: int, **fields) -> reach.request_t:
        """A request under a number of its own, not yet sent."""
        self._request_seq += 1
        return _fill(reach.request_t(), kind, self._request_seq, fields)

    def result_of(self, request: reach.request_t) -> int:
        """What the newest status says of it; PENDING also where it was not looked at yet."""
        status = self.status
        if status is not None and status.model_request_seq == request.seq:
            return status.model_result  # whatever else was asked since
        if status is not None and status.request_seq == request.seq:
            return status.request_result
        return reach.status_t.PENDING

    def send(self, request: reach.request_t) -> None:
        self._lcm.publish("REACH_REQUEST", request.encode())

    def prepare_simulator(self, kind: int, **fields) -> reach.sim_request_t:
        self._sim_seq += 1
        return _fill(reach.sim_request_t(), kind, self._sim_seq, fields)

    def tell_simulator(self, request: reach.sim_request_t) -> None:
        self._lcm.publish("SIM_REQUEST", request.encode())

    def ask_simulator(self, kind: int, **fields) -> None:
        """Returns when the simulator has carried it out."""
        request = self.prepare_simulator(kind, **fields)
        self.wait(
            lambda: self.truth is not None and self.truth.request_seq >= request.seq,
            "simrobot",
            lambda: self.tell_simulator(request),
        )

    def run_until(self, until: int) -> None:
        """Lets a held simulator run; returns when the daemon has ticked at `until`; us."""
        kind, first = reach.sim_request_t.RUN_UNTIL, self._sim_seq + 1

        def send() -> None:
            self.tell_simulator(self.prepare_simulator(kind, until=until))

        self._held_since = None
        self.wait(lambda: self._time() >= until or self._held_at(until, first),
                  "reachd or simrobot", send, self._time)  # fmt: skip

    def _held_at(self, until: int, first_seq: int) -> bool:
        """The status of that tick was lost on its way here, but the simulator, asked once more,
        stands there, and has done for so long that the daemon must have answered: a request that
        came before it does would meet another tick than in other runs."""
        truth = self.truth
        if truth is None or truth.request_seq <= first_seq or truth.utime < until:
            return False
        self._held_since = self._held_since or time.monotonic()
        return time.monotonic() - self._held_since > RESEND_SECONDS

    def _time(self) -> int:
        return self.status.utime if self.status else -1

    def take_images(self, on: bool) -> list:
        """Begins to keep stereo pairs, or ends it and hands out what was kept."""
        if on:
            self._images = []
            self._image_subscription = self._listen(
                "STEREO_IMAGES", bot_core.images_t, lambda m: self._images.append(m)
            )
        elif self._image_subscription is not None:
            self._lcm.unsubscribe(self._image_subscription)
            self._image_subscription = None
        return self._images


def _fill(message, kind: int, seq: int, fields: dict):
    message.kind, message.seq = kind, seq
    message.utime = int(time.time() * 1e6)
    for name, value in fields.items():
        if not hasattr(message, name):
            raise AttributeError(name)
        setattr(message, name, value)
    return message
