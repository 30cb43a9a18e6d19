"""What programs write goes over no log."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lcm

PROGRAMS = Path(os.environ["REACH_BUILD_DIR"]) / "bin"


class Overwriting(unittest.TestCase):
    """A log is often all that is left of a run: no program replaces one by something else."""

    def test_no_program_overwrites_a_log(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        log, other = folder / "run.lcmlog", folder / "other.lcmlog"
        for path in (log, other):
            lcm.EventLog(str(path), "w", overwrite=True).write_event(1, "A", b"abc")
        before = other.read_bytes()
        etc = Path(os.environ["REACH_SOURCE_DIR"]) / "etc"
        export = [sys.executable, "-m", "reach.export", log]
        for command in (
            [PROGRAMS / "reach-log", "cut", log, other],
            [PROGRAMS / "reach-log", "repair", log, other],
            [*export, "--mcap", other],
            [*export, "--samples", other],
            [*export, "--rrd", other],
            [PROGRAMS / "reach-window", "--no-window", "--video", other],
            [PROGRAMS / "reach-simrobot", "--config", etc / "simrobot-sixaxis.yaml",
             "--snapshot", other],
        ):  # fmt: skip
            result = subprocess.run(
                list(map(str, command)), capture_output=True, text=True, stdin=subprocess.DEVNULL
            )
            self.assertEqual(result.returncode, 1, command)
            self.assertIn("not overwritten", result.stderr)
            self.assertEqual(other.read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
