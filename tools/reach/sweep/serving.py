"""One Dask worker in a process of its own: one run at a time, on the processors it is given."""

import asyncio
import os
import signal
import tempfile

from ..processes import die_with_parent
from .library import HTTP, distributed

NO_SCHEDULER = 3  # exit code: nobody answered
CONNECT_SECONDS = 60
ENDING = (signal.SIGINT, signal.SIGTERM)


def serve(address: str, resource: str, processors: set[int], folder: str) -> None:
    """Until the scheduler goes or a signal comes. To be called in a process that was just forked,
    with these signals held back: it begins to hear them when it can end properly."""
    die_with_parent()
    os.setsid()  # Ctrl-C is for the parent, which tells us
    os.sched_setaffinity(0, processors)
    raise SystemExit(asyncio.run(_serve(address, resource, folder)))


async def _serve(address: str, resource: str, folder: str) -> int:
    ending = asyncio.Event()
    for number in ENDING:
        asyncio.get_running_loop().add_signal_handler(number, ending.set)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)
    asked = asyncio.ensure_future(ending.wait())
    with tempfile.TemporaryDirectory(dir=folder) as place:
        try:
            worker = _worker(address, resource, place)
            started = asyncio.ensure_future(worker.start())
            await asyncio.wait({started, asked}, return_when=asyncio.FIRST_COMPLETED)
            if not started.done():
                started.cancel()
                return 0
            await started
        except (OSError, TimeoutError, ValueError):
            return NO_SCHEDULER
        gone = asyncio.ensure_future(worker.finished())
        await asyncio.wait({gone, asked}, return_when=asyncio.FIRST_COMPLETED)
        await worker.close()
    return 0


def _worker(address: str, resource: str, place: str) -> distributed.Worker:
    host, port = distributed.comm.get_address_host_port(address)
    return distributed.Worker(
        address,
        host=distributed.utils.get_ip(host, port),  # heard there, and on no other interface
        dashboard_address=HTTP,
        nthreads=1,
        resources={resource: 1},
        memory_limit=0,  # what takes memory are the runs, in processes of their own
        death_timeout=CONNECT_SECONDS,
        local_directory=place,
    )
