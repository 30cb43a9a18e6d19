"""Today's reachd makes the golden logs again, to the byte. Logs that were altered or cut, or are
not ours, are noticed."""

import os
import random
import re
import struct
import subprocess
import time
import unittest

from reach import programs
from reach.messages import ROOT, reach
from replaying import HEADER, Replay, events, replay

LOGS = ("lockstep", "real-time", "body")
INEXACT = (
    "acos", "asin", "atan", "atan2", "cbrt", "cos", "cosh", "exp", "exp2", "expm1", "hypot",
    "lgamma", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan", "tanh",
    "tgamma",
)  # fmt: skip


def flipped(log: bytes, at: int, bits: int = 1) -> bytes:
    """The log with bits of one byte turned over."""
    return log[:at] + bytes([log[at] ^ bits]) + log[at + 1 :]


class GoldenLogs(Replay):
    def test_they_are_repeated_to_the_byte(self):
        for name in LOGS:
            with self.subTest(name):
                log = self.golden(name)
                result = replay(log, "--verify")
                self.assertEqual(result.returncode, 0, f"{result.stderr} If that is meant: "
                                 "./run golden makes these logs anew.")  # fmt: skip
                ticks = int(result.stdout.split()[0])
                self.assertGreater(ticks, 100)

    def test_any_altered_byte_is_noticed(self):
        seed = int(os.environ.get("REACH_TEST_SEED", time.time_ns() % 10**9))
        print(f"REACH_TEST_SEED={seed}", flush=True)
        chance = random.Random(seed)
        for name in LOGS:
            log = self.golden(name).read_bytes()
            spans = self.consumed_and_sent(log)
            for channel in sorted(spans):
                for _ in range(4):
                    begin, end = chance.choice(spans[channel])
                    at = chance.randrange(begin, end)
                    with self.subTest(f"{name}: {channel}, byte {at}"):
                        wrong = flipped(log, at, 1 << chance.randrange(8))
                        self.assert_refused(wrong, "byte [0-9]+: ")

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
            "REACH_BODY": {t.body for t in traces if t.body},
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
            r"there is no event of an LCM log in it": b"# reachd\n" * 9,
            r"there is no REACH_TRACE in it": log[: found[0][3]],
            r"tick 42: before it, REACH_TRACE 41 is not in the log": log[:cut_event] + log[end:],
            r"tick 41: before it, REACH_TRACE 1 is not in the log": log[cut_event:],
            r"its configuration, of checksum \w+, was not recorded": without_configs,
            r"this REACH_TRACE is of another version": flipped(log, begin),
            r"the checksum of this REACH_TRACE is wrong": flipped(log, end - 1),
            r"the REACH_STATUS at byte \d+ has another checksum": self.with_another_duration(log),
        }.items():
            with self.subTest(reason):
                self.assert_refused(wrong, reason)

    def test_what_a_killed_logger_leaves_is_verified_up_to_its_end(self):
        path, log = self.golden("lockstep"), self.golden("lockstep").read_bytes()
        traces = [event for event in events(log) if event[1] == "REACH_TRACE"]
        for at, _, begin, end in traces[40:43]:
            for cut in (at + 2, at + HEADER, begin + 7, end - 1):
                path.write_bytes(log[:cut])
                result = replay(path, "--verify")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(f"ends within an event, at byte {at};", result.stderr)
                before = sum(trace[0] < at for trace in traces)
                self.assertTrue(result.stdout.startswith(f"{before} ticks"), result.stdout)

    def test_a_false_length_ends_nothing(self):
        """It hid all of the log behind it."""
        path, log = self.golden("lockstep"), self.golden("lockstep").read_bytes()
        at, _, _, end = events(log)[1]
        path.write_bytes(log[: at + 24] + struct.pack(">I", 1 << 24) + log[at + HEADER :])
        result = replay(path, "--verify")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{end - at} bytes from byte {at} on are no event", result.stderr)
        whole = sum(event[1] == "REACH_TRACE" for event in events(log))
        self.assertTrue(result.stdout.startswith(f"{whole} ticks"), result.stdout)

    def with_another_duration(self, log: bytes) -> bytes:
        """What is measured, and cannot be computed anew, is altered."""
        for _, channel, begin, end in events(log):
            if channel == "REACH_STATUS":
                status = reach.status_t.decode(log[begin:end])
                status.compute_us += 1
                return log[:begin] + status.encode() + log[end:]
        raise AssertionError("there is no status")


class Arithmetic(unittest.TestCase):
    def test_no_decision_depends_on_the_c_library(self):
        """It chooses its code by the processor. Checks at start and durations may use it."""
        archives = [
            programs.BINARIES.parent / n
            for n in (
                "common/base/libcommon_base.a",
                "daemon/libdaemon.a",
                "learner/libreach_learner.a",
            )
        ]
        said = subprocess.run(["nm", "-A", "--undefined-only", *archives], check=True,
                              capture_output=True, text=True).stdout  # fmt: skip
        self.assertRegex(said, r"duration_histogram\.c\.o: +U log\n")
        users = re.findall(rf":(\w+)\.cc?\.o: +U (?:{'|'.join(INEXACT)})\n", said)
        self.assertEqual(set(users), {"check", "duration_histogram"})


if __name__ == "__main__":
    unittest.main()
