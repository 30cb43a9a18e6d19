"""Seed and configuration decide a run: the same seed gives the same summary and the same commands,
another seed gives others, and no command depends on the truth being sent."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from reach import programs
from reach.bus import Bus
from reach.clock import HeldClock
from reach.experiment import Experiment
from reach.processes import Processes
from reach.progress import Progress
from reach.record import read_log

# As many as a body takes: what the search for it finds must be the same, too.
OPTIONS = ["--samples", "16", "--tool-samples", "3", "--tests", "2", "--period", "0.5"]


def demo(out: Path, seed: int) -> dict:
    command = [sys.executable, "-m", "reach.demo", "--out", out, "--seed", str(seed), *OPTIONS]
    subprocess.run([str(word) for word in command], check=True, capture_output=True)
    summary = json.loads((out / "summary.json").read_text())
    summary.pop("wall")
    return summary


def commands_of_babbling(out: Path, seed: int, *simrobot: str) -> dict[int, bytes]:
    """Motor commands of three babbled samples, by the state that each answers."""
    out.mkdir()
    with Processes(out) as processes:
        programs.start(processes, out, seed=seed, simrobot=simrobot)
        bus = Bus(programs.LISTENER_URL, processes.check)
        programs.wait_until_ready(bus)
        clock = HeldClock(bus)
        clock.advance(0.5)
        experiment = Experiment(bus, clock, Progress({}), [])
        experiment.babble("babble", 3, seed=8, learn=True)
    rows = read_log(out / "run.lcmlog")["ROBOT_COMMAND"]
    return {int(row["state_seq"]): row["velocity"].tobytes() for row in rows}


class SameRun(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_same_seed_same_summary(self):
        first = json.dumps(demo(self.folder / "a", 7))
        self.assertEqual(first, json.dumps(demo(self.folder / "b", 7)))
        self.assertIsNotNone(json.loads(first)["body"])
        # And the log of a whole experiment gives the run again.
        log = self.folder / "a/run.lcmlog"
        replay = [programs.BINARIES / "reachd", "--replay", log, "--verify"]
        result = subprocess.run(replay, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_seed_decides_the_commands_and_the_truth_does_not(self):
        with_truth = commands_of_babbling(self.folder / "truth", 3)
        without = commands_of_babbling(self.folder / "none", 3, "--no-truth")
        self.assertGreater(len(with_truth), 100)
        self.assertEqual(with_truth, without)
        self.assertNotEqual(with_truth, commands_of_babbling(self.folder / "other", 4))


if __name__ == "__main__":
    unittest.main()
