"""Reads an LCM log into one structured array a channel."""

import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from . import messages
from .event_log import Gap, told
from .log_stream import JOINTS, Stream


class Record:
    """What was said on the bus. `record["MARKER"]["u_right"]` is a column; rows are in order."""

    def __init__(self, channels: dict[str, np.ndarray], refused: int, gaps: list[Gap]):
        self._channels = channels
        self.refused = refused  # messages of ours that could not be read
        self.gaps = gaps  # bytes of the log that are no event

    def __getitem__(self, channel: str) -> np.ndarray:
        return self._channels[channel]

    def __iter__(self) -> Iterator[str]:
        """The channels on which there is anything."""
        return (channel for channel, rows in self._channels.items() if len(rows))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __contains__(self, channel: object) -> bool:
        return channel in self._channels and len(self._channels[channel]) > 0

    def __repr__(self) -> str:
        lines = [f"{channel:20} {len(self[channel]):8} messages" for channel in self]
        if self.refused:
            lines.append(f"{self.refused} messages that cannot be read")
        return (
            "\n".join([f"<Record of {len(self)} channels", *(f"  {line}" for line in lines)]) + ">"
        )

    def lost(self, channel: str = "REACH_STATUS") -> int:
        """Messages that the log should hold but does not, by their sequence numbers."""
        numbers = np.unique(self._channels[channel]["seq"])
        return int(numbers[-1] - numbers[0] + 1 - len(numbers)) if len(numbers) else 0

    def between(self, channel: str, start: int, end: int) -> np.ndarray:
        """Rows with start <= utime <= end; us."""
        rows = self._channels[channel]
        return rows[(rows["utime"] >= start) & (rows["utime"] <= end)]


def read_log(path: Path) -> Record:
    """Every message of a known channel; one whose fingerprint or size is wrong is counted. Bytes
    that are no event are in the record's `gaps`, and a warning tells of them."""
    stream = Stream(path)
    rows: dict[str, list[np.ndarray]] = {channel: [] for channel in messages.CHANNELS}
    for piece in stream.pieces():
        for group in piece.groups:
            if group.channel != JOINTS:
                rows[group.channel].append(group.rows)
    if stream.gaps:
        warnings.warn(f"{path}: {told(stream.gaps)}", stacklevel=2)
    if stream.refused:
        what = ", ".join(f"{n} of {channel}" for channel, n in stream.refused.items())
        warnings.warn(f"{path}: was written by another version, or is damaged: {what} cannot be"
                      " read", stacklevel=2)  # fmt: skip
    columns = {
        channel: np.concatenate(parts) if parts else _none_of(channel)
        for channel, parts in rows.items()
    }
    return Record(columns, stream.refused.total(), stream.gaps)


def _none_of(channel: str) -> np.ndarray:
    return np.empty(0, messages.dtype_of(messages.CHANNELS[channel]).newbyteorder("="))
