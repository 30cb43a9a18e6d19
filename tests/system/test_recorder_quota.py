"""The command of reach-recorder.service: it stays within its quota, and the oldest goes first."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import lcm

UNIT = Path(os.environ["REACH_SOURCE_DIR"]) / "etc/systemd/reach-recorder.service"
FILES, MEGABYTES = 3, 0.2
MESSAGE = 20_000  # bytes
MESSAGES = 100  # ten times what one file holds


def command(folder: Path) -> list[str]:
    line = re.search(r"^ExecStart=(.*)$", UNIT.read_text(), re.MULTILINE).group(1)
    places = {"RECORDER_FILES": str(FILES), "RECORDER_MB": str(MEGABYTES),
              "STATE_DIRECTORY": str(folder)}  # fmt: skip
    return re.sub(r"\$\{(\w+)\}", lambda match: places[match[1]], line).split()


@unittest.skipUnless(shutil.which("lcm-logger"), "there is no lcm-logger")
class Quota(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def record(self) -> None:
        logger = subprocess.Popen(command(self.folder))
        bus = lcm.LCM()
        try:
            time.sleep(1)
            for i in range(MESSAGES):
                bus.publish("STEREO_IMAGES", bytes(MESSAGE))
                bus.publish("REACH_STATUS", b"message %04d" % i + bytes(MESSAGE))
                time.sleep(0.005)
            time.sleep(0.5)
        finally:
            logger.send_signal(signal.SIGINT)
            self.assertEqual(logger.wait(20), 0)

    def test_the_oldest_goes_first(self):
        self.record()
        files = sorted(self.folder.iterdir())
        written = sum(path.stat().st_size for path in files)
        self.assertLessEqual(written, (FILES + 1) * (MEGABYTES * 1e6 * 1.05 + MESSAGE))
        every = b"".join(path.read_bytes() for path in files)
        newest = b"".join(path.read_bytes() for path in files[:2])  # one may just have begun
        self.assertIn(b"message %04d" % (MESSAGES - 1), newest)
        self.assertNotIn(b"message 0000", every)
        self.assertNotIn(b"STEREO_IMAGES", every)

    def test_a_new_start_stays_within_it(self):
        self.record()
        self.record()
        self.assertLessEqual(len(list(self.folder.iterdir())), FILES + 1)


if __name__ == "__main__":
    unittest.main()
