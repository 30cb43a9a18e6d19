"""Does runs for the sweeps that come to a scheduler: ./run paper and accuracy with --scheduler.

It must be of the same version, with the same programs, as the tree from which they come; others
are refused there. It ends when the scheduler does. Whoever reaches the scheduler can run anything
here, unless TLS is set up: docs/howto/cluster.md.
"""

import argparse
import multiprocessing
import os
import signal
import sys
import tempfile
from multiprocessing.connection import wait

from ..command_line import Parser


def parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="./run worker", description=__doc__,
                    formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("address", metavar="ADDRESS",
                        help="of the scheduler: HOST:PORT, or tls://HOST:PORT")  # fmt: skip
    count = len(os.sched_getaffinity(0))
    parser.add_argument("--jobs", type=int, default=count, metavar="N",
                        help="runs at once, each on its own processors; default: one per"
                             " processor")  # fmt: skip
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error("--jobs must be at least 1")
    return options


def shares(count: int) -> list[set[int]]:
    """This process's processors, dealt out to so many workers, or to as many as there are."""
    processors = sorted(os.sched_getaffinity(0))
    count = min(count, len(processors))
    return [set(processors[i::count]) for i in range(count)]


class Workers:
    """Processes that serve; one that dies is replaced."""

    def __init__(self, address: str, resource: str, folder: str):
        from . import serving  # Dask, loaded once: the processes are forked

        self._serving = serving
        self._of_all = address, resource, folder
        self._processors: dict[int, set[int]] = {}  # by sentinel
        self._processes: dict[int, multiprocessing.Process] = {}
        self._ending = False
        for number in serving.ENDING:
            signal.signal(number, self._end)

    def begin(self, processors: set[int]) -> None:
        if self._ending:
            return
        address, resource, folder = self._of_all
        process = multiprocessing.get_context("fork").Process(
            target=self._serving.serve, args=(address, resource, processors, folder)
        )
        # A new process forgets the signals that come before it listens; those held back wait.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, self._serving.ENDING)
        try:
            process.start()
            self._processes[process.sentinel] = process
            self._processors[process.sentinel] = processors
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)

    def attend(self) -> int:
        """Until all have ended. Returns the exit code."""
        status = 0
        while self._processes:
            for sentinel in wait(list(self._processes), 1.0):
                process = self._processes.pop(sentinel)
                processors = self._processors.pop(sentinel)
                process.join()
                if process.exitcode == self._serving.NO_SCHEDULER:
                    status = 1
                elif process.exitcode != 0 and not self._ending:
                    print(f"worker: one has died, code {process.exitcode}; another takes its place",
                          file=sys.stderr)  # fmt: skip
                    self.begin(processors)
        return status

    def _end(self, *_) -> None:
        self._ending = True
        for process in self._processes.values():
            process.terminate()


def main(arguments: list[str] | None = None) -> int:
    options = parse(arguments)
    from .identity import identity

    resource, dealt = identity(), shares(options.jobs)
    with tempfile.TemporaryDirectory(prefix="reach-worker-") as folder:
        workers = Workers(options.address, resource, folder)
        for processors in dealt:
            workers.begin(processors)
        status = workers.attend()
    if status:
        print(f"worker: no scheduler answers at {options.address}; ./run scheduler starts one",
              file=sys.stderr)  # fmt: skip
    return status


if __name__ == "__main__":
    sys.exit(main())
