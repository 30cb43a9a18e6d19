"""A log becomes a recording for Rerun, read back by Rerun's own reader."""

import contextlib
import io
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import numpy as np
import synthetic
from reach import export, read_log, recording
from reach.messages import ROOT, bot_core
from reach.messages import reach as types
from rerun.chunk import RrdReader

RERUN = Path(sys.executable).with_name("rerun")
JOINTS = ("shoulder_pitch", "shoulder_yaw", "shoulder_roll", "elbow", "neck_yaw", "neck_pitch")
PLOTS = ("error", "experts", "solutions", "samples", "compute_us")


def rows_of(path: Path) -> dict[str, list]:
    """Entity -> its chunks as tables."""
    tables: dict[str, list] = {}
    for chunk in RrdReader(str(path)).stream():
        tables.setdefault(chunk.entity_path.strip("/"), []).append(chunk.to_record_batch())
    return tables


def counts(path: Path) -> Counter:
    return Counter({name: sum(table.num_rows for table in tables)
                    for name, tables in rows_of(path).items()})  # fmt: skip


def values(path: Path, entity: str) -> dict[int, float]:
    """Robot time in us -> a plot's value."""
    found = {}
    for table in rows_of(path)[entity]:
        times = table.column("robot_time").to_numpy(zero_copy_only=False).astype("int64")
        for time, value in zip(times, table.column("Scalars:scalars").to_pylist(), strict=True):
            found[int(time) // 1000] = value[0]
    return found


def write_joints(writer: synthetic.Writer, names=JOINTS) -> None:
    writer.write("JOINT_STATE", bot_core.joint_state_t(), num_joints=len(names),
                 joint_name=list(names), joint_position=[0.1] * len(names),
                 joint_velocity=[0.0] * len(names), joint_effort=[0.0] * len(names))  # fmt: skip


class Recording(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.log, self.path = self.folder / "run.lcmlog", self.folder / "run.rrd"

    def make(self, ticks: int, names=JOINTS) -> None:
        writer = synthetic.Writer(self.log)
        for tick in range(ticks):
            write_joints(writer, names)
            writer.step(1, types.status_t.MOVE, tick, np.array([tick, 0, 1]))
        writer.close()

    def test_what_a_person_sees_is_in_it(self):
        self.make(100)  # two seconds
        self.assertEqual(export.main([str(self.log), "--rrd", str(self.path)]), 0)
        subprocess.run([RERUN, "rrd", "verify", self.path], check=True, capture_output=True)
        found = counts(self.path)
        shown = [f"plots/{name}" for name in PLOTS] + [f"robot/joints/{name}" for name in JOINTS]
        for entity in [*shown, "eyes/left/ball", "eyes/right/ball", "robot/ball"]:
            self.assertIn(found[entity], (20, 21), entity)  # ten a second
        status = read_log(self.log)["REACH_STATUS"]
        cost = dict(zip(status["utime"] - status["utime"][0], status["compute_us"], strict=True))
        plotted = values(self.path, "plots/compute_us")
        self.assertEqual(plotted, {int(time): cost[time] for time in plotted})

    def test_the_robot_is_the_one_that_has_the_joints(self):
        for names, robot in ((JOINTS, "kobian"), (("nobody",), None)):
            self.make(1, names)
            found = recording.robot_of(self.log)
            self.assertEqual(found, robot and ROOT / f"etc/robots/{robot}.urdf")
            recording.write(self.log, self.path)
            self.assertEqual(any(e.startswith("kobian") for e in counts(self.path)), bool(robot))

    def test_two_are_written_by_one_program(self):
        self.make(10)
        recording.write(self.log, self.path)
        first = counts(self.path)
        recording.write(self.log, self.folder / "again.rrd")
        self.assertEqual(counts(self.folder / "again.rrd"), first)

    def test_beside_a_log(self):
        self.make(10)
        self.assertIsNone(recording.beside(self.log))
        self.assertGreater(counts(self.path)["plots/error"], 0)

    def test_what_cannot_be_is_said_in_one_line(self):
        self.make(10)
        for words, says in (
            (["--rrd", self.path, "--urdf", self.folder / "none.urdf"], "none.urdf"),
            (["--rrd", self.path, "--urdf", ROOT / "README.md"], "URDF"),
            (["--rrd", self.folder / "none/run.rrd"], "none/run.rrd"),
        ):
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(export.main([str(word) for word in (self.log, *words)]), 1)
            self.assertEqual(said.getvalue().count("\n"), 1, said.getvalue())
            self.assertIn(says, said.getvalue())
        self.assertEqual([path.name for path in self.folder.iterdir()], ["run.lcmlog"])

    def test_without_rerun_one_line_says_so(self):
        self.make(10)
        self.path.write_text("of an earlier run")
        code = ("import sys; sys.modules['rerun'] = None; from pathlib import Path;"
                "from reach import export, recording;"
                f"print(recording.beside(Path('{self.log}')));"
                f"sys.exit(export.main(['{self.log}', '--rrd', '{self.path}']))")  # fmt: skip
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        for text in (result.stdout, result.stderr):
            self.assertEqual(text.count("\n"), 1, text)
            self.assertIn("requirements-live.txt", text)
        self.assertFalse(self.path.exists())


if __name__ == "__main__":
    unittest.main()
