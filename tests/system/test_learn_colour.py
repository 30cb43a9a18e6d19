"""reach-vision --learn-colour with a click in its window, on a screen without a display."""

import os
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from screen import Screen

BUILD = Path(os.environ["REACH_BUILD_DIR"])
BLUE, ORANGE = (20, 60, 220), (220, 90, 20)
PATIENCE_SECONDS = 60


def draw_balls(path: Path) -> None:
    """A blue ball, and an orange one that is larger."""
    picture = Image.new("RGB", (640, 480), (120, 112, 104))
    draw = ImageDraw.Draw(picture)
    draw.ellipse((200, 150, 300, 250), fill=BLUE)
    draw.ellipse((380, 230, 540, 390), fill=ORANGE)
    picture.save(path)


def middle_of(screen: Screen, colour) -> tuple[int, int]:
    """Where the window shows it, once it has come to rest: column and row of its middle."""
    before = None
    until = time.monotonic() + PATIENCE_SECONDS
    while time.monotonic() < until:
        off = np.abs(screen.picture().astype(int) - colour).max(axis=2)
        rows, columns = np.nonzero(off < 30)
        if len(rows) > 1000:
            middle = int(columns.mean()), int(rows.mean())
            if middle == before:
                return middle
            before = middle
        time.sleep(0.2)
    raise AssertionError("the window never showed the ball")


class Click(unittest.TestCase):
    def test_the_ball_that_was_clicked_is_learned(self):
        with tempfile.TemporaryDirectory() as folder, Screen(1000, 700) as screen:
            path = Path(folder) / "balls.png"
            draw_balls(path)
            with subprocess.Popen(
                [BUILD / "bin/reach-vision", "--learn-colour", path, "--show"],
                env=os.environ | {"DISPLAY": screen.display, "XDG_RUNTIME_DIR": folder},
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            ) as vision:  # fmt: skip
                screen.click(*middle_of(screen, BLUE))
                printed, logged = vision.communicate(timeout=PATIENCE_SECONDS)
        self.assertEqual(vision.returncode, 0, logged)
        self.assertIn("ball: {hue: 228", printed, logged)


if __name__ == "__main__":
    unittest.main()
