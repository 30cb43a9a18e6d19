"""What the tests of reach-eval share: generated data, and the program on it."""

import gzip
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

REACH_EVAL = Path(os.environ["REACH_BUILD_DIR"]) / "bin/reach-eval"

SLOPE = np.array([[0.8, -0.5, 0.3], [0.2, 0.6, -0.9]])  # D = 2, d = 3
STEP = np.array([1.0, 0.5])  # what a tool adds
PARAMETERS = ["--param", "psi0=0.01", "sigma0=10", "ridge=0.003", "hyper_psi=.inf",
              "prior_psi=.inf", "clustering=leader", "p0=0.001"]  # fmt: skip


def samples(n: int, seed: int, offset=(0.0, 0.0)) -> np.ndarray:
    """Rows of an exactly linear function."""
    z = np.random.default_rng(seed).uniform(-1, 1, (n, 3))
    return np.hstack([z, z @ SLOPE.T + offset])


def run(*words) -> subprocess.CompletedProcess:
    command = [REACH_EVAL, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


class Fixture(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.json = self.folder / "out.json"

    def write(self, name: str, rows, header: str = "") -> Path:
        """A CSV file; gzip where the name says so."""
        path = self.folder / name
        lines = [header] if header else []
        lines += [",".join(repr(float(v)) for v in row) for row in rows]
        data = ("\n".join(lines) + "\n").encode()
        path.write_bytes(gzip.compress(data) if name.endswith(".gz") else data)
        return path

    def text(self, name: str, content: str) -> Path:
        path = self.folder / name
        path.write_text(content)
        return path

    def words(self, *words) -> list:
        return ["--learner", "imle", "--inputs", 3, "--outputs", 2, *PARAMETERS,
                "--json", self.json, *words]  # fmt: skip

    def evaluate(self, *words) -> dict:
        """The report of a run that has nothing to warn of."""
        result = run(*self.words(*words))
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stderr)
        return self.report()

    def report(self) -> dict:
        return json.loads(self.json.read_text())

    def warnings_of(self, *words) -> list[str]:
        """What a run warns of, on stderr and in its report alike."""
        result = run(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        warnings = self.report()["warnings"]
        told = "".join(f"reach-eval: warning: {warning}\n" for warning in warnings)
        self.assertEqual(result.stderr, told)
        return warnings
