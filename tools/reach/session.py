"""One run of the programs with an experimenter at the bus."""

import contextlib
import signal
from collections.abc import Iterator
from pathlib import Path

from . import programs
from .bus import Bus
from .clock import HeldClock, RealClock
from .processes import Processes

SETTLE_SECONDS = 1.0  # robot time before the first request


class Stop:
    """Notes that the user wants an end.

    It is raised only between two looks at the bus: an exception out of a signal may strike
    anywhere, even where the programs are being ended.
    """

    def __init__(self):
        self._asked = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._note)

    def _note(self, *_) -> None:
        self._asked = True

    def release(self) -> None:
        """From now on a signal interrupts at once."""
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.default_int_handler)

    def check(self) -> None:
        if self._asked:
            raise KeyboardInterrupt


@contextlib.contextmanager
def session(out: Path, stop: Stop, **options) -> Iterator[tuple[Bus, HeldClock | RealClock]]:
    """The programs of programs.start(), which takes the options, until the context is left."""
    with Processes(out) as processes:
        programs.start(processes, out, **options)
        bus = Bus(programs.LISTENER_URL, lambda: (stop.check(), processes.check()))
        programs.wait_until_ready(bus, options.get("robot", "kobian"))
        clock = RealClock(bus) if options.get("realtime") else HeldClock(bus, recorded=True)
        clock.advance(SETTLE_SECONDS)
        yield bus, clock
