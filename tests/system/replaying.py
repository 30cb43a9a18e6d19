"""What tests of the replay share: calling it, and taking a log apart."""

import lzma
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from reach import programs
from reach.messages import ROOT

REACHD = programs.BINARIES / "reachd"
HEADER = 28  # bytes of an event before the channel's name


def replay(*arguments) -> subprocess.CompletedProcess:
    command = [str(word) for word in (REACHD, "--replay", *arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=100)


def events(log: bytes) -> list[tuple[int, str, int, int]]:
    """Of each event: where it begins, its channel, where its message begins and ends."""
    found, at = [], 0
    while at < len(log):
        name, size = struct.unpack(">II", log[at + 20 : at + HEADER])
        message = at + HEADER + name
        found.append((at, log[at + HEADER : message].decode(), message, message + size))
        at = message + size
    return found


class Replay(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def golden(self, name: str) -> Path:
        """One of tests/golden, unpacked."""
        path = self.folder / f"{name}.lcmlog"
        path.write_bytes(lzma.decompress((ROOT / f"tests/golden/{name}.lcmlog.xz").read_bytes()))
        return path

    def assert_same(self, *arguments) -> str:
        result = replay(*arguments, "--verify")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (0, 0), result.stderr)
        self.assertIn("everything that was sent is the same to the byte", result.stdout)
        return result.stdout

    def assert_refused(self, log: bytes, reason: str, *options: str) -> None:
        path = self.folder / "wrong.lcmlog"
        path.write_bytes(log)
        result = replay(path, "--verify", *options)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertRegex(result.stderr, reason)
