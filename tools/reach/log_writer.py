"""Writes LCM's log files. LCM's own writer tells nobody of a full disk."""

import os
import struct
from pathlib import Path

MARK = b"\xed\xa1\xda\x01"
HEADER = struct.Struct(">4sqqII")  # mark, number, us since the epoch, lengths of channel, message
_BUFFER = 1 << 16


class LogWriter:
    """A new file; FileExistsError when it is there. What is no whole event is taken back when the
    disk is full, so that the file ends where an event does."""

    def __init__(self, path: Path):
        self._file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
        self._waiting: list[bytes] = []
        self._bytes = 0
        self._size = 0  # of the file, to the end of its last whole event
        self.events = 0
        self.written = 0  # events that are in the file

    def write(self, stamp: int, channel: str, data: bytes) -> None:
        """May wait in memory until `flush`. OSError as below."""
        name = channel.encode()
        self._waiting.append(HEADER.pack(MARK, self.events, stamp, len(name), len(data)))
        self._waiting += (name, data)
        self._bytes += HEADER.size + len(name) + len(data)
        self.events += 1
        if self._bytes > _BUFFER:
            self.flush()

    def flush(self) -> None:
        """Everything is in the file, or OSError says why not and later calls do nothing."""
        content, ends = b"".join(self._waiting), self._ends()
        self._waiting, self._bytes = [], 0
        done = 0
        try:
            while done < len(content):
                done += os.write(self._file, content[done:])
        except OSError:
            whole = max((end for end in ends if end <= done), default=0)
            os.ftruncate(self._file, self._size + whole)
            self._count(ends, whole)
            raise
        self._count(ends, done)

    def _ends(self) -> list[int]:
        """Where each event that waits ends."""
        ends, at = [], 0
        for i in range(0, len(self._waiting), 3):
            at += sum(map(len, self._waiting[i : i + 3]))
            ends.append(at)
        return ends

    def _count(self, ends: list[int], done: int) -> None:
        self._size += done
        self.written += sum(end <= done for end in ends)

    def close(self) -> None:
        """Also after an error."""
        os.close(self._file)
