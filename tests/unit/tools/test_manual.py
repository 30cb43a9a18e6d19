"""tools/dev/manual.py: a help becomes a page, and nothing of it is lost."""

import tempfile
import unittest
from pathlib import Path

import manual

HELP = """\
usage: prog [--file F] COMMAND
       prog --list

What it is for. And
how.

  -f, --file F  the file,
                or none
      --list    everything

Exit codes: 0 done, 1 refused, failed or lost, 2 wrong usage.

commands to look:
  status        how it goes
  reach A B     there
"""


class Manual(unittest.TestCase):
    def test_parts_of_a_help(self):
        said = manual.parse_help(HELP)
        self.assertEqual(said.usage, ["prog [--file F] COMMAND", "prog --list"])
        self.assertEqual(said.paragraphs, ["What it is for. And how."])
        options, commands = said.groups
        self.assertEqual(options.entries, [("-f, --file F", "the file, or none"),
                                           ("--list", "everything")])  # fmt: skip
        self.assertEqual((commands.title, commands.entries[1]),
                         ("commands to look", ("reach A B", "there")))  # fmt: skip
        self.assertEqual(said.exit_codes, [("0", "done"), ("1", "refused, failed or lost"),
                                           ("2", "wrong usage")])  # fmt: skip

    def test_page(self):
        source = Path(self.enterContext(tempfile.TemporaryDirectory())) / "prog.1"
        source.write_text(
            ".Dd May 1, 2026\n.Nd does it\n.Sh DESCRIPTION\nMore.\n.Sh FILES\nNone.\n"
            ".Sh SEE ALSO\n.Xr other 1\n"
        )
        text = manual.page(source, manual.parse_help(HELP), Path())
        headings = [line[4:] for line in text.splitlines() if line.startswith(".Sh ")]
        made = ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "COMMANDS TO LOOK"]
        self.assertEqual(headings, [*made, "FILES", "EXIT STATUS", "SEE ALSO"])
        self.assertIn(".It \\fB\\-f\\fR, \\fB\\-\\-file\\fR \\fIF\\fR\nthe file, or none\n", text)
        self.assertEqual(text.count("\n.Nm prog\n"), 3)  # its name, and two ways to call it

    def test_nothing_is_taken_for_a_command_of_roff(self):
        self.assertEqual(manual.escape(".end"), "\\&.end")
        self.assertEqual(manual.escape("'quoted' \\ -1"), "\\&\\(aqquoted\\(aq \\e \\-1")


if __name__ == "__main__":
    unittest.main()
