"""Messages that reachd refuses are told: counted in the status, a line a second in the log, a
finding of the doctor; and in lockstep answered, so that the sender does not wait for ever."""

import json
import statistics
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from reach.messages import ROOT
from reach.messages import reach as types
from reach.programs import BINARIES
from robot import Robot

STATUS = types.status_t


class Refusals(unittest.TestCase):
    def start(self, clock: str) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        log = self.enterContext((self.folder / "log").open("w"))
        self.daemon = subprocess.Popen(
            [BINARIES / "reachd", clock, "--config", ROOT / "etc/kobian.yaml"], stderr=log
        )
        self.addCleanup(self.daemon.wait)
        self.addCleanup(self.daemon.terminate)
        self.robot = Robot()

    def said(self) -> str:
        return (self.folder / "log").read_text()

    def bad_state(self, **fields) -> types.robot_state_t:
        state = types.robot_state_t.decode(self.robot.state_message())
        state.position = [*state.position[:2], 2.5, *state.position[3:]]
        for name, value in fields.items():
            setattr(state, name, value)
        return state

    def test_a_flood_is_a_line_a_second(self):
        self.start("--no-rt")
        self.assertTrue(self.robot.run(10, lambda: self.robot.status), self.said())
        doctor = subprocess.Popen(
            [BINARIES / "reachctl", "--json", "doctor"], stdout=subprocess.PIPE, text=True
        )
        end = time.monotonic() + 3
        while time.monotonic() < end:
            self.robot._lcm.publish("ROBOT_STATE", self.bad_state().encode())
            self.robot._lcm.publish("REACH_REQUEST", b"nonsense")
            self.robot.run(0.01)
        refused = self.robot.status.refused
        self.assertGreater(refused[STATUS.CHANNEL_STATE][STATUS.VALUE], 50)
        self.assertGreater(refused[STATUS.CHANNEL_REQUEST][STATUS.MALFORMED], 50)
        self.assertEqual(sum(map(sum, refused)), self.robot.status.bad_inputs)
        lines = [line for line in self.said().splitlines() if "refused: " in line]
        self.assertIn(len(lines), range(1, 6), self.said())
        self.assertRegex(lines[-1], r"\d+ ROBOT_STATE \(a value is out of range\)")
        self.assertRegex(lines[-1], r"\d+ REACH_REQUEST \(malformed\)")
        self.assertRegex(lines[-1], r"joint 3 is at 2.5, which must be within -?[\d.]+ \.\. [\d.]+")
        findings = {f["check"]: f for f in json.loads(doctor.communicate(timeout=30)[0])}
        self.assertEqual(findings["refused messages"]["verdict"], "finding", findings)
        self.assertIn("ROBOT_STATE", findings["refused messages"]["text"])

    def test_states_faster_than_the_loop(self):
        """4 kHz: the loop takes the newest, and passes over the rest without a complaint."""
        self.start("--no-rt")
        self.assertTrue(self.robot.run(10, lambda: self.robot.status), self.said())
        ages, used = [], set()
        end = time.monotonic() + 2
        while time.monotonic() < end:
            due = time.monotonic() + 0.005
            for _ in range(20):
                self.robot._publish_state()
            while (left := due - time.monotonic()) > 0:
                self.robot._lcm.handle_timeout(int(left * 1000) + 1)
                ages.append(self.robot.status.staleness)
                used.add(self.robot.status.state_seq)
        self.assertEqual(self.robot.status.bad_inputs, 0, self.said())
        self.assertGreater(len(used), 50)
        self.assertGreater(self.robot.status.state_seq, 40 * len(used))
        self.assertLess(statistics.median(ages), 0.008)  # what comes after 64 states is not lost

    def test_a_second_sender(self):
        """It says that the arm is at rest at mid-range, with numbers of its own."""
        self.start("--no-rt")
        self.assertTrue(self.robot.run(10, lambda: self.robot.status), self.said())
        self.robot.request(types.request_t.BABBLE, count=1000, seed=1)
        moving = lambda: any(abs(v) > 0.2 for v in self.robot.commands[-1][:4])  # noqa: E731
        self.assertTrue(self.robot.run(5, moving), self.said())
        second, first_publish = Robot(), self.robot._publish_state
        second._position = [0.0, -0.2, 0.5, -0.8, 0.0, 0.2]

        def publish_both() -> None:
            first_publish()
            self.robot._lcm.publish("ROBOT_STATE", second.state_message())

        self.robot._publish_state = publish_both
        in_fault = lambda: self.robot.status.state == STATUS.FAULT  # noqa: E731
        self.assertTrue(self.robot.run(1, in_fault), self.said())
        self.robot.run(0.3)
        self.assertFalse(any(self.robot.commands[-1]))
        self.assertRegex(self.said(), "fault: (two senders of ROBOT_STATE|a joint jumped: joint)")

    def test_lockstep_answers(self):
        """The very first state, and one whose marker will never come."""
        self.start("--lockstep")
        answers = []
        self.robot._lcm.subscribe(
            "ROBOT_COMMAND", lambda _, data: answers.append(types.robot_command_t.decode(data))
        )
        state = self.bad_state(lockstep=1, vision_due=12345)
        end = time.monotonic() + 10
        while time.monotonic() < end and not answers:
            self.robot._lcm.publish("ROBOT_STATE", state.encode())
            self.robot._lcm.handle_timeout(100)
        self.assertTrue(answers, self.said())
        self.assertEqual(answers[0].state_seq, state.seq)
        self.assertFalse(any(answers[0].velocity))
        end = time.monotonic() + 3
        while "joint 3 is at 2.5" not in self.said():
            self.assertLess(time.monotonic(), end, self.said())
            time.sleep(0.05)


if __name__ == "__main__":
    unittest.main()
