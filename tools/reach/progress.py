"""The line that tells how far a long experiment is."""

import sys
import time

LINE_SECONDS = 10.0  # between lines where the output is no terminal


class Progress:
    """`weights`: expected duration of each phase, in any unit; only their ratios count."""

    def __init__(self, weights: dict[str, float], out=sys.stderr):
        self._weights = weights
        self._out = out
        self._live = out.isatty()
        self._start = time.monotonic()
        self._last_line = 0.0
        self._shares: dict[str, float] = {}  # of phases that have begun

    def update(self, phase: str, share: float, text: str) -> None:
        """`share` of this phase is done, 0 .. 1; others may be under way."""
        self._shares[phase] = share
        now = time.monotonic()
        if not self._live and now - self._last_line < LINE_SECONDS:
            return
        self._last_line = now
        line = f"{phase}: {text}, {self._left()}"
        self._out.write(f"\r{line}\033[K" if self._live else f"{line}\n")
        self._out.flush()

    def part(self, name: str) -> "Part":
        """The same line for the phases of one of several runs, which are weighed as NAME/PHASE."""
        return Part(self, name)

    def finish(self, phase: str, text: str) -> None:
        self._shares[phase] = 1.0
        clear = "\r\033[K" if self._live else ""
        self._out.write(f"{clear}{phase}: {text}\n")
        self._out.flush()

    def _left(self) -> str:
        total = sum(self._weights.values())
        done = sum(share * self._weights.get(name, 0.0) for name, share in self._shares.items())
        if done <= 0.01 * total:
            return "time left unknown yet"
        seconds = (time.monotonic() - self._start) * (total - done) / done
        minutes, second = divmod(int(seconds), 60)
        hours = f"{minutes // 60}:{minutes % 60:02d}" if minutes >= 60 else str(minutes)
        return f"{hours}:{second:02d} left"


class Part:
    """A run among several: its phases under its name."""

    def __init__(self, progress: Progress, name: str):
        self._progress = progress
        self._name = name

    def update(self, phase: str, share: float, text: str) -> None:
        self._progress.update(f"{self._name}/{phase}", share, text)

    def finish(self, phase: str, text: str) -> None:
        self._progress.finish(f"{self._name}/{phase}", text)
