"""Runs side by side: each has its own place, one that fails leaves the others alone, all can be
stopped."""

import io
import os
import signal
import time
import unittest
from unittest import mock

from reach.paper import jobs, kobian, plan
from reach.progress import Progress
from reach.session import Stop

PROCESSORS = sorted(os.sched_getaffinity(0))
LONG_SECONDS = 120.0


class TaskError(Exception):
    pass


def network() -> int:
    return os.stat("/proc/self/ns/net").st_ino


def place(run: plan.Run, told: jobs.Told) -> str:
    return f"{run.name} {network()} {sorted(os.sched_getaffinity(0))}"


class Jobs(unittest.TestCase):
    def setUp(self):
        self.addCleanup(signal.signal, signal.SIGINT, signal.getsignal(signal.SIGINT))
        self.addCleanup(signal.signal, signal.SIGTERM, signal.getsignal(signal.SIGTERM))
        self.stop = Stop()
        self.said = io.StringIO()
        self.runs = plan.plan([kobian], ("body", "linear"), 2, True)

    def do(self, task: jobs.Task, count: int = 2) -> tuple[jobs.Jobs, dict[str, str]]:
        side_by_side = jobs.Jobs(count, task, (TaskError,))
        progress = Progress({f"{run.name}/phase": 1.0 for run in self.runs}, self.said)
        return side_by_side, side_by_side.do(self.runs, progress, self.stop)

    def test_none_is_in_our_network(self):
        done, failed = self.do(place)
        self.assertEqual((len(done.remarks), failed), (4, {}))
        self.assertNotIn(str(network()), {remark.split()[1] for remark in done.remarks})

    def test_processors_are_dealt_out(self):
        with mock.patch("os.sched_getaffinity", lambda _: {0, 1, 2, 3, 4}):
            self.assertEqual(jobs.Jobs(2, place, ())._free, [{0, 2, 4}, {1, 3}])
            self.assertEqual(len(jobs.Jobs(9, place, ())._free), 5)

    def test_one_alone_has_all_processors(self):
        done, _ = self.do(place, 1)
        for remark in done.remarks:
            self.assertIn(str(PROCESSORS), remark)

    def test_two_have_no_processor_in_common(self):
        if len(PROCESSORS) < 2:
            self.skipTest("one processor")
        done, _ = self.do(place)
        self.assertEqual({remark.partition("[")[2] for remark in done.remarks},
                         {f"{str(PROCESSORS[i::2])[1:]}" for i in range(2)})  # fmt: skip

    def test_a_failure_leaves_the_others_alone(self):
        def task(run: plan.Run, told: jobs.Told) -> str:
            if run.seed == 1:
                raise TaskError("the ball is gone")
            return run.name

        done, failed = self.do(task)
        self.assertEqual(failed, {"kobian-body-1": "the ball is gone",
                                  "kobian-linear-1": "the ball is gone"})  # fmt: skip
        self.assertEqual(done.remarks, {"kobian-body-2", "kobian-linear-2"})

    def test_an_end_without_a_word_is_a_failure(self):
        _, failed = self.do(lambda run, told: os._exit(3 if run.learner == "linear" else 0))
        self.assertEqual(failed["kobian-linear-2"], "ended with code 3")
        self.assertEqual(len(failed), 4)

    def test_what_runs_tell_is_shown_under_their_names(self):
        def task(run: plan.Run, told: jobs.Told) -> None:
            told.update("phase", 0.5, "half")
            told.finish("phase", "done")

        self.do(task)
        for run in self.runs:
            self.assertIn(f"{run.name}/phase: done\n", self.said.getvalue())

    def test_a_stop_ends_what_runs_and_begins_nothing(self):
        def task(run: plan.Run, told: jobs.Told) -> None:
            told.finish("phase", "begun")
            os.kill(os.getppid(), signal.SIGTERM)
            until = time.monotonic() + LONG_SECONDS
            while time.monotonic() < until:  # as a session does
                self.stop.check()
                time.sleep(0.01)

        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            self.do(task)
        self.assertLess(time.monotonic() - began, LONG_SECONDS / 4)
        self.assertLess(self.said.getvalue().count("begun"), len(self.runs))

    def test_an_end_before_the_first_step_is_heard(self):
        def task(run: plan.Run, told: jobs.Told) -> None:
            until = time.monotonic() + 10
            while time.monotonic() < until:
                self.stop.check()
                time.sleep(0.01)

        # On one processor the new process does not run before this one waits for it.
        self.addCleanup(os.sched_setaffinity, 0, set(PROCESSORS))
        os.sched_setaffinity(0, set(PROCESSORS[:1]))
        for _ in range(5):
            one = jobs.Jobs(1, task, ())
            began = time.monotonic()
            one._begin(self.runs[0])
            one._end_all()
            self.assertLess(time.monotonic() - began, 8)


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
