"""What must be the same on two machines for a run to give the same bytes on both."""

import hashlib
from pathlib import Path

from ..programs import BINARIES, ROOT

PROGRAMS = ("reachd", "reach-eval", "reach-finder", "reach-simrobot", "reach-vision")


def identity() -> str:
    """Version and git revision, and a digest of programs, configuration files and Python modules,
    in a form that people and Dask's resources can take."""
    from ..version import VERSION  # asks git

    return f"reach {VERSION}, programs {digest(BINARIES, ROOT)[:12]}"


def digest(binaries: Path, root: Path) -> str:
    """Of what is in the files and of their names, not of where the tree is."""
    total = hashlib.sha256()
    for name in PROGRAMS:
        path = binaries / name
        total.update(_of_file(path) if path.exists() else b"missing")
    for folder, pattern in (("etc", "*"), ("tools/reach", "*.py")):
        for path in sorted((root / folder).rglob(pattern)):
            if path.is_file():
                total.update(str(path.relative_to(root)).encode() + _of_file(path))
    return total.hexdigest()


def _of_file(path: Path) -> bytes:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").digest()
