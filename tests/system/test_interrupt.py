"""Ctrl-C in the middle of the experiment: everything stops, and what was kept is told."""

import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAMS = {"reach-simrobot", "reach-vision", "reachd"}


def others_in_this_namespace() -> list[str]:
    """Programs that share our network namespace: all that the experiment started."""
    mine = os.stat("/proc/self/ns/net").st_ino
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if (folder / "ns/net").stat().st_ino == mine and int(folder.name) != os.getpid():
                found.append((folder / "comm").read_text().strip())
        except OSError:
            continue  # it ended while we looked
    return found


class Interrupt(unittest.TestCase):
    def interrupt(self, number: int) -> None:
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-m", "reach.demo", "--out", folder, "--samples", "50"]
            with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as demo:
                first = demo.stderr.readline()
                self.assertIn("learn_hand", first)
                self.assertTrue(set(others_in_this_namespace()) >= PROGRAMS)
                demo.send_signal(number)
                demo.send_signal(number)
                _, said = demo.communicate(timeout=20)
            self.assertEqual(demo.returncode, 130)
            self.assertIn(f"kept {folder}/run.lcmlog", said)
            self.assertNotIn("Traceback", said)
        self.assertEqual(others_in_this_namespace(), [])

    def test_control_c(self):
        self.interrupt(signal.SIGINT)

    def test_terminate(self):
        self.interrupt(signal.SIGTERM)


if __name__ == "__main__":
    unittest.main()
