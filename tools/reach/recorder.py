"""Writes what is said on the bus into an LCM log, until SIGTERM.

Stands in for lcm-logger, which keeps at most 30 messages waiting and loses the rest without a word
when it does not run for some 30 ms; a log with gaps would make a summary depend on the machine.
It answers on REACH_HELLO after what was said before the question is written: who can make the
robot wait for that loses nothing, however seldom the recorder runs.
"""

import signal
import time

import lcm

from .command_line import Parser
from .messages import reach

ALL_BUT_IMAGES = "(?!STEREO_IMAGES).*"
QUEUE = 100_000  # messages that may wait; a full queue drops the newest
POLL_MS = 100


class Recorder:
    def __init__(self, url: str, channels: str, path: str):
        self._lcm = lcm.LCM(url)
        self._stop = False
        self._lcm.subscribe(channels, self._write).set_queue_capacity(QUEUE)
        self._lcm.subscribe("REACH_HELLO", self._answer).set_queue_capacity(QUEUE)
        # Last: that the file exists says to others that nothing will be missed from now on.
        self._log = lcm.EventLog(path, "w", overwrite=True)

    def _write(self, channel: str, data: bytes) -> None:
        self._log.write_event(int(time.time() * 1e6), channel, data)

    def _answer(self, channel: str, data: bytes) -> None:
        """Messages are handled in the order in which they came."""
        hello = reach.hello_t.decode(data)
        if hello.role == hello.RECORDER and not hello.answer:
            hello.answer = 1
            self._lcm.publish(channel, hello.encode())

    def stop(self, *_) -> None:
        self._stop = True

    def run(self) -> None:
        """Also what is still waiting when it is told to stop is written."""
        waiting, broken = 1, 0
        while waiting or not self._stop:
            try:
                waiting, broken = self._lcm.handle_timeout(POLL_MS), 0
            except OSError:  # a signal broke into the call; it may be noted only after this
                broken += 1
                if broken > 3:
                    raise
        self._log.close()


def main() -> None:
    parser = Parser(prog="reach.recorder", description=__doc__)
    parser.add_argument("--url", required=True)
    parser.add_argument("--channels", default=ALL_BUT_IMAGES,
                        help="pattern of the channels to record; default %(default)s")  # fmt: skip
    parser.add_argument("log")
    options = parser.parse_args()
    recorder = Recorder(options.url, options.channels, options.log)
    signal.signal(signal.SIGTERM, recorder.stop)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    recorder.run()


if __name__ == "__main__":
    main()
