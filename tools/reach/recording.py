"""A run's log as a recording for Rerun's viewer: what the window of `./run live` would have shown,
ten times a second of the robot's time.

Without rerun-sdk, which is large and optional, nothing is written and one line says so.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from .event_log import Event, events
from .log_stream import IMAGES, JOINTS, Selection, Stream
from .messages import ROOT

MISSING = (
    "rerun-sdk is missing: pip install 'reach[rerun]'; in the tree:"
    " .venv/bin/python -m pip install -r requirements-live.txt"
)


STEP = 100_000  # us; a person sees no more, and all 50 a second take five times as long to write


class RecordingError(Exception):
    """Why there is none; one line for the user."""


def write(log: Path, path: Path, urdf: Path | None = None,
          selection: Selection | None = None) -> int:  # fmt: skip
    """Writes the recording; `urdf` is the robot, by default one of ours that has the log's joints.
    A file under its own name is whole. Returns how many messages could not be shown."""
    try:
        from . import view
    except ImportError:
        raise RecordingError(MISSING) from None
    if urdf:
        urdf.open("rb").close()  # Rerun's own complaint does not name the file
    aside = path.with_name(f"{path.name}.new")
    try:
        bad = view.write_log(
            _selected(log, selection), aside, urdf or robot_of(log), STEP, has_images(log)
        )
        aside.replace(path)
        return bad
    except RuntimeError as error:
        raise RecordingError(f"{path}: {error}") from None
    finally:
        aside.unlink(missing_ok=True)


def beside(log: Path) -> str | None:
    """Writes LOG's name with .rrd. None, or one line that says why not: it is no reason to fail."""
    path = log.with_suffix(".rrd")
    path.unlink(missing_ok=True)
    try:
        write(log, path)
    except (RecordingError, OSError) as error:
        return f"no {path.name} for Rerun's viewer beside the log: {error}"
    return None


def robot_of(log: Path) -> Path | None:
    """The robot of ours that has all joints that the log tells of."""
    joints = _joints_in(log)
    for urdf in sorted((ROOT / "etc/robots").glob("*.urdf")):
        names = {joint.get("name") for joint in ElementTree.parse(urdf).iter("joint")}
        if joints and joints <= names:
            return urdf
    return None


def has_images(log: Path) -> bool:
    return any(event.channel == IMAGES for event in events(log))


def _joints_in(log: Path) -> set[str]:
    only = Selection(channels=re.compile(JOINTS))
    for piece in Stream(log, only).pieces():
        for group in piece.groups:
            return set(group.joints)
    return set()


def _selected(log: Path, selection: Selection | None) -> Iterator[Event]:
    first = None
    for event in events(log):
        first = event.timestamp if first is None else first
        if selection is None or selection.takes(event, first):
            yield event
