"""The user's side of a sweep: hands runs to workers, shows how far they are, gathers results.

A run is a process of its own on a worker (run_process). One that fails leaves the others alone. A
worker that dies loses the run that it was doing, which is then done again by another one. The same
programs do the same runs anywhere, so the results are the same.
"""

import queue
import sys
import time
import uuid
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import cloudpickle

from ..progress import Progress
from ..session import Stop
from . import carrying, cluster, pieces
from .identity import identity
from .library import distributed

LOOK_SECONDS = 0.5  # between two looks whether the user wants an end
WORKERS_SECONDS = 30.0  # a lab's workers must be there by then
TRIES = 3  # of a run whose files cannot be had from its worker


class SweepError(Exception):
    """A run has failed without which the others are worth nothing; mostly one line."""


@dataclass(frozen=True)
class Job:
    """One run: `task(told)`, or with a folder `task(told, folder)`, which leaves files there. Its
    result is pickled. `told` is a Progress."""

    name: str
    task: Callable[..., Any]
    folder: Path | None = None

    def order(self, expected: tuple[type[Exception], ...], network: bool) -> bytes:
        return cloudpickle.dumps((self.task, expected, network))

    def modules(self) -> list[str]:
        """What a process must import for it."""
        name = getattr(self.task, "func", self.task).__module__
        return [] if name == "__main__" else [name]


@dataclass
class Outcome:
    """By the names of the runs."""

    results: dict[str, Any] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)  # one line each, mostly


@dataclass
class _Under:
    """A run that is under way."""

    job: Job
    tries: int


class Sweep:
    """A context: workers stand ready until it is left. `at_once` runs go side by side here; with
    `scheduler`, as many as it has workers. A task fails by raising one of `expected`; what else it
    raises is told as a bug. Raises ClusterError."""

    def __init__(self, at_once: int, stop: Stop, scheduler: str | None = None,
                 expected: tuple[type[Exception], ...] = (OSError,)):  # fmt: skip
        self._expected = expected
        self._at_once = at_once
        self._scheduler = scheduler
        self._stop = stop
        self._topic = f"reach-{uuid.uuid4()}"
        self._said: queue.SimpleQueue = queue.SimpleQueue()
        self._under: dict[distributed.Future, _Under] = {}
        self._refused: set[str] = set()
        self._alone_since: float | None = None

    def __enter__(self) -> "Sweep":
        self._resource = identity()
        self._cluster = cluster.of(self._at_once, self._scheduler)
        self._client = self._cluster.client
        self._client.subscribe_topic(self._topic, lambda event: self._said.put(event[1]))
        return self

    def __exit__(self, *_) -> None:
        self._cluster.close()

    def do(self, jobs: Iterable[Job], progress: Progress, *, network: bool = False,
           at_once: int | None = None) -> Outcome:  # fmt: skip
        """`network`: each run has a network of its own, with multicast. Raises KeyboardInterrupt
        when the user wants an end."""
        waiting, outcome = deque((job, 1) for job in jobs), Outcome()
        self._progress, self._network = progress, network
        try:
            while waiting or self._under:
                self._hand_out(waiting, at_once)
                for future in self._ended():
                    again = self._gather(future, outcome)
                    waiting.extend([again] if again else [])
                self._look()
        finally:
            self._client.cancel(list(self._under))
            self._under.clear()
        return outcome

    def map(self, name: str, task: Callable, count: int, progress: Progress,
            at_once: int | None = None) -> list:  # fmt: skip
        """The results of task(0, told) to task(count - 1, told), in that order. Raises SweepError
        where one fails."""
        jobs = [Job(f"{name} {n + 1}", partial(task, n)) for n in range(count)]
        outcome = self.do(jobs, progress, at_once=at_once)
        for which, why in outcome.failed.items():
            raise SweepError(f"{which}: {why}")
        return [outcome.results[job.name] for job in jobs]

    def _look(self) -> None:
        while not self._said.empty():
            kind, name, *said = self._said.get()
            getattr(self._progress.part(name), kind)(*said)
        self._cluster.check()
        self._stop.check()

    def _hand_out(self, waiting: deque, at_once: int | None) -> None:
        """No more than there are workers: what waits at a worker that dies counts as its victim."""
        workers = self._workers()
        room = min(workers, at_once or workers) - len(self._under)
        for _ in range(min(room, len(waiting))):
            self._submit(*waiting.popleft())

    def _submit(self, job: Job, tries: int) -> None:
        folder = None if job.folder is None else True
        if job.folder is not None and self._cluster.writes_here:
            folder = str(job.folder)
        future = self._client.submit(
            carrying.carry_out, job.order(self._expected, self._network), job.modules(),
            self._topic, job.name, folder, key=f"{job.name}-{uuid.uuid4()}", pure=False,
            resources={self._resource: 1},  # of which each worker like us has one
        )  # fmt: skip
        self._under[future] = _Under(job, tries)

    def _workers(self) -> int:
        """How many would do what we do. The others are refused, and each is told of once."""
        try:
            every = self._client.scheduler_info(n_workers=-1)["workers"]
        except (OSError, TimeoutError) as error:
            raise cluster.ClusterError(f"the scheduler does not answer: {error}") from None
        ours = [name for name, info in every.items() if self._resource in info["resources"]]
        for name in set(every) - set(ours) - self._refused:
            self._refused.add(name)
            theirs = ", ".join(every[name]["resources"]) or "no worker of this project"
            print(f"refused  {name} is {theirs}; here is {self._resource}", file=sys.stderr)
        self._complain_of_nobody(bool(ours))
        return len(ours)

    def _complain_of_nobody(self, somebody: bool) -> None:
        if somebody or not self._scheduler:
            self._alone_since = None
            return
        self._alone_since = self._alone_since or time.monotonic()
        if time.monotonic() - self._alone_since > WORKERS_SECONDS:
            raise cluster.ClusterError(
                f"{self._scheduler} has no worker of {self._resource}; ./run worker"
                f" {self._scheduler}, in a tree of this version, starts some"
            )

    def _ended(self) -> list[distributed.Future]:
        if not self._under:
            time.sleep(LOOK_SECONDS)
            return []
        try:
            distributed.wait(list(self._under), LOOK_SECONDS, return_when="FIRST_COMPLETED")
        except TimeoutError:
            return []
        except distributed.client.FuturesCancelledError:
            self._cluster.check()
            raise cluster.ClusterError("the scheduler has forgotten a run") from None
        return [future for future in self._under if future.done()]

    def _gather(self, future: distributed.Future, outcome: Outcome) -> tuple[Job, int] | None:
        """What is to be done again: a run whose worker has gone with its result."""
        under = self._under[future]
        name = under.job.name
        try:
            found = future.result(timeout=LOOK_SECONDS * 20)
        except TimeoutError:
            return None  # its worker has died since, and it is under way again
        except distributed.scheduler.KilledWorker:
            found = ("failed", "each worker that did it has died"), None
        except Exception as error:  # a worker that cannot begin it
            found = ("failed", f"its worker says: {error!r}"), None
        del self._under[future]
        if found is None or not self._fetch(found, under):
            if under.tries < TRIES:
                return under.job, under.tries + 1
            found = ("failed", f"its files could not be fetched, {TRIES} times"), None
        kind, said = found[0]
        if kind == "done":
            outcome.results[name] = cloudpickle.loads(said)
        else:
            outcome.failed[name] = said
        return None

    def _fetch(self, carried: carrying.Carried, under: _Under) -> bool:
        _, kept = carried
        try:
            if kept:
                pieces.fetch(self._client, kept, under.job.folder, self._look)
        except (OSError, TimeoutError) as error:
            print(f"{under.job.name}: {error}; it is done again", file=sys.stderr)
            return False
        return True
