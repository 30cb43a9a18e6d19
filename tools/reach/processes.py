"""Starts the programs of an experiment and ends them, each by its process id."""

import ctypes
import signal
import subprocess
import time
from pathlib import Path

STOP_SECONDS = 8.0
_PR_SET_PDEATHSIG = 1


class ProcessDiedError(Exception):
    """A program of the experiment has ended by itself."""


def die_with_parent() -> None:
    """In the child: nothing of ours outlives the experiment, even one killed outright."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)


class Processes:
    """A context: what was started is ended on leaving, last started first."""

    def __init__(self, folder: Path):
        self._folder = folder
        self._running: dict[str, subprocess.Popen] = {}
        self._commands: dict[str, list] = {}

    def __enter__(self) -> "Processes":
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def start(self, name: str, command: list) -> None:
        """Its output goes to FOLDER/NAME.log. A session of its own keeps Ctrl-C from it."""
        mode = "ab" if name in self._commands else "wb"  # a restart goes on in the same log
        self._commands[name] = command
        with self._log(name).open(mode) as log:
            try:
                self._running[name] = subprocess.Popen(
                    [str(word) for word in command],
                    stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                    start_new_session=True, preexec_fn=die_with_parent,
                )  # fmt: skip
            except FileNotFoundError:
                raise ProcessDiedError(f"{command[0]} is missing; ./run build makes it") from None

    def restart(self, name: str) -> None:
        """Kills it outright, and starts it again as it was."""
        self._running[name].kill()
        self._running[name].wait()
        self.start(name, self._commands[name])

    def runs(self, name: str) -> bool:
        return name in self._running

    def memory_kb(self, name: str) -> int:
        """What it holds in memory at present."""
        status = Path(f"/proc/{self._running[name].pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0])

    def check(self) -> None:
        """Raises ProcessDiedError with the last line of whoever has ended."""
        for name, process in self._running.items():
            if process.poll() is not None:
                code = process.returncode
                ended = f"ended with code {code}" if code >= 0 else f"was killed by signal {-code}"
                raise ProcessDiedError(f"{name} {ended}: {self._last_line(name)}")

    def pid(self, name: str) -> int:
        return self._running[name].pid

    def release(self, name: str) -> subprocess.Popen:
        """Hands it over, forgotten as by kill(): it may end by itself."""
        return self._running.pop(name)

    def kill(self, name: str) -> None:
        """Outright, and forgotten: check() does not miss it, start() may start it again."""
        process = self._running.pop(name)
        process.kill()
        process.wait()

    def stop(self) -> None:
        for process in reversed(self._running.values()):
            if process.poll() is None:
                process.terminate()
        deadline = time.monotonic() + STOP_SECONDS
        for process in self._running.values():
            try:
                process.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._running.clear()

    def _log(self, name: str) -> Path:
        return self._folder / f"{name}.log"

    def _last_line(self, name: str) -> str:
        lines = self._log(name).read_text(errors="replace").strip().splitlines()
        return lines[-1] if lines else "it said nothing"
