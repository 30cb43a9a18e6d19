"""`./run paper` on very few samples: the real programs fill every row, are not run twice, and come
to the same where models are saved and loaded in between."""

import contextlib
import io
import json
import tempfile
import time
import unittest
from importlib.util import find_spec
from pathlib import Path
from unittest import mock

from reach.paper import __main__ as paper
from reach.paper import kobian

TINY = {"hand": 15, "tool": 15, "again": 3, "tests": 4, "turn_seconds": 2.0,
        "star_seconds": 2.0}  # fmt: skip


class Live(unittest.TestCase):
    def call(self, out: Path, only: str = "K1,K2,K3,K4") -> str:
        with contextlib.redirect_stderr(io.StringIO()) as said, \
             contextlib.redirect_stdout(io.StringIO()):  # fmt: skip
            status = paper.main(["--quick", "--learner", "body", "--only", only,
                                 "--out", str(out)])  # fmt: skip
        self.assertEqual(status, 0, said.getvalue())
        return said.getvalue()

    @mock.patch.object(kobian, "settings", lambda quick, learner: TINY)
    def test_every_row_is_measured_once(self):
        with tempfile.TemporaryDirectory() as name:
            out = Path(name)
            self.call(out)
            recordings = list(out.glob("runs/*/run.rrd"))
            self.assertEqual(len(recordings), find_spec("rerun") is not None)
            table = json.loads((out / "summary.json").read_text())
            self.assertEqual([row["id"] for row in table if row["n"] != 1], [])
            values = {row["id"]: row["mean"] for row in table}
            self.assertEqual(values["K2.hand.targets"], 16)
            self.assertLess(values["K3.hand.final_error_median_px"], 8)
            began = time.monotonic()
            self.assertIn("1 runs, 1 of them complete", self.call(out))
            self.assertLess(time.monotonic() - began, 60)

    def test_saving_and_loading_takes_no_time_of_the_disk(self):
        tables = []
        for _ in range(2):
            with tempfile.TemporaryDirectory() as name:
                self.call(Path(name), "E1")
                tables.append((Path(name) / "summary.json").read_bytes())
        self.assertEqual(*tables)


if __name__ == "__main__":
    unittest.main()
