"""The message bindings that the build generates, and the sizes of their fields for bulk reading."""

import sys
from functools import cache
from pathlib import Path

import numpy as np

from .message_fields import Message, parse_message

ROOT = Path(__file__).resolve().parents[2]
_INSTALLED = Path(__file__).resolve().parent / "lcmtypes"  # where pip puts them
_LCMTYPES = _INSTALLED if _INSTALLED.is_dir() else ROOT / "lcmtypes"

try:
    from reach_lcm import bot_core, reach
except ImportError:
    sys.exit(
        "reach: the message bindings are missing; build them (./run build) and set"
        " PYTHONPATH=tools:build/python"
    )

__all__ = ["CHANNELS", "ROOT", "bot_core", "described", "dtype_of", "reach"]

# Channel -> type of what a log holds. Images, JOINT_STATE and requests for a body, whose size
# varies, are apart.
CHANNELS = {
    "ROBOT_STATE": "robot_state_t",
    "ROBOT_COMMAND": "robot_command_t",
    "END_EFFECTOR": "end_effector_t",
    "MARKER": "marker_t",
    "REACH_STATUS": "status_t",
    "REACH_TRACE": "trace_t",
    "REACH_SAMPLE": "sample_t",
    "REACH_REQUEST": "request_t",
    "SIM_REQUEST": "sim_request_t",
    "SIM_TRUTH": "sim_truth_t",
    "LEARNER_REQUEST": "learner_request_t",
    "LEARNER_REPLY": "learner_reply_t",
    "LEARNER_PREDICTION": "learner_prediction_t",
    "SIM_CONTACTS": "sim_contacts_t",
    "REACH_CONFIG": "config_t",
    "REACH_BODY": "body_t",
    "REACH_BODY_IN_USE": "body_t",
    "LEARNER_BODY": "body_t",
    "REACH_HELLO": "hello_t",
}

_SCALARS = {"int8_t": ">i1", "int32_t": ">i4", "int64_t": ">i8", "double": ">f8"}


@cache
def described(type_name: str) -> Message:
    """What lcmtypes/ say of one of our messages, or of bot_core's."""
    for folder in (_LCMTYPES, _LCMTYPES / "bot_core"):
        path = folder / f"{type_name}.lcm"
        if path.is_file():
            return parse_message(path.read_text())
    raise KeyError(type_name)


def dtype_of(type_name: str) -> np.dtype:
    """The encoded layout of one of our messages, which LCM packs big-endian without gaps.

    All of them are of fixed size, so a whole log becomes one array without a call a message.
    """
    fields = [("fingerprint", ">i8")]
    for entry in described(type_name).fields:
        fields.append((entry.plain_name, _SCALARS[entry.type], entry.dimensions))
    return np.dtype(fields)
