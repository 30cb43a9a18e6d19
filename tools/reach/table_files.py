"""Tables of a log as CSV or Parquet: a file a channel, since a table has one set of columns, and
columns.csv, which says what each column is. Written beside their places, then moved there."""

import csv
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import numpy as np

from .log_stream import Group, Stream
from .tables import Column, Table, name_joints, values

COLUMNS = "columns.csv"
_ROW_GROUP = 8 << 20  # bytes of messages that are gathered for one row group of Parquet


class MissingError(Exception):
    """A package that is not installed; one line for the user."""


class CsvFile:
    """Numbers in full precision; what does not count is empty."""

    SUFFIX = "csv"

    def __init__(self, path: Path, table: Table):
        self._table, self._columns = table, table.columns()
        self._file = path.open("w", newline="")
        self._writer = csv.writer(self._file)
        self._writer.writerow([column.name for column in self._columns])

    def take(self, group: Group) -> None:
        lists = [_cells(*values(self._table, column, group)) for column in self._columns]
        self._writer.writerows(zip(*lists, strict=True))

    def close(self) -> None:
        self._file.close()


def _cells(found: np.ndarray, counted: np.ndarray | None) -> list:
    cells = found.tolist()
    if counted is None:
        return cells
    return [cell if counts else "" for cell, counts in zip(cells, counted.tolist(), strict=True)]


class ParquetFile:
    """Units, joints, meanings are metadata of the columns; what does not count is null."""

    SUFFIX = "parquet"

    def __init__(self, path: Path, table: Table):
        try:
            import pyarrow
            from pyarrow import parquet
        except ImportError:
            raise MissingError("pyarrow is missing: pip install 'reach[parquet]'") from None
        self._pyarrow, self._table, self._columns = pyarrow, table, table.columns()
        self._waiting: list[Group] = []
        self._bytes = 0
        self._schema = pyarrow.schema([self._field(column) for column in self._columns])
        self._writer = parquet.ParquetWriter(path, self._schema)

    def _field(self, column: Column):
        types = self._pyarrow
        by_type = {"int8_t": types.int8(), "int16_t": types.int16(), "int32_t": types.int32(),
                   "int64_t": types.int64(), "float": types.float32(),
                   "double": types.float64()}  # fmt: skip
        text = column.is_word or column.field.is_text
        kind = types.string() if text else by_type[column.field.type]
        about = _about(column)
        return types.field(column.name, kind, metadata={k: v for k, v in about.items() if v})

    def take(self, group: Group) -> None:
        self._waiting.append(group)
        self._bytes += group.rows.nbytes
        if self._bytes > _ROW_GROUP:
            self._flush()

    def _flush(self) -> None:
        arrays = []
        for column, entry in zip(self._columns, self._schema, strict=True):
            parts = [self._array(column, entry.type, group) for group in self._waiting]
            arrays.append(self._pyarrow.chunked_array(parts, entry.type))
        rows = sum(len(group.rows) for group in self._waiting)
        table = self._pyarrow.Table.from_arrays(arrays, schema=self._schema)
        self._writer.write_table(table, row_group_size=max(1, rows))
        self._waiting, self._bytes = [], 0

    def _array(self, column: Column, kind, group: Group):
        found, counted = values(self._table, column, group)
        mask = None if counted is None else ~counted
        return self._pyarrow.array(np.ascontiguousarray(found), kind, mask=mask)

    def close(self) -> None:
        if self._waiting:
            self._flush()
        self._writer.close()


def survey(stream: Stream) -> dict[str, Table]:
    """The tables of a log, which is read for it."""
    tables: dict[str, Table] = {}
    for piece in stream.pieces():
        for group in piece.groups:
            tables.setdefault(group.channel, Table(group.channel, group.type)).note(group)
    name_joints(tables)
    return tables


class Folder:
    """A file a channel; none has its name before all are whole."""

    def __init__(self, folder: Path, make: type[CsvFile | ParquetFile], tables: Iterable[Table]):
        folder.mkdir(parents=True, exist_ok=True)
        self._files: dict[str, CsvFile | ParquetFile] = {}
        self._paths: list[Path] = []
        try:
            for table in tables:
                path = self._beside(folder / f"{table.channel}.{make.SUFFIX}")
                self._files[table.channel] = make(path, table)
            _write_columns(self._beside(folder / COLUMNS), tables)
        except BaseException:
            self.discard()
            raise

    def _beside(self, path: Path) -> Path:
        self._paths.append(path)
        return _new(path)

    def take(self, groups: list[Group]) -> None:
        for group in groups:
            self._files[group.channel].take(group)

    def told(self) -> list[str]:
        return []

    def finish(self) -> None:
        self._close()
        for path in self._paths:
            _new(path).replace(path)

    def discard(self) -> None:
        with suppress(OSError, ValueError):  # what failed is told already; it fails here again
            self._close()
        for path in self._paths:
            _new(path).unlink(missing_ok=True)

    def _close(self) -> None:
        for file in self._files.values():
            file.close()


def _new(path: Path) -> Path:
    return path.with_name(f"{path.name}.new")


def _about(column: Column) -> dict[str, str]:
    unit = "" if column.is_word else column.field.unit
    return {"unit": unit, "joint": column.joint, "meaning": column.meaning}


def _write_columns(path: Path, tables: Iterable[Table]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["channel", "column", "unit", "joint", "meaning"])
        for table in tables:
            for column in table.columns():
                writer.writerow([table.channel, column.name, *_about(column).values()])
