"""`reachctl new-robot` as a user calls it: one command from a URDF to a table of targets."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from reach.messages import ROOT
from reach.programs import BINARIES

URDF = ROOT / "etc/robots/sixaxis.urdf"


def new_robot(folder: Path, *words) -> subprocess.CompletedProcess:
    command = [BINARIES / "reachctl", "new-robot", *words]
    return subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True)


class NewRobot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_from_a_urdf_to_reaching(self):
        done = new_robot(self.folder, URDF)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"body    found from \d+ samples")
        self.assertIn("12 of 12 within 10 mm", done.stdout)
        distances = re.findall(r"^ +(?:-?\d\.\d{3} +){3}(\d+\.\d\d)$", done.stdout, re.MULTILINE)
        self.assertEqual(len(distances), 12, done.stdout)
        self.assertLess(max(map(float, distances)), 3)
        again = new_robot(self.folder, URDF, "--write-only")
        self.assertEqual(again.returncode, 1)
        self.assertIn("sixaxis.yaml: is there already", again.stderr)

    def test_a_robot_that_the_simulator_refuses(self):
        text = URDF.read_text()
        path = self.folder / "weightless.urdf"
        path.write_text(re.sub(r"<inertial>.*?</inertial>", "", text, flags=re.DOTALL))
        done = new_robot(self.folder, path)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"weightless.urdf:\d+: link tower: .*needs <inertial>")
        self.assertIn("--repair-inertia mends masses", done.stderr)

    def test_wrong_usage(self):
        for words in ([], [URDF, "--samples", "0"], [URDF, "--fly"]):
            done = new_robot(self.folder, *words)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
