"""A sweep on a cluster: a scheduler and workers on machines of their own, which are network
namespaces joined by cables. One machine dies in the middle of a run; nothing is missing at the end.
"""

import contextlib
import functools
import hashlib
import io
import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from reach.progress import Progress
from reach.session import Stop
from reach.sweep import pieces
from reach.sweep.cluster import ClusterError
from reach.sweep.sweep import Job, Sweep

PORT = 8786
PATIENCE_SECONDS = 60


def draw(seed: int, marker: Path | None, told, folder: Path) -> str:
    """What it leaves follows from the seed: more than one piece, and a file in a folder. With
    `marker`, the first that makes that file says who it is, and never comes to an end."""
    if marker:
        with contextlib.suppress(FileExistsError):
            with marker.open("x") as file:
                file.write(str(os.getpid()))
            time.sleep(10 * PATIENCE_SECONDS)
    data = random.Random(seed).randbytes(pieces.PIECE + 1000)
    (folder / "series").mkdir()
    (folder / "series/small").write_text(str(seed))
    (folder / "large").write_bytes(data)
    if seed == 5:
        raise OSError("the ball is gone")
    told.finish("draw", "drawn")
    return hashlib.sha256(data).hexdigest()


def wait_for(path: Path) -> str:
    until = time.monotonic() + PATIENCE_SECONDS
    while not path.exists() or not path.read_text():
        if time.monotonic() > until:
            raise AssertionError(f"{path} does not come")
        time.sleep(0.05)
    return path.read_text()


def content(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in folder.rglob("*") if path.is_file()}  # fmt: skip


def family(pid: int) -> list[int]:
    """The process and those that it has started."""
    threads = Path(f"/proc/{pid}/task").glob("*/children")
    children = [child for thread in threads for child in thread.read_text().split()]
    return [pid, *(found for child in children for found in family(int(child)))]


class Killer(Stop):
    """When the run `marker` is under way, kills the machine that does it, all at once."""

    def __init__(self, marker: Path, machines: list["Machine"]):
        super().__init__()
        self._marker, self._machines, self.killed = marker, machines, []

    def check(self) -> None:
        super().check()
        if not self.killed and self._marker.exists() and self._marker.read_text():
            (dead,) = (machine for machine in self._machines
                       if int(self._marker.read_text()) in family(machine.worker.pid))  # fmt: skip
            self.killed = dead.kill()


class Machine:
    """A network namespace with a worker, at the other end of a cable."""

    def __init__(self, number: int, environment: dict[str, str]):
        self._keeper = subprocess.Popen(
            ["unshare", "--net", "sh", "-c", "ip link set lo up && echo ready && exec sleep 600"],
            stdout=subprocess.PIPE,
        )
        self._keeper.stdout.readline()
        cable, ours, theirs = f"cable{number}", f"10.77.{number}.1", f"10.77.{number}.2"
        inside = ["nsenter", f"--net=/proc/{self._keeper.pid}/ns/net"]
        for command in (
            ["ip", "link", "add", cable, "type", "veth", "peer", "name", "eth0",
             "netns", str(self._keeper.pid)],
            ["ip", "address", "add", f"{ours}/24", "dev", cable],
            ["ip", "link", "set", cable, "up"],
            [*inside, "ip", "address", "add", f"{theirs}/24", "dev", "eth0"],
            [*inside, "ip", "link", "set", "eth0", "up"],
        ):  # fmt: skip
            subprocess.run(command, check=True)
        self.worker = subprocess.Popen(
            [*inside, sys.executable, "-m", "reach.sweep.worker", f"{ours}:{PORT}", "--jobs", "1"],
            env=os.environ | environment,
        )

    def kill(self) -> list[int]:
        pids = family(self.worker.pid)
        for pid in pids:
            os.kill(pid, signal.SIGKILL)
        return pids

    def close(self) -> None:
        self.worker.terminate()
        self.worker.wait()
        self._keeper.kill()
        self._keeper.wait()
        self._keeper.stdout.close()


class Cluster(unittest.TestCase):
    def setUp(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.addCleanup(signal.signal, number, signal.getsignal(number))
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.scheduler = subprocess.Popen(
            [sys.executable, "-m", "reach.sweep.scheduler", "--host", "0.0.0.0"],
            stdout=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.addCleanup(self.stop_scheduler)
        self.assertIn("listens", self.scheduler.stdout.readline())

    def stop_scheduler(self) -> None:
        self.scheduler.terminate()
        self.scheduler.wait()
        self.scheduler.stdout.close()

    def machine(self, number: int, **environment: str) -> Machine:
        # What a machine leaves that is killed goes with the folder.
        machine = Machine(number, {"TMPDIR": str(self.folder), **environment})
        self.addCleanup(machine.close)
        return machine

    def jobs(self, where: str, marker: Path | None) -> list[Job]:
        return [Job(f"run-{seed}", functools.partial(draw, seed, marker if seed == 2 else None),
                    self.folder / where / str(seed)) for seed in range(1, 6)]  # fmt: skip

    def do(self, jobs: list[Job], stop: Stop, scheduler: str | None):
        said = io.StringIO()
        with contextlib.redirect_stderr(io.StringIO()) as complained, \
             Sweep(2, stop, scheduler) as sweep:  # fmt: skip
            outcome = sweep.do(jobs, Progress({}, said))
        return outcome, said.getvalue(), complained.getvalue()

    def test_a_machine_that_dies_loses_one_run_which_is_done_again(self):
        here = self.jobs("here", None)
        for job in here:
            job.folder.mkdir(parents=True)
        alone, _, _ = self.do(here, Stop(), None)
        machines = [self.machine(1), self.machine(2)]
        (self.folder / "bin").mkdir()
        (self.folder / "bin/reachd").write_text("another")
        stranger = self.machine(3, REACH_BUILD_DIR=str(self.folder))  # has other programs
        killer = Killer(self.folder / "marker", machines)
        outcome, said, complained = self.do(
            self.jobs("there", self.folder / "marker"), killer, f"127.0.0.1:{PORT}"
        )
        self.assertTrue(killer.killed, "nobody was killed")
        self.assertEqual((outcome.failed, outcome.results), (alone.failed, alone.results))
        self.assertEqual(outcome.failed, {"run-5": "the ball is gone"})
        self.assertEqual(content(self.folder / "there"), content(self.folder / "here"))
        self.assertEqual(len(content(self.folder / "there")), 10)
        for seed in range(1, 5):
            self.assertIn(f"run-{seed}/draw: drawn\n", said)
        self.assertEqual(complained.count("refused  tcp://10.77.3.2"), 1)
        self.assertRegex(complained, "is reach .*, programs .*; here is reach .*, programs ")
        self.assertIsNone(stranger.worker.poll())

    def test_who_has_gone_leaves_no_run_behind(self):
        """The user's process is killed outright; the worker ends its run and stays."""
        machine, marker = self.machine(1), self.folder / "marker"
        user = subprocess.Popen([sys.executable, __file__, "--user", self.folder])
        run = Path("/proc", wait_for(marker))
        user.kill()
        user.wait()
        until = time.monotonic() + PATIENCE_SECONDS
        while run.exists() and time.monotonic() < until:
            time.sleep(0.05)
        self.assertFalse(run.exists())
        self.assertIsNone(machine.worker.poll())
        self.assertFalse((self.folder / "there").exists())

    def test_a_scheduler_that_is_not_there_is_named(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))  # where nobody listens
            address = f"127.0.0.1:{taken.getsockname()[1]}"
            with self.assertRaisesRegex(ClusterError, f"no scheduler answers at {address}"):
                self.do([], Stop(), address)


def be_a_user(folder: Path) -> None:
    """In a process of its own."""
    job = Job("run", functools.partial(draw, 1, folder / "marker"), folder / "there")
    with Sweep(1, Stop(), f"127.0.0.1:{PORT}") as sweep:
        sweep.do([job], Progress({}))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--user"]:
        sys.exit(be_a_user(Path(sys.argv[2])))
    unittest.main()
