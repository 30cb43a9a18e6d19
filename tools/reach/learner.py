"""reach-learner as an object: maps with several values, learned by a process of its own."""

import random
import time
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

import lcm
import numpy as np

from .bus import DEFAULT_URL, NoAnswerError
from .client import RefusedError
from .messages import dtype_of, reach

RESEND_SECONDS = 0.2
WINDOW = 32  # requests under way at once; the service remembers twice as many
QUEUE = 200  # answers that may wait to be looked at
_REQUEST, _REPLY = reach.learner_request_t, reach.learner_reply_t
_PREDICTION = dtype_of("learner_prediction_t")
_CLIENT = slice(16, 24)  # where an encoded answer says whose it is
_LEARNED = {_REPLY.UPDATED: "updated", _REPLY.BORN: "born", _REPLY.OUTLIER: "outlier",
            _REPLY.FULL: "full", _REPLY.BEYOND: "beyond", _REPLY.FROZEN: "frozen"}  # fmt: skip
_TROUBLES = {
    _REPLY.MANY_FULL: "many samples are dropped: no expert is left",
    _REPLY.MANY_OUTLIERS: "many samples are dropped as outliers",
    _REPLY.FAR: "an input is many scales from its reference",
    _REPLY.CONSTANT: "an input does not change",
    _REPLY.STILL: "outputs stand still while inputs move",
    _REPLY.EXPERTS: "there are more experts than branches",
}
_REFUSALS = {
    _REPLY.FAILED: "the disk refuses, see its log",
    _REPLY.UNKNOWN_KIND: "it does not know this kind of request",
    _REPLY.DIMENSIONS: "other dimensions than its own",
    _REPLY.VALUE: "a number is not finite or out of range",
    _REPLY.FORGOTTEN: "the request is too old",
    _REPLY.NO_DIRECTORY: "it keeps no models: model.directory is empty",
}


class LateError(RefusedError):
    """The deadline was over before it was done: it was not, and will not be."""


class RestartedError(Exception):
    """The service was started anew while an update was under way: whether it was learned is not
    known. What was acknowledged before is safe; the next call goes on."""


@dataclass(frozen=True)
class Learned:
    """What became of a sample: updated or born (learned, by an expert that was there or by a new
    one), outlier, full, beyond or frozen (dropped); its number in the model's life; and whether it
    is safe on disk."""

    how: str
    sample: int
    stored: bool


@dataclass(frozen=True)
class Prediction:
    """Solutions, strongest first; n of them, none while nothing is known."""

    values: np.ndarray  # (n, outputs)
    variances: np.ndarray  # (n, outputs)
    weights: np.ndarray  # (n,), 0 .. 1
    jacobians: np.ndarray  # (n, outputs, inputs): dx / dz

    def __len__(self) -> int:
        return len(self.weights)


@dataclass(frozen=True)
class Inverse:
    """Inputs that give the output, strongest first: first guesses, to be checked by predict."""

    inputs: np.ndarray  # (n, inputs)
    variances: np.ndarray  # (n, inputs)
    weights: np.ndarray  # (n,), relative

    def __len__(self) -> int:
        return len(self.weights)


class Learner:
    """A client of a running reach-learner.

        learner = Learner()
        learner.update([0.1], [0.4])    # safe on disk when this returns, if it keeps its model
        print(learner.predict([0.1]).values)

    A call is sent again until it is answered, which does not do it twice, and given up after
    `timeout` seconds (NoAnswerError); what the service has not begun by then it will not do.
    `deadline`, in seconds from now, is for callers who have less time (LateError).
    """

    def __init__(self, url: str = DEFAULT_URL, timeout: float = 5.0):
        self._lcm = lcm.LCM(url)
        self._timeout = timeout
        self._client = random.SystemRandom().getrandbits(62)
        self._seq = 0
        self._answers: dict[int, object] = {}  # of what is under way; None until one comes
        for channel, take in (("LEARNER_REPLY", self._on_reply),
                              ("LEARNER_PREDICTION", self._on_prediction)):  # fmt: skip
            self._lcm.subscribe(channel, take).set_queue_capacity(QUEUE)
        known = self.statistics
        self.inputs, self.outputs = known.n_inputs, known.n_outputs

    @property
    def statistics(self) -> reach.learner_reply_t:
        """How the service is: samples, experts, what it refused and dropped."""
        return self._ask(self._request(_REQUEST.STATISTICS))

    @property
    def troubles(self) -> list[str]:
        """What is wrong with the newest samples; the service's log says more."""
        bits = self.statistics.troubles
        return [text for bit, text in _TROUBLES.items() if bits & bit]

    def update(self, z, x, *, deadline: float | None = None) -> Learned:
        """Learns that z gives x."""
        return _learned(self._ask(self._sample(z, x, deadline)))

    def update_all(self, zs: Iterable, xs: Iterable) -> list[Learned]:
        """Many samples, several of them under way at once; when a message is lost, its sample is
        learned after some that follow it."""
        pairs = zip(zs, xs, strict=True)
        answers = self._ask_all(self._sample(z, x, None) for z, x in pairs)
        return [_learned(answer) for answer in answers]

    def predict(self, z, *, deadline: float | None = None) -> Prediction:
        """All values that x may have at z."""
        request = self._request(_REQUEST.PREDICT, deadline, z=_padded(z, self.inputs, 16, "z"))
        found = self._ask(request)
        n, d, D = int(found["n_solutions"]), self.inputs, self.outputs
        return Prediction(*(_native(part) for part in (
            found["x"][:n, :D], found["x_variance"][:n, :D], found["weight"][:n],
            found["jacobian"][:n, :D, :d])))  # fmt: skip

    def predict_inverse(self, x, *, deadline: float | None = None) -> Inverse:
        """All z that are known to give x."""
        request = self._request(
            _REQUEST.PREDICT_INVERSE, deadline, x=_padded(x, self.outputs, 8, "x")
        )
        found = self._ask(request)
        n, d = int(found["n_solutions"]), self.inputs
        return Inverse(*(_native(part) for part in (
            found["z"][:n, :d], found["z_variance"][:n, :d], found["weight"][:n])))  # fmt: skip

    def save(self, number: int) -> None:
        """Keeps the model under this number, in the service's directory."""
        self._ask(self._request(_REQUEST.SAVE, number=number))

    def _sample(self, z, x, deadline: float | None) -> reach.learner_request_t:
        return self._request(_REQUEST.UPDATE, deadline, z=_padded(z, self.inputs, 16, "z"),
                             x=_padded(x, self.outputs, 8, "x"))  # fmt: skip

    def _request(self, kind: int, deadline: float | None = None, **fields):
        self._seq += 1
        request = _REQUEST()
        request.kind, request.client, request.seq = kind, self._client, self._seq
        request.utime = int(time.time() * 1e6)
        patience = self._timeout if deadline is None else deadline
        request.deadline = request.utime + int(patience * 1e6)
        if kind in (_REQUEST.UPDATE, _REQUEST.PREDICT, _REQUEST.PREDICT_INVERSE):
            request.n_inputs, request.n_outputs = self.inputs, self.outputs
        for name, value in fields.items():
            setattr(request, name, value)
        return request

    def _on_reply(self, _, data: bytes) -> None:
        if int.from_bytes(data[_CLIENT], "big") == self._client:
            reply = _REPLY.decode(data)
            self._take(reply.seq, reply)

    def _on_prediction(self, _, data: bytes) -> None:
        if int.from_bytes(data[_CLIENT], "big") == self._client:
            prediction = np.frombuffer(data, _PREDICTION)[0]
            self._take(int(prediction["seq"]), prediction)

    def _take(self, seq: int, answer) -> None:
        if seq in self._answers:
            self._answers[seq] = answer

    def _ask(self, request):
        return self._ask_all([request])[0]

    def _ask_all(self, requests: Iterable) -> list:
        """The answers, in order of the requests."""
        under_way, answers = deque(), []
        try:
            for request in requests:
                under_way.append(_UnderWay(self, request))
                if len(under_way) == WINDOW:
                    answers.append(self._first_answer(under_way))
            while under_way:
                answers.append(self._first_answer(under_way))
            return answers
        finally:
            for one in under_way:
                one.forget()

    def _first_answer(self, under_way: deque) -> object:
        """Waits for the oldest one's answer, and meanwhile keeps asking for all: each has
        `timeout` from its own sending, which it must not spend behind the others."""
        first = under_way[0]
        while (found := first.answer()) is None:
            for one in under_way:
                one.send_again_if_due()
            self._handle(0.05)
        under_way.popleft().forget()
        return found

    def _handle(self, seconds: float) -> None:
        self._lcm.handle_timeout(max(0, int(seconds * 1000)))


class _UnderWay:
    """A request that was sent and may have to be sent again."""

    def __init__(self, learner: Learner, request):
        self._learner, self._request = learner, request
        self._end = time.monotonic() + learner._timeout
        patience = (request.deadline - request.utime) * 1e-6
        self._give_up = time.monotonic() + patience  # what is left of it goes along
        self._times = 0
        self._send()

    def _send(self) -> None:
        self._times += 1
        self._sent = time.monotonic()
        self._request.utime = self._request.deadline - int((self._give_up - self._sent) * 1e6)
        self._learner._answers[self._request.seq] = None
        self._learner._lcm.publish("LEARNER_REQUEST", self._request.encode())

    def forget(self) -> None:
        self._learner._answers.pop(self._request.seq, None)

    def answer(self):
        """The last word on it, or None as long as there is none."""
        found = self._learner._answers[self._request.seq]
        if found is not None and not self._goes_on(found):
            return found
        if time.monotonic() > self._end:
            raise NoAnswerError(
                f"no answer from reach-learner in {self._learner._timeout:g} s: does it run?"
            )
        return None

    def send_again_if_due(self) -> None:
        unanswered = self._learner._answers[self._request.seq] is None
        if unanswered and time.monotonic() - self._sent > RESEND_SECONDS:
            self._send()

    def _goes_on(self, found) -> bool:
        """Whether this answer is not the last word."""
        if not isinstance(found, _REPLY) or found.status in (_REPLY.DONE, _REPLY.NOT_STORED):
            return False
        if found.status == _REPLY.BUSY:
            self._times -= 1  # not done
            self._learner._answers[self._request.seq] = None
            return True
        if found.status == _REPLY.UNKNOWN_CLIENT:
            return self._make_known()
        if found.status == _REPLY.LATE:
            raise LateError("reach-learner: the deadline was over")
        raise RefusedError(f"reach-learner: {_REFUSALS.get(found.status, 'unknown status')}")

    def _make_known(self) -> bool:
        """The service has begun anew. What was sent once was not done by the one that says so."""
        sent_once = self._times == 1
        self._learner._ask(self._learner._request(_REQUEST.STATISTICS))
        if not sent_once and self._request.kind == _REQUEST.UPDATE:
            raise RestartedError("reach-learner was started anew; was this sample learned?")
        self.forget()
        self._learner._seq += 1
        self._request.seq = self._learner._seq
        self._send()
        return True


def _padded(numbers, count: int, size: int, name: str) -> list[float]:
    row = np.asarray(numbers, dtype=float).reshape(-1)
    if len(row) != count:
        raise ValueError(f"{name} has {len(row)} numbers; wanted: {count}")
    return [*row.tolist(), *[0.0] * (size - count)]


def _native(array: np.ndarray) -> np.ndarray:
    """A copy in the machine's byte order."""
    return array.astype(float)


def _learned(reply: reach.learner_reply_t) -> Learned:
    return Learned(_LEARNED[reply.learned], reply.sample,
                   reply.status == _REPLY.DONE and reply.stored >= reply.sample)  # fmt: skip
