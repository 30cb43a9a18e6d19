"""What bad configurations, models and messages get: each case is tried, and the table of
docs/hostile-input.md must say exactly what it got. With --write, the table is written anew."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from reach.messages import ROOT, reach
from reach.programs import BINARIES
from robot import Robot

PAGE = ROOT / "docs/hostile-input.md"
ETC = ROOT / "etc"
BEGIN, END = "<!-- tried by tests/system/test_hostile_table.py -->\n", "<!-- end -->\n"


def complaint(*command, folder: Path) -> str:
    """The last line, with the file's folder left out, and the exit code."""
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, timeout=20
    )
    line = (done.stderr.strip().splitlines() or ["nothing"])[-1]
    return f"{line.replace(f'{folder}/', '').replace(f'{ROOT}/', '')} ({done.returncode})"


def reachd(*options) -> list:
    return [BINARIES / "reachd", *options]


def configurations(folder: Path):
    """Name of the case and its answer."""
    good = (ETC / "kobian.yaml").read_text()
    for name, text in {
        "not YAML": "arm: [1, 2\n",
        "an empty file": "",
        "binary": "\x00\x01\x02\x7f",
        "an unknown option": "nonsense: 1\n" + good,
        "an option twice": "period: 0.02\n" + good,
        "out of range": good.replace("period: 0.02 ", "period: 20 "),
        "not a number": good.replace("period: 0.02 ", "period: .nan "),
        "a line end in a value": good.replace("period: 0.02 ", 'period: "a\\nb" '),
        "a list for a number": good.replace("period: 0.02 ", "period: [1, 2] "),
        "limits that cross": good.replace("[-70, -30, -15, -90]\n  max", "[0, 0, 0, 0]\n  max", 1),
        "too many joints": good.replace("[-70, -30, -15, -90]", str([-1] * 17), 1),
        "a wish beyond the gate": good.replace("arm_velocity: 40 ", "arm_velocity: 80 "),
        "a thousand levels": "a: " + "{a: " * 1000 + "1" + "}" * 1000 + "\n",
    }.items():
        file = folder / "robot.yaml"
        file.write_text(text)
        yield name, complaint(*reachd("--lockstep", "--config", file), folder=folder)
    yield "no such file", complaint(*reachd("--config", folder / "none.yaml"), folder=folder)
    (folder / "robots").mkdir()
    yield "a folder", complaint(*reachd("--config", folder / "robots"), folder=folder)
    os.mkfifo(folder / "pipe")
    yield "a pipe", complaint(*reachd("--config", folder / "pipe"), folder=folder)


def stored_model(folder: Path) -> None:
    """A model of no samples, as a first start leaves it."""
    daemon = subprocess.Popen(
        reachd("--no-rt", "--config", ETC / "kobian.yaml", "--set", f"model.directory={folder}"),
        stderr=subprocess.DEVNULL,
    )
    robot = Robot()
    robot.run(10, lambda: robot.status)
    daemon.terminate()
    daemon.wait()


def models(folder: Path):
    kept, tried = folder / "kept", folder / "model"
    kept.mkdir()
    stored_model(kept)
    model, journal = "current-000000.imle", "current-000000.journal"

    def answer(*options) -> str:
        command = reachd("--check-model", "--config", ETC / "kobian.yaml", *options)
        return complaint(*command, "--set", f"model.directory={tried}", folder=folder)

    def flip(at: int):
        return lambda old: old[:at] + bytes([old[at] ^ 1]) + old[at + 1 :]

    for name, file, change in (
        ("a bit of the model flipped", model, flip(100)),
        ("a bit of its header flipped", model, flip(1)),
        ("the model cut short", model, lambda old: old[:-1]),
        ("an empty model", model, lambda _: b""),
        ("the model made longer", model, lambda old: old + b"x"),
        ("a text for a model", model, lambda _: b"hello, world\n" * 20),
        ("a text for a journal", journal, lambda _: b"hello, world\n" * 20),
        ("a bit of the journal flipped", journal, flip(9)),
    ):
        shutil.copytree(kept, tried)
        (tried / file).write_bytes(change((tried / file).read_bytes()))
        yield name, answer()
        shutil.rmtree(tried)
    shutil.copytree(kept, tried)
    (tried / journal).unlink()
    yield "the journal missing", answer()
    shutil.rmtree(tried)
    shutil.copytree(kept, tried)
    yield "another learner", answer("--set", "learner.kind=lwpr")
    yield "other parameters", answer("--set", "learner.degree=2")
    (tried / model).unlink()
    os.mkfifo(tried / model)
    yield "a pipe in the place of the model", answer()


def state_of(robot: Robot, **fields):
    state = reach.robot_state_t.decode(robot.state_message())
    for name, value in fields.items():
        setattr(state, name, value)
    return state.encode()


def messages(_: Path):
    """What the status says a moment after each: how many were refused, and the request's result."""
    daemon = subprocess.Popen(
        reachd("--no-rt", "--config", ETC / "kobian.yaml"), stderr=subprocess.DEVNULL
    )
    try:
        robot = Robot()
        robot.run(10, lambda: robot.status)
        nan, infinite = float("nan"), float("inf")
        good = robot.state_message()
        for name, channel, data in (
            ("nothing", "ROBOT_STATE", b""),
            ("another type", "ROBOT_STATE", reach.marker_t().encode()),
            ("one byte short", "ROBOT_STATE", good[:-1]),
            ("one byte long", "ROBOT_STATE", good + b"x"),
            ("a joint too many", "ROBOT_STATE", state_of(robot, n_joints=7)),
            ("joints below none", "ROBOT_STATE", state_of(robot, n_joints=-1)),
            ("2 billion joints", "ROBOT_STATE", state_of(robot, n_joints=2**31 - 1)),
            ("a joint that is no number", "ROBOT_STATE", state_of(robot, position=[nan] * 16)),
            ("a joint out of this world", "ROBOT_STATE", state_of(robot, position=[1e9] * 16)),
            ("a time below zero", "ROBOT_STATE", state_of(robot, utime=-1)),
        ):
            yield f"{channel}: {name}", robot.refusals(channel, data)
        for name, fields in (
            ("no number", {"u_right": nan}),
            ("infinite", {"disparity": infinite}),
            ("out of any image", {"v_right": 1e12}),
        ):
            marker = reach.marker_t()
            marker.seen, marker.utime, marker.seq = 1, 1, 1
            for field, value in fields.items():
                setattr(marker, field, value)
            yield f"MARKER: {name}", robot.refusals("MARKER", marker.encode())
        kinds = reach.request_t
        for name, fields in (
            ("an unknown kind", {"kind": 99}),
            ("babble: no samples", {"kind": kinds.BABBLE, "count": 0}),
            ("babble: samples below none", {"kind": kinds.BABBLE, "count": -5}),
            ("reach: no targets", {"kind": kinds.REACH, "period": 1.0}),
            ("reach: 33 targets", {"kind": kinds.REACH, "n_targets": 33, "period": 1.0}),
            ("reach: a period that is no number",
             {"kind": kinds.REACH, "n_targets": 1, "period": nan}),
            ("reach: a target that is no number",
             {"kind": kinds.REACH, "n_targets": 1, "period": 1.0, "target": [[nan] * 3] * 32}),
            ("load: no such number", {"kind": kinds.LOAD, "count": -1}),
        ):  # fmt: skip
            yield f"REACH_REQUEST: {name}", robot.answer(**fields)
        yield "and after all that", "state " + ("idle" if robot.idle() else "not idle")
    finally:
        daemon.kill()
        daemon.wait()


def table() -> str:
    lines = []
    for title, cases in (
        ("configuration", configurations), ("model", models), ("message", messages),
    ):  # fmt: skip
        lines += [f"| {title} | what it got |\n", "|---|---|\n"]
        with tempfile.TemporaryDirectory() as folder:
            for name, answer in cases(Path(folder)):
                lines.append(f"| {name} | {answer.replace('|', '/')} |\n")
        lines.append("\n")
    return "".join(lines)


class Table(unittest.TestCase):
    maxDiff = None

    def test_the_page_tells_the_truth(self):
        text = PAGE.read_text()
        told = text[text.index(BEGIN) + len(BEGIN) : text.index(END)]
        self.assertMultiLineEqual(told, table())


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        text = PAGE.read_text()
        PAGE.write_text(text[: text.index(BEGIN) + len(BEGIN)] + table() + text[text.index(END) :])
    else:
        unittest.main()
