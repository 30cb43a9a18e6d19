"""Writes what a log holds in the formats of other tools."""

import argparse
import base64
import csv
import json
import sys
from pathlib import Path

import numpy as np

from . import recording
from .command_line import Parser
from .event_log import events
from .messages import CHANNELS, bot_core
from .record import Record, read_log

IMAGES = "STEREO_IMAGES"
_EYES = {bot_core.images_t.LEFT: "left", bot_core.images_t.RIGHT: "right"}
_SCHEMA_OF_IMAGES = "foxglove.CompressedImage"


class ExportError(Exception):
    """One line for the user."""


def field_names(dtype: np.dtype) -> list[str]:
    return [name for name in dtype.names if name != "fingerprint"]


def flat_columns(rows: np.ndarray) -> dict[str, np.ndarray]:
    """A column a number: arrays become position[0], position[1], ..."""
    columns = {}
    for name in field_names(rows.dtype):
        values = rows[name]
        if values.ndim == 1:
            columns[name] = values
        for index in np.ndindex(values.shape[1:]):
            if index:
                brackets = "".join(f"[{i}]" for i in index)
                columns[name + brackets] = values[(slice(None), *index)]
    return columns


def spoken(record: Record) -> dict[str, np.ndarray]:
    """The channels that hold something."""
    return {channel: record[channel] for channel in CHANNELS if len(record[channel])}


def write_csv(record: Record, folder: Path) -> None:
    """A file a channel, numbers in full precision."""
    folder.mkdir(parents=True, exist_ok=True)
    for channel, rows in spoken(record).items():
        columns = flat_columns(rows)
        with (folder / f"{channel}.csv").open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


def write_parquet(record: Record, folder: Path) -> None:
    """A file a channel: tables of different columns do not fit into one."""
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise ExportError("pyarrow is missing: pip install 'reach[parquet]'") from None
    folder.mkdir(parents=True, exist_ok=True)
    for channel, rows in spoken(record).items():
        columns = {
            name: pyarrow.array(np.ascontiguousarray(column))
            for name, column in flat_columns(rows).items()
        }
        parquet.write_table(pyarrow.table(columns), folder / f"{channel}.parquet")


def schema(dtype: np.dtype) -> dict:
    """What a message of ours looks like, as JSON Schema."""
    properties = {}
    for name in field_names(dtype):
        field = dtype[name]
        entry = {"type": "number" if field.base.kind == "f" else "integer"}
        for _ in field.shape:
            entry = {"type": "array", "items": entry}
        properties[name] = entry
    return {"type": "object", "properties": properties}


def as_json(row: np.void) -> bytes:
    """JSON has no infinity and no NaN: null stands for them."""
    fields = {name: row[name].tolist() for name in field_names(row.dtype)}
    try:
        return json.dumps(fields, allow_nan=False).encode()
    except ValueError:
        return json.dumps(_finite(fields)).encode()


def _finite(value):
    if isinstance(value, dict):
        return {name: _finite(entry) for name, entry in value.items()}
    if isinstance(value, list):
        return [_finite(entry) for entry in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def write_mcap(record: Record, log: Path, path: Path) -> None:
    """Messages as JSON, and images that were logged as foxglove.CompressedImage."""
    try:
        from mcap.writer import Writer
    except ImportError:
        raise ExportError("mcap is missing: pip install 'reach[mcap]'") from None
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="", library="reach-export")
        for channel, rows in spoken(record).items():
            text = json.dumps(schema(rows.dtype)).encode()
            type_name = f"reach.{CHANNELS[channel]}"
            topic = _register(writer, f"/{channel}", type_name, text)
            for number, row in enumerate(rows):
                stamp = int(row["utime"]) * 1000
                writer.add_message(topic, stamp, as_json(row), stamp, number)
        _write_images(writer, log)
        writer.finish()


def _register(writer, topic: str, type_name: str, text: bytes) -> int:
    number = writer.register_schema(type_name, "jsonschema", text)
    return writer.register_channel(topic, "json", number)


def _write_images(writer, log: Path) -> None:
    text = json.dumps({"type": "object", "properties": {
        "timestamp": {"type": "object", "properties": {"sec": {"type": "integer"},
                                                       "nsec": {"type": "integer"}}},
        "frame_id": {"type": "string"}, "format": {"type": "string"},
        "data": {"type": "string", "contentEncoding": "base64"}}}).encode()  # fmt: skip
    topics: dict[str, int] = {}
    for event in events(log):
        if event.channel != IMAGES:
            continue
        pair = bot_core.images_t.decode(event.data)
        for kind, image in zip(pair.image_types, pair.images, strict=True):
            if image.pixelformat != image.PIXEL_FORMAT_MJPEG or kind not in _EYES:
                continue
            eye = _EYES[kind]
            if eye not in topics:
                topics[eye] = _register(writer, f"/{IMAGES}/{eye}", _SCHEMA_OF_IMAGES, text)
            seconds, rest = divmod(image.utime, 1_000_000)
            message = {"timestamp": {"sec": seconds, "nsec": rest * 1000}, "frame_id": eye,
                       "format": "jpeg", "data": base64.b64encode(image.data).decode()}  # fmt: skip
            stamp = image.utime * 1000
            writer.add_message(topics[eye], stamp, json.dumps(message).encode(), stamp)


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="reach-export", description=__doc__)
    parser.add_argument("log", type=Path, help="log of lcm-logger, or run.lcmlog of a run")
    parser.add_argument("--csv", type=Path, metavar="DIR",
                        help="write one CSV file for each channel to DIR")  # fmt: skip
    parser.add_argument("--parquet", type=Path, metavar="DIR",
                        help="write one Parquet file for each channel to DIR")  # fmt: skip
    parser.add_argument("--mcap", type=Path, metavar="FILE",
                        help="write one MCAP file, such as for Foxglove")  # fmt: skip
    parser.add_argument("--rrd", type=Path, metavar="FILE",
                        help="write one file for Rerun's viewer")  # fmt: skip
    parser.add_argument("--urdf", type=Path, metavar="FILE", help="the robot in it; default: one"
                        " of ours with the log's joints")  # fmt: skip
    options = parser.parse_args(arguments)
    if not (options.csv or options.parquet or options.mcap or options.rrd):
        parser.error("--csv, --parquet, --mcap or --rrd is wanted")
    return options


def export(options: argparse.Namespace) -> str:
    """Does it; returns a line about it."""
    options.log.open("rb").close()  # LCM's own complaint does not name the file
    record = read_log(options.log)
    channels = spoken(record)
    if not channels:
        raise ExportError(f"{options.log}: it holds no message of ours")
    if options.csv:
        write_csv(record, options.csv)
    if options.parquet:
        write_parquet(record, options.parquet)
    if options.mcap:
        write_mcap(record, options.log, options.mcap)
    if options.rrd:
        recording.write(options.log, options.rrd, options.urdf)
    total = sum(len(rows) for rows in channels.values())
    refused = f", {record.refused} of another layout left out" if record.refused else ""
    return f"{total} messages of {len(channels)} channels{refused}"


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    try:
        print(f"reach-export: {export(options)}")
    except (ExportError, recording.RecordingError, OSError) as error:
        print(f"reach-export: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
