"""Where vision says that the ball is, against where the simulator has it, while arm and head move.

Stands in for the daemon: answers every state, waves the arm through the babbled range and turns the
head after the ball. Prints what it measured as JSON; fails when vision is worse than it promises.

The eyes' mounts stand still here: the truth is that of eyes that do not tremble, so that with
--mounts their tremble (0.31 px rms) and creep are measured, not vision.
"""

import argparse
import json
import math
import os
import random
import subprocess
import sys
import time
from pathlib import Path

import lcm
from reach_lcm.reach import (
    marker_t,
    robot_command_t,
    robot_state_t,
    sim_request_t,
    sim_truth_t,
)

SOURCE = Path(os.environ.get("REACH_SOURCE_DIR", Path(__file__).resolve().parents[2]))
BUILD = Path(os.environ.get("REACH_BUILD_DIR", SOURCE / "build"))
URL = "udpm://239.255.76.67:7667?ttl=0"
ARM_RANGE = [(-70, -60), (-30, -5), (-15, 15), (-90, -40)]  # deg, robots.md: babbling
HEAD_RANGE = [(-40, 40), (-10, 20)]  # deg
FOCAL = 1200.0  # px
WRONG_PX = 10.0
VISIBLE = 0.999  # share of the disc: the ball stands free
SILENCE_SECONDS = 30.0
MOST_STD_PX = 0.1
STILL = ["eyes.tremble=0", "eyes.creep=0"]


class Waver:
    """Moves the arm to one random posture after another and keeps the eyes on the ball."""

    def __init__(self, seed: int):
        self._random = random.Random(seed)
        self._goal: list[float] = []
        self._until = 0
        self._unseen = 0

    def command(self, state, marker) -> list[float]:
        if state.utime >= self._until:
            self._goal = [math.radians(self._random.uniform(*r)) for r in ARM_RANGE]
            self._until = state.utime + 1_500_000
        arm = [2.0 * (g - p) for g, p in zip(self._goal, state.position, strict=False)]
        return arm + self._head(state, marker)

    def _head(self, state, marker) -> list[float]:
        if marker and marker.seen:
            self._unseen = 0
            return [-2.0 * marker.u_right / FOCAL, 2.0 * marker.v_right / FOCAL]
        # Sweeps the head's range until the ball comes into view.
        self._unseen += 1
        middle = [math.radians(sum(r) / 2) for r in HEAD_RANGE]
        reach = [math.radians((r[1] - r[0]) / 2) for r in HEAD_RANGE]
        yaw = middle[0] + reach[0] * math.sin(0.02 * self._unseen)
        pitch = middle[1] + reach[1] * math.sin(0.07 * self._unseen)
        n = state.n_joints
        return [2.0 * (yaw - state.position[n - 2]), 2.0 * (pitch - state.position[n - 1])]


class Bench:
    """The bus as the daemon would use it, and a record of what was seen and what was true."""

    def __init__(self, seed: int):
        self._bus = lcm.LCM(URL)
        self._waver = Waver(seed)
        self._answered = 0
        self._waiting = None
        self.marker = None
        self.utime = 0
        self.repeats = 0
        self.markers: dict[int, marker_t] = {}
        self.truths: dict[int, sim_truth_t] = {}
        self._bus.subscribe("ROBOT_STATE", self._on_state).set_queue_capacity(100)
        self._bus.subscribe("MARKER", self._on_marker).set_queue_capacity(100)
        self._bus.subscribe("SIM_TRUTH", self._on_truth).set_queue_capacity(500)

    def _on_state(self, _, data):
        self._waiting = robot_state_t.decode(data)
        self._answer()

    def _on_marker(self, _, data):
        marker = marker_t.decode(data)
        if marker.utime in self.markers:
            self.repeats += 1
        else:
            self.markers[marker.utime] = marker
        if self.marker is None or marker.utime > self.marker.utime:
            self.marker = marker
        self._answer()

    def _on_truth(self, _, data):
        truth = sim_truth_t.decode(data)
        if truth.exposure:
            self.truths[truth.utime] = truth

    def _answer(self):
        state = self._waiting
        seen_until = self.marker.utime if self.marker else 0
        if state is None or state.vision_due > seen_until:
            return
        if state.seq > self._answered:
            self._velocity = self._waver.command(state, self.marker)
            self._answered = state.seq
            self.utime = state.utime
        command = robot_command_t()
        command.utime = state.utime
        command.seq = command.state_seq = state.seq
        command.n_joints = state.n_joints
        command.velocity = self._velocity + [0.0] * (16 - state.n_joints)
        self._bus.publish("ROBOT_COMMAND", command.encode())
        self._waiting = None

    def request(self, kind, **fields):
        message = sim_request_t()
        message.seq = time.monotonic_ns()
        message.kind = kind
        for name, value in fields.items():
            setattr(message, name, value)
        self._bus.publish("SIM_REQUEST", message.encode())

    def run(self, seconds: float, processes):
        """Until the simulated clock has moved on by this."""
        until = self.utime + seconds * 1e6
        heard = time.monotonic()
        while self.utime < until:
            before = self.utime
            self._bus.handle_timeout(200)
            if self.utime != before:
                heard = time.monotonic()
            for process in processes:
                if process.poll() is not None:
                    sys.exit(f"vision_truth: {process.args[0]} ended with {process.returncode}")
            if time.monotonic() - heard > SILENCE_SECONDS:
                sys.exit(f"vision_truth: the simulated clock stands still at {self.utime} us")


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else math.nan


def spread(values):
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))


def judge(bench: Bench) -> dict:
    """Errors over the frames seen; misses over those in which the ball stands free in both eyes."""
    errors = {"u": [], "v": [], "disparity": []}
    jumps = {name: [] for name in errors}
    free = missed = wrong = seen = hidden_seen = 0
    worst = {"px": 0.0}
    last = None
    for utime, marker in sorted(bench.markers.items()):
        truth = bench.truths.get(utime)
        if truth is None:
            continue
        is_free = truth.in_view and truth.visible >= VISIBLE
        free += is_free
        missed += is_free and not marker.seen
        if not marker.seen:
            last = None
            continue
        seen += 1
        hidden_seen += truth.visible < VISIBLE
        error = {
            "u": marker.u_right - truth.u_right,
            "v": marker.v_right - truth.v_right,
            "disparity": marker.disparity - truth.disparity,
        }
        size = math.sqrt(sum(e * e for e in error.values()))
        wrong += size > WRONG_PX
        if size > worst["px"]:
            worst = {"px": size, "utime": utime, "visible": truth.visible, **error}
        for name, value in error.items():
            errors[name].append(value)
            if last:
                jumps[name].append((value - last[name]) / math.sqrt(2))
        last = error
    times = [m.compute_us for m in bench.markers.values()]
    return {
        "frames": len(bench.markers),
        "seen": seen,
        "free": free,
        "missed": missed,
        "partly_hidden_and_seen": hidden_seen,
        "wrong": wrong,
        "bias_px": {n: round(sum(e) / len(e), 3) for n, e in errors.items()},
        "std_px": {n: round(spread(e), 3) for n, e in errors.items()},
        "jitter_px": {n: round(spread(j), 3) for n, j in jumps.items()},
        "p999_px": {n: round(quantile([abs(x) for x in e], 0.999), 2) for n, e in errors.items()},
        "worst": worst,
        "repeats": bench.repeats,
        "vision_us": {"p50": quantile(times, 0.5), "p999": quantile(times, 0.999)},
    }


def start(arguments, bench_vision: list):
    simulator = [
        BUILD / "bin/reach-simrobot", "--config", SOURCE / "etc/simrobot-kobian.yaml", "--lockstep",
        "--seed", arguments.seed, "--url", URL,
    ]  # fmt: skip
    eyes = SOURCE / "etc/vision-kobian.yaml"
    vision = [BUILD / "bin/reach-vision", "--config", eyes, "--url", URL]
    for setting in ([] if arguments.mounts else STILL) + arguments.sim:
        simulator += ["--set", setting]
    processes = [subprocess.Popen([str(w) for w in vision + bench_vision])]
    time.sleep(0.7)  # vision first asks whether it is alone
    processes.append(subprocess.Popen([str(w) for w in simulator]))
    return processes


def demand(result: dict, mounts: bool):
    """The promises of docs/vision.md."""
    complaints = []
    if result["wrong"] > 0.001 * result["frames"]:
        complaints.append("wrong detections are more than 0.1 % of the frames")
    if result["missed"] > 0.01 * result["free"]:
        complaints.append("more than 1 % of the frames with a free ball were missed")
    if result["free"] < 0.3 * result["frames"]:
        complaints.append("the ball was hardly ever in view")
    for name, value in result["std_px"].items():
        if value > MOST_STD_PX and not mounts:
            complaints.append(f"the error in {name} is above {MOST_STD_PX} px")
    return complaints


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10, help="simulated time of each part")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mounts", action="store_true", help="the eyes' mounts tremble and creep")
    parser.add_argument("--sim", action="append", default=[], help="NAME=VALUE for simrobot")
    parser.add_argument("--vision", action="append", default=[], help="NAME=VALUE for vision")
    arguments = parser.parse_args()

    bench = Bench(arguments.seed)
    processes = start(arguments, [w for s in arguments.vision for w in ("--set", s)])
    began = time.monotonic()
    try:
        for tool in (0, 1):
            bench.request(sim_request_t.TOOL, tool=tool)
            for brightness in (1.0, 0.6, 1.3):
                bench.request(sim_request_t.LIGHT, value=brightness)
                bench.run(arguments.seconds / 3, processes)
    finally:
        for process in processes:
            process.terminate()
        for process in processes:
            process.wait()
    result = judge(bench)
    result["real_time_factor"] = round(bench.utime / 1e6 / (time.monotonic() - began), 2)
    print(json.dumps(result, indent=1))
    complaints = demand(result, arguments.mounts)
    for complaint in complaints:
        print(f"vision_truth: {complaint}", file=sys.stderr)
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
