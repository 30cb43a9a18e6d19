"""Reads a log of any size in pieces of a few megabytes, each channel's messages as one array."""

import re
import struct
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from . import messages
from .event_log import Event, Gap, events, told

IMAGES = "STEREO_IMAGES"
JOINTS = "JOINT_STATE"
_PIECE = 4 << 20  # bytes
# They repeat samples; their size varies.
_SEARCHES = ("REACH_BODY_REQUEST", "LEARNER_BODY_REQUEST")
_TESTS_OF_THE_BUS = re.compile(r"(REACH|LCM)_SELF_TEST.*")  # what programs send themselves
_MOST_JOINTS = 1000


@dataclass
class Selection:
    """What of a log is wanted: channels whose whole name matches, seconds after its first stamp."""

    channels: re.Pattern | None = None
    start: float | None = None
    end: float | None = None

    def takes(self, event: Event, first: int) -> bool:
        at = (event.timestamp - first) * 1e-6
        return (
            (self.channels is None or self.channels.fullmatch(event.channel) is not None)
            and (self.start is None or at >= self.start)
            and (self.end is None or at <= self.end)
        )


@dataclass
class Group:
    """Messages of one channel in a piece, in order."""

    channel: str
    type: str  # "status_t"
    rows: np.ndarray  # in this machine's byte order; fields as in lcmtypes/
    stamps: np.ndarray  # when each was logged, us
    places: list[int]  # of each in the piece
    joints: tuple[str, ...] = ()  # JOINT_STATE: their names


@dataclass
class Piece:
    size: int  # events
    stamps: list[int]
    groups: list[Group]
    images: list[tuple[int, Event]]  # with their places


def counted(n: int, noun: str) -> str:
    return f"{n} {noun}{'s' * (n != 1)}"


def printable(name: str) -> str:
    """A name from a log, for a terminal: what could command it is escaped."""
    return "".join(c if " " <= c <= "~" else f"\\x{ord(c):02x}" for c in name)


def told_of(what: str, counter: Counter) -> list[str]:
    """A line that names the channels and how many messages each has; none where there are none."""
    if not counter:
        return []
    named = [f"{n} {printable(channel)}" for channel, n in counter.most_common(10)]
    more = ", ..." if len(counter) > 10 else ""
    return [f"{counted(counter.total(), 'message')} {what}: {', '.join(named)}{more}"]


@dataclass
class Stream:
    """A log; what was found of it is told by the fields once `pieces` has come to its end."""

    path: Path
    selection: Selection = field(default_factory=Selection)
    gaps: list[Gap] = field(default_factory=list)
    refused: Counter = field(default_factory=Counter)  # channels of ours: messages of other layouts
    foreign: Counter = field(default_factory=Counter)  # channels that are not ours: messages
    left_out: Counter = field(default_factory=Counter)  # channels of ours that no table holds

    def __post_init__(self):
        self._dtypes = {c: messages.dtype_of(t) for c, t in messages.CHANNELS.items()}
        self._native = {c: dtype.newbyteorder("=") for c, dtype in self._dtypes.items()}
        self._prints = {c: _print_of(messages.reach, t) for c, t in messages.CHANNELS.items()}
        self._joints = _print_of(messages.bot_core, "joint_state_t")

    def pieces(self) -> Iterator[Piece]:
        for counter in (self.gaps, self.refused, self.foreign, self.left_out):
            counter.clear()
        found: list[Event] = []
        size, first = 0, None
        everything = self.selection == Selection()
        for event in events(self.path, self.gaps):
            first = event.timestamp if first is None else first
            if not everything and not self.selection.takes(event, first):
                continue
            found.append(event)
            size += len(event.data) + 32
            if size > _PIECE:
                yield self._piece(found)
                found, size = [], 0
        if found:
            yield self._piece(found)

    def told(self) -> list[str]:
        """What is not in the pieces, a line each."""
        lines = [told(self.gaps)] if self.gaps else []
        lines += told_of("that cannot be read", self.refused)
        lines += told_of("not exported", self.left_out)
        return lines + told_of("on channels that are not ours", self.foreign)

    def _piece(self, found: list[Event]) -> Piece:
        places: dict[str, list[int]] = {}
        for place, event in enumerate(found):
            places.setdefault(event.channel, []).append(place)
        piece = Piece(len(found), [event.timestamp for event in found], [], [])
        for channel, at in places.items():
            if channel in self._dtypes:
                piece.groups += self._group(channel, at, found)
            elif channel == JOINTS:
                piece.groups += self._joint_groups(at, found)
            elif channel == IMAGES:
                piece.images = [(place, found[place]) for place in at]
            elif channel in _SEARCHES:
                self.left_out[channel] += len(at)
            elif not _TESTS_OF_THE_BUS.fullmatch(channel):
                self.foreign[channel] += len(at)
        return piece

    def _group(self, channel: str, places: list[int], found: list[Event]) -> list[Group]:
        size, start = self._dtypes[channel].itemsize, self._prints[channel]
        right = [p for p in places if len(found[p].data) == size and found[p].data[:8] == start]
        self._count_refused(channel, len(places) - len(right))
        if not right:
            return []
        rows = _rows(right, found, self._dtypes[channel]).astype(self._native[channel])
        return [Group(channel, messages.CHANNELS[channel], rows, _stamps(right, found), right)]

    def _joint_groups(self, places: list[int], found: list[Event]) -> list[Group]:
        """One for each set of names, whose messages all have one layout."""
        alike: dict[bytes, list[int]] = {}
        heads: list[bytes] = []
        for place in places:
            data = found[place].data
            head = next((h for h in heads if data.startswith(h, 16)), None)
            if head is None or len(data) != _joints_size(head):
                head = _head_of_joints(data)
                if head and head not in alike:
                    heads.append(head)
            if not head or not data.startswith(self._joints):
                self._count_refused(JOINTS, 1)
                continue
            alike.setdefault(head, []).append(place)
        return [self._joint_group(head, at, found) for head, at in alike.items()]

    def _joint_group(self, head: bytes, places: list[int], found: list[Event]) -> Group:
        names = _names_in(head)
        n = (len(names),)
        dtype = np.dtype([("fingerprint", ">i8"), ("utime", ">i8"), ("head", f"V{len(head)}"),
                          ("joint_position", ">f4", n), ("joint_velocity", ">f4", n),
                          ("joint_effort", ">f4", n)])  # fmt: skip
        wire = _rows(places, found, dtype)
        native = np.dtype([("utime", "i8"), ("num_joints", "i2"),
                           *((name, "f4", n) for name in dtype.names[3:])])  # fmt: skip
        rows = np.empty(len(wire), native)
        rows["num_joints"] = len(names)
        for name in ("utime", *dtype.names[3:]):
            rows[name] = wire[name]
        return Group(JOINTS, "joint_state_t", rows, _stamps(places, found), places, names)

    def _count_refused(self, channel: str, n: int) -> None:
        if n:
            self.refused[channel] += n


def _print_of(package, type_name: str) -> bytes:
    return getattr(package, type_name)._get_packed_fingerprint()


def _rows(places: list[int], found: list[Event], dtype: np.dtype) -> np.ndarray:
    return np.frombuffer(b"".join([found[place].data for place in places]), dtype)


def _stamps(places: list[int], found: list[Event]) -> np.ndarray:
    return np.array([found[place].timestamp for place in places], np.int64)


def _head_of_joints(data: bytes) -> bytes | None:
    """Number and names of the joints of a JOINT_STATE; None when it is none."""
    at = 18
    try:
        (n,) = struct.unpack_from(">h", data, 16)
        if not 0 <= n <= _MOST_JOINTS:
            return None
        for _ in range(n):
            (length,) = struct.unpack_from(">i", data, at)
            at += 4 + length
            if length < 1 or at > len(data):
                return None
    except struct.error:
        return None
    return data[16:at] if len(data) == at + 12 * n else None


def _joints_size(head: bytes) -> int:
    """Bytes of a whole message with this head."""
    return 16 + len(head) + 12 * struct.unpack_from(">h", head)[0]


def _names_in(head: bytes) -> tuple[str, ...]:
    names, at = [], 2
    while at < len(head):
        (length,) = struct.unpack_from(">i", head, at)
        names.append(head[at + 4 : at + 3 + length].decode(errors="backslashreplace"))
        at += 4 + length
    return tuple(names)
