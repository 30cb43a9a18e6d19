"""Seed and configuration decide a run: the same seed gives the same summary and the same commands,
another seed gives others, and no command depends on the truth being sent."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from reach import demo, programs, summary
from reach.bus import Bus
from reach.clock import HeldClock
from reach.experiment import Experiment
from reach.processes import Processes
from reach.progress import Progress
from reach.record import read_log

# As many as a body takes: what the search for it finds must be the same, too.
OPTIONS = ["--samples", "16", "--tool-samples", "2", "--tests", "1", "--period", "0.5"]


def summary_of_demo(out: Path, seed: int) -> str:
    """Of a whole experiment, without its report and pictures, which take longer than the run."""
    options = demo.parse_arguments(["--out", str(out), "--seed", str(seed), *OPTIONS])
    phases = []
    out.mkdir()
    demo.run(options, phases)
    found = summary.summarise(read_log(out / "run.lcmlog"), demo.describe(options, phases, 1.0))
    found.pop("wall")
    return json.dumps(found)


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
        first = summary_of_demo(self.folder / "a", 7)
        self.assertEqual(first, summary_of_demo(self.folder / "b", 7))
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
