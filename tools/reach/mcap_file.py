"""A log as one MCAP file: our messages and images as Protocol Buffers, in the order of the log.

log_time is the logger's stamp, publish_time the message's own, sequence its number.
"""

import json
from collections import Counter
from contextlib import suppress
from pathlib import Path

import numpy as np

from .event_log import Event
from .log_stream import IMAGES, Group, Piece, counted, told_of
from .mcap_writer import McapWriter, is_there
from .messages import bot_core, described
from .protobuf import encode, field, file, file_set, full_name, message, of_bytes, of_number, schema
from .table_files import MissingError

_EYES = {bot_core.images_t.LEFT: "left", bot_core.images_t.RIGHT: "right"}
_IMAGE = "foxglove.CompressedImage"
_LATEST = (2**63 - 1) // 1000  # us; MCAP counts ns, and its readers in 63 bits
_INT64, _INT32, _STRING, _MESSAGE, _BYTES = 3, 5, 9, 11, 12  # types of protobuf
_UNITS, _JOINTS = "units", "joints"


class McapFile:
    """Written beside its place; `finish` moves it there."""

    def __init__(self, path: Path, joints: tuple[str, ...] = ()):
        if not is_there():
            raise MissingError("mcap is missing: pip install 'reach[mcap]'")
        self._path, self._beside = path, path.with_name(f"{path.name}.new")
        self._file = self._beside.open("wb")
        self._writer = McapWriter(self._file, "reach-export")
        self._topics: dict[str, int] = {}
        self._channels: dict[int, str] = {}  # of each topic
        self._joints = joints  # in the order of all arrays of joints
        self.images = 0
        self.untimely: Counter = Counter()  # channel -> messages of a time that MCAP cannot hold
        self.unreadable = 0  # pairs of images

    def take(self, piece: Piece) -> None:
        """All of its messages, in their order."""
        places, topics, utimes, numbers, contents = [], [], [], [], []
        for group in piece.groups:
            places += group.places
            topics += [self._topic_of(group)] * len(group.rows)
            utimes += group.rows["utime"].tolist()
            numbers += _numbers(group).tolist()
            contents += encode(group)
        for place, event in piece.images:
            for topic, utime, content in self._pictures(event):
                places.append(place)
                topics.append(topic)
                utimes.append(utime)
                numbers.append(0)
                contents.append(content)
        self._add(piece, np.array(places, np.int64), np.array(topics, np.int64),
                  np.array(utimes, np.int64), np.array(numbers, np.int64), contents)  # fmt: skip

    def _add(self, piece: Piece, places: np.ndarray, topics: np.ndarray, utimes: np.ndarray,
             numbers: np.ndarray, contents: list[bytes]) -> None:  # fmt: skip
        stamps = np.array(piece.stamps, np.int64)[places]
        sound = (stamps >= 0) & (stamps <= _LATEST) & (utimes >= 0) & (utimes <= _LATEST)
        for topic in topics[~sound].tolist():
            self.untimely[self._channels[topic]] += 1
        order = np.argsort(places, kind="stable")
        order = order[sound[order]]
        taken = [contents[i] for i in order.tolist()]
        self._writer.add(topics[order], stamps[order] * 1000, utimes[order] * 1000,
                         numbers[order] & 0xFFFFFFFF, taken)  # fmt: skip

    def _topic_of(self, group: Group) -> int:
        if group.channel not in self._topics:
            self._register(group.channel, group.channel, full_name(group.type),
                           schema(group.type), self._metadata(group))  # fmt: skip
        return self._topics[group.channel]

    def _register(self, topic: str, channel: str, type_name: str, described_by: bytes,
                  metadata: dict[str, str]) -> None:  # fmt: skip
        number = self._writer.register(f"/{topic}", type_name, described_by, metadata)
        self._topics[topic], self._channels[number] = number, channel

    def _metadata(self, group: Group) -> dict[str, str]:
        """As JSON: the unit of each field, and the joints whose numbers its arrays have."""
        about = described(group.type)
        units = {entry.plain_name: entry.unit for entry in about.fields if entry.unit}
        said = {_UNITS: json.dumps(units)}
        if self._joints and any(about.is_of_joints(entry) for entry in about.fields):
            said[_JOINTS] = json.dumps(self._joints)
        return said

    def _pictures(self, event: Event) -> list[tuple]:
        """JPEG images of a stereo pair; one that is none is counted."""
        try:
            pair = bot_core.images_t.decode(event.data)
        except Exception:  # generated decoders raise anything on bytes like these
            self.unreadable += 1
            return []
        found = []
        for kind, image in zip(pair.image_types, pair.images, strict=True):
            if image.pixelformat == image.PIXEL_FORMAT_MJPEG and kind in _EYES:
                content = _image(image.utime, _EYES[kind], image.data)
                found.append((self._eye(_EYES[kind]), image.utime, content))
        self.images += len(found)
        return found

    def _eye(self, eye: str) -> int:
        topic = f"{IMAGES}/{eye}"
        if topic not in self._topics:
            self._register(topic, IMAGES, _IMAGE, _image_schema(), {})
        return self._topics[topic]

    def told(self) -> list[str]:
        """What is in it besides messages of fixed size, and what is not, a line each."""
        lines = [counted(self.images, "JPEG image")] if self.images else []
        if self.unreadable:
            lines.append(f"{counted(self.unreadable, 'pair')} of images that cannot be read")
        return lines + told_of("with a time that MCAP cannot hold", self.untimely)

    def finish(self) -> None:
        self._writer.finish()
        self._file.close()
        self._beside.replace(self._path)

    def discard(self) -> None:
        with suppress(OSError):  # the full disk that ended it
            self._file.close()
        self._beside.unlink(missing_ok=True)


def _numbers(group: Group) -> np.ndarray:
    """Of each message; 0 where its type has none."""
    rows = group.rows
    return rows["seq"] if "seq" in rows.dtype.names else np.zeros(len(rows), np.int64)


def _image(utime: int, eye: str, data: bytes) -> bytes:
    seconds, rest = divmod(utime, 1_000_000)
    time = of_number(1, seconds) + of_number(2, rest * 1000)
    return b"".join((of_bytes(1, time), of_bytes(2, data), of_bytes(3, b"jpeg"),
                     of_bytes(4, eye.encode())))  # fmt: skip


def _image_schema() -> bytes:
    stamp = "google/protobuf/timestamp.proto"
    time = message("Timestamp", field("seconds", 1, _INT64) + field("nanos", 2, _INT32))
    image = message("CompressedImage",
                    field("timestamp", 1, _MESSAGE, ".google.protobuf.Timestamp")
                    + field("data", 2, _BYTES) + field("format", 3, _STRING)
                    + field("frame_id", 4, _STRING))  # fmt: skip
    return file_set(
        file(stamp, "google.protobuf", of_bytes(4, time)),
        file("foxglove/CompressedImage.proto", "foxglove", of_bytes(4, image), (stamp,)),
    )
