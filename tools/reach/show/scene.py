"""What can be seen of a run: the newest pictures, and the curves of the last minute."""

import struct
import time
from collections import deque
from dataclasses import dataclass, field

import lcm
import numpy as np

from ..messages import bot_core, reach

LATE_SECONDS = 0.2
QUEUE = 100  # messages of a channel that may wait
KEPT = 20_000  # points of a curve
PIXELS_PER_RADIAN = 1200  # of reachd's own relation, etc/kobian.yaml


@dataclass
class Camera:
    """(u w, v w, w) = matrix (x, y, z, 1); u, v in px from the image's centre."""

    matrix: np.ndarray  # 3 x 4

    def see(self, point) -> tuple[float, float] | None:
        u, v, w = self.matrix @ [*point, 1.0]
        return (u / w, v / w) if w > 0 else None

    def under(self, u: float, v: float, depth_of) -> np.ndarray:
        """The point at (u, v) that is as far ahead of the camera as the point `depth_of`."""
        turn, shift = self.matrix[:, :3], self.matrix[:, 3]
        ahead = self.matrix[2] @ [*depth_of, 1.0]
        return np.linalg.solve(turn, np.array([u, v, 1.0]) * ahead - shift)


@dataclass
class Curves:
    """Times in s of the robot's time, and what was then."""

    error: deque = field(default_factory=lambda: deque(maxlen=KEPT))  # (time, px or m)
    wrong: deque = field(default_factory=lambda: deque(maxlen=KEPT))  # of a prediction, likewise
    context: deque = field(default_factory=lambda: deque(maxlen=KEPT))  # (time, context, experts)
    tool: deque = field(default_factory=lambda: deque(maxlen=KEPT))  # (time, tool) when it changed


class Scene:
    """`take_in` hears what was said since it was last called."""

    def __init__(self, url: str):
        self._lcm = lcm.LCM(url)
        self.status: reach.status_t | None = None
        self.marker: reach.marker_t | None = None
        self.truth: reach.sim_truth_t | None = None
        self.trace: reach.trace_t | None = None
        self.eyes: list = []  # images, left and right
        self.views: list = []
        self.cameras: dict[str, Camera] = {}  # left_view, right_view, left_eye, right_eye
        self.curves = Curves()
        # Places of the end-effector where no head looks for it: m, or u, v, disparity, px.
        self.visited: deque = deque(maxlen=2000)
        for channel, kind, take in (
            ("STEREO_IMAGES", bot_core.images_t, self._on_eyes),
            ("SIM_VIEW", bot_core.images_t, self._on_views),
            ("MARKER", reach.marker_t, self._on_marker),
            ("SIM_TRUTH", reach.sim_truth_t, self._on_truth),
            ("REACH_TRACE", reach.trace_t, lambda m: setattr(self, "trace", m)),
            ("REACH_STATUS", reach.status_t, self._on_status),
            ("REACH_SAMPLE", reach.sample_t, self._on_sample),
            ("END_EFFECTOR", reach.end_effector_t, lambda m: self.visited.append(m.position)),
        ):
            subscription = self._lcm.subscribe(channel, _decoded(kind, take))
            subscription.set_queue_capacity(QUEUE)

    @property
    def sees(self) -> bool:
        """Whether targets are in images; else they are places."""
        return self.status is None or self.status.space != reach.status_t.CARTESIAN

    @property
    def fixates(self) -> bool:
        """Whether a head turns to the ball, and a sample waits for it."""
        return self.status is None or self.status.space == reach.status_t.VISUAL

    def target(self) -> tuple[float, float, float] | None:
        """That of the behaviour: u, v, disparity (px), or x, y, z (m)."""
        reaches = self.status and self.trace and self.status.error > 0
        return tuple(self.trace.x_target) if reaches else None

    def take_in(self, now: int = 0) -> None:
        """Also what is under way: until the status of robot time `now`, us, unless it is lost."""
        end = time.monotonic() + LATE_SECONDS
        while self._lcm.handle_timeout(0) > 0:
            pass
        while self._time() < now and time.monotonic() < end:
            self._lcm.handle_timeout(20)

    def _time(self) -> int:
        return self.status.utime if self.status else 0

    def _on_eyes(self, pair) -> None:
        self.eyes = list(pair.images)

    def _on_views(self, pair) -> None:
        self.views = list(pair.images)
        for side, image in zip(("left_view", "right_view"), pair.images, strict=False):
            for note in image.metadata:
                name = side if note.key == "camera" else note.key
                numbers = struct.unpack(">12d", bytes(note.value))
                self.cameras[name] = Camera(np.reshape(numbers, (3, 4)))

    def _on_marker(self, marker) -> None:
        self.marker = marker
        if marker.seen and self.sees and not self.fixates:
            self.visited.append((marker.u_right, marker.v_right, marker.disparity))

    def _on_truth(self, truth) -> None:
        if self.truth is not None and truth.tool != self.truth.tool:
            self.curves.tool.append((truth.utime * 1e-6, truth.tool))
        self.truth = truth

    def _on_status(self, status) -> None:
        now = status.utime * 1e-6
        self.status = status
        self.curves.error.append((now, status.error if status.error > 0 else np.nan))
        self.curves.context.append((now, status.context, status.experts))

    def _on_sample(self, sample) -> None:
        unit = [PIXELS_PER_RADIAN, PIXELS_PER_RADIAN, 1] if self.fixates else [1, 1, 1]
        off = np.subtract(sample.x_predicted[:3], sample.x[:3]) * unit
        self.curves.wrong.append((sample.utime * 1e-6, float(np.linalg.norm(off))))


def _decoded(kind, take):
    return lambda _, data: take(kind.decode(data))
