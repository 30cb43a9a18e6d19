"""Runs side by side: each has its own place, one that fails leaves the others alone, all can be
stopped."""

import functools
import io
import os
import signal
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

from reach.progress import Progress
from reach.session import Stop
from reach.sweep import run_process, worker
from reach.sweep.cluster import ClusterError
from reach.sweep.identity import digest
from reach.sweep.sweep import Job, Outcome, Sweep

PROCESSORS = sorted(os.sched_getaffinity(0))
LONG_SECONDS = 120.0


class TaskError(Exception):
    pass


def network() -> int:
    return os.stat("/proc/self/ns/net").st_ino


def place(told: run_process.Told) -> tuple:
    told.update("phase", 0.5, "half")
    told.finish("phase", "done")
    return network(), sorted(os.sched_getaffinity(0))


def fail(why: str, told: run_process.Told) -> None:
    raise TaskError(why)


def end_without_a_word(told: run_process.Told) -> None:
    os._exit(3)


def leave_a_file(told: run_process.Told, folder: Path) -> str:
    (folder / "left").write_text("here")
    return str(folder)


def last(marker: Path, told: run_process.Told) -> None:
    """Says that it runs, and at the end that it was told to end."""
    stop = Stop()
    marker.with_suffix(".pid").write_text(str(os.getpid()))
    told.finish("phase", "begun")
    until = time.monotonic() + LONG_SECONDS
    try:
        while time.monotonic() < until:  # as a session does
            stop.check()
            time.sleep(0.01)
    finally:
        marker.touch()


class Asked(Stop):
    """A user who wants an end as soon as a run says that it has begun."""

    def __init__(self, said: io.StringIO):
        super().__init__()
        self._said = said

    def check(self) -> None:
        if "begun" in self._said.getvalue():
            os.kill(os.getpid(), signal.SIGTERM)
        super().check()


class Swept(unittest.TestCase):
    """One cluster of this machine for all: to start one takes seconds."""

    @classmethod
    def setUpClass(cls):
        for number in (signal.SIGINT, signal.SIGTERM):
            cls.addClassCleanup(signal.signal, number, signal.getsignal(number))
        cls.sweep = cls.enterClassContext(Sweep(2, Stop(), expected=(TaskError,)))

    def do(self, *jobs: Job, **how) -> Outcome:
        self.said = io.StringIO()
        progress = Progress({f"{job.name}/phase": 1.0 for job in jobs}, self.said)
        return self.sweep.do(jobs, progress, **how)

    def test_each_has_its_own_network_and_processors(self):
        names = ["a", "b", "c", "d"]
        outcome = self.do(*(Job(name, place) for name in names), network=True)
        self.assertEqual((sorted(outcome.results), outcome.failed), (names, {}))
        self.assertNotIn(network(), {found[0] for found in outcome.results.values()})
        for name in names:
            self.assertIn(f"{name}/phase: done\n", self.said.getvalue())
        if len(PROCESSORS) < 2:
            self.skipTest("one processor")
        self.assertEqual({tuple(found[1]) for found in outcome.results.values()},
                         {tuple(PROCESSORS[i::2]) for i in range(2)})  # fmt: skip

    def test_without_need_it_stays_in_our_network(self):
        self.assertEqual(self.do(Job("a", place)).results["a"][0], network())

    def test_a_failure_leaves_the_others_alone(self):
        outcome = self.do(
            Job("a", functools.partial(fail, "the ball is gone")), Job("b", end_without_a_word),
            Job("c", place), Job("d", functools.partial(int, "x")),
        )  # fmt: skip
        self.assertEqual(list(outcome.results), ["c"])
        self.assertEqual(outcome.failed["a"], "the ball is gone")
        self.assertEqual(outcome.failed["b"], "ended with code 3")
        self.assertIn("Traceback", outcome.failed["d"])

    def test_here_it_writes_where_its_files_shall_be(self):
        with tempfile.TemporaryDirectory() as name:
            found = self.do(Job("a", leave_a_file, Path(name)))
            self.assertEqual(found.results, {"a": name})
            self.assertEqual((Path(name) / "left").read_text(), "here")

    def test_one_at_a_time_where_that_is_asked(self):
        def timed(told: run_process.Told) -> tuple[float, float]:
            began = time.monotonic()
            time.sleep(0.3)
            return began, time.monotonic()

        (_, end), (begin, _) = sorted(
            self.do(Job("a", timed), Job("b", timed), at_once=1).results.values()
        )
        self.assertLess(end, begin)


class Ends(unittest.TestCase):
    def setUp(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.addCleanup(signal.signal, number, signal.getsignal(number))
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_a_stop_ends_what_runs_and_begins_nothing(self):
        said = io.StringIO()
        jobs = [Job(name, functools.partial(last, self.folder / name)) for name in "abcd"]
        progress = Progress({}, said)
        with Sweep(2, Asked(said)) as sweep, self.assertRaises(KeyboardInterrupt):
            began = time.monotonic()
            sweep.do(jobs, progress)
        self.assertLess(time.monotonic() - began, LONG_SECONDS / 4)
        begun = {path.stem for path in self.folder.glob("*.pid")}
        self.assertTrue(begun and begun <= {"a", "b"})
        for name in begun:
            self.assertTrue((self.folder / name).exists(), "it was not told to end")
            pid = (self.folder / name).with_suffix(".pid").read_text()
            self.assertFalse(Path("/proc", pid).exists(), "it outlives the sweep")

    def test_workers_that_do_not_start_are_told_of(self):
        with (
            mock.patch.object(sys, "executable", "/bin/false"),
            Sweep(1, Stop()) as sweep,
            self.assertRaisesRegex(ClusterError, "ended with code 1"),
        ):
            sweep.do([Job("a", place)], Progress({}, io.StringIO()))


class Parts(unittest.TestCase):
    def test_processors_are_dealt_out(self):
        with mock.patch("os.sched_getaffinity", lambda _: {0, 1, 2, 3, 4}):
            self.assertEqual(worker.shares(2), [{0, 2, 4}, {1, 3}])
            self.assertEqual(len(worker.shares(9)), 5)
            self.assertEqual(worker.shares(1), [{0, 1, 2, 3, 4}])

    def test_the_digest_is_of_content_and_not_of_the_place(self):
        with tempfile.TemporaryDirectory() as name:
            trees = [Path(name, tree) for tree in ("one", "other")]
            for tree in trees:
                for path in ("bin/reachd", "etc/kobian.yaml", "tools/reach/a.py"):
                    (tree / path).parent.mkdir(parents=True)
                    (tree / path).write_text("same")
            found = {digest(tree / "bin", tree) for tree in trees}
            self.assertEqual(len(found), 1)
            for path in ("bin/reachd", "etc/kobian.yaml", "tools/reach/a.py"):
                (trees[0] / path).write_text("another")
                found.add(digest(trees[0] / "bin", trees[0]))
            self.assertEqual(len(found), 4)

    def test_a_worker_that_has_hardly_begun_hears_its_end(self):
        # On one processor the new process does not run before this one waits for it.
        self.addCleanup(os.sched_setaffinity, 0, set(PROCESSORS))
        os.sched_setaffinity(0, set(PROCESSORS[:1]))
        for number in (signal.SIGINT, signal.SIGTERM):
            self.addCleanup(signal.signal, number, signal.getsignal(number))
        for _ in range(3):
            with tempfile.TemporaryDirectory() as folder:
                workers = worker.Workers("127.0.0.1:9", "reach", folder)  # where nobody listens
                workers.begin(set(PROCESSORS[:1]))
                began = time.monotonic()
                os.kill(os.getpid(), signal.SIGTERM)
                self.assertEqual(workers.attend(), 0)
                self.assertLess(time.monotonic() - began, 20)


class TimeLeft(unittest.TestCase):
    def test_all_phases_under_way_count(self):
        said = io.StringIO()
        with mock.patch("time.monotonic", lambda: 1000.0):
            progress = Progress({"a": 1.0, "b": 1.0}, said)
        said.isatty = lambda: True
        progress._live = True
        with mock.patch("time.monotonic", lambda: 1060.0):
            progress.update("a", 0.5, "")
            progress.update("b", 0.5, "")
        self.assertIn("1:00 left", said.getvalue())


if __name__ == "__main__":
    unittest.main()
