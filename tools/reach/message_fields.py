"""What lcmtypes/*.lcm say of the messages: fields, units, meanings, words for numbers. Standard
library only, since the build reads manuals by it."""

import re
from dataclasses import dataclass, field

# Units in comments: alone, before or after the meaning.
_UNIT = r"rad/s|rad|us since the epoch|us|px|m/s|N m|bytes|m|s"

# Arrays of joints, inputs, solutions are as long as the message type allows; how many entries count
# is said by a field for each dimension, None: all of them.
_COUNTED: dict[str, dict[str, tuple[str | None, ...]]] = {
    "robot_state_t": dict.fromkeys(("position", "velocity"), ("n_joints",)),
    "robot_command_t": {"velocity": ("n_joints",)},
    "sim_truth_t": dict.fromkeys(("position", "velocity"), ("n_joints",)),
    "sample_t": {
        "q": ("n_inputs",), "x": ("n_outputs",), "x_predicted": ("n_outputs",),
        "values": ("solutions", "n_outputs"),
    },
    "status_t": dict.fromkeys(("x_predicted", "x_estimated"), ("n_outputs",)),
    "trace_t": {
        "observation": ("n_observations",), "observation_checksum": ("n_observations",),
        "request": ("n_requests",), "request_checksum": ("n_requests",),
        "velocity": ("n_joints",), "x_estimated": ("n_outputs",),
    },
    "request_t": {"target": ("n_targets", None)},
    "learner_request_t": {"z": ("n_inputs",), "x": ("n_outputs",)},
    "learner_prediction_t": {
        "weight": ("n_solutions",),
        "x": ("n_solutions", "n_outputs"), "x_variance": ("n_solutions", "n_outputs"),
        "jacobian": ("n_solutions", "n_outputs", "n_inputs"),
        "z": ("n_solutions", "n_inputs"), "z_variance": ("n_solutions", "n_inputs"),
    },
    "joint_state_t": dict.fromkeys(
        ("joint_name", "joint_position", "joint_velocity", "joint_effort"), ("num_joints",)),
}  # fmt: skip
# The entries of these arrays are of the robot's joints, in the order of JOINT_STATE.
_OF_JOINTS = {("sample_t", "q")} | {
    (kind, name)
    for kind, counted in _COUNTED.items()
    for name, counts in counted.items()
    if counts in (("n_joints",), ("num_joints",))
}


@dataclass
class Field:
    type: str
    name: str  # as it is written, with its dimensions: position[16]
    unit: str
    meaning: str
    constants: list[str] = field(default_factory=list)  # "A = 0, B = 1 (what they are)"

    @property
    def plain_name(self) -> str:
        return self.name.partition("[")[0]

    @property
    def dimensions(self) -> tuple[int, ...]:
        """() for a single number; of fixed arrays alone."""
        return tuple(int(n) for n in re.findall(r"\[(\d+)\]", self.name))

    @property
    def is_text(self) -> bool:
        """ASCII up to a zero: what our messages have arrays of bytes for."""
        return self.type == "int8_t" and bool(self.dimensions)

    @property
    def words(self) -> dict[int, str]:
        """The numbers that have names; none where names are bits, of which there may be several."""
        pairs = re.findall(r"(\w+) = (-?\d+)", ", ".join(self.constants))
        named = {int(number): name for name, number in pairs}
        return named if 0 in named or any(n & (n - 1) for n in named) else {}


@dataclass
class Message:
    package: str
    name: str
    about: str
    channels: list[str]
    fields: list[Field]

    def counts(self, entry: Field) -> tuple[str | None, ...]:
        """For each dimension the field that says how many entries count; None: all."""
        counted = _COUNTED.get(self.name, {}).get(entry.plain_name)
        return counted or (None,) * len(entry.dimensions)

    def is_of_joints(self, entry: Field) -> bool:
        return (self.name, entry.plain_name) in _OF_JOINTS


def split_unit(comment: str) -> tuple[str, str]:
    """(meaning, unit) of a field's comment."""
    if found := re.fullmatch(rf"({_UNIT})(?:[,;] (.*))?", comment):
        return found[2] or "", found[1]
    if found := re.fullmatch(rf"(.*)[,;] ({_UNIT})( \(.*\))?", comment):
        return found[1] + (found[3] or ""), found[2]
    return comment, ""


def _parse_line(line: str, pending: list[str], fields: list[Field]) -> None:
    """One line within a struct: a comment about the next field, a constant or a field."""
    code, _, comment = line.partition("//")
    code, comment = code.strip(), comment.strip()
    if not code:
        pending[:] = [*pending, comment] if comment else []
        return
    names = re.findall(r"(\w+ = -?\d+)(?: ?[,;])", line)
    if code.startswith("const ") or re.match(r"\w+ = ", code):
        fields[-1].constants.append(", ".join(names) + (f" ({comment})" if comment else ""))
        return
    kind, name = code.rstrip(";").split(None, 1)
    meaning, unit = split_unit(comment)
    before = " ".join(pending)
    fields.append(Field(kind, name, unit, ". ".join(x for x in (before.rstrip("."), meaning) if x)))
    pending[:] = []


def parse_message(text: str) -> Message:
    head, _, rest = text.partition("\nstruct ")
    about = " ".join(re.findall(r"^// ?(.+)$", head, re.M))
    name, _, body = rest.partition("{")
    fields: list[Field] = []
    pending: list[str] = []
    for line in body.rsplit("}", 1)[0].splitlines():
        _parse_line(line, pending, fields)
    channels = re.findall(r"[Cc]hannel ([A-Z][A-Z_]+)", about)
    return Message(re.search(r"package (\w+);", head)[1], name.strip(), about, channels, fields)
