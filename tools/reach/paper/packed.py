"""A run's log, kept compressed: it is mostly zeros, and many runs are kept."""

import contextlib
import gzip
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

NAME = "run.lcmlog"
LEVEL = 1  # higher ones take long and gain little


def pack(folder: Path) -> None:
    """run.lcmlog becomes run.lcmlog.gz."""
    plain = folder / NAME
    with plain.open("rb") as source, gzip.open(folder / f"{NAME}.gz", "wb", LEVEL) as target:
        shutil.copyfileobj(source, target, 1 << 20)
    plain.unlink()


def exists(folder: Path) -> bool:
    return (folder / f"{NAME}.gz").exists()


@contextlib.contextmanager
def unpacked(folder: Path) -> Iterator[Path]:
    """The log as it was written, until the context is left."""
    with tempfile.TemporaryDirectory(prefix="reach-log-") as place:
        plain = Path(place) / NAME
        with gzip.open(folder / f"{NAME}.gz", "rb") as source, plain.open("wb") as target:
            shutil.copyfileobj(source, target, 1 << 20)
        yield plain
