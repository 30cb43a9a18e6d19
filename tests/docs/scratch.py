"""A scratch folder that looks like the tree to commands that are typed in it."""

import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("REACH_BUILD_DIR", SOURCE / "build"))
LONGEST = 100 * int(os.environ.get("CK_TIMEOUT_MULTIPLIER", "1"))  # s; sanitizers are slow


class Scratch:
    """Links to the tree in `folder`, and shells that end at the first error."""

    def __init__(self, folder: Path):
        self.folder = folder
        for name in ("tools", "examples", "etc"):
            (folder / name).symlink_to(SOURCE / name)
        (folder / "build").symlink_to(BUILD)
        (folder / ".venv").symlink_to(sys.prefix)
        (folder / "strict").write_text("set -e -o pipefail\n")

    def run(self, commands: str) -> subprocess.CompletedProcess:
        """Runs them in one shell, and ends whatever they have left running."""
        environment = os.environ | {"BASH_ENV": str(self.folder / "strict")}
        said, complained = self.folder / "stdout", self.folder / "stderr"
        with said.open("w") as out, complained.open("w") as error:
            shell = subprocess.Popen(["bash"], stdin=subprocess.PIPE, stdout=out, stderr=error,
                                     cwd=self.folder, env=environment, text=True,
                                     start_new_session=True)  # fmt: skip
            try:
                shell.communicate(commands, LONGEST)
            finally:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(shell.pid, signal.SIGTERM)
                shell.wait()
        return subprocess.CompletedProcess(
            shell.args, shell.returncode, said.read_text(), complained.read_text()
        )
