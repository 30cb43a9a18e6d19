"""Made-up logs whose numbers are known: of a whole demo, or of other phases."""

from pathlib import Path

import lcm
import numpy as np
from PIL import Image
from reach import messages, metrics
from reach.messages import reach

PERIOD = 20_000
STAR_SECONDS = 2.0
YAW_ERROR = np.radians(0.5)  # of every prediction against the measurement
FINAL_ERROR = 3.0  # px, of every STAR target
DEMO_PHASES = ("learn_hand", "test_hand", "learn_tool", "test_tool", "star_tool", "star_hand",
               "retest_hand")  # fmt: skip


class Writer:
    """Appends messages to a log and keeps the time."""

    def __init__(self, path: Path, inputs: int = 4):
        self._inputs = inputs
        self._log = lcm.EventLog(str(path), "w", overwrite=True)
        self.utime = 1_000_000
        self.tick = 0

    def write(self, channel: str, message, **fields) -> None:
        for name, value in fields.items():
            setattr(message, name, value)
        message.utime = self.utime
        self._log.write_event(self.utime, channel, message.encode())

    def step(self, request: int, phase: int, progress: int, place: np.ndarray) -> None:
        """One control period with the ball at `place`, seen 1 px too far to the right."""
        self.tick += 1
        u, v, disparity = (float(value) for value in place)
        true = {"n_joints": max(6, self._inputs), "marker": [u, v, disparity]}
        seen = {"v_right": v, "disparity": disparity}
        self.write("REACH_STATUS", reach.status_t(), request_seq=request, phase=phase,
                   progress=progress, compute_us=100.0 + self.tick % 7, experts=3)  # fmt: skip
        self.write("ROBOT_STATE", reach.robot_state_t(), n_joints=6)
        self.write("SIM_TRUTH", reach.sim_truth_t(), u_right=u, in_view=1, visible=1.0, **seen,
                   **true)  # fmt: skip
        self.write("SIM_TRUTH", reach.sim_truth_t(), u_right=u, in_view=1, visible=1.0,
                   exposure=1, **seen)  # fmt: skip
        self.write("MARKER", reach.marker_t(), seen=1, u_right=u + 1, compute_us=900.0, **seen)
        self.utime += PERIOD

    def sample(self, request: int, index: int) -> None:
        x = [0.01 * index, -0.005 * index, 2.0 * index] + [0.0] * 5
        predicted = [x[0] + YAW_ERROR, *x[1:]]
        values = [predicted] + [[9.0] * 8] * 15
        self.write("REACH_SAMPLE", reach.sample_t(), request_seq=request,
                   n_inputs=self._inputs, n_outputs=3,
                   q=[0.01 * index] + [0.0] * 15, x=x, x_predicted=predicted, solutions=2,
                   values=values)  # fmt: skip

    def close(self) -> None:
        self._log.close()


def _babble(writer: Writer, request: int, count: int) -> None:
    for index in range(count):
        writer.step(request, phase=1, progress=index, place=np.zeros(3))
        writer.sample(request, index)


def _pursue(writer: Writer, request: int, targets: np.ndarray, beside: float) -> None:
    """Straight at once to a place beside each target."""
    for _ in range(10):
        writer.step(request, phase=2, progress=0, place=np.zeros(3))
    start = np.zeros(3)
    for index, target in enumerate(targets):
        steps = round(STAR_SECONDS * 1e6 / PERIOD)
        end = target + np.array([0, 0, beside])
        for step in range(steps):
            share = min(1.0, step / (steps / 4))
            writer.step(request, phase=5, progress=index, place=start + share * (end - start))
        start = end


def make(folder: Path, count: int = 12, names: tuple[str, ...] = DEMO_PHASES,
         targets: dict[str, np.ndarray] | None = None, beside: float = FINAL_ERROR,
         inputs: int = 4) -> dict:  # fmt: skip
    """Writes run.lcmlog and pictures into the folder; returns the description of the run.

    `targets`: of the phases whose names begin so, which end `beside` them; all others babble."""
    targets = targets or {"star": metrics.star_targets()}
    writer, phases = Writer(folder / "run.lcmlog", inputs), []
    for request, name in enumerate(names, start=1):
        start = writer.utime
        pursued = [rows for prefix, rows in targets.items() if name.startswith(prefix)]
        if pursued:
            _pursue(writer, request, pursued[0], beside)
        else:
            _babble(writer, request, count)
        phases.append({"name": name, "tool": int("tool" in name), "learn": "learn" in name,
                       "request_seq": request, "start": start, "end": writer.utime, "skipped": 0,
                       "experts": 3})  # fmt: skip
        if pursued:
            phases[-1]["targets"] = pursued[0].tolist()
    writer.close()
    _pictures(folder / "images")
    return {"seed": 5, "samples": count, "tests": count, "experts": "polynomial",
            "clock": "lockstep", "phases": phases, "wall_seconds": 10.0}  # fmt: skip


def _pictures(folder: Path) -> None:
    folder.mkdir()
    for side in ("left", "right"):
        Image.fromarray(np.full((48, 64, 3), 90, np.uint8)).save(folder / f"hand-{side}.png")
    (folder / "hand.json").write_text(
        '{"seen": 1, "u_right": 3.0, "v_right": 4.0, "disparity": 2.0, "radius": 5.0}'
    )


__all__ = ["FINAL_ERROR", "YAW_ERROR", "make", "messages"]
