"""Reads an LCM log into one structured array a channel."""

from pathlib import Path

import numpy as np

from . import messages
from .event_log import events


class Record:
    """What was said on the bus. `record["MARKER"]["u_right"]` is a column; rows are in order."""

    def __init__(self, channels: dict[str, np.ndarray], refused: int):
        self._channels = channels
        self.refused = refused  # messages of ours that could not be read

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
    """Every message of a known channel; one whose fingerprint or size is wrong is counted."""
    dtypes = {channel: messages.dtype_of(name) for channel, name in messages.CHANNELS.items()}
    prints = {
        channel: getattr(messages.reach, name)._get_packed_fingerprint()
        for channel, name in messages.CHANNELS.items()
    }
    chunks: dict[str, list[bytes]] = {channel: [] for channel in dtypes}
    refused = 0
    for event in events(path):
        dtype = dtypes.get(event.channel)
        if dtype is None:
            continue
        if len(event.data) == dtype.itemsize and event.data.startswith(prints[event.channel]):
            chunks[event.channel].append(event.data)
        else:
            refused += 1
    return Record({c: _columns(chunks[c], dtypes[c]) for c in dtypes}, refused)


def _columns(chunks: list[bytes], dtype: np.dtype) -> np.ndarray:
    rows = np.frombuffer(b"".join(chunks), dtype)
    return rows.astype(dtype.newbyteorder("="))
