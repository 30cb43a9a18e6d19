"""What reach-export makes of a log: tables and samples, and what it says of what is bad."""

import contextlib
import io
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import lcm
import numpy as np
import synthetic
from export_bed import Exported, filled, joint_state, state, status, stereo
from pyarrow import parquet
from reach import export, read_log
from reach.messages import ROOT, bot_core
from reach.messages import reach as types

REACH_EVAL = Path(os.environ["REACH_BUILD_DIR"]) / "bin/reach-eval"
FAR = 2**62


class Tables(Exported):
    def test_words_units_joints_and_the_log_s_stamp(self):
        self.write(
            [
                ("JOINT_STATE", 11, joint_state()),
                ("ROBOT_STATE", 12, state(1)),
                ("REACH_STATUS", 13, status(state=5, phase=99)),
            ]
        )
        self.export("--csv", self.folder / "csv", "--parquet", self.folder / "parquet")
        (said,) = self.rows("REACH_STATUS")
        self.assertEqual((said["log_utime"], said["state"], said["state_word"]),
                         ("13", "5", "FAULT"))  # fmt: skip
        self.assertEqual((said["phase"], said["phase_word"]), ("99", ""))
        about = {(row["channel"], row["column"]): row for row in self.rows("columns")}
        elbow = about["ROBOT_STATE", "position[1]"]
        self.assertEqual((elbow["unit"], elbow["joint"]), ("rad", "elbow"))
        self.assertEqual(about["JOINT_STATE", "joint_effort[2]"]["unit"], "N m")
        table = parquet.read_table(self.folder / "parquet/ROBOT_STATE.parquet")
        metadata = table.schema.field("velocity[2]").metadata
        self.assertEqual((metadata[b"unit"], metadata[b"joint"]), (b"rad/s", b"wrist"))
        self.assertEqual(table["log_utime"].to_pylist(), [12])
        words = parquet.read_table(self.folder / "parquet/REACH_STATUS.parquet")["state_word"]
        self.assertEqual(words.to_pylist(), ["FAULT"])

    def test_columns_are_those_in_use(self):
        self.write([("ROBOT_STATE", 1, state(1, n=2)), ("ROBOT_STATE", 2, state(2, n=4))])
        self.export("--csv", self.folder / "csv", "--parquet", self.folder / "parquet")
        rows = self.rows("ROBOT_STATE")
        self.assertNotIn("position[4]", rows[0])
        self.assertEqual([row["position[3]"] for row in rows], ["", "2.3"])
        table = parquet.read_table(self.folder / "parquet/ROBOT_STATE.parquet")
        self.assertEqual(table["position[3]"].to_pylist(), [None, 2.3])
        self.assertEqual(table["position[1]"].to_pylist(), [1.1, 2.1])

    def test_a_body_has_no_columns_for_all_its_numbers(self):
        body = filled(types.body_t(), {"samples": 7, "why": [*b"too few", *[0] * 153]})
        request = types.body_request_t()
        self.write([("REACH_BODY", 1, body), ("REACH_BODY_REQUEST", 2, request)])
        said = self.export("--csv", self.folder / "csv")
        self.assertIn("1 message not exported: 1 REACH_BODY_REQUEST", said)
        (row,) = self.rows("REACH_BODY")
        self.assertEqual((row["samples"], row["why"]), ("7", "too few"))
        self.assertLess(len(row), 30)
        self.assertEqual(read_log(self.log)["REACH_BODY"]["numbers"].shape, (1, 5841))

    def test_a_whole_run(self):
        synthetic.make(self.folder)
        record = read_log(self.log)
        self.export("--csv", self.folder / "csv", "--parquet", self.folder / "parquet")
        for channel in ("REACH_SAMPLE", "SIM_TRUTH", "MARKER"):
            table = parquet.read_table(self.folder / f"parquet/{channel}.parquet")
            rows, wanted = self.rows(channel), record[channel]
            self.assertEqual((len(rows), table.num_rows), (len(wanted), len(wanted)))
            name = {"REACH_SAMPLE": "values[0][2]", "SIM_TRUTH": "marker[1]"}.get(channel, "radius")
            base, *index = name.replace("]", "").split("[")
            column = wanted[base][(slice(None), *map(int, index))]
            np.testing.assert_array_equal([float(row[name] or 0) for row in rows], column)
            np.testing.assert_array_equal(table[name].fill_null(0).to_numpy(), column)


class Asked(Exported):
    """What is taken of a log, and what is told of the rest."""

    def setUp(self):
        super().setUp()
        self.write(
            [("REACH_STATUS", 1_000_000 * i, status(seq=i)) for i in range(1, 6)]
            + [("MARKER", 3_000_000, types.marker_t())]
        )

    def seqs(self, *words) -> list[str]:
        self.export("--csv", self.folder / "csv", *words)
        return [row["seq"] for row in self.rows("REACH_STATUS")]

    def test_times(self):
        self.assertEqual(self.seqs(), ["1", "2", "3", "4", "5"])
        self.assertEqual(self.seqs("--from", "1", "--to", "2.5"), ["2", "3"])
        self.assertEqual(self.seqs("--from", "3"), ["4", "5"])

    def test_channels(self):
        self.export("--csv", self.folder / "csv", "--channels", "MARKER|SIM_.*")
        self.assertEqual(
            {p.name for p in (self.folder / "csv").iterdir()}, {"MARKER.csv", "columns.csv"}
        )
        self.export("--csv", self.folder / "none", "--channels", "MARK", code=1)

    def test_wrong_usage(self):
        for words in (["--from", "-1"], ["--to", "x"], ["--channels", "("], []):
            more = ["--csv", "x"] if words else []
            with self.assertRaises(SystemExit) as ended, contextlib.redirect_stderr(io.StringIO()):
                export.main([str(self.log), *more, *words])
            self.assertEqual(ended.exception.code, 2)


class Bad(Exported):
    """Each is counted and told in one line; none is a traceback."""

    def every_format(self) -> str:
        said = {
            self.export("--csv", self.folder / "csv"),
            self.export("--parquet", self.folder / "parquet"),
        }
        self.assertEqual(len(said), 1, said)
        return self.export("--mcap", self.folder / "run.mcap")

    def test_messages(self):
        short = stereo(bot_core.image_t.PIXEL_FORMAT_MJPEG).encode()[:-3]
        bad_names = joint_state().encode()[:40]
        good = [("ROBOT_STATE", 5, state(1)), ("JOINT_STATE", 5, joint_state())]
        fingerprint = state(1).encode()
        cases = {
            "1 message with a time that MCAP cannot hold: 1 ROBOT_STATE":
                ("ROBOT_STATE", 5, state(1, utime=FAR)),
            "1 message with a time that MCAP cannot hold: 1 REACH_STATUS":
                ("REACH_STATUS", 5, status(utime=-1)),
            "1 message with a time that MCAP cannot hold: 1 MARKER":
                ("MARKER", -3, types.marker_t()),
            "1 message that cannot be read: 1 ROBOT_STATE":
                ("ROBOT_STATE", 5, b"\0" + fingerprint[1:]),
            "1 message that cannot be read: 1 REACH_TRACE": ("REACH_TRACE", 5, b""),
            "1 message that cannot be read: 1 JOINT_STATE": ("JOINT_STATE", 5, bad_names),
            "1 pair of images that cannot be read": ("STEREO_IMAGES", 5, short),
            "1 message on channels that are not ours: 1 CAMERA": ("CAMERA", 5, b"12345678"),
        }  # fmt: skip
        for says, message in cases.items():
            with self.subTest(says):
                self.write([*good, message, *good])
                self.assertIn(says, self.every_format())
        for data in (b"nonsense", b"", joint_state().encode()[:8] + b"\x7f\xff" * 20):
            self.write([("JOINT_STATE", 5, data), ("STEREO_IMAGES", 5, data), *good])
            self.assertIn("1 JOINT_STATE", self.every_format())

    def test_names_cannot_command_the_terminal(self):
        self.write([("ROBOT_STATE", 5, state(1)), ("\x1b[2J\x9bé", 5, b"12345678")])
        self.assertIn("1 \\x1b[2J\\x9b\\xe9\n", self.every_format())

    def test_a_damaged_log(self):
        self.write([("ROBOT_STATE", 5, state(i)) for i in range(5)])
        whole = self.log.read_bytes()
        self.log.write_bytes(whole[:-100])
        said = self.every_format()
        size = len(whole) // 5
        self.assertIn(f"{size - 100} bytes are no event: {size - 100} at byte {4 * size}, the end",
                      said)  # fmt: skip
        with self.assertWarnsRegex(UserWarning, "no event"):
            record = read_log(self.log)
        self.assertEqual((len(record["ROBOT_STATE"]), record.gaps[0].at_end), (4, True))

    def test_a_full_disk_ends_with_a_line_and_leaves_nothing(self):
        synthetic.make(self.folder)
        for option, name in (("--mcap", "run.mcap"), ("--csv", "csv"), ("--test-samples", "s.csv")):
            code = (
                "import resource, signal, sys; signal.signal(signal.SIGXFSZ, signal.SIG_IGN);"
                "resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000));"
                "from reach import export; sys.exit(export.main(sys.argv[1:]))"
            )
            command = [sys.executable, "-c", code, self.log, option, self.folder / name]
            result = subprocess.run(command, capture_output=True, text=True, timeout=60)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn("File too large", result.stderr)
            left = [p for p in self.folder.rglob("*") if ".new" in p.name or p.suffix == ".mcap"]
            self.assertEqual(left, [])


class Samples(Exported):
    def sample(self, learned: int, q: list[float], x: list[float]) -> types.sample_t:
        return filled(
            types.sample_t(),
            {
                "learned": learned,
                "n_inputs": len(q),
                "n_outputs": len(x),
                "q": q + [0.0] * (16 - len(q)),
                "x": x + [0.0] * (8 - len(x)),
            },
        )

    def test_reach_eval_takes_them(self):
        rows = [[0.1 * i, -0.2 * i] for i in range(60)]
        space = status(space=types.status_t.CARTESIAN)
        self.write(
            [("REACH_STATUS", 1, space)]
            + [
                ("REACH_SAMPLE", 2, self.sample(i % 3 != 0, q, [sum(q), 1.0]))
                for i, q in enumerate(rows)
            ]
            + [("REACH_SAMPLE", 3, self.sample(1, [float("nan"), 0], [0, 0]))]
        )
        train, test = self.folder / "train.csv", self.folder / "test.csv"
        said = self.export("--samples", train, "--test-samples", test)
        self.assertIn("40 samples, 1 left out that hold no finite numbers", said)
        self.assertIn("; 20 samples", said)
        report = self.folder / "report.json"
        command = [REACH_EVAL, "--learner", "imle", "--inputs", "2", "--outputs", "2",
                   "--param", "psi0=1e-4", "sigma0=1", "--train", train, "--test", f"all={test}",
                   "--json", report, "--quiet"]  # fmt: skip
        subprocess.run(command, check=True, timeout=60, capture_output=True)
        result = json.loads(report.read_text())["results"][-1]
        self.assertEqual((result["at"], result["test"]["all"]["rows"]), (40, 20))

    def test_angles_of_a_head_are_in_degrees_there(self):
        self.write(
            [
                ("REACH_STATUS", 1, status(space=types.status_t.VISUAL)),
                ("REACH_SAMPLE", 2, self.sample(1, [0.5], [np.pi / 2, -np.pi, 7.0])),
            ]
        )
        path = self.folder / "s.csv"
        self.export("--samples", path)
        self.assertEqual(path.read_text().split(), ["q1,x1,x2,x3", "0.5,90.0,-180.0,7.0"])

    def test_what_cannot_be_said(self):
        path = self.folder / "s.csv"
        for messages, says in (
            ([("REACH_SAMPLE", 2, self.sample(1, [1.0], [1.0]))], "no REACH_STATUS before"),
            ([("REACH_STATUS", 1, status())], "there is no REACH_SAMPLE"),
            ([("REACH_STATUS", 1, status()), ("REACH_SAMPLE", 2, self.sample(1, [1.0], [1.0])),
              ("REACH_SAMPLE", 2, self.sample(1, [1.0, 2.0], [1.0]))], "and then 2 and 1"),
        ):  # fmt: skip
            self.write(messages)
            self.assertIn(says, self.export("--samples", path, code=1))
            self.assertEqual([p.name for p in self.folder.iterdir()], ["run.lcmlog"])

    def test_the_shipped_example(self):
        command = [REACH_EVAL, "--learner", "imle", "--inputs", "7", "--outputs", "3", "--quiet",
                   "--train", ROOT / "examples/icub_samples.csv", "--json",
                   self.folder / "report.json"]  # fmt: skip
        subprocess.run(command, check=True, timeout=60, capture_output=True)


class Large(Exported):
    def test_memory_does_not_grow_with_the_log(self):
        """Three times as long a log wants hardly more memory."""
        peaks = []
        for n in (40_000, 120_000):
            self.write([])
            one = [state(i).encode() for i in range(100)]
            log = lcm.EventLog(str(self.log), "w", overwrite=True)
            for i in range(n):
                log.write_event(20_000 * i, "ROBOT_STATE", one[i % 100])
            log.close()
            code = (
                "import resource, sys; from reach import export;"
                "code = export.main(sys.argv[1:]);"
                "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss); sys.exit(code)"
            )
            command = [
                sys.executable,
                "-c",
                code,
                self.log,
                "--mcap",
                self.folder / "run.mcap",
                "--csv",
                self.folder / "csv",
                "--parquet",
                self.folder / "parquet",
            ]
            result = subprocess.run(command, capture_output=True, text=True, timeout=100)
            self.assertEqual(result.returncode, 0, result.stderr)
            peaks.append(int(result.stdout.split()[-1]))
        print(f"memory for {n // 3} and {n} messages: {peaks} kB")
        self.assertLess(peaks[1] - peaks[0], 20_000)


if __name__ == "__main__":
    unittest.main()
