"""reachctl top as text, and on a terminal."""

import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import termios
import time
import unittest

from scripted import REACHCTL, Scripted, reachctl

ENTER_SCREEN, LEAVE_SCREEN = b"\x1b[?1049h", b"\x1b[?1049l"


class Terminal:
    """reachctl top on a pseudo terminal."""

    def __init__(self):
        self.master, self._slave = pty.openpty()
        self.resize(80, 24)
        self.settings = termios.tcgetattr(self._slave)
        self.process = subprocess.Popen([REACHCTL, "top"], stdin=self._slave, stdout=self._slave)
        self.text = b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        os.close(self.master)
        os.close(self._slave)

    def resize(self, width: int, height: int) -> None:
        fcntl.ioctl(self._slave, termios.TIOCSWINSZ, struct.pack("HHHH", height, width, 0, 0))

    def press(self, keys: bytes) -> None:
        os.write(self.master, keys)

    def read_until(self, piece: bytes, seconds: float = 10) -> bytes:
        """What was written up to the piece; the rest stays for the next call."""
        end = time.monotonic() + seconds
        while piece not in self.text:
            if not select.select([self.master], [], [], max(0, end - time.monotonic()))[0]:
                raise AssertionError(f"no {piece!r} in {self.text!r}")
            self.text += os.read(self.master, 65536)
        before, _, self.text = self.text.partition(piece)
        return before

    def given_back(self) -> bool:
        return termios.tcgetattr(self._slave) == self.settings


class Top(unittest.TestCase):
    def test_once_is_one_frame_of_text(self):
        with Scripted():
            result = reachctl("top", "--once")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"reachd idle, none, .* (1\.0|0\.9|1\.1) times real time")
        self.assertNotIn("\x1b", result.stdout)
        row = next(line for line in result.stdout.splitlines() if "REACH_STATUS" in line)
        self.assertTrue(5 < float(row.split()[1]) < 60, row)  # every 20 ms at most

    def test_silence_is_told(self):
        result = reachctl("top", "--once", "--timeout", "0.5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("reachd has not been heard", result.stdout)
        self.assertEqual(result.stderr, "reachctl: no status from reachd in 0.5 s\n")

    def test_without_a_terminal_once_is_wanted(self):
        result = reachctl("top")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--once", result.stderr)

    def test_frames_follow_the_terminals_size_until_q(self):
        with Scripted(), Terminal() as terminal:
            terminal.read_until(ENTER_SCREEN)
            terminal.read_until(b"request accepted")
            terminal.resize(20, 3)
            terminal.read_until(b"\x1b[J")  # the end of a frame that may have been begun before
            terminal.read_until(b"\x1b[H")
            frame = terminal.read_until(b"\x1b[J")
            self.assertEqual(frame.count(b"\n"), 2)
            self.assertNotIn(b"request accepted", frame)
            terminal.press(b"q")
            terminal.read_until(LEAVE_SCREEN)
            self.assertEqual(terminal.process.wait(10), 0)
            self.assertTrue(terminal.given_back())

    def test_a_signal_gives_the_terminal_back(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number), Terminal() as terminal:
                terminal.read_until(ENTER_SCREEN)
                self.assertFalse(terminal.given_back())
                terminal.process.send_signal(number)
                terminal.read_until(LEAVE_SCREEN)
                self.assertEqual(terminal.process.wait(10), 0)
                self.assertTrue(terminal.given_back())


if __name__ == "__main__":
    unittest.main()
