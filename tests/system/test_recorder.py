"""The log is complete however seldom the recorder runs: the robot waits for it."""

import os
import signal
import tempfile
import threading
import time
import unittest
from pathlib import Path

from reach.experiment import Experiment
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
