"""Public robots and pinocchio, fetched when somebody wants them, into a folder outside the tree.

python -m reach.robots.packages FOLDER   fetches what is missing there
"""

import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

from ..messages import ROOT

REQUIREMENTS = ROOT / "requirements-robots.txt"


def usual_folder() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "reach/robots"


class Packages:
    """What is installed below `folder`."""

    def __init__(self, folder: Path):
        self._folder = folder
        self._installed = folder / "requirements.installed"

    @property
    def python(self) -> Path:
        """The interpreter that has pinocchio."""
        return self._folder / "venv/bin/python"

    @property
    def place(self) -> Path:
        """Where the packages' files are."""
        (place,) = (self._folder / "venv/lib").glob("python3*/site-packages")
        return place

    @property
    def complete(self) -> bool:
        there = self._installed.exists()
        return there and self._installed.read_bytes() == REQUIREMENTS.read_bytes()

    def fetch(self) -> None:
        """Some 900 MB on disk. CalledProcessError: pip has said why not."""
        print(f"robots: fetching public robots and pinocchio into {self._folder}", file=sys.stderr)
        self._folder.mkdir(parents=True, exist_ok=True)
        venv.create(self._folder / "venv", with_pip=True)
        command = [self.python, "-m", "pip", "install", "-q", "--disable-pip-version-check",
                   "--no-deps", "-r", REQUIREMENTS]  # fmt: skip
        subprocess.run(list(map(str, command)), check=True)
        shutil.copy(REQUIREMENTS, self._installed)  # last: it says that all went well


def main() -> int:
    packages = Packages(Path(sys.argv[1]) if len(sys.argv) > 1 else usual_folder())
    if packages.complete:
        return 0
    try:
        packages.fetch()
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"robots: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
