"""tools/dev/version.sh in a repository, in a copy without one, and in an archive of git's."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["REACH_SOURCE_DIR"])
IDENTITY = ["-c", "user.name=nobody", "-c", "user.email=nobody@localhost"]


def run(*command, cwd: Path | None = None) -> str:
    words = [str(word) for word in command]
    return subprocess.run(words, cwd=cwd, check=True, capture_output=True, text=True).stdout.strip()


def version(tree: Path, *file) -> str:
    return run(tree / "tools/dev/version.sh", *file)


class Version(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name).resolve() / "tree"
        (self.tree / "tools/dev").mkdir(parents=True)
        shutil.copy(SOURCE / "tools/dev/version.sh", self.tree / "tools/dev")
        shutil.copy(SOURCE / ".gitattributes", self.tree)
        (self.tree / "CMakeLists.txt").write_text("project(reachd VERSION 1.2.3 LANGUAGES C)\n")
        self.git("init", "-q")
        self.git("add", "-A")
        self.commit()

    def git(self, *words) -> str:
        return run("git", "-C", self.tree, *IDENTITY, *words)

    def commit(self) -> None:
        self.git("commit", "-q", "--allow-empty", "-m", "one")

    def revision(self) -> str:
        return self.git("rev-parse", "--short", "HEAD")

    def test_follows_commits_and_changes(self):
        for _ in range(2):
            self.assertEqual(version(self.tree), f"1.2.3 ({self.revision()})")
            self.commit()
        (self.tree / "CMakeLists.txt").write_text("project(reachd VERSION 1.2.4 LANGUAGES C)\n")
        self.assertEqual(version(self.tree), f"1.2.4 ({self.revision()}-dirty)")

    def test_the_real_tree(self):
        self.assertRegex(version(SOURCE), r"^\d+\.\d+\.\d+ \(\w+(-dirty)?\)$")

    def test_a_file_is_written_when_it_differs(self):
        file = self.tree.parent / "version.txt"
        version(self.tree, file)
        self.assertEqual(file.read_text(), version(self.tree) + "\n")
        os.utime(file, (1, 1))
        version(self.tree, file)
        self.assertEqual(file.stat().st_mtime, 1)
        self.commit()
        version(self.tree, file)
        self.assertNotEqual(file.stat().st_mtime, 1)

    def test_a_copy_is_not_of_the_repository_around_it(self):
        copy = self.tree / "copy"
        shutil.copytree(self.tree / "tools", copy / "tools")
        shutil.copy(self.tree / "CMakeLists.txt", copy)
        self.assertEqual(version(copy), "1.2.3 (unknown)")

    def test_an_archive_knows_where_it_is_from(self):
        archive, unpacked = self.tree.parent / "tree.tar", self.tree.parent / "unpacked"
        self.git("archive", "--output", archive, "HEAD")
        unpacked.mkdir()
        run("tar", "-xf", archive, "-C", unpacked)
        self.assertEqual(version(unpacked), f"1.2.3 ({self.revision()})")


if __name__ == "__main__":
    unittest.main()
