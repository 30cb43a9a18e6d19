"""Reads an LCM log into one structured array a channel."""

import warnings
from pathlib import Path

import numpy as np

from . import messages
from .event_log import Gap, events, told


class Record:
    """What was said on the bus. `record["MARKER"]["u_right"]` is a column; rows are in order."""

    def __init__(self, channels: dict[str, np.ndarray], refused: int, gaps: list[Gap]):
        self._channels = channels
        self.refused = refused  # messages of ours that could not be read
        self.gaps = gaps  # bytes of the log that are no event

    def __getitem__(self, channel: str) -> np.ndarray:
        return self._channels[channel]

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
    dtypes = {channel: messages.dtype_of(name) for channel, name in messages.CHANNELS.items()}
    prints = {
        channel: getattr(messages.reach, name)._get_packed_fingerprint()
        for channel, name in messages.CHANNELS.items()
    }
    chunks: dict[str, list[bytes]] = {channel: [] for channel in dtypes}
    refused, gaps = 0, []
    for event in events(path, gaps):
        dtype = dtypes.get(event.channel)
        if dtype is None:
            continue
        if len(event.data) == dtype.itemsize and event.data.startswith(prints[event.channel]):
            chunks[event.channel].append(event.data)
        else:
            refused += 1
    if gaps:
        warnings.warn(f"{path}: {told(gaps)}", stacklevel=2)
    return Record({c: _columns(chunks[c], dtypes[c]) for c in dtypes}, refused, gaps)


def _columns(chunks: list[bytes], dtype: np.dtype) -> np.ndarray:
    rows = np.frombuffer(b"".join(chunks), dtype)
    return rows.astype(dtype.newbyteorder("="))
