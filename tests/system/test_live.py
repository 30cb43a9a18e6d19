"""./run live: a short run is written as a recording, and the viewer draws it on a screen of its
own, without a graphics card."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
import screen
from PIL import Image
from reach import programs

RERUN = Path(sys.executable).with_name("rerun")
WIDTH, HEIGHT = 1600, 1000
SOFTWARE = Path("/usr/share/vulkan/icd.d")


def draw(recording: Path, picture: Path) -> subprocess.CompletedProcess:
    """The viewer draws itself. Its OpenGL renderer refuses software; Vulkan does not."""
    driver = next(SOFTWARE.glob("lvp_icd*.json"))
    # The pointer rests in the middle of the screen; there it is beside the window.
    with screen.Screen(3 * WIDTH, 3 * HEIGHT) as display:
        environment = {**os.environ, "DISPLAY": display.display, "VK_ICD_FILENAMES": str(driver)}
        return subprocess.run(
            [RERUN, recording, "--renderer", "vulkan", "--window-size", f"{WIDTH}x{HEIGHT}",
             "--screenshot-to", picture],
            env=environment, capture_output=True, text=True, timeout=240,
        )  # fmt: skip


def ball_of(pixels: np.ndarray) -> np.ndarray:
    """Where a picture has the colour of the ball."""
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return (green > 100) & (green > 1.6 * red) & (green > 1.6 * blue)


def drawn(display: screen.Screen, run: subprocess.Popen, said) -> np.ndarray:
    """What the window shows once it shows the ball and all was said, or after a while."""
    end = time.monotonic() + 150
    while True:
        picture = display.picture()
        complete = said() and ball_of(picture.astype(int)).sum() > 20
        if complete or run.poll() is not None or time.monotonic() > end:
            return picture
        time.sleep(1)


class Live(unittest.TestCase):
    def test_a_run_is_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            recording = Path(folder) / "live.rrd"
            command = [sys.executable, "-m", "reach.live", "--out", folder, "--do", "babble 5",
                       "--seconds", "8", "--save", recording]  # fmt: skip
            result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True,
                                    text=True, timeout=120)  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertGreater(recording.stat().st_size, 1_000_000)
            picture = programs.BINARIES.parent / "live.png"
            result = draw(recording, picture)
        self.assertTrue(picture.exists(), result.stderr)
        pixels = np.asarray(Image.open(picture).convert("RGB")).astype(int)
        red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
        upper = pixels.shape[0] // 2
        ball = ball_of(pixels)
        ring = (red > 200) & (green > 150) & (blue < 80)
        # The ball in both eyes and in the world; the ring of vision around it.
        thirds = np.array_split(ball[:upper], 3, axis=1)
        self.assertTrue(all(part.sum() > 20 for part in thirds), [p.sum() for p in thirds])
        self.assertGreater(ring[:upper].sum(), 20)
        self.assertGreater(len(np.unique(pixels[upper:].reshape(-1, 3), axis=0)), 10)  # curves

    def test_the_window_draws_from_where_run_calls_it(self):
        """The viewer is found without the virtual environment on the PATH, it draws what the run
        says, and --do stops at what is refused."""
        command = [sys.executable, "-m", "reach.live", "--lockstep", "--do", "babble 1",
                   "--do", "load 7", "--do", "babble 2", "--seconds", "600"]  # fmt: skip
        environment = os.environ | {
            "PATH": "/usr/bin:/bin", "VK_ICD_FILENAMES": str(next(SOFTWARE.glob("lvp_icd*.json"))),
        }  # fmt: skip
        with (
            tempfile.TemporaryDirectory() as folder,
            screen.Screen(WIDTH, HEIGHT, composite=False) as display,
        ):
            environment["DISPLAY"], path = display.display, Path(folder) / "said"
            with path.open("w") as file:  # a pipe would end only with the viewer
                run = subprocess.Popen([*command, "--out", folder], stdin=subprocess.DEVNULL,
                                       stdout=file, stderr=file, env=environment)  # fmt: skip
            picture = drawn(display, run, lambda: "was not done" in path.read_text())
            run.send_signal(signal.SIGINT)
            run.wait(60)
            said = path.read_text()
        screen.save(picture, programs.BINARIES.parent / "live-window.png")
        self.assertGreater(ball_of(picture.astype(int)).sum(), 20, said)
        self.assertNotIn("Traceback", said)
        self.assertIn("'load 7' was not done", said)
        self.assertIn("babble: 1 of 1", said)
        self.assertNotIn("of 2", said)

    def test_another_robot_has_no_empty_panes(self):
        with tempfile.TemporaryDirectory() as folder:
            recording = Path(folder) / "live.rrd"
            command = [sys.executable, "-m", "reach.live", "--out", folder, "--config", "sixaxis",
                       "--lockstep", "--seconds", "2", "--save", recording]  # fmt: skip
            result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True,
                                    text=True, timeout=120)  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            told = recording.read_bytes()
        self.assertNotIn(b"left eye", told)
        self.assertIn(b"robot", told)


if __name__ == "__main__":
    unittest.main()
