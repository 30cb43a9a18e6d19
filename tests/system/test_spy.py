"""reach-spy on a screen of its own: every channel is there, with its type, its rate, and nothing
that it could not decode. The picture is read by eye, that is, by optical character recognition."""

import os
import re
import subprocess
import tempfile
import time
import unittest
from difflib import SequenceMatcher
from pathlib import Path

import lcm
import screen
from background import Background
from reach import programs
from reach.bus import DEFAULT_URL
from reach.messages import ROOT, bot_core
from reach.messages import reach as types

SPY = programs.BINARIES / "reach-spy"
# Channel, type, messages a second.
SAID = [
    ("END_EFFECTOR", types.end_effector_t, 10),
    ("JOINT_STATE", bot_core.joint_state_t, 20),
    ("LEARNER_PREDICTION", types.learner_prediction_t, 5),
    ("LEARNER_REPLY", types.learner_reply_t, 5),
    ("LEARNER_REQUEST", types.learner_request_t, 5),
    ("MARKER", types.marker_t, 5),
    ("REACH_BODY", types.body_t, 5),
    ("REACH_BODY_REQUEST", types.body_request_t, 5),
    ("REACH_CONFIG", types.config_t, 5),
    ("REACH_HELLO", types.hello_t, 5),
    ("REACH_REQUEST", types.request_t, 10),
    ("REACH_SAMPLE", types.sample_t, 10),
    ("REACH_STATUS", types.status_t, 20),
    ("REACH_TRACE", types.trace_t, 20),
    ("ROBOT_COMMAND", types.robot_command_t, 20),
    ("ROBOT_STATE", types.robot_state_t, 20),
    ("SIM_CONTACTS", types.sim_contacts_t, 10),
    ("SIM_REQUEST", types.sim_request_t, 5),
    ("SIM_TRUTH", types.sim_truth_t, 10),
    ("STEREO_IMAGES", bot_core.images_t, 10),
]
STRANGE = "ZZ_STRANGE"  # last in the window; nobody can decode it
WITHIN = {"image_t", "image_metadata_t"}  # parts of other messages
TITLE, ROW = 20, 16  # heights in the window, px


class Speaker(Background):
    """Says all of it on time."""

    def __init__(self):
        super().__init__()
        self._lcm = lcm.LCM(DEFAULT_URL)

    def run(self):
        messages = [(channel, kind().encode(), 20 // rate) for channel, kind, rate in SAID]
        messages.append((STRANGE, b"\0" * 16, 4))
        start, tick = time.monotonic(), 0
        while not self._halt.wait(max(0, start + tick * 0.05 - time.monotonic())):
            for channel, data, every in messages:
                if tick % every == 0:
                    self._lcm.publish(channel, data)
            tick += 1


def similar(read: str, meant: str) -> float:
    """How alike two names look, lines and blanks apart: 0 .. 1."""
    plain = [re.sub(r"[^A-Z0-9]", "", text.upper()) for text in (read, meant)]
    return SequenceMatcher(None, *plain).ratio()


def table(picture, n_rows: int) -> dict[str, list[str]]:
    """The window's columns by title, where each has a line for each row."""
    bottom = TITLE + ROW * n_rows
    names = ("channel", "type", "count", "rate", "period", "jitter", "bandwidth", "undecodable")
    wanted = ("channel", "type", "rate", "undecodable")
    columns = screen.columns(picture, TITLE + 1, bottom - 1)
    found = dict(zip(names, columns, strict=False))
    return {name: screen.read_lines(picture[TITLE + 1 : bottom, found[name]])
            for name in wanted if name in found}  # fmt: skip


class Spy(unittest.TestCase):
    def test_every_type_is_said(self):
        there = {path.stem for path in (ROOT / "lcmtypes").rglob("*.lcm")}
        self.assertEqual({kind.__name__ for _, kind, _ in SAID} | WITHIN, there)

    def test_all_channels_are_shown_and_decoded(self):
        with screen.Screen(800, 600) as display, Speaker(), tempfile.TemporaryFile() as log:
            spy = subprocess.Popen([SPY], env={**os.environ, "DISPLAY": display.display},
                                   stdout=log, stderr=log)  # fmt: skip
            try:
                picture, shown = self.wait_for_rates(display, spy)
            finally:
                spy.terminate()
                spy.wait(20)
        screen.save(picture, programs.BINARIES.parent / "spy.png")
        for i, (channel, kind, _) in enumerate(SAID):
            with self.subTest(channel):
                self.assertGreater(similar(shown["channel"][i], channel), 0.75, shown)
                self.assertGreater(similar(shown["type"][i], kind.__name__), 0.75, shown)
                self.assertEqual(shown["undecodable"][i].replace("O", "0"), "0", shown)
        self.assertGreater(similar(shown["channel"][-1], STRANGE), 0.75, shown)
        self.assertNotIn(shown["undecodable"][-1], ("0", "O"), shown)

    def rates_are_right(self, shown: dict[str, list[str]]) -> bool:
        rows = len(SAID) + 1
        if len(shown) != 4 or any(len(lines) != rows for lines in shown.values()):
            return False
        rates = [re.sub(r"[^0-9]", "", text) for text in shown["rate"]]
        # Two decimals, whether or not the point was read.
        return all(text and abs(int(text) / 100 - rate) < 0.25 * rate
                   for text, (_, _, rate) in zip(rates, SAID, strict=False))  # fmt: skip

    def wait_for_rates(self, display, spy):
        """Until the window shows every rate as it is."""
        end = time.monotonic() + 150  # it draws slowly on a busy machine
        shown: dict = {}
        while time.monotonic() < end:
            time.sleep(2)
            self.assertIsNone(spy.poll(), "reach-spy has ended")
            picture = display.picture()
            shown = table(picture, len(SAID) + 1)
            if self.rates_are_right(shown):
                return picture, shown
        screen.save(picture, programs.BINARIES.parent / "spy.png")
        self.fail(f"the window showed {shown}; see build/spy.png")


class Usage(unittest.TestCase):
    def spy(self, *words, **environment):
        return subprocess.run([SPY, *words], capture_output=True, text=True, timeout=20,
                              env={**os.environ, **environment})  # fmt: skip

    def test_help_and_version(self):
        self.assertIn("usage: reach-spy", self.spy("--help").stdout)
        self.assertRegex(self.spy("--version").stdout, r"^reach-spy \d+\.\d+\.\d+ \(.+\)\n$")

    def test_wrong_usage(self):
        for words in (["--no-such"], ["--url"]):
            result = self.spy(*words)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1), result)

    def test_what_is_missing_is_named(self):
        result = self.spy(DISPLAY="")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result)
        self.assertIn("display", result.stderr)
        result = self.spy("--jar", str(Path("/no/such.jar")))
        self.assertEqual(result.returncode, 1)
        self.assertIn("/no/such.jar", result.stderr)


if __name__ == "__main__":
    unittest.main()
