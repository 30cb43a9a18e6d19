"""An X screen without a display, and what is written on it."""

import ctypes
import mmap
import os
import subprocess
import tempfile
from itertools import pairwise
from pathlib import Path

import numpy as np
from PIL import Image

DARK = 90  # letters are darker, the lines of tables are not
ENLARGED = 4  # tesseract wants letters of some 30 pixels


class Screen:
    """A context: Xvfb on a display of its own, ended on leaving. `composite`: windows deeper than
    the screen, such as Rerun's, are kept beside it, and stay black where no compositor puts them on
    it, as a desktop does."""

    def __init__(self, width: int, height: int, composite: bool = True):
        self._folder = tempfile.TemporaryDirectory()
        number, told = os.pipe()
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(told), "-screen", "0", f"{width}x{height}x24",
             "-nolisten", "tcp", "-nocursor", "-fbdir", self._folder.name,
             *([] if composite else ["-extension", "Composite"])],
            pass_fds=[told], stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(told)
        with os.fdopen(number) as answer:
            self.display = f":{answer.readline().strip()}"  # it has begun to serve by then

    def __enter__(self) -> "Screen":
        return self

    def __exit__(self, *_) -> None:
        self._server.terminate()
        self._server.wait()
        self._folder.cleanup()

    def windows(self) -> int:
        """How many windows are open."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype, x11.XDefaultRootWindow.restype = ctypes.c_void_p, ctypes.c_ulong
        display = ctypes.c_void_p(x11.XOpenDisplay(self.display.encode()))
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.c_void_p()
        x11.XQueryTree(display, ctypes.c_ulong(x11.XDefaultRootWindow(display)),
                       ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children),
                       ctypes.byref(count))  # fmt: skip
        x11.XCloseDisplay(display)
        return count.value

    def type(self, letter: str) -> None:
        """A key that is pressed and let go, for the window under the pointer."""
        x11, xtst = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        display = ctypes.c_void_p(x11.XOpenDisplay(self.display.encode()))
        code = x11.XKeysymToKeycode(display, ctypes.c_ulong(ord(letter)))
        for pressed in (True, False):
            xtst.XTestFakeKeyEvent(display, code, pressed, ctypes.c_ulong(0))
        x11.XCloseDisplay(display)

    def click(self, column: int, row: int) -> None:
        """The pointer goes there, and its left button is pressed and let go."""
        x11, xtst = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        display = ctypes.c_void_p(x11.XOpenDisplay(self.display.encode()))
        xtst.XTestFakeMotionEvent(display, -1, column, row, ctypes.c_ulong(0))
        for pressed in (True, False):
            xtst.XTestFakeButtonEvent(display, 1, pressed, ctypes.c_ulong(50))
        x11.XCloseDisplay(display)

    def picture(self) -> np.ndarray:
        """What is shown now, as height x width x RGB. Xvfb keeps it in a file in XWD format."""
        with (Path(self._folder.name) / "Xvfb_screen0").open("rb") as file:
            data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
            header = np.frombuffer(data[:100], ">u4")
            width, height, row, colours = (int(header[i]) for i in (4, 5, 12, 19))
            start = int(header[0]) + 12 * colours
            pixels = np.frombuffer(data[start : start + row * height], np.uint8)
            data.close()
        return pixels.reshape(height, row // 4, 4)[:, :width, 2::-1].copy()


def save(picture: np.ndarray, path: Path) -> None:
    Image.fromarray(picture).save(path)


def columns(picture: np.ndarray, top: int, bottom: int) -> list[slice]:
    """Between the vertical lines that go through all rows from `top` to `bottom`."""
    rows = picture[top:bottom].min(axis=2)
    lines = np.flatnonzero((rows < 200).all(axis=0) & (rows > DARK).all(axis=0))
    return [slice(a + 1, b) for a, b in pairwise(lines) if b - a > 10]


def read_lines(picture: np.ndarray) -> list[str]:
    """The dark letters on it, line by line."""
    letters = np.where(picture.max(axis=2) < DARK, 0, 255).astype(np.uint8)
    letters = np.pad(letters, 6, constant_values=255)
    enlarged = Image.fromarray(letters).resize(
        (letters.shape[1] * ENLARGED, letters.shape[0] * ENLARGED), Image.Resampling.BICUBIC
    )
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        enlarged.save(file.name)
        command = ["tesseract", file.name, "-", "--psm", "6"]
        one_thread = {**os.environ, "OMP_THREAD_LIMIT": "1"}
        result = subprocess.run(command, capture_output=True, text=True, check=True, env=one_thread)
    return [line for line in result.stdout.splitlines() if line.strip()]
