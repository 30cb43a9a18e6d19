"""docs/reference/ is what the programs and the message types say today, and is understood right."""

import os
import unittest
from pathlib import Path

import reference

SOURCE = Path(os.environ["REACH_SOURCE_DIR"])
BUILD = Path(os.environ["REACH_BUILD_DIR"])

# Built, but for developers: docs name them where they are of use.
NOT_FOR_USERS = {"hard-pictures", "iiwa_driver", "reach-prime", "reach-window", "robot_driver"}

OPTIONS = """\
arm.gain      of the arm, one of many
              number, default 90, unit deg/s, range 0 .. 360
arm.words     how
              word, default a, one of a|b
arm.places    where
              list of numbers, default [0.1, 2], range 0 .. 1
arm.name      who
              text, must be given
"""

MESSAGE = """\
package reach;

// What is meant. Channel SOME_CHANNEL, from a test.
struct some_t
{
    int64_t utime;      // when; us

    // Above the field,
    // on two lines
    double place[3];    // m, in the room
    int8_t kind;        // one of the constants below
    const int8_t ONE = 1, TWO = 2,
                 THREE = 3; // the last
}
"""


class Parsing(unittest.TestCase):
    def test_options(self):
        gain, words, places, name = reference.parse_options(OPTIONS)
        self.assertEqual(
            gain,
            reference.Option(
                "arm.gain", "of the arm, one of many", "number", "90", "deg/s", "0 .. 360"
            ),
        )
        self.assertEqual((words.type, words.default, words.range), ("word", "a", "a, b"))
        self.assertEqual((places.default, places.range), ("[0.1, 2]", "0 .. 1"))
        self.assertIsNone(name.default)

    def test_messages(self):
        message = reference.parse_message(MESSAGE)
        self.assertEqual((message.package, message.name), ("reach", "some_t"))
        self.assertEqual(message.channels, ["SOME_CHANNEL"])
        utime, place, kind = message.fields
        self.assertEqual((utime.name, utime.unit, utime.meaning), ("utime", "us", "when"))
        self.assertEqual((place.name, place.type, place.unit), ("place[3]", "double", "m"))
        self.assertEqual(place.meaning, "Above the field, on two lines. in the room")
        self.assertEqual(kind.constants, ["ONE = 1, TWO = 2", "THREE = 3 (the last)"])


class Pages(unittest.TestCase):
    def test_they_are_what_is_made_today(self):
        for name, text in reference.pages(BUILD).items():
            with self.subTest(name):
                page = SOURCE / "docs/reference" / name
                # Where they differ, assertEqual shows it; the message says what mends it.
                self.assertEqual(page.read_text(), text, f"mended by {reference.MEND}")

    def test_every_program_is_there(self):
        built = {p.name for p in (BUILD / "bin").iterdir() if os.access(p, os.X_OK)}
        self.assertEqual(built - NOT_FOR_USERS, set(reference.PROGRAMS))

    def test_every_program_tells_its_exit_codes(self):
        for program in reference.PROGRAMS:
            with self.subTest(program):
                self.assertRegex(
                    reference.said(BUILD, program, "--help"),
                    r"(?i)exit (code|status)s?: 0 .*2 wrong usage",
                )

    def test_every_channel_has_its_ends_explained(self):
        page = (SOURCE / "docs/messages.md").read_text()
        for message in reference.messages():
            for channel in message.channels:
                with self.subTest(channel):
                    package = "" if message.package == "reach" else f"{message.package}."
                    self.assertIn(f"| `{channel}` | `{package}{message.name}` |", page)


if __name__ == "__main__":
    unittest.main()
