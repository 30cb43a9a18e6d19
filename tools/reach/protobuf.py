"""Our messages as Protocol Buffers: their descriptions, and many messages at once.

Arrays are as long as they are in use; an array of arrays is repeated rows. Numbers have types of
fixed size, so that all messages of one layout are filled in as columns of one array.
"""

from collections.abc import Iterator

import numpy as np

from .log_stream import Group
from .message_fields import Field, Message
from .messages import described

PACKAGE = "reach"
_VARINT, _FIXED64, _BYTES, _FIXED32 = 0, 1, 2, 5
_OPTIONAL, _REPEATED = 1, 3
_DOUBLE, _FLOAT, _STRING, _MESSAGE, _ENUM, _SFIXED32, _SFIXED64 = 1, 2, 9, 11, 14, 15, 16
_LONGEST_VARINT = 10
# Type in protobuf, on the wire, and as numpy has it.
_NUMBERS = {
    "int8_t": (_SFIXED32, _FIXED32, "<i4"), "int16_t": (_SFIXED32, _FIXED32, "<i4"),
    "int32_t": (_SFIXED32, _FIXED32, "<i4"), "int64_t": (_SFIXED64, _FIXED64, "<i8"),
    "float": (_FLOAT, _FIXED32, "<f4"), "double": (_DOUBLE, _FIXED64, "<f8"),
}  # fmt: skip


def varint(number: int, at_least: int = 1) -> bytes:
    """Negative numbers as 64 bits; with `at_least` so many bytes, of which the last say nothing."""
    number &= (1 << 64) - 1
    parts = []
    while number or len(parts) < at_least:
        parts.append(number & 0x7F)
        number >>= 7
    return bytes([part | 0x80 for part in parts[:-1]] + parts[-1:])


def tag(number: int, wire: int) -> bytes:
    return varint(number << 3 | wire)


def of_bytes(number: int, content: bytes) -> bytes:
    """A field that holds text, bytes or a message."""
    return tag(number, _BYTES) + varint(len(content)) + content


def of_number(number: int, value: int) -> bytes:
    return tag(number, _VARINT) + varint(value)


def file_set(*files: bytes) -> bytes:
    """A FileDescriptorSet, as MCAP wants it."""
    return b"".join(of_bytes(1, file) for file in files)


def file(name: str, package: str, content: bytes, imports: tuple[str, ...] = ()) -> bytes:
    """A FileDescriptorProto; `content` are its messages, each a field 4."""
    head = of_bytes(1, name.encode()) + of_bytes(2, package.encode())
    needs = b"".join(of_bytes(3, path.encode()) for path in imports)
    return head + needs + content + of_bytes(12, b"proto3")


def message(name: str, content: bytes) -> bytes:
    """A DescriptorProto without its tag."""
    return of_bytes(1, name.encode()) + content


def field(name: str, number: int, kind: int, type_name: str = "", repeated: bool = False) -> bytes:
    """A FieldDescriptorProto as a field of its message."""
    content = of_bytes(1, name.encode()) + of_number(3, number)
    content += of_number(4, _REPEATED if repeated else _OPTIONAL) + of_number(5, kind)
    return of_bytes(2, content + (of_bytes(6, type_name.encode()) if type_name else b""))


def full_name(type_name: str) -> str:
    return f"{PACKAGE}.{type_name}"


def schema(type_name: str) -> bytes:
    """What a message of ours looks like."""
    about = described(type_name)
    content = b"".join(_describe(about, entry, i) for i, entry in enumerate(about.fields, 1))
    body = of_bytes(4, message(type_name, content))
    return file_set(file(f"{PACKAGE}/{type_name}.proto", PACKAGE, body))


def _describe(about: Message, entry: Field, number: int) -> bytes:
    name, inside = entry.plain_name, f".{PACKAGE}.{about.name}"
    depth = len(about.counts(entry))
    if entry.type == "string" or entry.is_text:
        return field(name, number, _STRING, repeated=entry.type == "string")
    if entry.words:
        enum = name.title().replace("_", "")
        return field(name, number, _ENUM, f"{inside}.{enum}") + of_bytes(4, _enum(enum, entry))
    kind = _NUMBERS[entry.type][0]
    if depth < 2:
        return field(name, number, kind, repeated=depth == 1)
    row = f"{name.title().replace('_', '')}Row"
    return field(name, number, _MESSAGE, f"{inside}.{row}", repeated=True) + of_bytes(
        3, _row(row, f"{inside}.{row}", kind, depth - 1)
    )


def _row(name: str, inside: str, kind: int, depth: int) -> bytes:
    """A message around the entries of an inner dimension."""
    if depth == 1:
        return message(name, field("column", 1, kind, repeated=True))
    inner = of_bytes(3, _row("Row", f"{inside}.Row", kind, depth - 1))
    return message(name, field("row", 1, _MESSAGE, f"{inside}.Row", repeated=True) + inner)


def _enum(name: str, entry: Field) -> bytes:
    values = b"".join(
        of_bytes(2, of_bytes(1, word.encode()) + of_number(2, number))
        for number, word in sorted(entry.words.items())
    )
    return of_bytes(1, name.encode()) + values


class _Layout:
    """One encoded message as a row of numpy's: bytes that are the same in all, and columns."""

    def __init__(self):
        self._parts: list[tuple[str, str | tuple, object]] = []  # name, type, its bytes or column

    def same(self, content: bytes) -> None:
        self._parts.append((f"c{len(self._parts)}", f"V{len(content)}", content))

    def column(self, dtype: str, column: np.ndarray) -> None:
        self._parts.append((f"c{len(self._parts)}", (dtype, column.shape[1:]), column))

    def encoded(self, rows: int) -> list[bytes]:
        dtype = np.dtype([
            (name, *(kind if isinstance(kind, tuple) else (kind,))) for name, kind, _ in self._parts
        ])  # fmt: skip
        out = np.empty(rows, dtype)
        for name, _, content in self._parts:
            out[name] = np.void(content) if isinstance(content, bytes) else content
        whole, size = out.tobytes(), dtype.itemsize
        return [whole[at : at + size] for at in range(0, rows * size, size)]


def encode(group: Group) -> list[bytes]:
    """Each message of the group."""
    about = described(group.type)
    done: list[bytes] = [b""] * len(group.rows)
    for lengths, places in _alike(about, group.rows):
        rows = group.rows[places]
        layout = _Layout()
        for number, entry in enumerate(about.fields, 1):
            _put(layout, about, entry, number, rows, lengths, group.joints)
        for place, content in zip(places.tolist(), layout.encoded(len(rows)), strict=True):
            done[place] = content
    return done


def _alike(about: Message, rows: np.ndarray) -> Iterator[tuple[dict[str, int], np.ndarray]]:
    """The rows by layout: those whose arrays are equally long; ones with text by themselves."""
    names = sorted({count for entry in about.fields for count in about.counts(entry)} - {None})
    if any(entry.is_text for entry in about.fields):
        for place in range(len(rows)):
            yield {}, np.array([place])
        return
    if not names:
        yield {}, np.arange(len(rows))
        return
    table = np.stack([rows[name].astype(np.int64) for name in names], axis=1)
    kinds, which = np.unique(table, axis=0, return_inverse=True)
    for i, kind in enumerate(kinds.tolist()):
        yield dict(zip(names, kind, strict=True)), np.flatnonzero(which.ravel() == i)


def _put(layout: _Layout, about: Message, entry: Field, number: int, rows: np.ndarray,
         lengths: dict[str, int], joints: tuple[str, ...]) -> None:  # fmt: skip
    if entry.type == "string":
        layout.same(b"".join(of_bytes(number, name.encode()) for name in joints))
        return
    column = rows[entry.plain_name]
    if entry.is_text:
        text = column[0].tobytes().partition(b"\0")[0].decode("ascii", errors="backslashreplace")
        layout.same(of_bytes(number, text.encode()))
    elif entry.words:
        _put_enum(layout, number, column)
    elif column.ndim == 1:
        _, wire, dtype = _NUMBERS[entry.type]
        layout.same(tag(number, wire))
        layout.column(dtype, column)
    else:
        counts = about.counts(entry)
        used = tuple(
            size if count is None else min(size, max(0, lengths[count]))
            for size, count in zip(column.shape[1:], counts, strict=True)
        )
        _put_array(layout, number, column[(slice(None), *map(slice, used))], entry.type)


def _put_enum(layout: _Layout, number: int, column: np.ndarray) -> None:
    layout.same(tag(number, _VARINT))
    if ((column >= 0) & (column < 0x80)).all():
        layout.column("u1", column)
        return
    numbers = [varint(value, _LONGEST_VARINT) for value in column.tolist()]
    layout.column("u1", np.frombuffer(b"".join(numbers), "u1").reshape(-1, _LONGEST_VARINT))


def _put_array(layout: _Layout, number: int, column: np.ndarray, kind: str) -> None:
    """Packed numbers, or for more dimensions a row of them for each index."""
    if 0 in column.shape[1:2]:
        return
    if column.ndim == 2:
        layout.same(tag(number, _BYTES) + varint(_size_of(column.shape[1:], kind)))
        layout.column(_NUMBERS[kind][2], column)
        return
    for i in range(column.shape[1]):
        inner = column[:, i]
        layout.same(tag(number, _BYTES) + varint(_size_of(inner.shape[1:], kind, row=True)))
        _put_array(layout, 1, inner, kind)


def _size_of(shape: tuple[int, ...], kind: str, row: bool = False) -> int:
    """Bytes of the packed numbers; with `row` of the message that holds them in its field 1."""
    if 0 in shape[:1]:
        return 0
    if len(shape) > 1:
        size = _size_of(shape[1:], kind, row=True)
        return shape[0] * (1 + len(varint(size)) + size)
    size = shape[0] * np.dtype(_NUMBERS[kind][2]).itemsize
    return 1 + len(varint(size)) + size if row else size
