"""reachctl top as text, and on a terminal."""

import fcntl
import json
import os
import pty
import select
import signal
import struct
import subprocess
import termios
import threading
import time
import unittest

import lcm
from reach.bus import DEFAULT_URL
from reach.messages import bot_core
from reach.messages import reach as types
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


class Echo(unittest.TestCase):
    """What comes on a channel, as JSON."""

    def echo(self, pattern: str, messages: dict[str, bytes]) -> list[dict]:
        """What is printed while these messages are sent again and again, until two lines came."""
        bus = lcm.LCM(DEFAULT_URL)
        command = [REACHCTL, "echo", pattern]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
            lines: list[bytes] = []
            thread = threading.Thread(target=lambda: lines.extend(process.stdout))
            thread.start()
            for _ in range(60):
                for channel, data in messages.items():
                    bus.publish(channel, data)
                time.sleep(0.05)
                if len(lines) > 2:
                    break
            process.terminate()
            thread.join(10)
        return [json.loads(line) for line in lines]

    def test_every_field_of_ours(self):
        status = types.status_t()
        status.utime, status.seq, status.staleness = 123, 2**60, float("inf")
        status.x_predicted[1] = 0.1
        said = self.echo("REACH_STATUS", {"REACH_STATUS": status.encode(), "REACH_STATUS2": b""})
        self.assertEqual({line["channel"] for line in said}, {"REACH_STATUS"})
        self.assertEqual(said[0]["type"], "reach.status_t")
        self.assertEqual((said[0]["seq"], said[0]["staleness"]), (2**60, "inf"))
        self.assertEqual(said[0]["x_predicted"], [0, 0.1, *[0] * 6])
        self.assertEqual(set(types.status_t.__slots__), set(said[0]) - {"channel", "type"})

    def test_text_names_and_what_is_not_ours(self):
        config, joints = types.config_t(), bot_core.joint_state_t()
        config.text = [*b'a="\x1b[2J\\\n', *[0] * 8183]
        joints.num_joints, joints.joint_name = 2, ["elbow", "\x1b]0;x\x07"]
        joints.joint_position = joints.joint_velocity = joints.joint_effort = [0.5, 0]
        said = self.echo(
            "(REACH_CONFIG|JOINT_STATE|MINE)",
            {"REACH_CONFIG": config.encode(), "JOINT_STATE": joints.encode(), "MINE": b"12345678"},
        )
        found = {line["channel"]: line for line in said}
        self.assertEqual(found["REACH_CONFIG"]["text"], 'a="\\x1b[2J\\\\x0a')
        self.assertEqual(found["JOINT_STATE"]["joint_name"], ["elbow", "\\x1b]0;x\\x07"])
        self.assertEqual(found["JOINT_STATE"]["joint_position"], [0.5, 0])
        mine = {"channel": "MINE", "type": "not ours", "bytes": 8}
        self.assertEqual(found["MINE"], mine)

    def test_once_and_silence(self):
        with Scripted():
            result = reachctl("echo", "REACH_STATUS", "--once")
        self.assertEqual((result.returncode, result.stdout.count("\n")), (0, 1), result.stderr)
        result = reachctl("echo", "NOBODY", "--once", "--timeout", "0.3")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, "reachctl: nothing came on 'NOBODY' in 0.3 s\n")


class Top(unittest.TestCase):
    def test_once_is_one_frame_of_text(self):
        with Scripted():
            result = reachctl("top", "--once")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"reachd idle, none, .* (1\.0|0\.9|1\.1) times real time")
        self.assertNotIn("\x1b", result.stdout)
        row = next(line for line in result.stdout.splitlines() if "REACH_STATUS" in line)
        self.assertTrue(5 < float(row.split()[1]) < 60, row)  # every 20 ms at most

    def test_every_channel_is_shown_by_once(self):
        with Scripted():
            bus = lcm.LCM(DEFAULT_URL)
            process = subprocess.Popen([REACHCTL, "top", "--once"], stdout=subprocess.PIPE)
            end = time.monotonic() + 20
            while process.poll() is None and time.monotonic() < end:
                for i in range(70):
                    bus.publish(f"CHANNEL_{i:02}", b"")
                time.sleep(0.1)
            text = process.stdout.read().decode()
            process.stdout.close()
        for i in range(70):
            self.assertIn(f"CHANNEL_{i:02} ", text)
        self.assertNotIn("more", text)

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
