"""Writes MCAP files in chunks: the records of the package `mcap`, with messages by the thousand.

Its own writer takes four times as long, since it makes an object of each message.
"""

import struct
import zlib
from typing import BinaryIO

import numpy as np

try:
    import zstandard
    from mcap.data_stream import RecordBuilder
    from mcap.records import (
        Channel,
        Chunk,
        ChunkIndex,
        DataEnd,
        Footer,
        Header,
        Schema,
        Statistics,
        SummaryOffset,
    )
    from mcap.writer import MCAP0_MAGIC, Opcode
except ImportError:
    zstandard = None

# What stands before each message; `length` counts what follows it.
_HEAD = np.dtype([("opcode", "u1"), ("length", "<u8"), ("channel", "<u2"), ("number", "<u4"),
                  ("log_time", "<u8"), ("publish_time", "<u8")])  # fmt: skip
_COUNTED = _HEAD.itemsize - 1 - 8
_CHUNK = 1 << 20
_INDEX = np.dtype([("time", "<u8"), ("offset", "<u8")])


def is_there() -> bool:
    """Whether the package is installed."""
    return zstandard is not None


class McapWriter:
    """Plain names of the format: https://mcap.dev/spec."""

    def __init__(self, stream: BinaryIO, library: str):
        self._stream = stream
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._indexes: list[ChunkIndex] = []
        self._counts: dict[int, int] = {}
        self._compress = zstandard.ZstdCompressor().compress
        stream.write(MCAP0_MAGIC)
        self._write(Header(profile="", library=library))

    def _write(self, *records) -> int:
        """Returns how many bytes that were."""
        builder = RecordBuilder()
        for record in records:
            record.write(builder)
        content = builder.end()
        self._stream.write(content)
        return len(content)

    def register(self, topic: str, type_name: str, schema: bytes, metadata: dict[str, str]) -> int:
        """A topic of messages of Protocol Buffers; returns its number."""
        found = next((s for s in self._schemas if s.name == type_name), None)
        if found is None:
            found = Schema(id=len(self._schemas) + 1, data=schema, encoding="protobuf",
                           name=type_name)  # fmt: skip
            self._schemas.append(found)
            self._write(found)
        channel = Channel(id=len(self._channels) + 1, topic=topic, message_encoding="protobuf",
                          metadata=metadata, schema_id=found.id)  # fmt: skip
        self._channels.append(channel)
        self._write(channel)
        return channel.id

    def add(self, channels: np.ndarray, log_times: np.ndarray, publish_times: np.ndarray,
            numbers: np.ndarray, contents: list[bytes]) -> None:  # fmt: skip
        """Messages, in chunks of their own. Times in ns, from 0 to 2^64 - 1; numbers of 32 bits."""
        heads = np.empty(len(contents), _HEAD)
        lengths = np.fromiter(map(len, contents), np.int64, len(contents))
        heads["opcode"], heads["length"] = Opcode.MESSAGE, _COUNTED + lengths
        heads["channel"], heads["number"] = channels, numbers
        heads["log_time"], heads["publish_time"] = log_times, publish_times
        ends = np.cumsum(_HEAD.itemsize + lengths)
        begin = before = 0
        while begin < len(contents):
            end = max(begin + 1, int(np.searchsorted(ends, before + _CHUNK)))
            starts = np.concatenate(([0], ends[begin : end - 1] - before))
            self._write_chunk(heads[begin:end], starts, contents[begin:end])
            begin, before = end, int(ends[end - 1])

    def _write_chunk(self, heads: np.ndarray, starts: np.ndarray, contents: list[bytes]) -> None:
        whole, size = heads.tobytes(), _HEAD.itemsize
        parts: list[bytes] = [b""] * (2 * len(contents))
        parts[::2] = [whole[at : at + size] for at in range(0, len(whole), size)]
        parts[1::2] = contents
        content = b"".join(parts)
        times = heads["log_time"]
        first, last = int(times.min()), int(times.max())
        packed = self._compress(content)
        start = self._stream.tell()
        length = self._write(Chunk(
            compression="zstd", data=packed, message_start_time=first, message_end_time=last,
            uncompressed_crc=zlib.crc32(content), uncompressed_size=len(content)))  # fmt: skip
        offsets, indexed = self._write_indexes(heads, starts)
        self._indexes.append(ChunkIndex(
            chunk_length=length, chunk_start_offset=start, compression="zstd",
            compressed_size=len(packed), message_end_time=last, message_index_length=indexed,
            message_index_offsets=offsets, message_start_time=first,
            uncompressed_size=len(content)))  # fmt: skip

    def _write_indexes(self, heads: np.ndarray, starts: np.ndarray) -> tuple[dict[int, int], int]:
        """Where each channel's is, and how long they are together."""
        offsets, start = {}, self._stream.tell()
        for channel in np.unique(heads["channel"]).tolist():
            its = heads["channel"] == channel
            table = np.empty(int(its.sum()), _INDEX)
            table["time"], table["offset"] = heads["log_time"][its], starts[its]
            offsets[channel] = self._stream.tell()
            self._counts[channel] = self._counts.get(channel, 0) + len(table)
            rows = table.tobytes()
            head = struct.pack("<BQHI", Opcode.MESSAGE_INDEX, 6 + len(rows), channel, len(rows))
            self._stream.write(head + rows)
        return offsets, self._stream.tell() - start

    def finish(self) -> None:
        self._write(DataEnd(data_section_crc=0))
        start = self._stream.tell()
        summary, offsets = RecordBuilder(), []
        for opcode, records in (
            (Opcode.SCHEMA, self._schemas),
            (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [self._statistics()]),
            (Opcode.CHUNK_INDEX, self._indexes),
        ):
            before = summary.count
            for record in records:
                record.write(summary)
            if records:
                offsets.append(SummaryOffset(group_opcode=opcode, group_start=start + before,
                                             group_length=summary.count - before))  # fmt: skip
        offsets_start = start + summary.count
        for offset in offsets:
            offset.write(summary)
        self._write_end(summary.end(), start, offsets_start)

    def _write_end(self, summary: bytes, start: int, offsets_start: int) -> None:
        head = struct.pack("<BQQQ", Opcode.FOOTER, 8 + 8 + 4, start, offsets_start)
        self._stream.write(summary)
        self._write(Footer(summary_start=start, summary_offset_start=offsets_start,
                           summary_crc=zlib.crc32(head, zlib.crc32(summary))))  # fmt: skip
        self._stream.write(MCAP0_MAGIC)

    def _statistics(self) -> "Statistics":
        return Statistics(
            attachment_count=0, channel_count=len(self._channels),
            channel_message_counts=self._counts, chunk_count=len(self._indexes),
            message_count=sum(self._counts.values()), metadata_count=0,
            message_start_time=min((i.message_start_time for i in self._indexes), default=0),
            message_end_time=max((i.message_end_time for i in self._indexes), default=0),
            schema_count=len(self._schemas))  # fmt: skip
