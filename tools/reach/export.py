"""Writes what a log holds in the formats of other tools."""

import argparse
import re
import sys
from contextlib import ExitStack
from pathlib import Path

from . import recording
from .command_line import Parser
from .event_log import begins
from .log_stream import JOINTS, Selection, Stream, counted
from .mcap_file import McapFile
from .samples import SamplesError, SamplesFile
from .table_files import CsvFile, Folder, MissingError, ParquetFile, survey


class ExportError(Exception):
    """One line for the user."""


def seconds(text: str) -> float:
    value = float(text)
    if not 0 <= value < float("inf"):
        raise ValueError(text)
    return value


def pattern(text: str) -> re.Pattern:
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no pattern: {error}") from None


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="reach-export", description=__doc__)
    parser.add_argument("log", type=Path, help="log of lcm-logger, or run.lcmlog of a run")
    parser.add_argument("--csv", type=Path, metavar="DIR",
                        help="write one CSV file for each channel to DIR")  # fmt: skip
    parser.add_argument("--parquet", type=Path, metavar="DIR",
                        help="write one Parquet file for each channel to DIR")  # fmt: skip
    parser.add_argument("--mcap", type=Path, metavar="FILE",
                        help="write one MCAP file, such as for Foxglove")  # fmt: skip
    parser.add_argument("--samples", type=Path, metavar="FILE",
                        help="write the samples that were learned, for reach-eval")  # fmt: skip
    parser.add_argument("--test-samples", type=Path, metavar="FILE",
                        help="write the samples that were gathered with a frozen"
                        " model, for reach-eval")  # fmt: skip
    parser.add_argument("--rrd", type=Path, metavar="FILE",
                        help="write one file for Rerun's viewer")  # fmt: skip
    parser.add_argument("--urdf", type=Path, metavar="FILE", help="the robot in it; default: one"
                        " of ours with the log's joints")  # fmt: skip
    parser.add_argument("--channels", type=pattern, metavar="PATTERN",
                        help="only channels whose whole name matches")  # fmt: skip
    parser.add_argument("--from", type=seconds, metavar="S", dest="start",
                        help="begin S seconds after the log's first stamp")  # fmt: skip
    parser.add_argument("--to", type=seconds, metavar="S", dest="end",
                        help="end S seconds after the log's first stamp")  # fmt: skip
    options = parser.parse_args(arguments)
    files = (options.csv, options.parquet, options.mcap, options.rrd, options.samples,
             options.test_samples)  # fmt: skip
    if not any(files):
        parser.error("--csv, --parquet, --mcap, --samples, --test-samples or --rrd is wanted")
    return options


def open_outputs(options: argparse.Namespace, stream: Stream, stack: ExitStack) -> list:
    """What is written to; the stack discards what is not finished."""
    outputs: list = []
    if options.csv or options.parquet:
        tables = list(survey(stream).values())
        for folder, make in ((options.csv, CsvFile), (options.parquet, ParquetFile)):
            if folder and tables:
                outputs.append(_kept(stack, Folder(folder, make, tables)))
    if options.mcap:
        outputs.append(_kept(stack, McapFile(options.mcap, _first_joints(stream))))
    for path, learned in ((options.samples, True), (options.test_samples, False)):
        if path:
            outputs.append(_kept(stack, SamplesFile(path, learned)))
    return outputs


def _kept(stack: ExitStack, output):
    stack.callback(output.discard)
    return output


def _first_joints(stream: Stream) -> tuple[str, ...]:
    """Their names, where they are told in the first seconds."""
    for piece in stream.pieces():
        return next((group.joints for group in piece.groups if group.channel == JOINTS), ())
    return ()


def write(options: argparse.Namespace, stream: Stream) -> list[str]:
    """Returns what is to be told, a line each."""
    messages, channels, lines = 0, set(), []
    with ExitStack() as stack:
        outputs = open_outputs(options, stream, stack)
        for piece in stream.pieces():
            for output in outputs:
                output.take(piece if isinstance(output, McapFile) else piece.groups)
            messages += sum(len(group.rows) for group in piece.groups)
            channels |= {group.channel for group in piece.groups}
            if options.mcap:
                channels |= {event.channel for _, event in piece.images}
        if not channels:
            raise ExportError("; ".join(["there is no message of ours in it", *stream.told()]))
        for output in outputs:
            output.finish()
            lines += output.told()
    said = f"{counted(messages, 'message')} of {counted(len(channels), 'channel')}"
    return [said, *lines, *stream.told()]


def export(options: argparse.Namespace) -> str:
    """Does it; returns a line about it."""
    stream = Stream(options.log, Selection(options.channels, options.start, options.end))
    for path in (options.mcap, options.rrd, options.samples, options.test_samples):
        if path and begins(path):
            raise OSError(f"{path}: is a log, and is not overwritten")
    lines = write(options, stream)
    if options.rrd:
        bad = recording.write(options.log, options.rrd, options.urdf, stream.selection)
        if bad:
            lines.append(f"{counted(bad, 'message')} cannot be shown in {options.rrd}")
    return "; ".join(lines)


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    try:
        print(f"reach-export: {export(options)}")
    except (ExportError, SamplesError) as error:
        print(f"reach-export: {options.log}: {error}", file=sys.stderr)
        return 1
    except (MissingError, recording.RecordingError, OSError) as error:
        print(f"reach-export: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
