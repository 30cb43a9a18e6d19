"""Writes what is said on the bus into an LCM log, until SIGTERM or Ctrl-C.

Stands in for lcm-logger, which keeps at most 30 messages waiting and loses the rest without a word
when it does not run for some 30 ms, and goes on as if nothing were when the disk is full; a log
with gaps would make a summary depend on the machine. It overwrites no file.
It answers on REACH_HELLO after what was said before the question is written: who can make the
robot wait for that loses nothing, however seldom the recorder runs.
"""

import re
import signal
import sys
import time
from pathlib import Path

import lcm

from .command_line import Parser
from .log_writer import LogWriter
from .messages import reach

ALL_BUT_IMAGES = "(?!STEREO_IMAGES|SIM_VIEW).*"
QUEUE = 100_000  # messages that may wait; a full queue drops the newest
POLL_MS = 100


class Recorder:
    def __init__(self, url: str, channels: str, path: Path):
        self._lcm = lcm.LCM(url)
        self._stop = False
        self._error: OSError | None = None
        # LCM anchors only the ends of "A|B", and a group makes it whole.
        self._lcm.subscribe(f"({channels})", self._write).set_queue_capacity(QUEUE)
        self._lcm.subscribe("REACH_HELLO", self._answer).set_queue_capacity(QUEUE)
        # Last: that the file exists says to others that nothing will be missed from now on.
        self.log = LogWriter(path)

    def _write(self, channel: str, data: bytes) -> None:
        self._keep(lambda: self.log.write(int(time.time() * 1e6), channel, data))

    def _answer(self, channel: str, data: bytes) -> None:
        """Messages are handled in the order in which they came."""
        hello = reach.hello_t.decode(data)
        if hello.role == hello.RECORDER and not hello.answer:
            self._keep(self.log.flush)
            hello.answer = 1
            if not self._error:
                self._lcm.publish(channel, hello.encode())

    def _keep(self, call) -> None:
        """What a handler raises could not be told from what LCM does when a signal comes."""
        try:
            if not self._error:
                call()
        except OSError as error:
            self._error = error

    def stop(self, *_) -> None:
        self._stop = True

    def run(self) -> None:
        """Also what is still waiting when it is told to stop is written. OSError: the disk, or the
        bus, failed."""
        waiting, broken = 1, 0
        while (waiting or not self._stop) and not self._error:
            try:
                waiting, broken = self._lcm.handle_timeout(POLL_MS), 0
            except OSError:  # a signal broke into the call; it may be noted only after this
                broken += 1
                if broken > 3:
                    raise
            if not waiting:
                self._keep(self.log.flush)
        self._keep(self.log.flush)
        self.log.close()
        if self._error:
            raise self._error


def main() -> int:
    parser = Parser(prog="reach.recorder", description=__doc__)
    parser.add_argument("--url", required=True)
    parser.add_argument("--channels", default=ALL_BUT_IMAGES,
                        help="pattern of the channels to record, which a whole name must match;"
                        " default %(default)s")  # fmt: skip
    parser.add_argument("log", type=Path)
    options = parser.parse_args()
    try:
        re.compile(options.channels)
    except re.error as error:
        parser.error(f"--channels: '{options.channels}' is no pattern: {error}")
    try:
        recorder = Recorder(options.url, options.channels, options.log)
    except FileExistsError:
        print(f"reach.recorder: {options.log}: is there already, and is not overwritten",
              file=sys.stderr)  # fmt: skip
        return 1
    except (OSError, RuntimeError) as error:
        print(f"reach.recorder: {error}", file=sys.stderr)
        return 1
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, recorder.stop)
    try:
        recorder.run()
    except OSError as error:
        left = f"the log ends after {recorder.log.written} messages, and is not complete"
        print(f"reach.recorder: {options.log}: {error.strerror}; {left}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
