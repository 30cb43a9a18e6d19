"""What a worker does with a run: it starts the run's process, tells how far it is, and ends it when
it is no longer wanted. Dask runs this in a thread; the worker answers to its scheduler meanwhile.

The scheduler must be able to import this module, and needs no built programs for that.
"""

import multiprocessing
import shutil
import tempfile
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerContext
from multiprocessing.process import BaseProcess

from . import pieces
from .library import distributed

LOOK_SECONDS = 0.3  # between two looks whether the run is still wanted
STOP_SECONDS = 20.0  # for its programs to end
_RUNNING = distributed.core.Status.running, distributed.core.Status.paused

# The run's answer, and where its files wait to be fetched.
Carried = tuple[tuple, pieces.Kept | None]


def carry_out(order: bytes, modules: list[str], topic: str, name: str,
              folder: str | bool | None) -> Carried | None:  # fmt: skip
    """`order` as in run_process, which wants `modules`. `folder`: where the run writes; True: into
    a folder of the worker's own, to be fetched; None: nowhere. Returns None when the run is not
    wanted any longer."""
    worker = distributed.get_worker()
    key = worker.get_current_task()
    place = (
        tempfile.mkdtemp(prefix="run-", dir=worker.local_directory) if folder is True else folder
    )
    ours, process = _begin(order, modules, place)
    try:
        answer = None
        while _wanted(worker, key):
            if not ours.poll(LOOK_SECONDS):
                continue
            try:
                kind, *said = ours.recv()
            except EOFError:
                process.join()
                answer = answer or ("failed", _how_it_ended(process))
                return answer, pieces.keep(worker.address, place) if folder is True else None
            if kind in ("update", "finish"):
                worker.log_event(topic, (kind, name, *said))
            else:
                answer = kind, *said
        if folder is True:
            shutil.rmtree(place, ignore_errors=True)
        return None
    finally:
        _end(ours, process)


def _begin(order: bytes, modules: list[str], place: str | None) -> tuple[Connection, BaseProcess]:
    from . import run_process  # wants what the build makes

    context: ForkServerContext = multiprocessing.get_context("forkserver")
    # Imported once, by the server: only before its start does this have an effect.
    context.set_forkserver_preload([run_process.__name__, *modules])
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=run_process.work, args=(order, place, theirs))
    process.start()
    theirs.close()
    return ours, process


def _wanted(worker: distributed.Worker, key: str) -> bool:
    """False when the worker shall end, and when the user's process has cancelled the run or is
    gone: a thread cannot be interrupted, but Dask's own state says so."""
    task = worker.state.tasks.get(key)
    return worker.status in _RUNNING and task is not None and task.state == "executing"


def _how_it_ended(process: BaseProcess) -> str:
    code = process.exitcode
    return f"ended with code {code}" if code >= 0 else f"was killed by signal {-code}"


def _end(ours: Connection, process: BaseProcess) -> None:
    if process.is_alive():
        process.terminate()
    try:
        while ours.poll(STOP_SECONDS):  # nobody may be left who waits for a listener
            ours.recv()
    except (EOFError, OSError):
        pass
    process.join(STOP_SECONDS)
    if process.is_alive():
        process.kill()
        process.join()
    ours.close()
