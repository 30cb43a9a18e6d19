"""reach-learner as a process: several clients, lost messages, deadlines, kills, nonsense."""

import math
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from reach import LateError, Learner, NoAnswerError, RefusedError, RestartedError
from reach.bus import DEFAULT_URL
from reach.learner import _UnderWay
from reach.messages import ROOT
from reach.messages import reach as types
from reach.processes import Processes
from reach.programs import BINARIES

PROGRAM = BINARIES / "reach-learner"
CONFIG = ROOT / "etc/reach-learner.yaml"
OTHER_URL = DEFAULT_URL.replace("7667", "7668")


def branches(number: int) -> tuple[float, float]:
    """Sample `number` of a function that has two values everywhere; several of one of them in a
    row, since a single one that does not fit is taken for an outlier."""
    z = math.sin(1.7 * number) * 3
    return z, math.sin(z) if number // 5 % 2 else 3 + 0.5 * z


class Lossy:
    """A bus that loses messages, to and fro, at random."""

    def __init__(self, learner: Learner, chance: random.Random):
        self._bus, self._chance = learner._lcm, chance
        self.lost = 0
        learner._lcm = self
        self._take, learner._take = learner._take, self.take

    def publish(self, channel: str, data: bytes) -> None:
        if not self._loses():
            self._bus.publish(channel, data)

    def handle_timeout(self, milliseconds: int) -> int:
        return self._bus.handle_timeout(milliseconds)

    def take(self, seq: int, answer) -> None:
        if not self._loses():
            self._take(seq, answer)

    def _loses(self) -> bool:
        lost = self._chance.random() < 0.25
        self.lost += lost
        return lost


def chance() -> random.Random:
    seed = int(os.environ.get("REACH_TEST_SEED", time.time_ns() % 100000))
    print(f"REACH_TEST_SEED={seed}")
    return random.Random(seed)


class Service(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.model = self.folder / "model"
        self.model.mkdir()
        self.processes = self.enterContext(Processes(self.folder))

    def start(self, *options, name: str = "learner") -> None:
        self.processes.start(name, [PROGRAM, "--config", CONFIG, *options])

    def start_keeping(self) -> None:
        self.start("--set", f"model.directory={self.model}")

    def run_program(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True,
                              timeout=20)  # fmt: skip


class Requests(Service):
    def test_two_clients_teach_one_map(self):
        self.start()
        one, two = Learner(), Learner()
        for number in range(0, 400, 2):
            one.update(*branches(number))
            two.update(*branches(number + 1))
        found = two.predict(0.5)
        self.assertEqual(len(found), 2)
        order = np.argsort(found.values[:, 0])
        np.testing.assert_allclose(found.values[order, 0], [math.sin(0.5), 3.25], atol=0.03)
        np.testing.assert_allclose(found.jacobians[order, 0, 0], [math.cos(0.5), 0.5], atol=0.1)
        guess = one.predict_inverse(3.25).inputs[0]
        self.assertLess(np.abs(one.predict(guess).values - 3.25).min(), 0.1)
        known = one.statistics
        self.assertEqual((known.samples, known.repeated, known.stored), (400, 0, 0))

    def test_what_is_lost_and_sent_again_is_learned_once(self):
        self.start_keeping()
        clients = [Learner(), Learner()]
        drawn = chance()
        lines = [Lossy(client, drawn) for client in clients]
        for number in range(20):
            self.assertTrue(clients[number % 2].update(*branches(number)).stored)
        many = [branches(number) for number in range(20, 60)]
        numbers = [learned.sample for learned in clients[0].update_all(*zip(*many, strict=True))]
        self.assertEqual(sorted(numbers), list(range(21, 61)))
        known = Learner().statistics
        self.assertEqual(known.samples, 60)
        self.assertGreater(known.repeated, 0)
        self.assertGreater(min(line.lost for line in lines), 0)

    def test_what_is_late_is_refused(self):
        self.start()
        client = Learner()
        client.update(*branches(0))
        for call in (client.predict, client.predict_inverse):
            with self.assertRaises(LateError):
                call(0.1, deadline=-0.1)
        # In time when it was sent, and late when the service comes to it.
        os.kill(self.processes.pid("learner"), signal.SIGSTOP)
        self.addCleanup(os.kill, self.processes.pid("learner"), signal.SIGCONT)
        waker = subprocess.Popen(
            ["sh", "-c", f"sleep 0.5; kill -CONT {self.processes.pid('learner')}"]
        )
        with self.assertRaises(LateError):
            client.update(*branches(1), deadline=0.1)
        waker.wait()
        known = client.statistics
        self.assertEqual(known.samples, 1)
        self.assertGreaterEqual(known.late, 3)

    def test_the_example(self):
        self.start()
        command = [sys.executable, ROOT / "examples/learn_a_function.py"]
        result = subprocess.run(
            command, cwd=self.folder, capture_output=True, text=True, timeout=60
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        share, off = re.search(r"two values at (\d+)% of the places, at most (\S+) off",
                               result.stdout).groups()  # fmt: skip
        self.assertGreaterEqual(int(share), 95)
        self.assertLess(float(off), 0.1)
        self.assertGreater((self.folder / "learn_a_function.png").stat().st_size, 10_000)

    def test_trouble_is_told(self):
        """By each answer, by the client, and in the log: once."""
        self.start()
        client = Learner()
        walk = [3 * math.sin(0.05 * step) for step in range(200)]
        for z in walk:
            client.update(z, math.sin(z) + 0.001 * z)
        self.assertEqual(client.troubles, [])
        held = math.sin(walk[-1])
        answers = [client.update(z + 0.5, held) for z in walk]
        self.assertEqual(answers[-1].how, "frozen")
        self.assertEqual(client.troubles, ["outputs stand still while inputs move"])
        log = self.folder / "learner.log"
        until = time.monotonic() + 10
        while "stood still" not in log.read_text() and time.monotonic() < until:
            time.sleep(0.1)
        time.sleep(2.2)  # two more looks
        self.assertEqual(log.read_text().count("outputs stood still while inputs moved"), 1)
        learned = client.statistics
        self.assertEqual(learned.samples + learned.frozen, 400)

    def test_what_is_wrong_is_refused(self):
        self.start()
        client = Learner()
        for z, x in ((math.nan, 0), (0, math.inf), (2e9, 0)):
            with self.assertRaisesRegex(RefusedError, "not finite or out of range"):
                client.update(z, x)
        with self.assertRaisesRegex(RefusedError, r"model\.directory"):
            client.save(1)
        with self.assertRaisesRegex(ValueError, "z has 2 numbers; wanted: 1"):
            client.predict([1, 2])
        self.assertEqual(client.statistics.samples, 0)

    def test_nonsense_is_counted(self):
        self.start()
        client = Learner()
        drawn = chance()
        whole = types.learner_request_t().encode()
        nonsense = [b"", whole[:-1], whole + b"x", types.hello_t().encode()]
        nonsense += [drawn.randbytes(drawn.randrange(1500)) for _ in range(50)]
        for data in nonsense:
            client._lcm.publish("LEARNER_REQUEST", data)
        for _ in range(50):  # of the right type, with anything in it
            client._lcm.publish("LEARNER_REQUEST", whole[:8] + drawn.randbytes(len(whole) - 8))
        known = client.statistics
        self.assertEqual((known.malformed, known.samples), (len(nonsense), 0))
        self.assertEqual(known.refused + known.late, 50 - self.introductions(client))
        self.processes.check()

    def introductions(self, client) -> int:
        """Of the random requests, those that asked for statistics in time."""
        known = client.statistics
        return known.requests - 3 - known.refused - known.late  # three were the client's own

    def test_a_flood_is_outlived(self):
        self.start()
        # The client's own may be sent again while the flood is in their way.
        send = _UnderWay._send
        with mock.patch.object(_UnderWay, "_send", autospec=True, side_effect=send) as sent:
            client = Learner(timeout=20)
            request = client._request(types.learner_request_t.PREDICT, z=[0.5] + [0.0] * 15)
            for _ in range(8000):
                client._lcm.publish("LEARNER_REQUEST", request.encode())
            self.assertEqual(client.update(*branches(0)).sample, 1)
            known = client.statistics
        print(f"{known.requests} of 8000 requests taken, {known.dropped} dropped")
        self.assertGreater(known.requests, 256)  # more than its queue holds
        self.assertLessEqual(known.requests + known.dropped, 8000 + sent.call_count)


class Persistence(Service):
    def test_what_was_acknowledged_outlives_kills(self):
        """Killed at random while two clients teach; the model is that of the same samples without
        an interruption, as far as it goes."""
        self.start_keeping()
        clients = [Learner(timeout=20), Learner(timeout=20)]
        sent, safe, doubts = [], 0, 0
        for kill in range(4):
            for _ in range(20 + 7 * kill):
                sent.append(branches(len(sent)))
                safe = clients[len(sent) % 2].update(*sent[-1]).sample
                self.assertEqual(safe, len(sent))
            # One is under way when it happens.
            sent.append(branches(len(sent)))
            client = clients[len(sent) % 2]
            request = client._sample(*sent[-1], None)
            client._lcm.publish("LEARNER_REQUEST", request.encode())
            time.sleep(0.002 * kill)
            self.processes.restart("learner")
            found = Learner(timeout=20).statistics
            self.assertIn(found.samples, (safe, safe + 1))
            self.assertEqual(found.stored, found.samples)
            doubts += found.samples == safe + 1
            del sent[found.samples :]
        print(f"{doubts} of 4 samples under way were learned")
        self.same_as_uninterrupted(sent)

    def same_as_uninterrupted(self, sent: list) -> None:
        self.start("--url", OTHER_URL, name="other")
        other, this = Learner(OTHER_URL, timeout=20), Learner(timeout=20)
        for sample in sent:
            other.update(*sample)
        for z in np.linspace(-3, 3, 20):
            expected, found = other.predict(z), this.predict(z)
            np.testing.assert_array_equal(found.values, expected.values)
            np.testing.assert_array_equal(found.variances, expected.variances)
            np.testing.assert_array_equal(found.weights, expected.weights)

    def test_a_client_learns_of_a_restart(self):
        self.start_keeping()
        client = Learner(timeout=20)
        client.update(*branches(0))
        self.processes.restart("learner")
        other = Learner(timeout=20)  # it listens
        # Sent once to the service that does not know it: done by nobody before.
        self.assertEqual(client.update(*branches(1)).sample, 2)
        self.processes.kill("learner")
        waker = subprocess.Popen(["sleep", "1"])
        with self.assertRaises(RestartedError):
            self.update_while(client, waker)
        self.assertEqual(client.statistics.samples, 2)
        self.assertEqual(client.update(*branches(3)).sample, 3)
        self.assertEqual(other.statistics.samples, 3)

    def update_while(self, client: Learner, waker: subprocess.Popen) -> None:
        """Sends an update to nobody, again and again; then the service is there."""
        handle = client._handle

        def start_when_due(seconds: float) -> None:
            if waker.poll() is not None and not self.processes.runs("learner"):
                self.start_keeping()
            handle(seconds)

        client._handle = start_when_due
        client.update(*branches(2))

    def test_an_end_that_was_asked_for_keeps_everything(self):
        self.start_keeping()
        client = Learner()
        many = [branches(number) for number in range(300)]
        self.assertTrue(all(done.stored for done in client.update_all(*zip(*many, strict=True))))
        client.save(7)
        self.assertGreater((self.model / "model-7.imle").stat().st_size, 1000)
        process = self.processes.pid("learner")
        os.kill(process, signal.SIGTERM)
        self.assertEqual(os.waitpid(process, 0)[1], 0)
        checked = self.run_program("--config", CONFIG, "--set", f"model.directory={self.model}",
                                   "--check-model")  # fmt: skip
        self.assertIn("a model of 300 samples", checked.stdout)
        self.processes.kill("learner")
        self.start_keeping()
        self.assertEqual(Learner(timeout=20).statistics.stored, 300)

    def test_a_model_of_other_dimensions_is_refused(self):
        self.start_keeping()
        Learner(timeout=20).update(0, 0)
        self.processes.kill("learner")
        result = self.run_program("--config", CONFIG, "--set", f"model.directory={self.model}",
                                  "--set", "inputs=2")  # fmt: skip
        self.assertEqual(result.returncode, 1)
        self.assertIn("saved with other dimensions", result.stderr)


class Program(Service):
    def test_usage(self):
        for words, says in (
            ((), "--config is missing"),
            (("--nonsense",), "unrecognized option"),
            (("--config",), "--config: FILE is missing"),
            (("x",), "unexpected"),
        ):
            result = self.run_program(*words)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1))
            self.assertIn(says, result.stderr)
        self.assertRegex(self.run_program("--version").stdout, r"^reach-learner \d+\.\d+")
        self.assertIn("usage: reach-learner", self.run_program("--help").stdout)
        self.assertIn("model.directory", self.run_program("--help-options").stdout)

    def test_what_it_cannot_start_with(self):
        for setting, says in (("inputs=17", "out of range 1 .. 16"),
                              ("model.directory=/nonexistent", "No such file")):  # fmt: skip
            result = self.run_program("--config", CONFIG, "--set", setting)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn(says, result.stderr)

    def test_a_second_one_on_the_bus_ends(self):
        self.start()
        Learner(timeout=20)
        result = self.run_program("--config", CONFIG)
        self.assertEqual(result.returncode, 1)
        self.assertIn("another reach-learner is on this bus", result.stderr)

    def test_nobody_is_there(self):
        with self.assertRaisesRegex(NoAnswerError, "0.3 s"):
            Learner(timeout=0.3)


if __name__ == "__main__":
    unittest.main()
