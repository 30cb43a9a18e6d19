"""The log is complete however seldom the recorder runs: the robot waits for it."""

import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import lcm
from reach.bus import DEFAULT_URL
from reach.event_log import events
from reach.experiment import Experiment
from reach.messages import reach as types
from reach.progress import Progress
from reach.record import read_log
from reach.session import Stop, session

SAMPLES = 3000  # of which one a tick
STOPS = 3
STOPPED = 0.7  # s, in which hundreds of ticks would pass


def disturb(pid: int) -> None:
    """Lets the recorder stand still for a while, again and again."""
    for _ in range(STOPS):
        time.sleep(0.3)
        os.kill(pid, signal.SIGSTOP)
        time.sleep(STOPPED)
        os.kill(pid, signal.SIGCONT)


def recorder_of(folder: Path) -> int:
    """Its process: the one that has this folder's log open."""
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        words = entry.read_bytes().split(b"\0")
        if b"reach.recorder" in words and str(folder / "run.lcmlog").encode() in words:
            return int(entry.parent.name)
    raise AssertionError("no recorder runs")


def record(log: Path, **settings) -> subprocess.Popen:
    """A recorder that has begun to record."""
    command = [sys.executable, "-m", "reach.recorder", "--url", DEFAULT_URL, "--channels",
               "SOME|MORE.*", log]  # fmt: skip
    there = log.exists()
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, **settings)
    end = time.monotonic() + 20
    while not there and not log.exists() and time.monotonic() < end:
        time.sleep(0.02)
    return process


def ended(process: subprocess.Popen) -> tuple[int, str]:
    """Its exit code and what it said."""
    _, said = process.communicate(timeout=20)
    return process.returncode, said


class ByHand(unittest.TestCase):
    """The recorder as a user starts it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log = Path(folder.name) / "run.lcmlog"
        self.bus = lcm.LCM(DEFAULT_URL)

    def publish(self, n: int) -> None:
        for i in range(n):
            self.bus.publish("SOME", b"%05d" % i + bytes(395))
        time.sleep(0.3)

    def test_interrupt_and_end_leave_a_whole_log(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = record(self.log)
                self.publish(20)
                self.bus.publish("SOMEBODY", b"begins with a name that is recorded")
                self.bus.publish("NOMORE", b"ends with one")
                process.send_signal(number)
                self.assertEqual(ended(process), (0, ""))
                gaps: list = []
                found = list(events(self.log, gaps))
                self.assertEqual([int(event.data[:5]) for event in found], list(range(20)))
                self.assertEqual(gaps, [])
                theirs = [(e.timestamp, e.channel, e.data) for e in lcm.EventLog(str(self.log))]
                self.assertEqual(theirs, [tuple(event) for event in found])
                self.log.unlink()

    def test_no_file_is_overwritten(self):
        self.log.write_bytes(b"of yesterday")
        code, said = ended(record(self.log))
        self.assertEqual((code, said.count("\n")), (1, 1), said)
        self.assertIn("run.lcmlog: is there already, and is not overwritten", said)
        self.assertEqual(self.log.read_bytes(), b"of yesterday")

    def test_a_full_disk_ends_it_with_a_line_and_the_log_with_an_event(self):
        limit = (20_000, 20_000)
        process = record(self.log, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                         limit))  # fmt: skip
        self.publish(200)
        code, said = ended(process)
        self.assertEqual((code, said.count("\n")), (1, 1), said)
        gaps: list = []
        n = len(list(events(self.log, gaps)))
        self.assertEqual((gaps, n), ([], 20_000 // (28 + 4 + 400)))
        self.assertIn(f"File too large; the log ends after {n} messages", said)

    def test_a_full_disk_is_no_answer(self):
        """Who waits for the recorder must not take what it could not write for written."""
        process = record(self.log, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                         (100, 100)))  # fmt: skip
        self.bus.publish("SOME", bytes(400))
        hello, answers = types.hello_t(), []
        hello.role = hello.RECORDER
        self.bus.subscribe("REACH_HELLO", lambda _, data: answers.append(
            types.hello_t.decode(data).answer))  # fmt: skip
        self.bus.publish("REACH_HELLO", hello.encode())
        self.assertEqual(ended(process)[0], 1)
        while self.bus.handle_timeout(200):
            pass
        self.assertEqual(answers, [0])


class Recorder(unittest.TestCase):
    def test_nothing_is_lost_while_it_stands_still(self):
        with tempfile.TemporaryDirectory() as name:
            folder, phases = Path(name), []
            with session(folder, Stop(), seed=1, robot="icub") as (bus, clock):
                thread = threading.Thread(target=disturb, args=[recorder_of(folder)])
                thread.start()
                experiment = Experiment(bus, clock, Progress({"babble": 1.0}), phases)
                experiment.babble("babble", SAMPLES, seed=1, learn=True)
                thread.join()
            record = read_log(folder / "run.lcmlog")
        self.assertEqual(record.lost(), 0)
        self.assertEqual(record.lost("ROBOT_STATE"), 0)
        self.assertGreaterEqual(len(record["REACH_SAMPLE"]), SAMPLES)


if __name__ == "__main__":
    unittest.main()
