"""Our readers of log files, in Python and in C, against LCM's writer and on damaged files."""

import json
import os
import random
import re
import signal
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import damaged_logs
import lcm
from reach.event_log import Gap, events

SEED = int(os.environ.get("REACH_TEST_SEED") or random.SystemRandom().randrange(2**31))
REACH_LOG = Path(os.environ["REACH_BUILD_DIR"]) / "bin/reach-log"
URL = "udpm://239.255.76.67:7667?ttl=0"


def reach_log(*words) -> subprocess.CompletedProcess:
    return subprocess.run([REACH_LOG, *map(str, words)], capture_output=True, text=True, timeout=60)


def by_python(path: Path) -> tuple[list[tuple], list[tuple[int, int]], bool]:
    """Events; position and size of each gap; whether the end is torn."""
    gaps: list[Gap] = []
    found = [tuple(event) for event in events(path, gaps)]
    torn = bool(gaps) and gaps[-1].at_end
    return found, [(gap.position, gap.size) for gap in gaps], torn


def by_c(path: Path) -> tuple[int, list[tuple[int, int]], bool]:
    """As above, but of the events how many there are."""
    result = reach_log("info", "--json", path)
    if result.returncode:
        return 0, [(0, path.stat().st_size)] if path.stat().st_size else [], True
    said = json.loads(result.stdout)
    gaps = [(gap["position"], gap["bytes"]) for gap in said["skipped"]]
    return said["messages"], gaps, said["torn_end"]


def parts(event: bytes) -> tuple:
    """Stamp, channel and message of a whole event."""
    stamp, name, _ = struct.unpack(">qII", event[12 : damaged_logs.HEADER])
    rest = event[damaged_logs.HEADER :]
    return stamp, rest[:name].decode(), rest[name:]


def size_of_name(channel: str) -> int:
    """In the file, where a byte that is no UTF-8 is one, and not the four of its escape."""
    return len(re.sub(r"\\x[0-9a-f]{2}", "?", channel).encode())


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.path = self.folder / "run.lcmlog"


class Damaged(Folder):
    def test_both_readers_find_what_is_right(self):
        logs = damaged_logs.write(self.folder)
        self.assertGreaterEqual(len(logs), 30)
        for name, log in logs.items():
            with self.subTest(name):
                path = self.folder / f"{name}.lcmlog"
                found, gaps, torn = by_python(path)
                self.assertEqual(found, [parts(event) for event in log.kept])
                self.assertEqual((gaps, torn), (log.gaps, log.torn))
                self.assertEqual(by_c(path)[:2], (len(log.kept), log.gaps))
                if log.kept:
                    self.assertEqual(by_c(path)[2], log.torn)

    def test_a_repaired_log_holds_what_was_whole_to_the_byte(self):
        for name, log in damaged_logs.write(self.folder).items():
            with self.subTest(name):
                new = self.folder / f"{name}.repaired"
                result = reach_log("repair", self.folder / f"{name}.lcmlog", new)
                self.assertEqual(result.returncode, 0 if log.kept else 1, result.stderr)
                self.assertEqual(new.exists(), bool(log.kept))
                if log.kept:
                    self.assertEqual(new.read_bytes(), b"".join(log.kept))
                if log.kept and log.gaps:
                    left_out = sum(size for _, size in log.gaps)
                    self.assertIn(f"{left_out} bytes that are no event", result.stdout)

    def test_bytes_turned_over_anywhere(self):
        """Whatever is damaged, both say the same, and nothing that they take was not there."""
        chance = random.Random(SEED)
        whole = damaged_logs.all_logs()["whole"]
        right = {parts(event) for event in whole.kept}
        for turn in range(60):
            content = bytearray(whole.content)
            for _ in range(chance.randrange(1, 4)):
                content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
            self.path.write_bytes(content[: chance.randrange(len(content) // 2, len(content))])
            found, gaps, torn = by_python(self.path)
            self.assertEqual(by_c(self.path), (len(found), gaps, torn), f"seed {SEED}, turn {turn}")
            taken = sum(28 + size_of_name(c) + len(data) for _, c, data in found)
            skipped = sum(size for _, size in gaps)
            self.assertEqual(taken + skipped, self.path.stat().st_size, f"seed {SEED}")
            self.assertGreater(len(set(found) & right), 0)


class Logged(Folder):
    """What LCM itself writes."""

    def test_liblcm_s_writer(self):
        chance = random.Random(SEED)
        log = lcm.EventLog(str(self.path), "w", overwrite=True)
        for index in range(50):
            channel = chance.choice(["A", "ROBOT_STATE", "x" * 200])
            log.write_event(10 * index, channel, chance.randbytes(chance.randrange(3000)))
        log.close()
        theirs = [(e.timestamp, e.channel, bytes(e.data)) for e in lcm.EventLog(str(self.path))]
        self.assertEqual(by_python(self.path), (theirs, [], False), f"seed {SEED}")
        self.assertEqual(by_c(self.path), (50, [], False))

    def test_lcm_logger_s_file_cut_at_every_byte_of_the_last_events(self):
        self.log_some(6)
        whole = self.path.read_bytes()
        found, _, _ = by_python(self.path)
        sizes = [28 + len(channel) + len(data) for _, channel, data in found]
        ends = [sum(sizes[: i + 1]) for i in range(len(sizes))]
        self.assertEqual(ends[-1], len(whole))
        for cut in range(ends[-4], len(whole)):
            self.path.write_bytes(whole[:cut])
            n = sum(end <= cut for end in ends)
            gaps = [(ends[n - 1], cut - ends[n - 1])] if cut > ends[n - 1] else []
            self.assertEqual(by_python(self.path), (found[:n], gaps, bool(gaps)), cut)
            self.assertEqual(by_c(self.path), (n, gaps, bool(gaps)), cut)

    def test_lcm_logger_started_again_behind_a_torn_event(self):
        """Its second part is not mixed with its first."""
        self.log_some(3)
        before, _, _ = by_python(self.path)
        self.path.write_bytes(self.path.read_bytes()[:-5])
        torn = self.path.stat().st_size
        self.log_some(3, "-a")
        found, gaps, _ = by_python(self.path)
        self.assertEqual(found[: len(before) - 1], before[:-1])
        said = [data for _, _, data in found[-3:]]
        self.assertEqual(said, [b"message 0", b"message 1", b"message 2"])
        self.assertEqual(sum(gaps[0]), torn)
        self.assertEqual(by_c(self.path), (len(found), gaps, False))

    def log_some(self, n: int, *options: str) -> None:
        """lcm-logger writes what it has buffered when it ends."""
        command = ["lcm-logger", *options, "-c", "SOME", f"--lcm-url={URL}", self.path]
        logger = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        bus = lcm.LCM(URL)
        try:
            time.sleep(0.5)
            for i in range(n):
                bus.publish("SOME", b"message %d" % i)
            time.sleep(0.5)
        finally:
            logger.send_signal(signal.SIGINT)
            self.assertEqual(logger.wait(20), 0)


if __name__ == "__main__":
    unittest.main()
