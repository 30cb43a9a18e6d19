"""Does several runs side by side, each in a process, in a network and on processors of its own.

The programs of a lockstep run wait for each other all the time. On a processor of their own they
take turns without waking another one, which is dear: two runs on two processors, one on each, come
further than the same two sharing both.
"""

import contextlib
import ctypes
import multiprocessing
import os
import signal
import subprocess
from collections.abc import Callable, Iterable, Iterator
from multiprocessing.connection import Connection, wait

from ..processes import die_with_parent
from ..programs import ROOT
from ..progress import Progress
from ..session import Stop
from .plan import Run

LOOK_SECONDS = 0.5  # between two looks at whether the user wants an end
_CLONE_NEWNET = 0x40000000
_ENDING = (signal.SIGINT, signal.SIGTERM)

# What a run does: it is told where to say how far it is, and returns what the user should know.
Task = Callable[[Run, "Told"], str | None]


class Told:
    """A Progress of which the parent process writes the lines."""

    def __init__(self, connection: Connection):
        self._connection = connection

    def update(self, phase: str, share: float, text: str) -> None:
        self._connection.send(("update", phase, share, text))

    def finish(self, phase: str, text: str) -> None:
        self._connection.send(("finish", phase, text))


class Jobs:
    """`task` does one run; it raises one of `expected` where that fails."""

    def __init__(self, count: int, task: Task, expected: tuple[type[Exception], ...]):
        processors = sorted(os.sched_getaffinity(0))
        count = min(count, len(processors))
        self._free = [set(processors[i::count]) for i in range(count)]
        self._task = task
        self._expected = expected
        self.remarks: set[str] = set()  # what the runs returned
        self._working: dict[Connection, _Worker] = {}

    def do(self, runs: Iterable[Run], progress: Progress, stop: Stop) -> dict[str, str]:
        """What failed, by the run's name: the others go on. Raises KeyboardInterrupt after `stop`,
        when all have ended."""
        waiting, failed = list(runs), {}
        try:
            while waiting or self._working:
                while waiting and self._free:
                    self._begin(waiting.pop(0))
                for connection in wait(list(self._working), LOOK_SECONDS):
                    self._hear(connection, progress, failed)
                stop.check()
        finally:
            self._end_all()
        return failed

    def _begin(self, run: Run) -> None:
        ours, theirs = multiprocessing.Pipe(duplex=False)
        processors = self._free.pop(0)
        # Forked: what this process has imported and set, the run finds.
        process = multiprocessing.get_context("fork").Process(
            target=self._work, args=(run, processors, theirs)
        )
        with _end_held_back():
            process.start()
        theirs.close()
        self._working[ours] = _Worker(run, process, processors)

    def _work(self, run: Run, processors: set[int], connection: Connection) -> None:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDING)
        die_with_parent()
        os.sched_setaffinity(0, processors)
        try:
            _enter_network()
            connection.send(("done", self._task(run, Told(connection))))
        except self._expected as error:
            connection.send(("failed", str(error)))
        except KeyboardInterrupt:
            pass

    def _hear(self, connection: Connection, progress: Progress, failed: dict[str, str]) -> None:
        worker = self._working[connection]
        try:
            kind, *said = connection.recv()
        except EOFError:
            self._dismiss(connection)
            if not worker.told_end:
                failed[worker.run.name] = f"ended with code {worker.process.exitcode}"
            return
        if kind in ("update", "finish"):
            getattr(progress.part(worker.run.name), kind)(*said)
            return
        worker.told_end = True
        if kind == "failed":
            failed[worker.run.name] = said[0]
        elif said[0]:
            self.remarks.add(said[0])

    def _dismiss(self, connection: Connection) -> None:
        worker = self._working.pop(connection)
        worker.process.join()
        connection.close()
        self._free.append(worker.processors)

    def _end_all(self) -> None:
        for worker in self._working.values():
            worker.process.terminate()
        for connection in list(self._working):
            with contextlib.suppress(EOFError):
                while True:  # nobody may be left who waits for a listener
                    connection.recv()
            self._dismiss(connection)


class _Worker:
    def __init__(self, run: Run, process: multiprocessing.Process, processors: set[int]):
        self.run = run
        self.process = process
        self.processors = processors
        self.told_end = False


@contextlib.contextmanager
def _end_held_back() -> Iterator[None]:
    """A new process forgets the signals that came before its interpreter's first step; those that
    are blocked wait for it."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _enter_network() -> None:
    """This process alone on a loopback of its own; as in tools/netns.sh, which does the rest."""
    if ctypes.CDLL(None, use_errno=True).unshare(_CLONE_NEWNET) != 0:
        raise OSError(ctypes.get_errno(), "cannot make a network namespace")
    if subprocess.run([ROOT / "tools/netns.sh", "--inside", "yes", "true"]).returncode != 0:
        raise OSError("no loopback in the run's network namespace, see above")
