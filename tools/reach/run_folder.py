"""The folder that a run writes into: one run at a time, and no log is lost."""

import fcntl
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LOG, BEFORE = "run.lcmlog", "before.lcmlog"


class FolderInUseError(OSError):
    """Another run writes there."""


@contextmanager
def claimed(folder: Path) -> Iterator[None]:
    """Made where it is missing, and nobody else's until the context is left. To be called before
    anything in it is touched. The lock is on the folder itself, and goes with the process."""
    folder.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            told = f"{folder}: another run writes there; --out names another folder"
            raise FolderInUseError(told) from None
        yield
    finally:
        os.close(descriptor)


def set_log_aside(folder: Path) -> None:
    """The log of the run before keeps another name until the next one; so it is said."""
    log = folder / LOG
    if log.exists():
        log.replace(folder / BEFORE)
        print(f"{log} of an earlier run is now {BEFORE}", file=sys.stderr)
