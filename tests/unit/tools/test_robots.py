"""The table of ./run robots, and where public arms are looked for."""

import tempfile
import unittest
from pathlib import Path

from reach.robots import arms, measure, table
from reach.robots.packages import REQUIREMENTS, Packages


class Table(unittest.TestCase):
    ROWS = (
        measure.Row("good", 7, reached={"body": 12, "polynomial": 5}, trouble={}, kinematics=2e-16,
                    drift=0.021, fastest=1.04, body=33, real_time_factor=2.4),
        measure.Row("mended", 6, repaired=2, weak=1, reached={"body": 11},
                    trouble={"polynomial": "it stops"}),
        measure.Row("bad", refused="bad.urdf:7: joint x: is none"),
    )  # fmt: skip

    def test_every_arm_has_a_line(self):
        text = table.of(self.ROWS, 12)
        self.assertIn("| good | 7 | yes | 2.0e-16 |", text)
        self.assertIn("| 2.1 % | 1.04 | 33 | 12 | 5 | 2 |", text)
        self.assertIn("| mended | 6 | 2 repaired |", text)
        self.assertIn("| bad |  | refused |", text)

    def test_sums_and_notes(self):
        text = table.of(self.ROWS, 12)
        self.assertIn("2 of 3 load, 1 of them with repaired masses", text)
        self.assertIn("12 of 12 targets within 1 cm: 1 with a body, 0 with polynomials", text)
        self.assertIn("- bad is refused: bad.urdf:7: joint x: is none\n", text)
        self.assertIn("- mended: motors too weak for the arm's weight: 1", text)
        self.assertIn("- mended, polynomial: it stops\n", text)

    def test_rows_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            for row in self.ROWS:
                measure.write(row, Path(folder) / "row.json")
                self.assertEqual(measure.read(Path(folder) / "row.json"), row)


class Arms(unittest.TestCase):
    def test_thirty_by_names_of_their_own(self):
        names = [arm.name for arm in arms.PUBLIC]
        self.assertEqual((len(names), len(set(names))), (30, 30))
        self.assertLess(set(arms.TEN), set(names))
        self.assertEqual(len(arms.TEN), 10)

    def test_ours_are_there(self):
        for arm in arms.OURS:
            self.assertTrue(arm.path(Path("/nowhere")).is_file())

    def test_other_packages_than_wanted_are_not_complete(self):
        with tempfile.TemporaryDirectory() as folder:
            packages, installed = Packages(Path(folder)), Path(folder) / "requirements.installed"
            self.assertFalse(packages.complete)
            installed.write_text("pin==0\n")
            self.assertFalse(packages.complete)
            installed.write_bytes(REQUIREMENTS.read_bytes())
            self.assertTrue(packages.complete)


if __name__ == "__main__":
    unittest.main()
