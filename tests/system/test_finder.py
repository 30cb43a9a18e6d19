"""reach-finder among those who ask it: reach-learner finds a body with it, two who ask get each
their own, it may be killed at any time, and what is no body is refused."""

import contextlib
import math
import struct
import tempfile
import time
import unittest
import zlib
from collections.abc import Callable
from pathlib import Path

import lcm
import numpy as np
from reach import Learner
from reach.bus import DEFAULT_URL
from reach.messages import reach as types
from reach.processes import Processes
from reach.programs import BINARIES

JOINTS, NOISE = 4, 5e-4  # m
# Axes and offsets of an arm, each in the frame of the joint before; the tip in the last one.
AXES = np.array([[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0]])
OFFSETS = np.array([[0, 0, 0.1], [0, 0, 0.2], [0.3, 0, 0], [0.25, 0, 0]])
TIP = np.array([0.05, 0.04, 0.02])
CONFIG = f"""inputs: {JOINTS}
outputs: 3
experts: body
degree: 2
capacity: 8
psi0: 1e-4
sigma0: 1
body.noise_share: {NOISE**2 / 1e-4:g}
"""
REPLY = types.learner_reply_t


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def place(joints: np.ndarray) -> np.ndarray:
    at = TIP
    for axis, offset, angle in reversed(list(zip(AXES, OFFSETS, joints, strict=True))):
        at = offset + turned(axis, angle) @ at
    return at


def samples(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    drawn = np.random.default_rng(seed)
    joints = drawn.uniform(-1.2, 1.2, (count, JOINTS))
    places = np.array([place(z) for z in joints])
    return joints, places + drawn.normal(0, NOISE, places.shape)


def request(count: int, seed: int, starts: int = 40) -> types.body_request_t:
    """As one who asks puts it."""
    joints, places = samples(count, seed)
    asked = types.body_request_t()
    asked.utime, asked.seq, asked.seed = time.time_ns() // 1000, 1, 1
    asked.n_joints, asked.angle_unit, asked.starts = JOINTS, 1.0, starts
    asked.noise, asked.gravity = [NOISE] * 3, [0.0, 0.0, -1.0]
    asked.n_contexts, asked.rigid[0], asked.count[0] = 1, 1, count
    asked.n_z, asked.n_x = joints.size, places.size
    asked.z, asked.x = joints.ravel().tolist(), places.ravel().tolist()
    return asked


class Finder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "model").mkdir()
        (self.folder / "arm.yaml").write_text(CONFIG)
        self.processes = self.enterContext(Processes(self.folder))
        self.bus = lcm.LCM(DEFAULT_URL)
        self.heard = {"REACH_BODY": [], "LEARNER_BODY": []}
        self.asked = []
        for channel in self.heard:
            self.bus.subscribe(channel, self.hear)
        self.bus.subscribe("LEARNER_BODY_REQUEST", self.hear_request)

    def hear(self, channel: str, data: bytes) -> None:
        with contextlib.suppress(ValueError, struct.error):  # nonsense of this test
            self.heard[channel].append(types.body_t.decode(data))

    def hear_request(self, _: str, data: bytes) -> None:
        self.asked.append(types.body_request_t.decode(data))

    def start_finder(self) -> None:
        self.processes.start("finder", [BINARIES / "reach-finder"])
        self.wait_until(lambda: "ready" in self.log("finder"), "the finder is ready")

    def start_learner(self, *options: str) -> Learner:
        self.processes.start("learner", [
            BINARIES / "reach-learner", "--config", self.folder / "arm.yaml",
            "--set", f"model.directory={self.folder / 'model'}", *options,
        ])  # fmt: skip
        return Learner(timeout=20)

    def wait_until(self, holds: Callable[[], bool], what: str, seconds: float = 30) -> None:
        end = time.monotonic() + seconds
        while not holds():
            self.assertLess(time.monotonic(), end, f"not in {seconds} s: {what}")
            self.bus.handle_timeout(20)
            self.processes.check()

    def log(self, name: str) -> str:
        return (self.folder / f"{name}.log").read_text()

    def wait_for_body(self, learner: Learner, body: int) -> None:
        self.wait_until(lambda: learner.statistics.body == body, f"statistics.body is {body}")

    def answers(self, channel: str, outcome: int) -> list:
        return [answer for answer in self.heard[channel] if answer.outcome == outcome]


class LearnersBody(Finder):
    def test_it_is_found_and_outlives_a_kill(self):
        self.start_finder()
        learner = self.start_learner()
        learner.update_all(*samples(30, 1))
        self.wait_for_body(learner, REPLY.BODY_FOUND)
        self.assertEqual(self.heard["REACH_BODY"], [])
        self.processes.kill("finder")  # so that no further body comes
        learner.update_all(*samples(20, 2))
        postures, _ = samples(20, 3)
        found = [learner.predict(z) for z in postures]
        off = [np.linalg.norm(p.values[0] - place(z)) for p, z in zip(found, postures, strict=True)]
        self.assertLess(max(off), 4 * NOISE)  # polynomials of 50 samples: centimetres
        self.processes.restart("learner")
        again = Learner(timeout=20)
        known = again.statistics
        self.assertEqual((known.body, known.samples), (REPLY.BODY_FOUND, 50))
        for z, before in zip(postures, found, strict=True):
            np.testing.assert_array_equal(again.predict(z).values, before.values)

    def test_a_finder_may_be_killed_and_come_late(self):
        learner = self.start_learner()
        learner.update_all(*samples(30, 1))
        self.wait_for_body(learner, REPLY.BODY_NO_FINDER)
        self.assertIn("no reach-finder is on the bus", self.log("learner"))
        # The next search is due with a quarter more samples.
        self.start_finder()
        learner.update_all(*samples(10, 2))
        self.wait_until(lambda: self.heard["LEARNER_BODY"], "an answer")
        self.processes.restart("finder")  # in the search, or after it
        self.wait_for_body(learner, REPLY.BODY_FOUND)


class TwoWhoAsk(Finder):
    def test_each_gets_its_own(self):
        """Both under the same name, while the finder is at work on a third."""
        self.start_finder()
        hard = request(14, 9, starts=60)  # too few samples: every start is made
        self.bus.publish("REACH_BODY_REQUEST", hard.encode())
        one, two = request(40, 1), request(60, 2)
        one.utime = two.utime
        one.seq = two.seq = 2
        self.bus.publish("REACH_BODY_REQUEST", one.encode())
        self.bus.publish("LEARNER_BODY_REQUEST", two.encode())
        found = types.body_t.FOUND
        self.wait_until(lambda: all(self.answers(c, found) for c in self.heard), "two bodies")
        self.assertEqual([a.samples for a in self.answers("REACH_BODY", found)], [40])
        self.assertEqual([a.samples for a in self.answers("LEARNER_BODY", found)], [60])
        # An answer that was lost comes again, though another was found since.
        self.bus.publish("REACH_BODY_REQUEST", one.encode())
        self.bus.publish("LEARNER_BODY_REQUEST", two.encode())
        self.wait_until(lambda: all(len(self.answers(c, found)) == 2 for c in self.heard),
                        "both again")  # fmt: skip
        for channel in self.heard:
            first, second = self.answers(channel, found)
            self.assertEqual(first.encode(), second.encode())

    def test_a_body_of_somebody_else_is_not_taken(self):
        """Neither what was found for reachd, nor for a reach-learner of before."""
        self.start_finder()
        self.bus.publish("REACH_BODY_REQUEST", request(40, 1).encode())
        self.wait_until(lambda: self.answers("REACH_BODY", types.body_t.FOUND), "a body")
        self.processes.kill("finder")
        body = self.answers("REACH_BODY", types.body_t.FOUND)[0]
        learner = self.start_learner()
        learner.update_all(*samples(16, 1))
        self.wait_until(lambda: self.asked, "a request")
        own = self.asked[0]
        body.seq, body.request_utime = own.seq, own.utime
        self.bus.publish("REACH_BODY", body.encode())
        body.request_utime -= 1
        self.bus.publish("LEARNER_BODY", body.encode())
        self.wait_for_body(learner, REPLY.BODY_NO_FINDER)


class Nonsense(Finder):
    def answer(self, numbers: list[float], checksum: int | None = None) -> bytes:
        """FOUND, to the request that waits."""
        answer = types.body_t()
        answer.utime, answer.outcome, answer.error = 1, types.body_t.FOUND, 1.0
        answer.seq, answer.request_utime = self.asked[0].seq, self.asked[0].utime
        answer.numbers = [*numbers, *[0.0] * (5841 - len(numbers))]
        if checksum is None:
            checksum = zlib.crc32(struct.pack("<5841d", *answer.numbers))
        answer.checksum = (checksum ^ 0x80000000) - 0x80000000
        return answer.encode()

    def test_it_is_refused_and_counted(self):
        learner = self.start_learner()
        learner.update_all(*samples(16, 1))
        self.wait_until(lambda: self.asked, "a request")
        whole = self.answer([])
        nonsense = [b"", whole[:-1], whole + b"x", types.hello_t().encode(), whole,
                    self.answer([4.0], checksum=1), self.answer([math.nan]),
                    self.answer([4.0] * 5841)]  # fmt: skip
        for data in nonsense:
            self.bus.publish("LEARNER_BODY", data)
        self.wait_until(lambda: learner.statistics.malformed == len(nonsense), "all counted")
        self.wait_for_body(learner, REPLY.BODY_NO_FINDER)

    def test_a_body_of_another_robot_is_said(self):
        """Sound in itself, but of one joint more."""
        self.start_finder()
        self.bus.publish("REACH_BODY_REQUEST", request(40, 1).encode())
        found = types.body_t.FOUND
        self.wait_until(lambda: self.answers("REACH_BODY", found), "a body")
        self.processes.kill("finder")
        learner = self.start_learner("--set", f"inputs={JOINTS - 1}")
        joints, places = samples(16, 1)
        learner.update_all(joints[:, 1:], places)
        self.wait_until(lambda: self.asked, "a request")
        body = self.answers("REACH_BODY", found)[0]
        self.bus.publish("LEARNER_BODY", self.answer(body.numbers))
        self.wait_until(lambda: "of no use: the body has 4 joints" in self.log("learner"), "a line")
        self.assertEqual(learner.statistics.body, REPLY.BODY_NONE)


if __name__ == "__main__":
    unittest.main()
