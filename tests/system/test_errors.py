"""What bad circumstances get: one line that says what to do, and an exit code that is not 0."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from reach import programs
from reach.bus import Bus
from reach.messages import ROOT
from reach.messages import reach as types
from reach.processes import Processes

ETC = ROOT / "etc"
COMMANDS = {
    "reachd": ["--config", ETC / "kobian.yaml", "--lockstep"],
    "reach-vision": ["--config", ETC / "vision-kobian.yaml"],
    "reach-simrobot": ["--config", ETC / "simrobot-kobian.yaml"],
}


def run(*command, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, timeout=30,
        env={**os.environ, **environment},
    )  # fmt: skip


class Errors(unittest.TestCase):
    def assert_one_line(self, result: subprocess.CompletedProcess, *pieces: str, code: int = 1):
        """The complaint is the last line, and the only one that is no note of progress."""
        self.assertEqual(result.returncode, code, result.stderr)
        lines = result.stderr.strip().splitlines()
        self.assertLessEqual(len(lines), 1, result.stderr)
        for piece in pieces:
            self.assertIn(piece, result.stderr)

    def test_no_multicast_route(self):
        for name, options in {**COMMANDS, "reachctl": ["status"]}.items():
            with self.subTest(name):
                command = [programs.BINARIES / name, *options]
                result = run(ROOT / "tools/netns.sh", "--no-route", *command)
                self.assert_one_line(result, "ip route add 224.0.0.0/4 dev lo")

    def test_unknown_key(self):
        for name, options in COMMANDS.items():
            with self.subTest(name), tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
                file.write(Path(options[1]).read_text() + "\nnonsense: 1\n")
                file.flush()
                line = Path(file.name).read_text().count("\n")
                result = run(programs.BINARIES / name, "--config", file.name, *options[2:])
                self.assert_one_line(result, f"{file.name}:{line}:", "nonsense", "unknown option")

    def test_urdf_without_the_joints(self):
        result = run(programs.BINARIES / "reach-simrobot", *COMMANDS["reach-simrobot"],
                     "--set", "robot.arm_joints=no_such_joint")  # fmt: skip
        self.assert_one_line(result, "no_such_joint", "kobian.urdf")

    def test_a_robot_is_checked_without_a_run(self):
        simulator = programs.BINARIES / "reach-simrobot"
        for name in ("kobian", "icub", "sixaxis"):
            result = run(simulator, "--check", "--config", ETC / f"simrobot-{name}.yaml")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
        with tempfile.TemporaryDirectory() as folder:
            urdf = Path(folder) / "arm.urdf"
            text = (ETC / "robots/sixaxis.urdf").read_text()
            urdf.write_text(text.replace('effort="', 'effort="0.00'))
            command = [simulator, "--check", "--config", ETC / "simrobot-sixaxis.yaml",
                       "--set", f"robot.urdf={urdf}"]  # fmt: skip
            result = run(*command)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertGreaterEqual(result.stderr.count("too weak"), 2)
            urdf.write_text(text.replace('effort="', 'effort="-'))
            result = run(*command)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 6)
            self.assertEqual(result.stderr.count(f"{urdf}:"), 6)

    def test_no_graphics(self):
        result = run(programs.BINARIES / "reach-simrobot", *COMMANDS["reach-simrobot"],
                     __EGL_VENDOR_LIBRARY_FILENAMES="/dev/null")  # fmt: skip
        self.assert_one_line(result, "EGL")

    def test_two_of_a_kind(self):
        for name, options in COMMANDS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                command = [programs.BINARIES / name, *options]
                with Processes(Path(folder)) as processes:
                    processes.start(name, command)
                    role = {"reachd": types.hello_t.DAEMON, "reach-vision": types.hello_t.VISION,
                            "reach-simrobot": types.hello_t.SIMULATOR}[name]  # fmt: skip
                    Bus(check=processes.check).wait_for_role(role, name)
                    result = run(*command)
                    processes.check()
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertRegex(result.stderr.strip().splitlines()[-1], "another|already")


if __name__ == "__main__":
    unittest.main()
