"""What ./run setup and tools/netns.sh say on a system that is too old, on one without apt-get, and
where a user's namespace has no rights. Small programs in PATH play the system."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["REACH_SOURCE_DIR"])
PACKAGES = """\
# group, name, reason
build cmake   build system
build liblcm-dev the bus
lint  cppcheck static checks
"""
POLICY = """\
case $2 in
cmake) echo '  Candidate: {cmake}' ;;
python3) echo '  Candidate: 2:{python}' ;;
esac
"""


class System(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name).resolve()
        self.bin = self.tree / "bin"
        self.bin.mkdir()
        (self.tree / "cmake").mkdir()
        (self.tree / "cmake/packages.txt").write_text(PACKAGES)
        for name in (
            "sh",
            "bash",
            "awk",
            "sort",
            "comm",
            "paste",
            "sed",
            "cat",
            "mkdir",
            "id",
            "env",
        ):
            real = subprocess.run(["which", name], check=True, capture_output=True, text=True)
            (self.bin / name).symlink_to(real.stdout.strip())

    def program(self, name: str, text: str) -> None:
        path = self.bin / name
        path.unlink(missing_ok=True)
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(0o755)

    def debian(self, cmake: str, python: str) -> None:
        """A Debian without any package, whose archive has these versions; apt-get keeps a list of
        what it was asked for."""
        self.program("dpkg-query", "exit 0\n")
        self.program("apt-cache", POLICY.format(cmake=cmake, python=python))
        self.program("apt-get", f'echo "$*" >>{self.tree}/asked\n')
        self.program("id", "echo 0\n")
        self.program("python3", "exit 1\n")

    def asked(self) -> str:
        path = self.tree / "asked"
        return path.read_text() if path.exists() else ""

    def setup(self, command: str) -> tuple[int, str]:
        script = f". {SOURCE}/tools/dev/setup.sh; setup_find_python() {{ false; }}; {command}"
        return self.run_here("bash", "-euc", script)

    def run_here(self, *command) -> tuple[int, str]:
        result = subprocess.run([str(word) for word in command], cwd=self.tree, text=True,
                                capture_output=True, env={"PATH": str(self.bin)})  # fmt: skip
        return result.returncode, result.stderr


class Setup(System):
    def test_a_system_that_is_too_old_ends_before_anything_is_installed(self):
        for cmake, python, wanted in (
            (
                "3.22.1-1ubuntu1",
                "3.10.6-1",
                "cmake 3.25 or newer is wanted, and this system has 3.22.1",
            ),
            ("3.28.3-1build7", "3.10.6-1", "python3 3.11 or newer is wanted"),
            ("(none)", "3.12.3-0", "cmake 3.25 or newer is wanted, and this system has none"),
        ):
            with self.subTest(cmake=cmake, python=python):
                self.debian(cmake, python)
                code, said = self.setup("setup_packages build")
                self.assertEqual(code, 1, said)
                self.assertIn(wanted, said)
                self.assertIn("Ubuntu 24.04", said)
                self.assertNotIn("install", self.asked())

    def test_versions_are_compared_as_numbers(self):
        self.debian("3.100.0-1", "3.11.2-1+b1")
        code, said = self.setup("setup_packages build")
        self.assertEqual(code, 0, said)
        self.assertIn("install --no-install-recommends cmake liblcm-dev", self.asked())

    def test_without_apt_get_it_says_once_what_is_needed_and_goes_on(self):
        code, said = self.setup("setup_packages build; echo went on >&2; setup_packages build")
        self.assertEqual(code, 0, said)
        self.assertEqual(said.count("liblcm-dev the bus"), 1, said)
        self.assertNotIn("cppcheck", said)
        self.assertTrue(said.endswith("went on\n"), said)


class Namespace(System):
    def refused(self, restricted: str) -> str:
        self.program("unshare", "exit 1\n")
        self.program("cat", f"echo {restricted}\n")
        code, said = self.run_here(SOURCE / "tools/netns.sh", "true")
        self.assertEqual(code, 1)
        return said

    def test_it_names_the_switch_that_is_off(self):
        self.assertIn("kernel.apparmor_restrict_unprivileged_userns=0", self.refused("1"))
        self.assertIn("kernel.unprivileged_userns_clone=1", self.refused("0"))

    def test_it_names_the_switch_too_where_the_namespace_has_no_rights(self):
        self.program("cat", "echo 1\n")
        self.program("ip", "exit 2\n")
        code, said = self.run_here(SOURCE / "tools/netns.sh", "--inside", "yes", "true")
        self.assertEqual(code, 1)
        self.assertIn("kernel.apparmor_restrict_unprivileged_userns=0", said)


if __name__ == "__main__":
    unittest.main()
