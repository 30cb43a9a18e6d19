"""What `./run accuracy --only body` has measured already, one file a draw and learner, so that one
can go on with a run that was ended (--resume)."""

import hashlib
import json
from pathlib import Path

from .programs import BINARIES


def digest(parts: list[object], files: list[Path]) -> str:
    """Of all that decides a draw's numbers: these parts, and what is in these files."""
    found = hashlib.sha256(repr(parts).encode())
    for path in files:
        found.update(path.read_bytes())
    return found.hexdigest()


class KeptDraws:
    """In `folder`; nothing is kept where there is none. Without `resume` what is there is not read,
    only replaced."""

    def __init__(self, folder: Path | None, resume: bool):
        self._folder, self._resume = folder, resume

    def key(self, parts: list[object], config: Path) -> str:
        sources = sorted(Path(__file__).parent.glob("*.py"))
        return digest(parts, [BINARIES / "reach-eval", config, *sources])

    def read(self, name: str, key: str) -> dict | None:
        """reach-eval's results by number of samples; None where they are not those of `key`."""
        if not self._resume or self._folder is None:
            return None
        path = self._folder / f"{name}.json"
        if not path.exists():
            return None
        try:
            kept = json.loads(path.read_text())
        except json.JSONDecodeError:  # it was being written when the run was ended
            return None
        if kept["key"] != key:
            return None
        return {int(at): result for at, result in kept["results"].items()}

    def write(self, name: str, key: str, results: dict) -> None:
        if self._folder is None:
            return
        self._folder.mkdir(parents=True, exist_ok=True)
        path = self._folder / f"{name}.json"
        path.write_text(json.dumps({"key": key, "results": results}) + "\n")
