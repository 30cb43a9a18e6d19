"""What could hold up the watchdog, and does not: a log that nobody reads, the end of the daemon."""

import os
import signal
import tempfile
import time
import unittest
from pathlib import Path

from reach.messages import reach as types
from robot_in_trouble import Frozen, Trouble, assert_brakes

STATE = types.status_t


class Pipe:
    """A context: a named pipe whose reader we are."""

    def __enter__(self) -> "Pipe":
        self._folder = tempfile.TemporaryDirectory()
        self.path = Path(self._folder.name) / "stderr"
        os.mkfifo(self.path)
        self._reader = os.open(self.path, os.O_RDONLY | os.O_NONBLOCK)
        return self

    def __exit__(self, *_) -> None:
        self.close()
        self._folder.cleanup()

    def close(self) -> None:
        if self._reader >= 0:
            os.close(self._reader)
        self._reader = -1

    def fill(self) -> None:
        """Until nobody can write a byte."""
        writer = os.open(self.path, os.O_WRONLY | os.O_NONBLOCK)
        for size in (65536, 1):
            try:
                while True:
                    os.write(writer, b"x" * size)
            except BlockingIOError:
                pass
        os.close(writer)

    def read(self) -> str:
        text = b""
        try:
            while piece := os.read(self._reader, 1 << 20):
                text += piece
        except BlockingIOError:
            pass
        return text.decode()


class Watchdog(unittest.TestCase):
    def setUp(self):
        self.pipe = self.enterContext(Pipe())

    def test_nobody_reads_the_log(self):
        """The arm is braked all the same; later it is told how many lines are lost."""
        with Trouble(stderr=self.pipe.path) as trouble:
            trouble.set_moving()
            self.pipe.fill()
            with Frozen(trouble.processes.pid("reachd"), "reachd-loop"):
                trouble.watch(0.02)
                before = len(trouble.commands)
                trouble.until(lambda: len(trouble.commands) > before + 8, "braked", 2)
                assert_brakes(trouble, before - 1)
            trouble.until(lambda: trouble.status_is(STATE.FAULT), "a fault")
            trouble.watch(0.2)
            self.pipe.read()
            trouble.reset()
            trouble.watch(0.2)
            said = self.pipe.read()
            self.assertRegex(said, r"[1-9]\d* lines of this log are lost")
            self.assertIn("the fault was reset", said)

    def test_the_log_s_reader_is_gone(self):
        with Trouble(stderr=self.pipe.path) as trouble:
            trouble.set_moving()
            self.pipe.close()
            trouble.signal("reachd", signal.SIGUSR1)
            trouble.until(lambda: trouble.status_is(STATE.FAULT), "a fault")
            trouble.until(lambda: trouble.speed() == 0, "at rest")
            trouble.reset()
            trouble.set_moving()

    def test_the_daemon_is_to_end_while_the_loop_stands_still(self):
        """It ends, and the arm rests before."""
        with Trouble() as trouble:
            trouble.set_moving()
            daemon = trouble.processes.release("reachd")
            self.addCleanup(daemon.wait)
            self.addCleanup(daemon.kill)
            with Frozen(daemon.pid, "reachd-loop") as frozen:
                trouble.watch(0.01)
                before = len(trouble.commands)
                daemon.terminate()
                start = time.monotonic()
                while daemon.poll() is None:
                    self.assertLess(time.monotonic() - start, 10, trouble.log("reachd"))
                    trouble.watch(0.05)
                    frozen.let_end()
                assert_brakes(trouble, before - 1)
            self.assertEqual(daemon.returncode, 1)
            self.assertIn("the loop stood still at the end", trouble.log("reachd"))


if __name__ == "__main__":
    unittest.main()
