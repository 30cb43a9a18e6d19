"""reach-bench on its smallest case, and the table and picture made of its rows."""

import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from reach import bench

REACH_BENCH = Path(os.environ["REACH_BUILD_DIR"]) / "bin/reach-bench"
TIMES = ("p50", "p99", "p999", "max")


def run(*words) -> subprocess.CompletedProcess:
    command = [REACH_BENCH, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=110)


def row(name: str, experts: int, **others) -> dict:
    times = {"p50": 1.0, "p99": 2.0, "p999": 3.0, "max": 4.0}
    return {"name": name, "d": 7, "D": 3, "experts": experts, "ours_us": times,
            "textbook_us": {k: 20 * v for k, v in times.items()}, "lwpr_us": None,
            "ratio_p50": 20.0, "ratio_p999": 20.0, "stream_us": 5.0, "bytes": 2**20,
            "solutions": 1.5} | others  # fmt: skip


class Measured(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.json = Path(folder.name) / "bench.json"

    def test_rows(self):
        result = run("--only", "linear d=4 M=40", "--calls", 120, "--json", self.json)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        update, predict = json.loads(self.json.read_text())
        self.assertEqual((update["name"], predict["name"]), ("update", "predict"))
        for found in (update, predict):
            self.assertEqual((found["d"], found["D"], found["experts"]), (4, 3, 40))
            self.assertEqual(found["calls"], 120)
            for who in ("ours_us", "textbook_us", "lwpr_us"):
                values = [found[who][key] for key in TIMES]
                self.assertEqual(values, sorted(values))
                self.assertGreater(values[0], 0)
            for key, ratio in (("p50", "ratio_p50"), ("p999", "ratio_p999")):
                wanted = found["textbook_us"][key] / found["ours_us"][key]
                self.assertAlmostEqual(found[ratio], wanted, delta=1e-6 * wanted)
            self.assertGreater(found["stream_us"], 0)
        # Both learned the same samples, so that they are equally large.
        self.assertAlmostEqual(update["textbook_experts"], 40, delta=2)
        self.assertTrue(1 < update["concerned"] < 20)
        self.assertGreater(update["lwpr_fields"], 3)
        self.assertGreaterEqual(predict["solutions"], 1)

    def test_the_tick_of_a_daemon_with_many_experts(self):
        result = run("--only", "tick", "--calls", 20, "--json", self.json)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        (tick,) = json.loads(self.json.read_text())
        self.assertEqual((tick["name"], tick["d"], tick["experts"]), ("tick", 4, 1000))
        self.assertEqual(tick["calls"], 20)
        self.assertIsNone(tick["textbook_us"])
        self.assertIsNone(tick["solutions"])
        self.assertTrue(bench.table([tick]).endswith("MB) |  |\n"))
        self.assertGreater(tick["ours_us"]["p50"], 5)  # it does predict

    def test_mistakes(self):
        for words, code, reason in (
            ((), 2, "--json is missing"),
            (("--json", self.json, "word"), 2, "unexpected word 'word'"),
            (("--json", self.json, "--calls", "0"), 2, "--calls: a whole number"),
            (("--fly",), 2, "unrecognized option"),
            (("--json", self.json, "--only", "fourteen"), 1, "no case holds 'fourteen'"),
            (("--json", "/no/such/folder/x"), 1, "/no/such/folder/x: No such file"),
        ):
            result = run(*words)
            self.assertEqual(result.returncode, code)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(reason, result.stderr)
        self.assertFalse(self.json.exists())
        self.assertIn("--only TEXT", run("--help").stdout)
        self.assertRegex(run("--version").stdout, r"^reach-bench \d+\.\d+\.\d+ \(.+\)\n$")


class Shown(unittest.TestCase):
    def test_table(self):
        text = bench.table([row("update", 40),
                            row("predict quartic", 37, textbook_us=None, ratio_p50=None,
                                ratio_p999=None)])  # fmt: skip
        lines = text.splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({line.count("|") for line in lines}), 1)
        self.assertIn("| update | 7 | 40 | 1 / 3 / 4 | 20 / 60 / 80 |  | 20 / 20 |", lines[2])
        self.assertIn("| predict quartic | 7 | 37 | 1 / 3 / 4 |  |  |  | 5 (1.0 MB)", lines[3])

    def test_files_from_rows(self):
        rows = [row(name, n, d=d) for d in (4, 7) for name in ("update", "predict")
                for n in (40, 1000)]  # fmt: skip
        with tempfile.TemporaryDirectory() as folder:
            source, copy = Path(folder) / "rows.json", Path(folder) / "copy.json"
            source.write_text(json.dumps(rows))
            words = ["bench", "--from", str(source), "--json", str(copy), "--out", folder + "/out"]
            with mock.patch.object(sys, "argv", words), contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(bench.main(), 0)
            self.assertEqual(json.loads(copy.read_text()), rows)
            out = Path(folder) / "out"
            self.assertEqual((out / "table.md").read_text(), bench.table(rows))
            self.assertEqual((out / "cost.png").read_bytes()[:4], b"\x89PNG")


if __name__ == "__main__":
    unittest.main()
