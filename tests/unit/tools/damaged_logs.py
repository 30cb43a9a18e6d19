"""Logs as killed loggers, full disks and broken files leave them, each with what is right in it.

Made by the format's description alone, with neither of our readers:
    damaged_logs.py FOLDER   writes them all, and beside each NAME.json with what a reader must find
"""

import json
import random
import struct
import sys
from dataclasses import dataclass, field
from pathlib import Path

MARK = b"\xed\xa1\xda\x01"
HEADER = 28  # bytes before the channel's name
EVENTS = 12
NAME_LENGTH_AT, DATA_LENGTH_AT = 20, 24


@dataclass
class Log:
    """A file, and what is right in it."""

    content: bytes
    kept: list[bytes]  # whole events, as they stand in the file
    gaps: list[tuple[int, int]] = field(default_factory=list)  # position and size of what is none
    torn: bool = False  # the last gap is the end


def event(number: int, channel: bytes, data: bytes, stamp: int | None = None) -> bytes:
    stamp = 1_700_000_000_000_000 + 20_000 * number if stamp is None else stamp
    lengths = struct.pack(">II", len(channel), len(data))
    return MARK + struct.pack(">qq", number, stamp) + lengths + channel + data


def _plain() -> list[bytes]:
    chance = random.Random(7)
    channels = [b"ROBOT_STATE", b"MARKER", b"X"]
    return [event(i, channels[i % 3], bytes(chance.randrange(256) for _ in range(40 + 9 * i)))
            for i in range(EVENTS)]  # fmt: skip


def _with(pieces: list[tuple[bytes, bool]]) -> Log:
    """Of pieces and whether each is a whole event that counts."""
    log, at = Log(b"".join(piece for piece, _ in pieces), []), 0
    for piece, counts in pieces:
        if counts:
            log.kept.append(piece)
        elif log.gaps and sum(log.gaps[-1]) == at:
            log.gaps[-1] = (log.gaps[-1][0], log.gaps[-1][1] + len(piece))
        elif piece:
            log.gaps.append((at, len(piece)))
        at += len(piece)
    log.torn = bool(log.gaps) and sum(log.gaps[-1]) == len(log.content)
    return log


def _altered(events: list[bytes], changes: dict[int, list[tuple[bytes, bool]]]) -> Log:
    """The events, with other pieces in the place of some."""
    pieces: list[tuple[bytes, bool]] = []
    for index, piece in enumerate(events):
        pieces += changes.get(index, [(piece, True)])
    return _with(pieces)


def _number_at(piece: bytes, at: int, number: int) -> bytes:
    return piece[:at] + struct.pack(">I", number) + piece[at + 4 :]


def _wrong_length(events: list[bytes], at: int, number: int) -> Log:
    return _altered(events, {1: [(_number_at(events[1], at, number), False)]})


def _longer(events: list[bytes], at: int, by: int) -> Log:
    length = struct.unpack(">I", events[4][at : at + 4])[0]
    return _altered(events, {4: [(_number_at(events[4], at, length + by), False)]})


def _cut_at_end(events: list[bytes], left: int) -> Log:
    """`left` bytes of the last event are there."""
    return _altered(events, {EVENTS - 1: [(events[-1][:left], False)]})


def _appended(events: list[bytes], *cuts: tuple[int, int]) -> Log:
    """The logger was killed within these events, and started again with -a."""
    return _altered(events, {index: [(events[index][:left], False)] for index, left in cuts})


def all_logs() -> dict[str, Log]:
    events = _plain()
    whole = b"".join(events)
    fake = MARK + struct.pack(">qqII", 1, 2, 5, 7) + b"INNER" + b"seven b"
    holder = event(5, b"HOLDER", b"before " + fake + b" behind")
    nested = event(5, b"HOLDER", b"x" + whole)
    large = event(5, b"STEREO_IMAGES", bytes(range(256)) * 6000)
    flipped = events[4][:1] + b"\0" + events[4][2:]
    nul = event(5, b"NUL\0L", b"data")
    return {
        "whole": _altered(events, {}),
        "empty": Log(b"", []),
        "cut-in-mark": _cut_at_end(events, 2),
        "cut-behind-mark": _cut_at_end(events, 4),
        "cut-in-header": _cut_at_end(events, 21),
        "cut-in-name": _cut_at_end(events, HEADER),
        "cut-in-data": _cut_at_end(events, HEADER + 30),
        "cut-one-byte": _cut_at_end(events, len(events[-1]) - 1),
        "appended-in-data": _appended(events, (5, 60)),
        "appended-in-header": _appended(events, (5, 13)),
        # The event before is followed by no mark, so that nothing says where it ends.
        "appended-in-mark": _altered(events, {4: [(events[4], False)],
                                              5: [(events[5][:2], False)]}),
        "appended-twice": _appended(events, (3, 50), (8, 50)),
        "appended-two-in-a-row": _appended(events, (3, 50), (4, 50)),
        "length-2-to-24": _wrong_length(events, DATA_LENGTH_AT, 1 << 24),
        "length-too-large": _wrong_length(events, DATA_LENGTH_AT, (1 << 28) + 1),
        "length-negative": _wrong_length(events, DATA_LENGTH_AT, 0xFFFFFFFF),
        "length-short-by-one": _longer(events, DATA_LENGTH_AT, -1),
        "length-long-by-one": _longer(events, DATA_LENGTH_AT, 1),
        "name-of-no-length": _wrong_length(events, NAME_LENGTH_AT, 0),
        "name-of-1000": _wrong_length(events, NAME_LENGTH_AT, 1000),
        "name-of-2-to-31": _wrong_length(events, NAME_LENGTH_AT, 1 << 31),
        "name-long-by-one": _longer(events, NAME_LENGTH_AT, 1),
        "name-with-a-zero": _altered(events, {5: [(nul, False)]}),
        "rubbish-between": _altered(events, {4: [(events[4], False), (bytes(2_000_000), False)]}),
        "a-byte-between": _altered(events, {4: [(events[4], False), (b"\n", False)]}),
        "rubbish-before": _with([(b"# a log\n", False), *((e, True) for e in events)]),
        "zeros-at-end": _altered(events, {EVENTS - 1: [(events[-1], False), (bytes(4096), False)]}),
        "mark-flipped": _altered(events, {3: [(events[3], False)], 4: [(flipped, False)]}),
        "mark-in-data": _altered(events, {5: [(holder, True)]}),
        "torn-with-mark-in-data": _altered(events, {5: [(holder[:-4], False)]}),
        "log-in-a-message": _altered(events, {5: [(nested, True)]}),
        "large-message": _altered(events, {5: [(large, True)]}),
        "large-message-torn": _altered(events, {5: [(large[:-9], False)]}),
        "twice": _with([(e, True) for e in events + events]),
        "clock-set-back": _altered(events, {5: [(event(5, b"X", b"", stamp=3), True)]}),
        "only-marks": Log(MARK * 100, [], [(0, 400)], True),
        "no-log": Log(b"no log at all\n" * 9, [], [(0, 126)], True),
    }  # fmt: skip


def write(folder: Path) -> dict[str, Log]:
    logs = all_logs()
    for name, log in logs.items():
        (folder / f"{name}.lcmlog").write_bytes(log.content)
    return logs


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    for name, log in write(target).items():
        right = {"events": len(log.kept), "gaps": log.gaps, "torn_end": log.torn}
        (target / f"{name}.json").write_text(json.dumps(right) + "\n")
