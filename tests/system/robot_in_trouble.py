"""A robot in real time with programs that can be stopped, killed, frozen and lied to: what the
tests of failures share."""

import ctypes
import itertools
import math
import os
import signal
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import lcm
from reach import programs
from reach.bus import DEFAULT_URL, Bus
from reach.messages import ROOT, reach
from reach.processes import Processes

ARM = slice(0, 4)
# Where the robot is when a relay stands between it and the daemon.
ROBOT_URL = "udpm://239.255.76.68:7668?ttl=0"
PERIOD = 0.02
STEP = math.radians(600) * PERIOD  # the gate's acceleration, rad/s a period
PATIENCE = 15.0  # s; machines that test are busy
SEIZE, INTERRUPT, DETACH, WAIT_ALL = 0x4206, 0x4207, 17, 0x40000000


def may_run_in_real_time() -> bool:
    """Tried in a child, which takes the priority with it."""
    child = os.fork()
    if child == 0:
        try:
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
            os._exit(0)
        except OSError:
            os._exit(1)
    return os.waitpid(child, 0)[1] == 0


class Trouble:
    """A context: reachd, simrobot and, on demand, vision in real time."""

    def __init__(
        self, vision: bool = False, robot_url: str = DEFAULT_URL, stderr: Path | None = None
    ):
        """`stderr`: where reachd writes its log instead of into a file of ours."""
        self._folder = tempfile.TemporaryDirectory()
        self.processes = Processes(Path(self._folder.name))
        self._vision, self._robot_url, self._stderr = vision, robot_url, stderr

    def __enter__(self) -> "Trouble":
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def _start(self) -> None:
        self.start_reachd()
        self.start_simrobot()
        if self._vision:
            self.start_vision()
        self.bus = Bus(check=self.processes.check)
        self._lcm = lcm.LCM(DEFAULT_URL)
        self.commands: list[tuple[float, reach.robot_command_t]] = []
        self._lcm.subscribe("ROBOT_COMMAND", self._on_command).set_queue_capacity(500)
        self.until(lambda: self.status_is(reach.status_t.IDLE), "idle")

    def __exit__(self, *_) -> None:
        self.processes.stop()
        self._folder.cleanup()

    def start_reachd(self, **environment: str) -> None:
        clock = [] if may_run_in_real_time() else ["--no-rt"]
        # Without eyes a configuration is given up after a second, so that the arm moves on.
        timeout = "8" if self._vision else "1"
        elsewhere = [] if self._stderr is None else [
            "sh", "-c", 'exec "$@" 2>"$0"', self._stderr
        ]  # fmt: skip
        self.processes.start(
            "reachd", [*elsewhere, "env", *(f"{k}={v}" for k, v in environment.items()),
                       programs.BINARIES / "reachd", "--config", ROOT / "etc/kobian.yaml",
                       "--url", DEFAULT_URL, "--set", f"fixation.timeout={timeout}", *clock],
        )  # fmt: skip

    def start_simrobot(self) -> None:
        eyes = [] if self._vision else ["--no-eyes"]
        self.processes.start(
            "simrobot", [programs.BINARIES / "reach-simrobot", "--config",
                         ROOT / "etc/simrobot-kobian.yaml", "--url", self._robot_url,
                         "--truth-url", DEFAULT_URL, "--realtime", *eyes],
        )  # fmt: skip

    def start_vision(self) -> None:
        self.processes.start(
            "vision", [programs.BINARIES / "reach-vision",
                       "--config", ROOT / "etc/vision-kobian.yaml", "--url", DEFAULT_URL],
        )  # fmt: skip

    def signal(self, name: str, number: int) -> None:
        os.kill(self.processes.pid(name), number)

    def log(self, name: str) -> str:
        return (Path(self._folder.name) / f"{name}.log").read_text()

    def said(self, name: str, line: str) -> int:
        """How often the log has it."""
        return self.log(name).count(line)

    def _on_command(self, _, data: bytes) -> None:
        self.commands.append((time.monotonic(), reach.robot_command_t.decode(data)))

    def watch(self, seconds: float) -> None:
        """Takes in what comes in this time."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.bus.handle(0.01)
            while self._lcm.handle_timeout(0) > 0:
                pass

    def until(self, done: Callable[[], bool], what: str, patience: float = PATIENCE) -> float:
        """Watches until it is so. Returns how long that took; s."""
        start = time.monotonic()
        while not done():
            if time.monotonic() - start > patience:
                raise AssertionError(f"not {what} in {patience:g} s; {self.describe()}")
            self.watch(0.01)
        return time.monotonic() - start

    def describe(self) -> str:
        status = self.bus.status
        return "no status" if status is None else (
            f"state {status.state}, fault {status.fault}, behaviour {status.behaviour}, "
            f"staleness {status.staleness:.3f}"
        )  # fmt: skip

    def status_is(self, *states: int) -> bool:
        return self.bus.status is not None and self.bus.status.state in states

    def ask(self, kind: int, **fields) -> None:
        request = self.bus.prepare(kind, **fields)
        self.bus.wait(lambda: self.bus.status.request_seq == request.seq, "reachd",
                      lambda: self.bus.send(request))  # fmt: skip

    def speed(self) -> float:
        """The fastest arm joint of the newest command; rad/s."""
        return max(map(abs, self.commands[-1][1].velocity[ARM])) if self.commands else 0.0

    def true_speed(self) -> float:
        return max(map(abs, self.bus.truth.velocity[ARM]))

    def set_moving(self) -> None:
        """A long babbling, in which the arm is at speed now."""
        self.bus._request_seq = int(time.time() * 1e6)  # another daemon may have seen our numbers
        if self.bus.status.behaviour == reach.status_t.NONE:
            self.ask(reach.request_t.BABBLE, count=1000, seed=3, learn=1)
        self.until(lambda: self.speed() > 0.4, "the arm at speed")

    def assert_active_again(self) -> None:
        self.until(lambda: self.status_is(reach.status_t.ACTIVE), "active again")
        self.until(lambda: self.speed() > 0.2, "the arm moving again")

    def reset(self) -> None:
        self.ask(reach.request_t.RESET_FAULT)
        self.until(lambda: self.status_is(reach.status_t.IDLE), "idle after the reset")


def assert_brakes(trouble: Trouble, first: int) -> None:
    """From command number `first` on the arm's speed falls as fast as it may, and stays 0."""
    speeds = [max(map(abs, c.velocity[ARM])) for _, c in trouble.commands[first:]]
    at_rest = next((i for i, speed in enumerate(speeds) if speed == 0), math.inf)
    assert at_rest <= 7, speeds
    for before, after in itertools.pairwise(speeds):
        assert before - STEP - 1e-9 <= after <= max(before, 1e-9), speeds


class Frozen:
    """A context: one thread of a process stands still, the others run. The process may end."""

    _libc = ctypes.CDLL(None, use_errno=True)

    def __init__(self, pid: int, thread: str):
        tasks = Path(f"/proc/{pid}/task")
        names = {int(t.name): (t / "comm").read_text().strip() for t in tasks.iterdir()}
        self._tid = next(tid for tid, name in names.items() if name == thread)
        self._ended = False
        self._trace(SEIZE)

    def __enter__(self) -> "Frozen":
        self._trace(INTERRUPT)
        os.waitpid(self._tid, WAIT_ALL)
        return self

    def __exit__(self, *_) -> None:
        if not self._ended:
            self._trace(DETACH)

    def let_end(self) -> None:
        """To be called again and again while the process may end: it does so once the end of the
        frozen thread has been heard."""
        if not self._ended:
            pid, status = os.waitpid(self._tid, WAIT_ALL | os.WNOHANG)
            self._ended = pid != 0 and not os.WIFSTOPPED(status)

    def _trace(self, what: int) -> None:
        if self._libc.ptrace(what, self._tid, None, None) == -1:
            raise OSError(ctypes.get_errno(), "ptrace")


class Relay:
    """Between robot and daemon: passes states on, or does to them what `spoil` says. `spoil` gets
    the bytes and returns a list of what is delivered instead."""

    def __init__(self, spoil: Callable[[bytes], list[bytes]] = lambda data: [data]):
        self.spoil = spoil
        self._robot, self._daemon = lcm.LCM(ROBOT_URL), lcm.LCM(DEFAULT_URL)
        self._robot.subscribe("ROBOT_STATE", self._on_state)
        self._daemon.subscribe(
            "ROBOT_COMMAND", lambda channel, data: self._robot.publish(channel, data)
        )
        self._ending = False

    def _on_state(self, channel: str, data: bytes) -> None:
        for piece in self.spoil(data):
            self._daemon.publish(channel, piece)

    def run(self) -> None:
        while not self._ending:
            self._robot.handle_timeout(5)
            while self._daemon.handle_timeout(0) > 0:
                pass

    def end(self) -> None:
        self._ending = True


STOP, GO, KILL = signal.SIGSTOP, signal.SIGCONT, signal.SIGKILL
