"""A run's files on their way from the worker to the user, in pieces: the scheduler hands them on,
and must not hold hundreds of megabytes."""

import hashlib
import shutil
from collections.abc import Callable
from pathlib import Path

from .library import distributed

PIECE = 4 << 20  # bytes

# The worker's address, its folder, and of each file in it: name, bytes, SHA-256.
Kept = tuple[str, str, list[tuple[str, int, str]]]


def keep(worker: str, folder: str) -> Kept:
    """On the worker."""
    root, found = Path(folder), []
    for path in sorted(root.rglob("*")):
        if path.is_file():
            with path.open("rb") as file:
                digest = hashlib.file_digest(file, "sha256").hexdigest()
            found.append((str(path.relative_to(root)), path.stat().st_size, digest))
    return worker, folder, found


def read(path: str, offset: int) -> bytes:
    """On the worker."""
    with Path(path).open("rb") as file:
        file.seek(offset)
        return file.read(PIECE)


def forget(folder: str) -> None:
    """On the worker."""
    shutil.rmtree(folder, ignore_errors=True)


def fetch(client: distributed.Client, kept: Kept, target: Path, look: Callable[[], None]) -> None:
    """Into `target`, whole or not at all; `look` is called after each piece. OSError where a piece
    cannot be had or is not as it was."""
    worker, folder, files = kept
    aside = target.with_name(f"{target.name}.coming")
    shutil.rmtree(aside, ignore_errors=True)
    aside.mkdir(parents=True)
    try:
        for name, size, digest in files:
            _fetch_file(client, worker, f"{folder}/{name}", size, digest, aside / name, look)
        shutil.rmtree(target, ignore_errors=True)
        aside.rename(target)
    finally:
        shutil.rmtree(aside, ignore_errors=True)
    client.run(forget, folder, workers=[worker])


def _fetch_file(client, worker: str, path: str, size: int, digest: str, to: Path, look) -> None:
    to.parent.mkdir(parents=True, exist_ok=True)
    total = hashlib.sha256()
    with to.open("wb") as file:
        while file.tell() < size:
            piece = client.run(read, path, file.tell(), workers=[worker]).get(worker)
            if not piece:
                raise OSError(f"{path} on {worker} has become shorter")
            file.write(piece)
            total.update(piece)
            look()
    if total.hexdigest() != digest:
        raise OSError(f"{path} on {worker} did not arrive as it was")
