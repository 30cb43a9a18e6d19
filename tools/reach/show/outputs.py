"""Where the pictures go, and where keys and clicks come from: a window, a video, a terminal."""

import contextlib
import os
import select
import shutil
import subprocess
import sys
import termios
import tty
from pathlib import Path

import numpy as np
from PIL import Image

from ..programs import BINARIES
from .layout import HEIGHT, WIDTH

RATE = 25  # pictures a second of the robot's time
END_SECONDS = 60.0  # a video that is cut off cannot be played


class OutputError(Exception):
    """Why nothing can be shown; one line for the user."""


def window_opens() -> bool:
    """Says why not: a display over the network, as of ssh -X, is out of a network namespace's
    reach."""
    command = [BINARIES / "reach-window"]
    result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if result.returncode != 0:
        why = result.stderr.strip().splitlines() or ["it said nothing"]
        print(f"show: no window: {why[0]}", file=sys.stderr)
    return result.returncode == 0


class Frames:
    """reach-window, which shows the pictures, or writes them as a video, or both."""

    def __init__(self, window: bool, video: Path | None, rate: int = RATE):
        words = [BINARIES / "reach-window", "--width", WIDTH, "--height", HEIGHT, "--rate", rate]
        words += [] if window else ["--no-window"]
        words += ["--video", video] if video else []
        self._process = subprocess.Popen(
            [str(word) for word in words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, start_new_session=True,  # Ctrl-C is ours: a video wants its end
        )  # fmt: skip
        self._said = self._process.stdout.fileno()
        os.set_blocking(self._said, False)
        self._rest = b""
        self.closed = False

    def show(self, picture: Image.Image) -> None:
        try:
            self._process.stdin.write(picture.tobytes())
            self._process.stdin.flush()
        except BrokenPipeError:
            if self._process.wait() != 0:
                raise OutputError(self._process.stderr.read().decode().strip()) from None
            self.closed = True

    def events(self) -> list[list[str]]:
        """["key", "113"] or ["click", "10", "20"]."""
        try:
            self._rest += os.read(self._said, 65536)
        except BlockingIOError:
            return []
        *lines, self._rest = self._rest.split(b"\n")
        return [line.decode().split() for line in lines]

    def close(self) -> None:
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        try:
            self._process.wait(END_SECONDS)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


class Terminal:
    """The picture in blocks of two colours a letter, and keys as they are typed."""

    EVERY = 5  # pictures; a terminal is slow

    def __init__(self):
        self._number = 0
        self._before = termios.tcgetattr(sys.stdin)
        tty.setcbreak(sys.stdin)
        sys.stdout.write("\033[?1049h\033[?25l")
        self.closed = False

    def show(self, picture: Image.Image, lines: list[str]) -> None:
        self._number += 1
        if self._number % self.EVERY == 1:
            columns, rows = shutil.get_terminal_size()
            sys.stdout.write(f"\033[H{blocks(picture, columns, rows - len(lines) - 1)}\033[0m")
            sys.stdout.write("".join(f"\r\n{line[: columns - 1]}\033[K" for line in lines))
            sys.stdout.flush()

    def events(self) -> list[list[str]]:
        found = []
        while select.select([sys.stdin], [], [], 0)[0] and (typed := os.read(0, 64)):
            found += [["key", str(code)] for code in typed]
        return found

    def close(self) -> None:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._before)
        sys.stdout.write("\033[0m\033[?25h\033[?1049l")
        sys.stdout.flush()


def blocks(picture: Image.Image, columns: int, rows: int) -> str:
    """As large as fits, upright: a letter is twice as high as wide, and has an upper half of one
    colour and a lower one of another."""
    scale = min(columns / picture.width, 2 * rows / picture.height)
    size = max(1, int(picture.width * scale)), max(1, int(picture.height * scale) // 2) * 2
    pixels = np.asarray(picture.resize(size, Image.Resampling.BOX))
    lines = []
    for upper, lower in zip(pixels[::2], pixels[1::2], strict=True):
        letters = (f"\033[38;2;{a};{b};{c};48;2;{d};{e};{f}m▀"
                   for (a, b, c), (d, e, f) in zip(upper, lower, strict=True))  # fmt: skip
        lines.append("".join(letters) + "\033[0m\033[K")
    return "\r\n".join(lines)
