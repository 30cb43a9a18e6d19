"""What a key or a click does: the same for the window, the terminal and a test."""

import numpy as np

from .. import metrics
from ..bus import Bus
from ..clock import HeldClock
from ..messages import reach
from ..robot_files import Robot
from .layout import Layout
from .scene import Scene

KEYS = (
    "space pause   s star   b babble   x explore   t tube   1-9 tool   0 hand   click target"
    "   f fast   q end"
)
BABBLE = {True: 15, False: 400}  # samples; with a head that turns each of them takes a fixation
EXPLORE = {True: 30, False: 400}
STAR_SECONDS = {True: 3.0, False: 2.0}  # for each target
REACH_SECONDS = 4.0
STOP_SECONDS = 0.1
ENDS = 8
LEAST_SPREAD = 0.05  # m (or px), of places that a star is drawn between
MAX_TARGETS = 32


class Operator:
    """Until the first key the robot goes through a tour by itself: it learns, draws a star, is
    given a tool, and so on."""

    keys = KEYS  # as the picture tells of them

    def __init__(self, bus: Bus, clock: HeldClock, scene: Scene, robot: Robot, tour: bool = True):
        self._bus, self._clock, self._scene = bus, clock, scene
        self._tools = robot.tools()
        self._seed = 0
        self._tour = tour
        self._stations = 0
        self.paused = self.fast = self.ended = False
        self.said = "the robot goes through a tour; any key takes over"

    @property
    def idle(self) -> bool:
        """By the bus that the clock goes by: the scene may hear of it a little later."""
        return self._bus.status.behaviour == reach.status_t.NONE

    def key(self, character: str) -> None:
        """A character; what is none of ours is ignored."""
        self._tour = self._tour and character in " fq"
        calls = {" ": self._pause, "q": self._end, "f": self._go_fast, "s": self._star,
                 "b": self._babble, "x": self._explore, "t": lambda: self._take(1)}  # fmt: skip
        if character.isdecimal() and character.isascii():
            self._take(int(character))
        elif character in calls:
            calls[character]()

    def click(self, x: int, y: int, layout: Layout) -> None:
        """Into the right eye or a view from outside: the ball is to go there."""
        panel, u, v = layout.at(x, y)
        target = self.target_at(panel, u, v)
        if target is None:
            return
        self._tour = False
        self._pursue([target], REACH_SECONDS, from_centre=False,
                     said="reaches for ({:.4g}, {:.4g}, {:.4g})".format(*target))  # fmt: skip

    def follow(self) -> None:
        """Called once a picture: the next station of the tour, when the last one has ended."""
        if self._tour and self.idle and not self.paused:
            stations = self._stations_of_tour()
            stations[self._stations % len(stations)]()
            self._stations += 1

    def _stations_of_tour(self) -> list:
        learn = [self._babble, self._star]
        if not self._tools:
            return learn
        return [*learn, lambda: self._take(1), *learn, lambda: self._take(0), self._star]

    def _pause(self) -> None:
        self.paused = not self.paused
        self.said = "paused" if self.paused else "goes on"

    def _end(self) -> None:
        self.ended = True

    def _go_fast(self) -> None:
        self.fast = not self.fast
        self.said = "as fast as this machine can" if self.fast else "no faster than real time"

    def _take(self, tool: int) -> None:
        if tool > self._tools:
            self.said = f"this robot has no tool {tool}"
            return
        self._bus.ask_simulator(reach.sim_request_t.TOOL, tool=tool)
        held = f"tool {tool} is in the hand" if tool else "the hand is empty"
        self.said = f"{held}; nobody tells the daemon"

    def _babble(self) -> None:
        self._learn("BABBLE", BABBLE[self._scene.fixates], "babbles {} samples")

    def _explore(self) -> None:
        self._learn("EXPLORE", EXPLORE[self._scene.fixates], "explores, {} samples")

    def _learn(self, kind: str, count: int, said: str) -> None:
        self._seed += 1
        self._ask(kind, said.format(count), count=count, seed=self._seed, learn=1)

    def _star(self) -> None:
        if self._scene.fixates:
            targets = metrics.star_targets().tolist()
        elif (targets := star_of(np.array(self._scene.visited))) is None:
            self.said = "a star goes to places where the robot has been: let it babble first"
            return
        self._pursue(
            targets,
            STAR_SECONDS[self._scene.fixates],
            from_centre=self._scene.fixates,
            said="draws a star",
        )

    def _pursue(self, targets: list, period: float, from_centre: bool, said: str) -> None:
        rows = [list(target) for target in targets] + [[0.0] * 3] * (MAX_TARGETS - len(targets))
        self._ask("REACH", said, learn=1, count=int(from_centre), n_targets=len(targets),
                  target=rows, period=period)  # fmt: skip

    def _ask(self, kind: str, said: str, **fields) -> None:
        if not self.idle:  # it takes one at a time
            self._request("STOP")
            self._clock.advance(STOP_SECONDS)
        accepted = self._request(kind, **fields)
        self.said = said if accepted else f"reachd refused: {kind.lower()}"

    def _request(self, kind: str, **fields) -> bool:
        request = self._bus.prepare(getattr(reach.request_t, kind), **fields)
        return self._clock.ask_daemon(request) == reach.status_t.ACCEPTED

    def target_at(self, panel: str | None, u: float, v: float):
        """The target that a point of a panel means; None where it means none."""
        scene = self._scene
        if panel == "right_eye":
            return u, v, scene.marker.disparity if scene.marker and scene.marker.seen else 0.0
        if panel not in scene.cameras or panel == "left_eye" or scene.truth is None:
            return None
        place = scene.cameras[panel].under(u, v, scene.truth.marker)
        return tuple(place) if not scene.sees else self._seen_at(place)

    def _seen_at(self, place: np.ndarray):
        """Where the eyes would see a place."""
        left = self._scene.cameras["left_eye"].see(place)
        right = self._scene.cameras["right_eye"].see(place)
        if not left or not right or max(map(abs, (*left, *right))) > 320:
            self.said = "the eyes do not see that place"
            return None
        return right[0], right[1], left[0] - right[0]


def star_of(visited: np.ndarray) -> list | None:
    """Places that a hand of unknown reach can go to: ends that are far from each other, each
    followed by the centre, all of them visited before. None: too few were."""
    if len(visited) < 2 * ENDS or np.ptp(visited, axis=0).max() < LEAST_SPREAD:
        return None
    centre = visited[np.argmin(np.linalg.norm(visited - visited.mean(axis=0), axis=1))]
    ends = [centre]
    for _ in range(ENDS):
        far = np.min([np.linalg.norm(visited - end, axis=1) for end in ends], axis=0)
        ends.append(visited[np.argmax(far)])
    return [place.tolist() for end in ends[1:] for place in (end, centre)]
