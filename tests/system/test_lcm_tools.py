"""The programs and types of the LCM community against ours: lcm-logger writes what we read,
lcm-logplayer says again what was said, and bindings from other definitions decode what we send."""

import io
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import lcm
import numpy as np
from PIL import Image
from reach import programs, read_log
from reach.bus import Bus
from reach.messages import ROOT
from reach.processes import Processes

SECONDS = 4
MJPEG = 0x47504A4D  # "MJPG"
# As those who use the types of the community know them.
FINGERPRINTS = {
    "picture_t": 0x14739FFE13D5F5F0,
    "pictures_t": 0x20BA4F05E8F5E33A,
    "joints_t": 0x3E377B4CEBC593A4,
}


def events(path: Path) -> dict[str, list[bytes]]:
    """What was said on each channel, in order."""
    said: dict[str, list[bytes]] = {}
    for event in lcm.EventLog(str(path)):
        said.setdefault(event.channel, []).append(event.data)
    return said


def wait_for(path: Path) -> None:
    end = time.monotonic() + 20
    while not path.exists():
        if time.monotonic() > end:
            raise AssertionError(f"{path} was not written")
        time.sleep(0.05)


class Logged(unittest.TestCase):
    """One run in real time, logged by lcm-logger, images and all."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = Path(cls.folder.name)
        cls.log = cls.work / "theirs.lcmlog"
        with Processes(cls.work) as processes:
            programs.start(processes, cls.work, seed=3, realtime=True)
            bus = Bus(programs.LISTENER_URL, processes.check)
            programs.wait_until_ready(bus)
            command = ["lcm-logger", f"--lcm-url={programs.LISTENER_URL}", cls.log]
            logger = subprocess.Popen(command, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL)  # fmt: skip
            try:
                bus.handle(SECONDS)
            finally:
                logger.send_signal(signal.SIGINT)
                cls.code = logger.wait(20)
        cls.record = read_log(cls.log)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_our_reader_reads_it(self):
        self.assertEqual((self.code, self.record.refused), (0, 0))
        for channel, rate in (("REACH_STATUS", 50), ("ROBOT_STATE", 50), ("MARKER", 30)):
            rows = self.record[channel]
            # lcm-logger keeps 30 messages waiting and loses more; on a busy machine it may.
            self.assertGreater(len(rows), 0.5 * SECONDS * rate, channel)
            self.assertTrue((np.diff(rows["seq"]) > 0).all(), channel)

    def test_lcm_logplayer_says_it_again(self):
        again = self.work / "again.lcmlog"
        with Processes(self.work) as processes:
            processes.start("listener", [sys.executable, "-m", "reach.recorder", "--url",
                                         programs.LISTENER_URL, again])  # fmt: skip
            wait_for(again)
            player = ["lcm-logplayer", "-e", "(?!STEREO_IMAGES).*", "-l", programs.LISTENER_URL]
            subprocess.run([*player, self.log], check=True, timeout=60, capture_output=True)
            time.sleep(0.5)
        played = events(again)
        for channel, said in events(self.log).items():
            if channel != "STEREO_IMAGES":
                self.assertEqual(played[channel], said, channel)

    def test_reachctl_sees_a_run_that_is_played(self):
        player = subprocess.Popen(["lcm-logplayer", "-l", programs.LISTENER_URL, self.log],
                                  stdout=subprocess.DEVNULL)  # fmt: skip
        try:
            command = [programs.BINARIES / "reachctl", "status"]
            result = subprocess.run(command, capture_output=True, text=True, timeout=20)
        finally:
            player.terminate()
            player.wait(20)
        # The first status that comes by may be of a tick before the robot's first state.
        self.assertRegex(result.stdout, "state      (waiting|idle)", result.stderr)

    def test_others_decode_images_and_joints(self):
        others = self.bindings()
        for name, fingerprint in FINGERPRINTS.items():
            packed = getattr(others, name)._get_packed_fingerprint()
            self.assertEqual(int.from_bytes(packed, "big"), fingerprint, name)
        said = events(self.log)
        pair = others.pictures_t.decode(said["STEREO_IMAGES"][-1])
        self.assertEqual(list(pair.image_types), [0, 1])
        for image in pair.images:
            self.assertEqual((image.utime, image.pixelformat), (pair.utime, MJPEG))
            pixels = np.asarray(Image.open(io.BytesIO(image.data)))
            self.assertEqual(pixels.shape, (image.height, image.width, 3))
            self.assertGreater(pixels.std(), 10)
        self.check_joints(others, said["JOINT_STATE"])

    def check_joints(self, others, said: list[bytes]) -> None:
        ours = {int(row["utime"]): row for row in self.record["ROBOT_STATE"]}
        states = [others.joints_t.decode(data) for data in said]
        pairs = [(state, ours[state.utime]) for state in states if state.utime in ours]
        self.assertGreater(len(pairs), SECONDS * 10)
        for theirs, row in pairs:
            n = int(row["n_joints"])
            self.assertEqual((theirs.num_joints, len(set(theirs.joint_name))), (n, n))
            np.testing.assert_allclose(theirs.joint_position, row["position"][:n], atol=1e-6)
            np.testing.assert_allclose(theirs.joint_velocity, row["velocity"][:n], atol=1e-6)

    def bindings(self):
        """Of the others' definitions, in Python."""
        definitions = ROOT / "tests/system/others.lcm"
        subprocess.run(["lcm-gen", "-p", "--ppath", self.work, definitions], check=True)
        sys.path.insert(0, str(self.work))
        try:
            import others
        finally:
            sys.path.remove(str(self.work))
        return others


if __name__ == "__main__":
    unittest.main()
