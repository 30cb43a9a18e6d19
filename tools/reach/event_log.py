"""Reads LCM's log files without LCM, which Debian does not have for Python."""

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_SYNC = b"\xed\xa1\xda\x01"
_HEADER = struct.Struct(">qqii")  # number, us since the epoch, lengths of channel and message
_LONGEST_CHANNEL = 1000
_CHUNK = 1 << 20


class Event(NamedTuple):
    timestamp: int  # us, when it was logged
    channel: str
    data: bytes


def events(path: Path) -> Iterator[Event]:
    """In the order of the file. What is damaged is skipped to the next mark of a message, and one
    that was cut off at the end is left out, as LCM's own reader does."""
    with Path(path).open("rb") as file:
        while _to_mark(file):
            start = file.tell()
            header = file.read(_HEADER.size)
            if len(header) < _HEADER.size:
                return
            _, timestamp, channel_length, length = _HEADER.unpack(header)
            if not (0 <= channel_length <= _LONGEST_CHANNEL and length >= 0):
                file.seek(start)
                continue
            content = file.read(channel_length + length)
            if len(content) < channel_length + length:
                return
            channel = content[:channel_length].decode(errors="replace")
            yield Event(timestamp, channel, content[channel_length:])


def _to_mark(file) -> bool:
    """Behind the next mark, almost always the next four bytes; false: there is none."""
    if (start := file.read(len(_SYNC))) == _SYNC:
        return True
    while start:
        rest = file.read(_CHUNK)
        place = (start + rest).find(_SYNC)
        if place >= 0:
            file.seek(place + len(_SYNC) - len(start) - len(rest), 1)
            return True
        start = (start + rest)[-(len(_SYNC) - 1) :] if rest else b""
    return False
