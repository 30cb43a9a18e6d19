"""A scripted daemon and simulator, and reachctl against them, for tests on a bus of their own."""

import os
import subprocess
import time
from pathlib import Path

import lcm
from background import Background
from reach.bus import DEFAULT_URL
from reach.messages import reach

REACHCTL = Path(os.environ["REACH_BUILD_DIR"]) / "bin/reachctl"


class Scripted(Background):
    """Answers requests the way daemon and simulator do; a behaviour takes three statuses. The first
    `deaf_to` messages with requests are lost."""

    def __init__(self, result: int = reach.status_t.ACCEPTED, *, deaf_to: int = 0,
                 distances: tuple = (9.0, 1.25), space: int = reach.status_t.VISUAL,
                 faults: int = 0, also: dict | None = None):  # fmt: skip
        super().__init__()
        self.result = result
        self._deaf_to = deaf_to
        self._also = also or {}  # said with each status
        self._distances, self._space = distances, space
        self._faults = faults  # statuses that still tell of a fault after a request
        self.requests: list[reach.request_t] = []
        self.sim_requests: list[reach.sim_request_t] = []
        self._busy = 0
        self._lcm = lcm.LCM(DEFAULT_URL)
        self._lcm.subscribe("REACH_REQUEST", self._on_request)
        self._lcm.subscribe("SIM_REQUEST", self._on_sim_request)

    def _on_request(self, _, data):
        request = reach.request_t.decode(data)
        if self._deaf_to > 0:
            self._deaf_to -= 1
        elif not self.requests or self.requests[-1].seq != request.seq:
            self.requests.append(request)
            self._busy = 3

    def _on_sim_request(self, _, data):
        self.sim_requests.append(reach.sim_request_t.decode(data))

    def run(self):
        while not self._halt.is_set():
            self._lcm.handle_timeout(20)
            self._publish_status()
            truth = reach.sim_truth_t()
            truth.request_seq = self.sim_requests[-1].seq if self.sim_requests else 0
            self._lcm.publish("SIM_TRUTH", truth.encode())

    def _publish_status(self):
        status = reach.status_t()
        status.utime = int(time.time() * 1e6)
        status.state, status.n_outputs, status.experts = reach.status_t.IDLE, 3, 7
        status.staleness, status.space = float("inf"), self._space
        if self._faults > 0:
            status.state, status.fault = reach.status_t.FAULT, reach.status_t.FAULT_EMERGENCY
            self._faults -= 1 if self.requests else 0
        status.request_result = self.result
        if self.requests:
            status.request_seq = self.requests[-1].seq
        self._busy = max(0, self._busy - 1)
        if self._busy:
            status.behaviour = reach.status_t.REACH
            status.error = self._distances[-1] if self._busy == 1 else self._distances[0]
        self._lcm.publish("REACH_STATUS", status.encode())
        for channel, data in self._also.items():
            self._lcm.publish(channel, data)


def reachctl(*words: str) -> subprocess.CompletedProcess:
    command = [REACHCTL, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=20)
