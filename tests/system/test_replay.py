"""Recorded runs, replayed to the byte: in lockstep and in real time, from a log and from
lcm-logplayer; and logs that were altered, cut or belong to somebody else, which must be noticed."""

import lzma
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import lcm
import recorded_runs
from reach import programs
from reach.messages import ROOT, reach
from reach.processes import Processes

REACHD = programs.BINARIES / "reachd"
HEADER = 28  # bytes of an event before the channel's name
INEXACT = (
    "acos", "asin", "atan", "atan2", "cbrt", "cos", "cosh", "exp", "exp2", "expm1", "hypot",
    "lgamma", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan", "tanh",
    "tgamma",
)  # fmt: skip
LEAST_SPEED = 20  # times real time


def replay(*arguments) -> subprocess.CompletedProcess:
    command = [str(word) for word in (REACHD, "--replay", *arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=100)


def events(log: bytes) -> list[tuple[int, str, int, int]]:
    """Of each event: where it begins, its channel, where its message begins and ends."""
    found, at = [], 0
    while at < len(log):
        name, size = struct.unpack(">II", log[at + 20 : at + HEADER])
        message = at + HEADER + name
        found.append((at, log[at + HEADER : message].decode(), message, message + size))
        at = message + size
    return found


class Replay(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def golden(self, name: str) -> Path:
        """One of tests/golden, unpacked."""
        path = self.folder / f"{name}.lcmlog"
        path.write_bytes(lzma.decompress((ROOT / f"tests/golden/{name}.lcmlog.xz").read_bytes()))
        return path

    def assert_same(self, *arguments) -> str:
        result = replay(*arguments, "--verify")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (0, 0), result.stderr)
        self.assertIn("everything that was sent is the same to the byte", result.stdout)
        return result.stdout

    def assert_refused(self, log: bytes, reason: str, *options: str) -> None:
        path = self.folder / "wrong.lcmlog"
        path.write_bytes(log)
        result = replay(path, "--verify", *options)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertRegex(result.stderr, reason)


class GoldenLogs(Replay):
    def test_they_are_repeated_to_the_byte(self):
        for name in ("lockstep", "real-time"):
            with self.subTest(name):
                log = self.golden(name)
                result = replay(log, "--verify")
                self.assertEqual(result.returncode, 0, f"{result.stderr} If that is meant: "
                                 "./run golden makes these logs anew.")  # fmt: skip
                ticks = int(result.stdout.split()[0])
                self.assertGreater(ticks, 150)

    def test_any_altered_byte_is_noticed(self):
        seed = int(os.environ.get("REACH_TEST_SEED", time.time_ns() % 10**9))
        print(f"REACH_TEST_SEED={seed}", flush=True)
        chance = random.Random(seed)
        for name in ("lockstep", "real-time"):
            log = self.golden(name).read_bytes()
            spans = self.consumed_and_sent(log)
            for channel in sorted(spans):
                for _ in range(4):
                    begin, end = chance.choice(spans[channel])
                    at = chance.randrange(begin, end)
                    wrong = bytearray(log)
                    wrong[at] ^= 1 << chance.randrange(8)
                    with self.subTest(f"{name}: {channel}, byte {at}"):
                        self.assert_refused(bytes(wrong), "byte [0-9]+: ")

    def consumed_and_sent(self, log: bytes) -> dict[str, list[tuple[int, int]]]:
        """Messages that a tick was given, or sent, by channel."""
        traces, spans = [], {}
        for _, channel, begin, end in events(log):
            spans.setdefault(channel, []).append((begin, end))
            if channel == "REACH_TRACE":
                traces.append(reach.trace_t.decode(log[begin:end]))
        used = {
            "ROBOT_STATE": {t.given_state for t in traces if t.has_state},
            "REACH_REQUEST": {s for t in traces for s in t.request[: t.n_requests]},
            "ROBOT_COMMAND": {t.seq for t in traces if t.command_checksum},
            "REACH_STATUS": {t.seq for t in traces},
            "REACH_TRACE": {t.seq for t in traces},
            "REACH_SAMPLE": set(range(10**6)),
        }
        observed = {s for t in traces for s in t.observation[: t.n_observations]}
        used["MARKER"] = used["END_EFFECTOR"] = observed
        chosen = {}
        for channel, numbers in used.items():
            once = {}
            for begin, end in spans.get(channel, []):
                seq = struct.unpack(">q", log[begin + 16 : begin + 24])[0]
                once.setdefault(seq, []).append((begin, end))
            # What came twice may be altered once and nothing is lost.
            chosen[channel] = [s[0] for n, s in once.items() if n in numbers and len(s) == 1]
        return {channel: found for channel, found in chosen.items() if found}

    def test_the_first_difference_is_named(self):
        log = self.golden("real-time")
        gains = self.folder / "gains.yaml"
        gains.write_text("task: {gain: 2.5}\n")
        options = ["--config", ROOT / "etc/icub.yaml", "--config", gains]
        result = replay(log, "--verify", *options)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(
            result.stderr, r"byte \d+: tick \d+: REACH_TRACE\.config: recorded -?\d+, replayed"
        )
        self.assertEqual(replay(log, *options).returncode, 0)  # what would it have done

    def test_logs_that_cannot_be_replayed(self):
        log = self.golden("lockstep").read_bytes()
        found = events(log)
        traces = [event for event in found if event[1] == "REACH_TRACE"]
        _, _, begin, end = traces[40]
        cut_event = begin - HEADER - len("REACH_TRACE")
        without_configs = b"".join(
            log[at:stop] for at, channel, _, stop in found if channel != "REACH_CONFIG"
        )
        for reason, wrong in {
            rf"byte {cut_event}: the log ends within this event": log[: begin + 7],
            r"byte 0: this is no event of an LCM log": b"# reachd\n" * 9,
            r"there is no REACH_TRACE in it": log[: found[0][3]],
            r"tick 42: before it, REACH_TRACE 41 is not in the log": log[:cut_event] + log[end:],
            r"tick 41: before it, REACH_TRACE 1 is not in the log": log[cut_event:],
            r"its configuration, of checksum \w+, was not recorded": without_configs,
            r"this REACH_TRACE is of another version": log[:begin] + b"\1" + log[begin + 1 :],
        }.items():
            with self.subTest(reason):
                self.assert_refused(wrong, reason)


class NewLogs(Replay):
    def test_in_lockstep_and_fast(self):
        recorded_runs.lockstep_without_eyes(self.folder, 1500)
        said = self.assert_same(self.folder / "run.lcmlog")
        speed = int(re.search(r"(\d+) times real time", said)[1])
        self.assertGreater(speed, LEAST_SPEED)

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


class Arithmetic(unittest.TestCase):
    def test_no_decision_depends_on_the_c_library(self):
        """It chooses its code by the processor. Checks at start and durations may use it."""
        archives = [
            programs.BINARIES.parent / f"daemon/lib{n}.a" for n in ("reachd_core", "reach_learner")
        ]
        said = subprocess.run(["nm", "-A", "--undefined-only", *archives], check=True,
                              capture_output=True, text=True).stdout  # fmt: skip
        self.assertRegex(said, r"timing\.c\.o: +U log\n")
        users = re.findall(rf":(\w+)\.cc?\.o: +U (?:{'|'.join(INEXACT)})\n", said)
        self.assertEqual(set(users), {"config_check", "timing"})


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
