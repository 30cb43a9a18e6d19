"""`./run jitter`: how punctual reachd is in real time, with 1000 experts in its model.

It runs with the real-time simulator and vision, without and with a CPU and disk load beside them,
and with cyclictest in the same minutes.

What remains in the folder: jitter.json, table.md, jitter.png.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import lcm
import numpy as np
from matplotlib.figure import Figure

from .bus import DEFAULT_URL, Bus
from .command_line import Parser
from .figures import COLOURS, PAPER
from .messages import reach
from .processes import Processes
from .programs import BINARIES, ROOT

EXPERTS = 1000
CYCLICTEST_PRIORITY = 38  # under the daemon's threads: it is measured beside them, not over them
LOADS = ("quiet", "loaded")
TARGETS = ((-20, -20, 20), (20, -20, 25), (20, 20, 30), (-20, 20, 25))  # px
OPTIONS = ("learner.capacity=1024", "learner.noise_angle=0.05", "learner.noise_disparity=0.3")
BURN = "while True: sum(range(10000))"
WRITE = """
import os, sys
while True:
    with open(sys.argv[1], "wb") as file:
        for _ in range(64):
            file.write(os.urandom(1 << 20)); file.flush(); os.fsync(file.fileno())
"""


def start_robot(processes: Processes, model: Path) -> None:
    etc = ROOT / "etc"
    options = [word for option in (*OPTIONS, f"model.directory={model}")
               for word in ("--set", option)]  # fmt: skip
    url = ("--url", DEFAULT_URL)
    processes.start("reachd", [BINARIES / "reachd", "--config", etc / "kobian.yaml", "--config",
                               etc / "learner-linear.yaml", *options, *url])  # fmt: skip
    eyes, robot = etc / "vision-kobian.yaml", etc / "simrobot-kobian.yaml"
    processes.start("vision", [BINARIES / "reach-vision", "--config", eyes, *url])
    processes.start(
        "simrobot", [BINARIES / "reach-simrobot", "--config", robot, "--realtime", *url]
    )


def start_load(processes: Processes, folder: Path) -> None:
    """A busy program for each processor, and one that writes and syncs all the time."""
    for i in range(os.cpu_count() or 1):
        processes.start(f"burn{i}", [sys.executable, "-c", BURN])
    processes.start("write", [sys.executable, "-c", WRITE, folder / "load"])


class Listener:
    """Keeps what each status says of its tick."""

    def __init__(self) -> None:
        self._lcm = lcm.LCM(f"{DEFAULT_URL}&recv_buf_size=8388608")
        self._lcm.subscribe("REACH_STATUS", self._on_status).set_queue_capacity(2000)
        self.rows: list[tuple] = []
        self.last: reach.status_t | None = None

    def _on_status(self, _, data: bytes) -> None:
        status = self.last = reach.status_t.decode(data)
        self.rows.append((status.wakeup_us, status.compute_us, 1e6 * status.staleness))

    def listen(self, seconds: float, again) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._lcm.handle_timeout(100)
            again()


def keep_busy(bus: Bus):
    """Asks for new targets whenever the daemon has nothing to do."""

    def again() -> None:
        bus.handle(0)
        if bus.status and bus.status.behaviour == reach.status_t.NONE:
            request = bus.prepare(reach.request_t.REACH, n_targets=len(TARGETS), period=2.0)
            request.target[: len(TARGETS)] = [list(target) for target in TARGETS]
            bus.send(request)

    return again


def start_cyclictest(seconds: float) -> subprocess.Popen:
    command = ["cyclictest", "--quiet", "--mlockall", f"--priority={CYCLICTEST_PRIORITY}",
               "--interval=20000", f"--duration={int(seconds)}", "--histogram=100000"]  # fmt: skip
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


def cyclictest_latencies(output: str) -> np.ndarray:
    """Its histogram, spread out again; us."""
    values: list[int] = []
    for line in output.splitlines():
        if line and not line.startswith("#"):
            latency, count = line.split()[:2]
            values += [int(latency)] * int(count)
    return np.array(values, dtype=float)


def measure(load: str, seconds: float, model: Path) -> dict:
    with tempfile.TemporaryDirectory() as folder, Processes(Path(folder)) as processes:
        start_robot(processes, model)
        bus, listener = Bus(check=processes.check), Listener()
        bus.wait(lambda: bus.status and bus.status.state == reach.status_t.IDLE, "reachd",
                 lambda: None)  # fmt: skip
        if load == "loaded":
            start_load(processes, Path(folder))
        listener.listen(2.0, keep_busy(bus))
        before, listener.rows = listener.last, []
        cyclictest = start_cyclictest(seconds)
        listener.listen(seconds, keep_busy(bus))
        output, _ = cyclictest.communicate(timeout=30)
        after = listener.last
    wakeup, compute, age = np.array(listener.rows).T
    return {
        "load": load,
        "ticks": len(listener.rows),
        "experts": after.experts,
        "wakeup_us": wakeup.tolist(),
        "compute_us": compute.tolist(),
        "age_us": age.tolist(),
        "cyclictest_us": cyclictest_latencies(output).tolist(),
        "overruns": after.overruns - before.overruns,
        "slips": after.slips - before.slips,
        "page_faults": after.page_faults,
        "gated": after.gated - before.gated,
    }


def quantiles(values: list[float]) -> str:
    """Median / 99.9th percentile / greatest."""
    if not values:
        return ""
    return " / ".join(f"{v:,.0f}" for v in (*np.quantile(values, (0.5, 0.999)), max(values)))


def table(runs: list[dict]) -> str:
    lines = [
        "| | ticks | wake-up | cyclictest | compute | age of the state | overruns | slips"
        " | page faults |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for run in runs:
        times = " | ".join(
            quantiles(run[key]) for key in ("wakeup_us", "cyclictest_us", "compute_us", "age_us")
        )
        lines.append(f"| {run['load']}, {run['experts']} experts | {run['ticks']} | {times}"
                     f" | {run['overruns']} | {run['slips']} | {run['page_faults']} |")  # fmt: skip
    return "\n".join(lines) + "\n"


def picture(runs: list[dict]) -> Figure:
    figure = Figure(figsize=(9.0, 3.2 * len(runs)), layout="constrained")
    axes = figure.subplots(len(runs), 2, squeeze=False)
    bins = np.geomspace(1, 2e4, 70)
    for run, (left, right) in zip(runs, axes, strict=True):
        left.hist(np.maximum(run["wakeup_us"], 1), bins, color=COLOURS["hand"], label="reachd")
        left.hist(np.maximum(run["cyclictest_us"], 1), bins, histtype="step", color=PAPER,
                  label="cyclictest")  # fmt: skip
        right.hist(np.maximum(run["compute_us"], 1), bins, color=COLOURS["tool"])
        right.axvline(2000, color="#b02020", lw=0.8)
        left.set(title=f"wake-up latency, {run['load']}", ylabel="ticks", xlabel="µs")
        right.set(title=f"compute time of the control path, {run['load']}", xlabel="µs")
        left.legend()
        for axis in (left, right):
            axis.set(xscale="log", yscale="log")
    return figure


def parse() -> argparse.Namespace:
    parser = Parser(prog="./run jitter", description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--minutes", type=float, default=10.0, help="length of each of the two runs (default 10)")
    add("--load", choices=LOADS, help="do only the run with this load")
    add("--out", type=Path, default=ROOT / "out/jitter", help="folder of the results")
    return parser.parse_args()


def main() -> int:
    options = parse()
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as model:
        if subprocess.run([BINARIES / "reach-prime", model, str(EXPERTS)]).returncode:
            return 1
        runs = [measure(load, 60 * options.minutes, Path(model))
                for load in ([options.load] if options.load else LOADS)]  # fmt: skip
    (options.out / "jitter.json").write_text(json.dumps(runs))
    (options.out / "table.md").write_text(table(runs))
    picture(runs).savefig(options.out / "jitter.png", dpi=140)
    print("Microseconds: median / 99.9th percentile / greatest.\n\n" + table(runs))
    print(f"in {options.out}: jitter.json, table.md, jitter.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
