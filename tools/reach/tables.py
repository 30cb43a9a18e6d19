"""Messages as tables: a column a number, arrays as long as in use, words beside numbers."""

from dataclasses import dataclass, field
from itertools import product
from math import prod

import numpy as np

from .log_stream import JOINTS, Group
from .message_fields import Field, Message
from .messages import described

_LARGEST = 1000  # entries of an array that become columns; a body has more, and no use for them
LOG_STAMP = Field("int64_t", "log_utime", "us since the epoch", "when the message was logged")


@dataclass(frozen=True)
class Column:
    name: str  # position[0]; state_word
    field: Field
    index: tuple[int, ...] = ()
    is_word: bool = False
    joint: str = ""

    @property
    def meaning(self) -> str:
        return f"the word for {self.field.name}" if self.is_word else self.field.meaning


@dataclass
class Table:
    """A channel's columns; they are known once all groups of a log were noted."""

    channel: str
    type: str
    rows: int = 0
    joints: tuple[str, ...] = ()
    _greatest: dict[str, int] = field(default_factory=dict)  # of the fields that count entries

    def note(self, group: Group) -> None:
        self.rows += len(group.rows)
        self.joints = self.joints or group.joints
        for name in _counting(described(self.type)):
            most = int(group.rows[name].max())
            self._greatest[name] = max(self._greatest.get(name, 0), most)

    def columns(self) -> list[Column]:
        message = described(self.type)
        found = [Column(LOG_STAMP.name, LOG_STAMP)]
        for entry in message.fields:
            if entry.type != "string":
                found += self._columns_of(message, entry)
        return found

    def _columns_of(self, message: Message, entry: Field) -> list[Column]:
        name = entry.plain_name
        if not message.counts(entry) or entry.is_text:
            words = [Column(f"{name}_word", entry, is_word=True)] if entry.words else []
            return [Column(name, entry), *words]
        lengths = self._lengths(message, entry)
        if prod(lengths) > _LARGEST:
            return []
        found = []
        for index in product(*(range(n) for n in lengths)):
            joint = ""
            if message.is_of_joints(entry) and index[0] < len(self.joints):
                joint = self.joints[index[0]]
            brackets = "".join(f"[{i}]" for i in index)
            found.append(Column(name + brackets, entry, index, joint=joint))
        return found

    def _lengths(self, message: Message, entry: Field) -> list[int]:
        """Of the array's dimensions, as far as any row uses them."""
        most = entry.dimensions or (self._greatest.get("num_joints", 0),)
        counts = message.counts(entry)
        return [
            size if count is None else min(size, max(0, self._greatest.get(count, 0)))
            for size, count in zip(most, counts, strict=True)
        ]


def name_joints(tables: dict[str, Table]) -> None:
    """JOINT_STATE says how the joints are named whose numbers the other channels have."""
    if JOINTS in tables:
        for table in tables.values():
            table.joints = tables[JOINTS].joints


def values(table: Table, column: Column, group: Group) -> tuple[np.ndarray, np.ndarray | None]:
    """What the column has of the group's rows, and which of it counts; None: all of it."""
    if column.field is LOG_STAMP:
        return group.stamps, None
    found = group.rows[column.field.plain_name]
    if column.field.is_text:
        return _texts(found), None
    if column.is_word:
        words = column.field.words
        return np.array([words.get(number, "") for number in found.tolist()], object), None
    if not column.index:
        return found, None
    if column.index[0] >= found.shape[1]:  # JOINT_STATE with fewer joints than elsewhere
        return np.zeros(len(found), found.dtype), np.zeros(len(found), bool)
    counted = np.ones(len(found), bool)
    for i, count in zip(column.index, described(table.type).counts(column.field), strict=True):
        if count is not None:
            counted &= group.rows[count] > i
    return found[(slice(None), *column.index)], None if counted.all() else counted


def _texts(found: np.ndarray) -> np.ndarray:
    """Bytes up to a zero as text; those beyond ASCII become \\xNN."""
    texts = [row.tobytes().partition(b"\0")[0] for row in np.ascontiguousarray(found)]
    return np.array([text.decode("ascii", errors="backslashreplace") for text in texts], object)


def _counting(message: Message) -> set[str]:
    counts = {count for entry in message.fields for count in message.counts(entry)}
    return counts - {None} | ({"num_joints"} if message.name == "joint_state_t" else set())
