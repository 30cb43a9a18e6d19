"""The Jacobians that reach-eval compares with."""

import contextlib
import gzip
import io
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from reach import arm_jacobians
from reach.arm import TOOLS, Arm


def rotation(axis: int, angle: float) -> np.ndarray:
    """Right-handed, about x, y or z."""
    i, k = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[k, k] = np.cos(angle)
    matrix[i, k], matrix[k, i] = -np.sin(angle), np.sin(angle)
    return matrix


def tip(q: np.ndarray, tool: np.ndarray) -> np.ndarray:
    """By products of matrices."""
    wrist = rotation(2, -q[5]) @ rotation(1, -q[6]) @ (np.array([0, 0, -0.197]) + tool)
    elbow = rotation(1, q[3]) @ rotation(0, -q[4]) @ (np.array([0, 0, -0.152]) + wrist)
    waist = rotation(2, q[0]) @ rotation(0, q[1]) @ rotation(1, q[2])
    return waist @ (np.array([0, -0.11, 0.18]) + elbow)


class ArmJacobians(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.q = np.random.default_rng(1).uniform(-1, 1, (20, 7))

    def run_main(self, *words) -> tuple[int, str]:
        errors = io.StringIO()
        argv = ["arm_jacobians", *map(str, words)]
        with mock.patch.object(sys, "argv", argv), contextlib.redirect_stderr(errors):
            return arm_jacobians.main(), errors.getvalue()

    def test_tip_and_derivative(self):
        tool, step = TOOLS["L"], 1e-6
        np.testing.assert_allclose(
            Arm().tip(self.q, tool), [tip(q, tool) for q in self.q], atol=1e-14
        )
        found = Arm().jacobian(self.q, tool)
        for q, J in zip(self.q, found, strict=True):
            for k in range(7):
                d = step * np.eye(7)[k]
                difference = (tip(q + d, tool) - tip(q - d, tool)) / (2 * step)
                np.testing.assert_allclose(J[:, k], difference, atol=1e-8)

    def test_columns_are_appended(self):
        rows = np.hstack([self.q, Arm().tip(self.q, TOOLS["stick"])])
        source, target = self.folder / "a.csv.gz", self.folder / "b.csv.gz"
        with gzip.open(source, "wt") as file:
            np.savetxt(file, rows, "%.6f", ",", header="q1,q2,q3,q4,q5,q6,q7,x,y,z", comments="")
        self.assertEqual(self.run_main("--tool", "stick", source, target), (0, ""))
        result = np.loadtxt(target, delimiter=",")
        np.testing.assert_allclose(result[:, :10], rows, atol=1e-6)
        J = Arm().jacobian(self.q, TOOLS["stick"])
        np.testing.assert_allclose(result[:, 10:], J.reshape(20, 21), atol=1e-5)
        code, error = self.run_main("--tool", "none", source, target)
        self.assertEqual(code, 1)
        self.assertRegex(error, r"row \d+ is 0\.2\d+ m off this arm with tool none")

    def test_mistakes(self):
        source = self.folder / "a.csv"
        code, error = self.run_main("--tool", "none", source, self.folder / "b.csv")
        self.assertEqual((code, error.count("\n")), (1, 1))
        source.write_text("1,2,3\n")
        code, error = self.run_main("--tool", "none", source, self.folder / "b.csv")
        self.assertEqual(code, 1)
        self.assertIn("a.csv: 3 columns, not 10", error)


if __name__ == "__main__":
    unittest.main()
