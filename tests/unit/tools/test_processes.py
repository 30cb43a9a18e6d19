"""Children are ended by their ids, whatever happens to the experiment."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from reach.processes import ProcessDiedError, Processes


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")")[-1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def gone_within(pid: int, seconds: float) -> bool:
    end = time.monotonic() + seconds
    while alive(pid) and time.monotonic() < end:
        time.sleep(0.02)
    return not alive(pid)


class ProcessesTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_leaving_the_context_ends_everything(self):
        with Processes(self.folder) as processes:
            processes.start("one", ["sleep", "60"])
            pid = processes._running["one"].pid
            processes.check()
        self.assertFalse(alive(pid))

    def test_who_ended_is_told_with_the_last_line(self):
        with Processes(self.folder) as processes:
            processes.start("clumsy", ["sh", "-c", "echo first; echo the reason >&2; exit 3"])
            processes._running["clumsy"].wait(5)
            with self.assertRaisesRegex(ProcessDiedError, "clumsy ended with code 3: the reason"):
                processes.check()

    def test_a_missing_program_is_told(self):
        with (
            Processes(self.folder) as processes,
            self.assertRaisesRegex(ProcessDiedError, "/no/such is missing"),
        ):
            processes.start("none", ["/no/such"])

    def test_children_of_a_killed_experiment_end(self):
        script = (
            "import sys, time; from pathlib import Path; from reach.processes import Processes\n"
            "p = Processes(Path(sys.argv[1])); p.start('one', ['sleep', '60'])\n"
            "print(p._running['one'].pid, flush=True); time.sleep(60)"
        )
        command = [sys.executable, "-c", script, str(self.folder)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as experiment:
            child = int(experiment.stdout.readline())
            self.assertTrue(alive(child))
            os.kill(experiment.pid, signal.SIGKILL)
        self.assertTrue(gone_within(child, 5.0))


if __name__ == "__main__":
    unittest.main()
