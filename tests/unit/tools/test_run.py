"""./run in a copy of the tree: it configures anew what was configured elsewhere, and reads its
arguments before it fetches anything. CMake, and the Python of the copy, note what they are told."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["REACH_SOURCE_DIR"])
BUILD = Path(os.environ["REACH_BUILD_DIR"])
CMAKE = """#!/bin/sh
echo "cmake $*" >>"$NOTES"
"""
PYTHON = """#!/bin/sh
echo "python $*" >>"$NOTES"
case "$*" in
*"import rerun"* | *"pip "*) exit 1 ;; # it is not there, and nothing is fetched
esac
exec "{python}" "$@"
"""


def program(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name).resolve() / "tree"
        self.notes = self.tree / "notes"
        (self.tree / "build").mkdir(parents=True)
        for name in ("run", "requirements.txt", "requirements-live.txt", "CMakePresets.json"):
            shutil.copy(SOURCE / name, self.tree)
        shutil.copytree(SOURCE / "tools/dev", self.tree / "tools/dev")
        (self.tree / "cmake").mkdir()
        (self.tree / "cmake/packages.txt").write_text("")
        for name in ("reach", "netns.sh"):
            (self.tree / "tools" / name).symlink_to(SOURCE / "tools" / name)
        (self.tree / "build/python").symlink_to(BUILD / "python")
        (self.tree / ".venv").mkdir()
        shutil.copy(SOURCE / "requirements.txt", self.tree / ".venv/requirements.installed")
        program(self.tree / ".venv/bin/python", PYTHON.format(python=sys.executable))
        program(self.tree / "fake/cmake", CMAKE)

    def run_it(self, *words: str) -> subprocess.CompletedProcess:
        environment = os.environ | {
            "PATH": f"{self.tree / 'fake'}:{os.environ['PATH']}", "NOTES": str(self.notes),
        }  # fmt: skip
        return subprocess.run([self.tree / "run", *words], env=environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL)  # fmt: skip

    def configured_at(self, place: Path) -> None:
        (self.tree / "build/build.ninja").write_text("")
        cache = self.tree / "build/CMakeCache.txt"
        cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={place}\n")

    def test_a_moved_tree_is_configured_anew(self):
        self.configured_at(Path("/where/it/was"))
        result = self.run_it("build")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("cmake --preset release --fresh", self.notes.read_text())
        self.assertIn("configured at another place", result.stderr)

    def test_a_tree_that_stayed_is_not(self):
        self.configured_at(self.tree)
        self.assertEqual(self.run_it("build").returncode, 0)
        self.assertNotIn("--fresh", self.notes.read_text())

    def test_arguments_are_read_before_anything_is_fetched(self):
        result = self.run_it("live", "--bogus")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--bogus", result.stderr)
        self.assertNotIn("pip ", self.notes.read_text())
        self.assertNotIn("installing", result.stderr)

    def test_what_is_missing_is_fetched_for_good_arguments(self):
        result = self.run_it("live", "--seconds", "1")
        self.assertEqual(result.returncode, 1)
        self.assertIn("pip install", self.notes.read_text())


if __name__ == "__main__":
    unittest.main()
