"""Replays of logs as loggers leave them: torn, in pieces, with messages twice or of others, several
runs in one file. Taken, or refused with the true reason."""

import random
import struct
import subprocess
import unittest

from replaying import HEADER, REACHD, Replay, events, replay

TRACE, CONFIG, STATE = "REACH_TRACE", "REACH_CONFIG", "ROBOT_STATE"


def made(channel: str, data: bytes, stamp: int = 0) -> bytes:
    """An event."""
    head = b"\xed\xa1\xda\x01" + struct.pack(">qqII", 0, stamp, len(channel), len(data))
    return head + channel.encode() + data


class Logs(Replay):
    def setUp(self):
        super().setUp()
        self.log = self.golden("lockstep")
        self.whole = self.log.read_bytes()
        self.events = events(self.whole)
        self.ticks = sum(channel == TRACE for _, channel, _, _ in self.events)

    def pieces_of(self, index: int) -> tuple[bytes, bytes, bytes]:
        """What is before an event, it, and what is behind it."""
        at, _, _, end = self.events[index]
        return self.whole[:at], self.whole[at:end], self.whole[end:]

    def nth(self, channel: str, n: int) -> int:
        return [i for i, event in enumerate(self.events) if event[1] == channel][n]

    def verified(self, *paths) -> str:
        result = replay(*paths, "--verify")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("everything that was sent is the same to the byte", result.stdout)
        return result.stdout

    def same(self, log: bytes, ticks: int | None = None, runs: str = "1 run") -> str:
        self.log.write_bytes(log)
        said = self.verified(self.log)
        self.assertIn(f"{self.ticks if ticks is None else ticks} ticks in {runs}", said)
        return said


class Twice(Logs):
    def test_any_message_of_a_tick_may_be_logged_twice(self):
        for channel in (TRACE, CONFIG, STATE, "MARKER", "ROBOT_COMMAND", "REACH_STATUS"):
            with self.subTest(channel):
                before, one, behind = self.pieces_of(self.nth(channel, 3))
                said = self.same(before + one + one + behind)
                self.assertEqual("1 REACH_TRACE were logged twice" in said, channel == TRACE)

    def test_all_of_them(self):
        twice = b"".join(self.whole[at:end] * 2 for at, _, _, end in self.events)
        self.assertIn(f"{self.ticks} REACH_TRACE were logged twice", self.same(twice))

    def test_a_trace_that_comes_again_later(self):
        _, one, _ = self.pieces_of(self.nth(TRACE, 50))
        before, next_but_one, behind = self.pieces_of(self.nth(TRACE, 52))
        said = self.same(before + next_but_one + one + behind)
        self.assertIn("1 REACH_TRACE were logged twice", said)


class Foreign(Logs):
    """Somebody else speaks on our channels."""

    def test_messages_of_others_are_left_out_and_told(self):
        strange = made(TRACE, b"\1" * 40) + made(TRACE, b"") + made(CONFIG, b"\2" * 20)
        for n in (0, 40, -1):
            before, one, behind = self.pieces_of(self.nth(TRACE, n))
            said = self.same(before + one + strange + behind)
            self.assertIn("2 REACH_TRACE are of another version", said)
        before, one, behind = self.pieces_of(0)
        self.same(made(CONFIG, b"x" * 9) + before + one + behind)

    def test_nothing_but_those_of_others(self):
        none = b"".join(self.whole[a:e] for a, c, _, e in self.events if c != TRACE)
        self.assert_refused(none + made(TRACE, b"\1" * 40), "this REACH_TRACE is of another version"
                            " of reachd's messages, or of another program")  # fmt: skip
        none = b"".join(self.whole[a:e] for a, c, _, e in self.events if c != CONFIG)
        self.assert_refused(none + made(CONFIG, b"\1" * 40), "this REACH_CONFIG is of another")

    def test_a_trace_of_ours_that_became_foreign_is_missed(self):
        for n in (40, -1):
            at, _, begin, _ = self.events[self.nth(TRACE, n)]
            damaged = self.whole[:begin] + b"\0" + self.whole[begin + 1 :]
            self.assert_refused(damaged, f"byte {at}: this REACH_TRACE is of another version")


class Runs(Logs):
    def test_two_runs_in_one_file(self):
        self.same(self.whole + self.whole, 2 * self.ticks, "2 runs")
        other = self.golden("real-time").read_bytes()
        ticks = sum(channel == TRACE for _, channel, _, _ in events(other))
        self.same(self.whole + other, self.ticks + ticks, "2 runs")

    def test_the_first_torn(self):
        cut = self.events[self.nth(TRACE, 100)][0] + HEADER + 20
        self.log.write_bytes(self.whole[:cut] + self.whole)
        result = replay(self.log, "--verify")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{100 + self.ticks} ticks in 2 runs", result.stdout)
        self.assertIn("are no event of an LCM log; they were left out", result.stderr)


class Pieces(Logs):
    def split(self, n: int) -> list:
        """Files of about equal size, cut between events."""
        bounds = [self.events[i * len(self.events) // n][0] for i in range(n)] + [len(self.whole)]
        paths = [self.folder / f"run.lcmlog.{i:02}" for i in range(n)]
        for i, path in enumerate(paths):
            path.write_bytes(self.whole[bounds[i] : bounds[i + 1]])
        return paths

    def test_in_any_order(self):
        paths = self.split(7)
        random.Random(3).shuffle(paths)
        self.assertIn(f"{self.ticks} ticks in 1 run", self.verified(*paths))

    def test_a_missing_piece_and_a_file_that_is_no_log(self):
        paths = self.split(5)
        result = replay(*paths[:2], *paths[3:], "--verify")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(
            result.stderr, r"run\.lcmlog\.03: byte \d+: tick \d+: .* is not in the log"
        )
        paths[2].write_bytes(b"of another kind")
        result = replay(*paths, "--verify")
        self.assertIn("run.lcmlog.02: there is no event of an LCM log in it", result.stderr)
        result = replay(*paths, self.folder / "none", "--verify")
        self.assertRegex(result.stderr, "none: No such file")

    def test_the_last_one_torn_or_empty(self):
        paths = self.split(3)
        paths[2].write_bytes(paths[2].read_bytes()[:-9])
        result = replay(*paths, "--verify")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"run\.lcmlog\.02: the log ends within an event, at byte")
        paths[2].write_bytes(b"")
        self.verified(*paths)

    def test_standard_input(self):
        command = f"xz -dc < {self.folder}/log.xz | {REACHD} --replay - --verify"
        subprocess.run(f"xz -c {self.log} > {self.folder}/log.xz", shell=True, check=True)
        for line in (
            command,
            f"{REACHD} --replay - --verify < {self.log}",
            f"bash -c '{REACHD} --replay <(xz -dc {self.folder}/log.xz) --verify'",
        ):
            result = subprocess.run(line, shell=True, capture_output=True, text=True, timeout=100)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"{self.ticks} ticks in 1 run", result.stdout)

    def test_a_folder(self):
        result = replay(self.folder, "--verify")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1))
        self.assertIn("Is a directory", result.stderr)


class Terminal(Logs):
    def test_nothing_in_a_log_commands_the_terminal(self):
        """Neither its revision nor its configuration."""
        escaped = b"\x1b]0;x\x07"
        log = self.whole
        for _, channel, begin, _ in self.events:
            if channel == CONFIG:
                log = log[: begin + 28] + escaped + log[begin + 28 + len(escaped) :]
        self.log.write_bytes(log)
        result = replay(self.log, "--verify")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("recorded by reachd \\x1b]0;x\\x07", result.stderr)
        self.assertNotIn("\x1b", result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
