"""The workers of a sweep: this machine's processors, or those that a scheduler of a lab has."""

import subprocess
import sys

from ..processes import die_with_parent
from .library import HTTP, distributed

CONNECT_SECONDS = 20
STOP_SECONDS = 40.0  # more than a worker gives the programs of its run


class ClusterError(OSError):
    """One line for the user."""


class Here:
    """A scheduler in this process and the program of reach.sweep.worker beside it. Both are on the
    loopback of this process's network alone."""

    writes_here = True  # runs write into the user's folders

    def __init__(self, at_once: int):
        options = {"host": "127.0.0.1", "port": 0, "dashboard": False, "dashboard_address": HTTP}
        self._cluster = distributed.SpecCluster(
            scheduler={"cls": distributed.Scheduler, "options": options}, silence_logs=False
        )
        self.client = distributed.Client(self._cluster)
        # A session of its own keeps Ctrl-C from it: it ends when it is told to.
        self._program = subprocess.Popen(
            [sys.executable, "-m", f"{__package__}.worker", self._cluster.scheduler_address,
             "--jobs", str(at_once)],
            stdin=subprocess.DEVNULL, start_new_session=True, preexec_fn=die_with_parent,
        )  # fmt: skip

    def check(self) -> None:
        """Raises ClusterError when nobody is left who works, or will."""
        if self._program.poll() is not None:
            raise ClusterError(
                f"the workers have ended with code {self._program.returncode}, see above"
            )

    def close(self) -> None:
        self._program.terminate()
        try:
            self._program.wait(STOP_SECONDS)
        except subprocess.TimeoutExpired:
            self._program.kill()
            self._program.wait()
        self.client.close()
        self._cluster.close()


class Lab:
    """A scheduler that somebody has started, with workers that come and go."""

    writes_here = False

    def __init__(self, address: str):
        self._address = address
        try:
            self.client = distributed.Client(address, timeout=CONNECT_SECONDS)
        except (OSError, TimeoutError, ValueError, TypeError) as error:
            raise ClusterError(f"no scheduler answers at {address}: {error}") from None

    def check(self) -> None:
        if self.client.status != "running":
            raise ClusterError(f"the scheduler at {self._address} has gone")

    def close(self) -> None:
        self.client.close()  # what runs for it is cancelled, and ends


def of(at_once: int, scheduler: str | None) -> Here | Lab:
    return Lab(scheduler) if scheduler else Here(at_once)
