"""What the experimenter does to the simulated world, as an object."""

from collections.abc import Callable

from .bus import Bus
from .messages import reach

_MOST_TOOLS = 100


class Simulator:
    """reach-simrobot on the client's bus: `Reach().sim`. Each call returns when it was carried out;
    NoAnswerError says that it was not."""

    def __init__(self, bus: Bus, wait: Callable):
        self._bus, self._wait = bus, wait

    def attach(self, tool: int) -> None:
        """Puts a tool of the simulator's configuration, from 1, into the hand. The daemon is not
        told."""
        if not 1 <= tool <= _MOST_TOOLS:
            raise ValueError(f"a tool from 1 to {_MOST_TOOLS} is wanted")
        self._ask("TOOL", tool=tool)

    def detach(self) -> None:
        self._ask("TOOL", tool=0)

    def reset(self) -> None:
        """Back to the start pose, at rest."""
        self._ask("RESET")

    def light(self, brightness: float) -> None:
        """1 = as configured; 0 to 10."""
        self._ask("LIGHT", value=brightness)

    def pause(self) -> None:
        self._ask("PAUSE")

    def resume(self) -> None:
        self._ask("RESUME")

    def speed(self, factor: float) -> None:
        """Times real time; with the real-time clock only."""
        self._ask("SPEED", value=factor)

    def run_until(self, seconds: float) -> None:
        """Lets a simulator that holds go on until this simulated time; s."""
        self._ask("RUN_UNTIL", until=round(seconds * 1e6))

    def quit(self) -> None:
        """Ends the simulator, which does not answer any more."""
        self._bus.tell_simulator(self._bus.prepare_simulator(reach.sim_request_t.QUIT))

    def _ask(self, kind: str, **fields) -> None:
        request = self._bus.prepare_simulator(getattr(reach.sim_request_t, kind), **fields)
        self._bus.tell_simulator(request)
        self._wait(
            lambda: self._bus.truth is not None and self._bus.truth.request_seq == request.seq,
            lambda: self._bus.tell_simulator(request),
            "simrobot in {:g} s: it does not run, runs with --no-truth, or refused the request, see"
            " its log",
        )
