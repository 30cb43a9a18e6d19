"""A program outside the tree links the installed learner, by pkg-config and by CMake."""

import math
import os
import tempfile
import unittest
from pathlib import Path

import tree

EXAMPLE = tree.PREFIX / "share/doc/libreach-dev/examples/learner"


class Outside(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = Path(folder.name)

    def succeed(self, *command, **environment: str) -> str:
        result = tree.run(*command, cwd=self.work, env={**os.environ, **environment})
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def check(self, program: Path) -> None:
        rows = self.succeed(program).splitlines()
        self.assertEqual(len(rows), 6)
        for row in rows:
            z, _, values = row.partition(":")
            low, high = sorted(float(value) for value in values.split())
            self.assertAlmostEqual(low, math.sin(float(z)), delta=0.1)
            self.assertAlmostEqual(high, math.sin(float(z)) + 1, delta=0.1)

    def test_pkg_config(self):
        folder = next(tree.PREFIX.glob("lib/**/pkgconfig"))
        flags = self.succeed("pkg-config", "--cflags", "--libs", "reach-learner",
                             PKG_CONFIG_PATH=str(folder)).split()  # fmt: skip
        self.assertIn(f"-I{tree.PREFIX}/include", [os.path.normpath(f) for f in flags])
        self.succeed("cc", "-Wall", "-Werror", EXAMPLE / "two_valued.c", *flags, "-o", "two_valued")
        self.check(self.work / "two_valued")

    def test_cmake(self):
        self.succeed("cmake", "-S", EXAMPLE, "-B", "build", f"-DCMAKE_PREFIX_PATH={tree.PREFIX}")
        self.succeed("cmake", "--build", "build")
        self.check(self.work / "build/two_valued")

    def test_message_types(self):
        """A robot's driver with the headers and the library of the messages."""
        driver = tree.PREFIX / "share/doc/reach-tools/examples/robot_driver"
        folder = next(tree.PREFIX.glob("lib/**/pkgconfig"))
        flags = self.succeed("pkg-config", "--cflags", "--libs", "reach-lcmtypes",
                             PKG_CONFIG_PATH=str(folder)).split()  # fmt: skip
        self.succeed("cc", "-D_GNU_SOURCE", *driver.glob("*.c"), *flags, "-lm", "-o", "driver")
        result = tree.run(self.work / "driver", "one", "word", "too many")
        self.assertEqual((result.returncode, result.stderr), (2, "usage: robot_driver [LCM_URL]\n"))


if __name__ == "__main__":
    unittest.main()
