"""What the loop thread promises after its start, looked at from outside, while the real daemon
babbles in lockstep and in real time: no allocation, lock, file or socket call, no page fault,
little locked memory."""

import os
import tempfile
import unittest
from pathlib import Path

from reach import programs
from reach.bus import DEFAULT_URL, Bus
from reach.messages import ROOT
from reach.messages import reach as types
from reach.processes import Processes
from robot_in_trouble import may_run_in_real_time

SHIM = Path(os.environ["REACH_BUILD_DIR"]) / "tests/libloop_calls.so"
MOST_LOCKED = 64 * 1024  # kB
# The largest that the learner may be.
CAPACITY = ("--config", ROOT / "etc/learner-linear.yaml", "--set", "learner.capacity=1024")


class LoopPromises(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "model").mkdir()

    def babble(self, clock: str, daemon_clock: tuple, samples: int) -> types.status_t:
        """Some samples with the shim in the daemon, whose model is kept on disk. Returns the last
        status; the memory that was locked remains in self.locked, kB."""
        etc, url = ROOT / "etc", ("--url", DEFAULT_URL)
        with Processes(self.folder) as processes:
            processes.start(
                "reachd", ["env", f"LD_PRELOAD={SHIM}", f"REACH_LOOP_CALLS={self.folder / 'calls'}",
                           programs.BINARIES / "reachd", "--config", etc / "kobian.yaml", *CAPACITY,
                           "--set", f"model.directory={self.folder / 'model'}", *url,
                           *daemon_clock],
            )  # fmt: skip
            processes.start("vision", [programs.BINARIES / "reach-vision", "--config",
                                       etc / "vision-kobian.yaml", *url])  # fmt: skip
            processes.start("simrobot", [programs.BINARIES / "reach-simrobot", "--config",
                                         etc / "simrobot-kobian.yaml", *url, clock])  # fmt: skip
            bus = Bus(check=processes.check)
            bus.wait(lambda: bus.status and bus.status.state == types.status_t.IDLE, "reachd",
                     lambda: None)  # fmt: skip
            request = bus.prepare(types.request_t.BABBLE, count=samples, seed=2, learn=1)
            bus.wait(lambda: bus.status.request_seq == request.seq, "reachd",
                     lambda: bus.send(request))  # fmt: skip
            bus.wait(lambda: bus.status.behaviour == types.status_t.NONE, "reachd", lambda: None,
                     lambda: bus.status.progress)  # fmt: skip
            status = Path(f"/proc/{processes.pid('reachd')}/status").read_text()
            self.locked = int(status.split("VmLck:")[1].split()[0])
            self.said = (self.folder / "reachd.log").read_text()
        return bus.status

    def assert_calls_nothing(self) -> None:
        first, *called = (self.folder / "calls").read_text().split("\n")
        self.assertEqual(first, "seen")
        self.assertEqual([name for name in called if name], [])

    def test_lockstep(self):
        status = self.babble("--lockstep", ("--lockstep",), 6)
        self.assertEqual(status.samples, 6)
        self.assert_calls_nothing()

    @unittest.skipUnless(may_run_in_real_time(), "no right to real-time priority here")
    def test_real_time(self):
        status = self.babble("--realtime", (), 3)
        self.assertEqual(status.samples, 3)
        self.assert_calls_nothing()
        self.assertEqual(status.page_faults, 0)
        self.assertRegex(self.said, r"\d+\.\d MB for the loop, real time")
        self.assertGreater(self.locked, 0)
        self.assertLess(self.locked, MOST_LOCKED)
        print(f"locked at a capacity of 1024 linear experts: {self.locked / 1024:.1f} MB")


if __name__ == "__main__":
    unittest.main()
