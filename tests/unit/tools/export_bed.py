"""What the tests of reach-export share: logs of given messages, and the program on them."""

import contextlib
import csv
import io
import tempfile
import unittest
from pathlib import Path

import lcm
from reach import export
from reach.messages import bot_core
from reach.messages import reach as types

JOINTS = ("shoulder", "elbow", "wrist")


def joint_state(names=JOINTS) -> bot_core.joint_state_t:
    state = bot_core.joint_state_t()
    state.num_joints, state.joint_name = len(names), list(names)
    state.joint_position = [0.25 * i for i in range(len(names))]
    state.joint_velocity = state.joint_effort = [0.0] * len(names)
    return state


def stereo(pixelformat: int) -> bot_core.images_t:
    pair = bot_core.images_t()
    image = bot_core.image_t()
    image.utime, image.pixelformat, image.data, image.size = 1_500_000, pixelformat, b"jpeg", 4
    pair.n_images, pair.image_types, pair.images = 2, [pair.LEFT, pair.RIGHT], [image, image]
    return pair


class Exported(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.log = self.folder / "run.lcmlog"

    def write(self, messages: list[tuple[str, int, object]]) -> None:
        """Channel, logger's stamp, message or bytes of each."""
        log = lcm.EventLog(str(self.log), "w", overwrite=True)
        for channel, stamp, message in messages:
            data = message if isinstance(message, bytes) else message.encode()
            log.write_event(stamp, channel, data)
        log.close()

    def export(self, *words, code: int = 0) -> str:
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            result = export.main([str(word) for word in (self.log, *words)])
        self.assertEqual(result, code, err.getvalue())
        said = err.getvalue() if code else out.getvalue()
        self.assertEqual(said.count("\n"), 1, said)
        return said

    def rows(self, channel: str, folder: str = "csv") -> list[dict]:
        with (self.folder / folder / f"{channel}.csv").open(newline="") as file:
            return list(csv.DictReader(file))


def status(**fields) -> types.status_t:
    return filled(types.status_t(), fields)


def filled(message, fields: dict):
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def state(seq: int, n: int = 3, utime: int = 1_000_000) -> types.robot_state_t:
    position = [seq + 0.1 * i for i in range(16)]
    return filled(types.robot_state_t(), {"seq": seq, "n_joints": n, "position": position,
                                          "utime": utime})  # fmt: skip
