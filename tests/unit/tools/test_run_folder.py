"""Two runs never write into one folder, and no run deletes the log of the one before."""

import contextlib
import io
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from reach.run_folder import FolderInUseError, claimed, set_log_aside


class RunFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory())) / "out"

    def test_a_second_run_is_refused_until_the_first_has_ended(self):
        with claimed(self.folder):
            (self.folder / "run.lcmlog").write_text("the first one's")
            with self.assertRaisesRegex(FolderInUseError, "another run writes there"):
                self.enterContext(claimed(self.folder))
            for program in ("demo", "live", "show", "soak", "paper"):
                command = [sys.executable, "-m", f"reach.{program}", "--out", self.folder]
                command += ["1"] if program == "soak" else []
                result = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(result.returncode, 1, program)
                self.assertIn("another run writes there", result.stderr)
                self.assertNotIn("Traceback", result.stderr)
            self.assertEqual((self.folder / "run.lcmlog").read_text(), "the first one's")
        with claimed(self.folder):
            pass

    def test_a_run_that_was_killed_leaves_no_lock(self):
        script = (
            "import os, sys; from pathlib import Path; from reach.run_folder import claimed\n"
            "with claimed(Path(sys.argv[1])): os.kill(os.getpid(), 9)"
        )
        subprocess.run([sys.executable, "-c", script, self.folder])
        with claimed(self.folder):
            pass

    def test_the_log_of_the_run_before_is_kept(self):
        self.folder.mkdir()
        (self.folder / "run.lcmlog").write_text("old")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            set_log_aside(self.folder)
            set_log_aside(self.folder)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["before.lcmlog"])
        self.assertEqual(said.getvalue().count("before.lcmlog"), 1)


if __name__ == "__main__":
    unittest.main()
