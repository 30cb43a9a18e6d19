"""Runs that are recorded and replayed to the byte: in lockstep and in real time, from a log and
from lcm-logplayer, which also loses something."""

import resource
import shutil
import struct
import subprocess
import sys
import time
import unittest
from pathlib import Path

import lcm
import recorded_runs
from reach import programs
from reach.messages import reach
from reach.processes import Processes
from replaying import REACHD, Replay, events

LEAST_SPEED = 20  # times real time, of processor time: the machine may be busy


def bodies_taken(log: Path) -> list[int]:
    """Numbers of the bodies that the learner was given."""
    traces = [reach.trace_t.decode(event.data) for event in lcm.EventLog(str(log))
              if event.channel == "REACH_TRACE"]  # fmt: skip
    return [trace.body for trace in traces if trace.body]


class NewLogs(Replay):
    def test_in_lockstep_and_fast(self):
        recorded_runs.lockstep_without_eyes(self.folder, 1500)
        log = self.folder / "run.lcmlog"
        self.assertGreater(len(bodies_taken(log)), 1)
        self.without_its_bodies(log)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assert_same(self.folder / "run.lcmlog")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.assertGreater(1500 * 0.02 / took, LEAST_SPEED)  # a sample a tick at most

    def without_its_bodies(self, log: Path) -> None:
        """One that is not there, or was altered, is missed: a replay never searches."""
        whole = log.read_bytes()
        found = [event for event in events(log.read_bytes()) if event[1] == "REACH_BODY"]
        rest, at = [], 0
        for begin, _, _, stop in found:
            rest.append(whole[at:begin])
            at = stop
        missed = r"its learner was given REACH_BODY \d+ is not in the log"
        self.assert_refused(b"".join([*rest, whole[at:]]), missed)
        taken = bodies_taken(log)[0]
        altered = bytearray(whole)
        for _, _, begin, stop in found:
            body = reach.body_t.decode(whole[begin:stop])
            if body.seq == taken and body.outcome == body.FOUND:
                altered[stop - 8 * len(body.numbers) + 8 * 40] ^= 1
        self.assert_refused(bytes(altered), missed)

    def test_in_real_time_with_models(self):
        models = self.folder / "models"
        models.mkdir()
        logs = []
        for name in ("first", "second"):
            (self.folder / name).mkdir()
            recorded_runs.real_time(self.folder / name, models)
            logs.append(self.folder / name / "run.lcmlog")
            # The next run saves its own under this name.
            shutil.copy(models / "model-1.imle", self.folder / f"{name}.imle")
        self.assert_same(logs[0], "--model", self.folder / "first.imle")
        self.assert_refused(logs[0].read_bytes(), "it has a model of hash .* no --model file has")
        self.assert_refused(logs[1].read_bytes(), "tick 1: it has a model of hash")
        # It began with what the first had learned: the snapshot of its start.
        files = [self.folder / "second.imle", *models.glob("current-*.imle")]
        self.assert_same(logs[1], *(word for path in files for word in ("--model", path)))


class Played(Replay):
    """lcm-logplayer into a daemon in its replay clock."""

    def play(self, log: Path) -> tuple[dict[str, list[bytes]], str]:
        """What the daemon sent, by channel, and what it printed at its end."""
        heard = self.folder / "heard.lcmlog"
        with Processes(self.folder) as processes:
            processes.start("recorder", [sys.executable, "-m", "reach.recorder", "--url",
                                         programs.LISTENER_URL, "--channels", "REPLAY_.*",
                                         heard])  # fmt: skip
            processes.start("reachd", [REACHD, "--replay-clock", "--url", programs.LISTENER_URL])
            self.wait_for(heard.exists)
            daemon = self.folder / "reachd.log"
            self.wait_for(lambda: "ready for lcm-logplayer" in daemon.read_text())
            player = ["lcm-logplayer", "-s", "2", "-l", programs.LISTENER_URL, log]
            subprocess.run(player, check=True, timeout=60, capture_output=True)
            time.sleep(0.3)
        sent: dict[str, list[bytes]] = {}
        for event in lcm.EventLog(str(heard)):
            sent.setdefault(event.channel, []).append(event.data)
        return sent, daemon.read_text()

    def wait_for(self, done) -> None:
        end = time.monotonic() + 20
        while not done():
            self.assertLess(time.monotonic(), end, "it does not start")
            time.sleep(0.05)

    def recorded_commands(self, log: Path) -> dict[int, bytes]:
        """Of each tick; the last one is sent once more, at rest, when reachd ends."""
        first: dict[int, bytes] = {}
        for event in lcm.EventLog(str(log)):
            if event.channel == "ROBOT_COMMAND":
                first.setdefault(reach.robot_command_t.decode(event.data).seq, event.data)
        return first

    def test_the_same_commands_come_out(self):
        log = self.golden("real-time")
        sent, said = self.play(log)
        self.assertNotIn("lost:", said)
        self.assertEqual(sent["REPLAY_ROBOT_COMMAND"], list(self.recorded_commands(log).values()))
        ticks = len(sent["REPLAY_REACH_TRACE"])
        self.assertIn(f"{ticks} ticks in 1 run", said)
        self.assertEqual(len(sent["REPLAY_REACH_STATUS"]), ticks)

    def test_what_was_lost_is_said(self):
        log = self.golden("real-time")
        whole = log.read_bytes()
        kept, lost = [], {"ROBOT_STATE": [60, 61, 90], "REACH_TRACE": [100, 101]}
        for at, channel, begin, end in events(whole):
            seq = struct.unpack(">q", whole[begin + 16 : begin + 24])[0]
            if seq not in lost.get(channel, []):
                kept.append(whole[at:end])
        log.write_bytes(b"".join(kept))
        sent, said = self.play(log)
        self.assertRegex(said, r"lost: [23] ROBOT_STATE, the first 60\n")
        self.assertIn("lost: 2 REACH_TRACE, the first 100\n", said)
        recorded = self.recorded_commands(log)
        commands = [reach.robot_command_t.decode(data) for data in sent["REPLAY_ROBOT_COMMAND"]]
        for command, data in zip(commands, sent["REPLAY_ROBOT_COMMAND"], strict=True):
            if command.state_seq < 59:
                self.assertEqual(data, recorded[command.seq])
        # What came after is numbered as it was.
        self.assertEqual(commands[-1].seq, max(recorded))


if __name__ == "__main__":
    unittest.main()
