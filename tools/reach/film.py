"""A piece of an experiment as a video: both eyes, the robot from outside, curves, as ./run show has
them."""

import sys
from dataclasses import dataclass
from pathlib import Path

from . import programs
from .bus import Bus
from .messages import reach
from .show import picture
from .show.layout import layout
from .show.outputs import Frames, OutputError
from .show.scene import Scene

RATE = 10  # pictures a second of the robot's time
SECONDS = 20.0


@dataclass(frozen=True)
class _Narrator:
    """What the picture says beside what the run says of itself."""

    said: str
    keys: str = ""


class FilmedClock:
    """A clock that a film is taken by, from begin() on for SECONDS of the robot's time. The
    simulator runs with --view, and draws only while it is filmed."""

    def __init__(self, clock, bus: Bus, path: Path):
        self._clock, self._bus, self._path = clock, bus, path
        self._scene = self._frames = None
        self._left = 0

    @property
    def now(self) -> int:
        return self._clock.now

    def ask_daemon(self, request) -> int:
        return self._clock.ask_daemon(request)

    def rest(self) -> None:
        """Nobody films: the simulator draws no view."""
        self._bus.ask_simulator(reach.sim_request_t.VIEW, value=0)

    def begin(self, said: str) -> None:
        self._bus.ask_simulator(reach.sim_request_t.VIEW, value=1)
        self._scene, self._narrator = Scene(programs.LISTENER_URL), _Narrator(said)
        self._frames = Frames(window=False, video=self._path, rate=RATE)
        self._left = round(SECONDS * RATE)

    def advance(self, seconds: float) -> None:
        steps = max(1, round(seconds * RATE)) if self._left else 1
        for _ in range(steps):
            self._clock.advance(seconds / steps)
            if self._left:
                self._take()

    def _take(self) -> None:
        self._scene.take_in(self._clock.now)
        drawn = picture.draw(self._scene, self._narrator, layout(self._scene.sees))
        try:
            self._frames.show(drawn)
            self._left -= 1
        except OutputError as error:
            print(f"demo: no video: {error}", file=sys.stderr)
            self._left = 0
        if self._left == 0:
            self.end()

    def end(self) -> None:
        """The video is complete, however long it is."""
        if self._frames is None:
            return
        self._frames.close()
        self._frames, self._left = None, 0
        self.rest()
