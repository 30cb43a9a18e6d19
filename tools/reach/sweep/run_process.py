"""The process of one run: it has its worker's processors, and a network of its own if it wants one.

It is forked from a small server that the worker keeps, so that it has no threads but its own. Its
end comes with that of the worker, even of one that is killed outright.
"""

import contextlib
import ctypes
import os
import signal
import subprocess
import time
import traceback
from multiprocessing.connection import Connection
from pathlib import Path

import cloudpickle

from ..processes import die_with_parent
from ..programs import ROOT

SAY_SECONDS = 0.5  # between two lines of a run: more are not read
_CLONE_NEWNET = 0x40000000
_CLONE_NEWUSER = 0x10000000


class Told:
    """A Progress of which the user's process writes the lines."""

    def __init__(self, connection: Connection):
        self._connection = connection
        self._last = 0.0

    def update(self, phase: str, share: float, text: str) -> None:
        if time.monotonic() - self._last >= SAY_SECONDS:
            self._last = time.monotonic()
            self._connection.send(("update", phase, float(share), text))

    def finish(self, phase: str, text: str) -> None:
        self._connection.send(("finish", phase, text))


def work(order: bytes, folder: str | None, connection: Connection) -> None:
    """`order` is what sweep.Job.order() gives. The answer is ("done", pickled result) or
    ("failed", why); none where the run was told to end."""
    die_with_parent()
    # The task may end children and remove files of its own; one that needs more time has a Stop.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with contextlib.suppress(KeyboardInterrupt, BrokenPipeError):
        connection.send(_answer(order, folder, connection))


def _answer(order: bytes, folder: str | None, connection: Connection) -> tuple:
    expected: tuple = ()
    try:
        task, expected, network = cloudpickle.loads(order)
        if network:
            enter_network()
        told = Told(connection)
        result = task(told, Path(folder)) if folder else task(told)
        return "done", cloudpickle.dumps(result)
    except expected as error:
        return "failed", str(error)
    except Exception:
        return "failed", traceback.format_exc()


def enter_network() -> None:
    """This process alone on a loopback of its own; as in tools/netns.sh, which does the rest."""
    user, group = os.getuid(), os.getgid()
    if _unshare(_CLONE_NEWNET) != 0:
        # Who is not root becomes root of a user namespace, which owns the network namespace.
        if _unshare(_CLONE_NEWUSER | _CLONE_NEWNET) != 0:
            raise OSError(
                ctypes.get_errno(),
                "no network namespace can be made here; tools/netns.sh true tells why",
            )
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"0 {user} 1")
        Path("/proc/self/gid_map").write_text(f"0 {group} 1")
    if subprocess.run([ROOT / "tools/netns.sh", "--inside", "yes", "true"]).returncode != 0:
        raise OSError("no loopback in the run's network namespace, see above")


def _unshare(flags: int) -> int:
    return ctypes.CDLL(None, use_errno=True).unshare(flags)
