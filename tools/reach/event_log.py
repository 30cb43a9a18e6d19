"""Reads LCM's log files without LCM, which Debian does not have for Python.

Nothing is invented and nothing is left out without a word. What begins with LCM's mark counts as
an event when behind it stands the mark of the next one, or the end of the file. Otherwise a length
in it is wrong, or the logger was killed in the middle of it; then the next event is looked for from
behind its own mark on. common/logs/event_log.h reads by the same rules; a test compares the two.
"""

import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

_MARK = b"\xed\xa1\xda\x01"
_HEADER = struct.Struct(">4sqqII")  # mark, number, us since the epoch, lengths of channel, message
_LONGEST_CHANNEL = 999
_LARGEST_MESSAGE = 1 << 28
_CHUNK = 1 << 20
_MOST_NAMES = 10_000  # that are kept


class Event(NamedTuple):
    timestamp: int  # us, when it was logged
    channel: str
    data: bytes


class Gap(NamedTuple):
    """Bytes of a log that are no event."""

    position: int
    size: int
    at_end: bool  # a logger that was killed leaves such an end


def told(gaps: list[Gap]) -> str:
    """One line for the user; "" when there is no gap."""
    if not gaps:
        return ""
    named = [f"{gap.size} at byte {gap.position}{', the end' * gap.at_end}" for gap in gaps[:3]]
    more = f" and {len(gaps) - 3} places more" if len(gaps) > 3 else ""
    return f"{sum(gap.size for gap in gaps)} bytes are no event: {'; '.join(named)}{more}"


def begins(path: Path) -> bool:
    """Whether the file is there and begins as a log does: who writes a file of another kind asks
    before it replaces one."""
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return file.read(len(_MARK)) == _MARK


def events(path: Path, gaps: list[Gap] | None = None) -> Iterator[Event]:
    """In the order of the file. What is no event is noted in `gaps`."""
    with Path(path).open("rb") as file:
        yield from _Reader(file, [] if gaps is None else gaps).events()


class _Reader:
    """A window on the file, so that a large one needs no more memory than its largest event."""

    def __init__(self, file: BinaryIO, gaps: list[Gap]):
        self._file = file
        self._size = os.fstat(file.fileno()).st_size
        self._gaps = gaps
        self._window, self._at = b"", 0
        self._names: dict[bytes, str] = {}  # channels so far

    def _look(self, at: int, size: int) -> int:
        """Makes the window hold so much from `at` on, or what there is; returns where `at` is."""
        place = at - self._at
        if place < 0 or place + size > len(self._window):
            self._file.seek(at)
            self._window, self._at = self._file.read(max(size, _CHUNK)), at
            return 0
        return place

    def events(self) -> Iterator[Event]:
        at = end = 0  # of the next event, of the newest one
        while at < self._size:
            found = self._event_in_window(at) or self._event(at)
            if found is None:
                at = self._next_mark(at + 1)
                continue
            if at > end:
                self._gaps.append(Gap(end, at - end, False))
            event, at = found
            end = at
            yield event
        if self._size > end:
            self._gaps.append(Gap(end, self._size - end, True))

    def _event_in_window(self, at: int) -> tuple[Event, int] | None:
        """As below, of events that lie in the window with the next one's mark: nearly all."""
        window, place = self._window, at - self._at
        if not 0 <= place <= len(window) - _HEADER.size:
            return None
        mark, _, stamp, name, size = _HEADER.unpack_from(window, place)
        middle = place + _HEADER.size + name
        end = middle + size
        if mark != _MARK or not 0 < name <= _LONGEST_CHANNEL or window[end : end + 4] != _MARK:
            return None
        channel = self._name(window[middle - name : middle])
        return (Event(stamp, channel, window[middle:end]), self._at + end) if channel else None

    def _name(self, name: bytes) -> str:
        """The channel's; "" when it is none."""
        known = self._names.get(name)
        if known is None:
            known = "" if b"\0" in name else name.decode(errors="backslashreplace")
            if len(self._names) < _MOST_NAMES:
                self._names[name] = known
        return known

    def _event(self, at: int) -> tuple[Event, int] | None:
        """The event that begins there, and where it ends."""
        place = self._look(at, _HEADER.size)
        if len(self._window) - place < _HEADER.size:
            return None
        mark, _, stamp, name, size = _HEADER.unpack_from(self._window, place)
        if mark != _MARK or not 0 < name <= _LONGEST_CHANNEL or size > _LARGEST_MESSAGE:
            return None
        end = at + _HEADER.size + name + size
        if not self._ends(end):
            return None
        start = self._look(at, end - at) + _HEADER.size
        channel = self._name(self._window[start : start + name])
        data = self._window[start + name : start + name + size]
        if len(data) < size or not channel:
            return None
        return Event(stamp, channel, data), end

    def _ends(self, at: int) -> bool:
        """Whether an event that ends there is followed by the next one, or by the end. A length may
        point anywhere: the window stays where it is."""
        size = min(len(_MARK), self._size - at)
        if size < 0:
            return False
        place = at - self._at
        if place >= 0 and place + size <= len(self._window):
            return self._window[place : place + size] == _MARK[:size]
        self._file.seek(at)
        return self._file.read(size) == _MARK[:size]

    def _next_mark(self, at: int) -> int:
        """Where it is, from `at` on; the file's size when there is none."""
        while at + len(_MARK) <= self._size:
            start = self._look(at, min(_CHUNK, self._size - at))
            place = self._window.find(_MARK, start)
            if place >= 0:
                return self._at + place
            read = len(self._window) - start
            if read < len(_MARK):
                break
            at += read - len(_MARK) + 1
        return self._size
