"""./run robots on a robot of this tree, and with --ten on ten public arms, where they were fetched
(python -m reach.robots.packages)."""

import sys
import tempfile
import unittest
from pathlib import Path

from reach.robots import __main__ as robots
from reach.robots import measure
from reach.robots.packages import Packages, usual_folder

TEN = "--ten" in sys.argv
if TEN:
    sys.argv.remove("--ten")


class Robots(unittest.TestCase):
    def rows(self, *words: str) -> list[measure.Row]:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        options = robots.parse_arguments([*words, "--out", folder.name])
        rows = robots.run(options)
        again = [measure.read(Path(folder.name) / row.name / "row.json") for row in rows]
        self.assertEqual(rows, again)  # so that it can go on where it was stopped
        return rows

    def assert_sound(self, row: measure.Row) -> None:
        """What holds for every arm that loads."""
        self.assertLess(row.off_chain, 1e-3)
        self.assertLess(row.drift, 0.2)
        if Packages(usual_folder()).complete:
            self.assertLess(row.kinematics, 1e-6)
            self.assertLess(row.gravity, 1e-6)

    @unittest.skipIf(TEN, "one of this tree is in another test")
    def test_one_of_this_tree(self):
        (row,) = self.rows("--only", "icub", "--targets", "6")
        self.assertEqual((row.refused, row.repaired, row.weak, row.trouble), ("", 0, 0, {}))
        self.assertEqual(row.joints, 7)
        self.assert_sound(row)
        self.assertLess(row.fastest, 1.2)
        self.assertGreater(row.body, 0)
        self.assertEqual(row.reached["body"], 6)
        self.assertIn("polynomial", row.reached)

    @unittest.skipUnless(TEN, "ten arms take some ten minutes")
    def test_ten_public_arms(self):
        if not Packages(usual_folder()).complete:
            self.skipTest("the public arms were not fetched")
        rows = self.rows("--set", "ten")
        self.assertEqual([row.refused for row in rows], [""] * 10)
        for row in rows:
            with self.subTest(row.name):
                self.assert_sound(row)
        self.assertGreaterEqual(sum(row.reached["body"] == 12 for row in rows), 9)


if __name__ == "__main__":
    unittest.main()
