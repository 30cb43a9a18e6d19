"""Our reader of log files against LCM's writer and reader, also on damaged files."""

import os
import random
import tempfile
import unittest
from pathlib import Path

import lcm
from reach.event_log import events

SEED = int(os.environ.get("REACH_TEST_SEED") or random.SystemRandom().randrange(2**31))


class EventLog(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "run.lcmlog"
        self.random = random.Random(SEED)
        log = lcm.EventLog(str(self.path), "w", overwrite=True)
        for index in range(50):
            channel = self.random.choice(["A", "ROBOT_STATE", "x" * 200])
            log.write_event(10 * index, channel, self.random.randbytes(self.random.randrange(3000)))
        log.close()

    def assert_read_alike(self):
        """Both readers find the same messages."""
        theirs = [(e.timestamp, e.channel, bytes(e.data)) for e in lcm.EventLog(str(self.path))]
        self.assertEqual([tuple(event) for event in events(self.path)], theirs, f"seed {SEED}")
        return theirs

    def test_whole(self):
        self.assertEqual(len(self.assert_read_alike()), 50)

    def test_cut_off(self):
        whole = self.path.read_bytes()
        for _ in range(30):
            self.path.write_bytes(whole[: self.random.randrange(1, len(whole))])
            self.assert_read_alike()

    def test_rubbish_between_messages(self):
        whole = self.path.read_bytes()
        marks = [i for i in range(len(whole)) if whole.startswith(b"\xed\xa1\xda\x01", i)]
        place = marks[20]
        self.path.write_bytes(whole[:place] + bytes(2_000_000) + whole[place:])
        self.assertEqual(len(list(events(self.path))), 50)

    def test_empty_and_no_log(self):
        for content in (b"", b"\xed", b"no log at all"):
            self.path.write_bytes(content)
            self.assertEqual(list(events(self.path)), [])


if __name__ == "__main__":
    unittest.main()
