"""./run show: a window on a screen of its own, keys as they are typed, clicks, a robot that is
nothing but a URDF, and a video where there is no display."""

import os
import pty
import subprocess
import sys
import tempfile
import time
import unittest
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import screen
from PIL import Image
from reach import programs, robot_files
from reach.messages import ROOT
from reach.pictures import decode
from reach.session import Stop, session
from reach.show import picture
from reach.show.layout import layout
from reach.show.operator import Operator, star_of
from reach.show.outputs import blocks
from reach.show.scene import Scene

SHOW = [sys.executable, "-m", "reach.show"]
FIRST_PICTURE_SECONDS = 10
PATIENCE = 60


def without_display() -> dict:
    return {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}


@contextmanager
def playing(robot: robot_files.Robot):
    """A run with its operator, without the tour."""
    with tempfile.TemporaryDirectory() as folder:
        options = {"robot": robot, "simrobot": ("--view",)}
        with session(Path(folder), Stop(), seed=1, **options) as (bus, clock):
            scene = Scene(programs.LISTENER_URL)
            operator = Operator(bus, clock, scene, robot, tour=False)
            yield Run(clock, scene, operator)


class Run:
    def __init__(self, clock, scene: Scene, operator: Operator):
        self.clock, self.scene, self.operator = clock, scene, operator
        self.go_on(0.5)

    def go_on(self, seconds: float, until=lambda: False) -> None:
        for _ in range(round(seconds / 0.1)):
            self.clock.advance(0.1)
            self.scene.take_in(self.clock.now)
            if until():
                return

    def idle(self) -> bool:
        return self.operator.idle


class Window(unittest.TestCase):
    def test_a_window_opens_and_the_ball_is_marked_in_it(self):
        with tempfile.TemporaryDirectory() as folder, screen.Screen(1400, 800) as display:
            start = time.monotonic()
            environment = {**os.environ, "DISPLAY": display.display}
            command = [*SHOW, "--out", folder, "--keys", "tb", "--seconds", "4"]
            process = subprocess.Popen(command, env=environment)
            while display.picture().std() < 20 and time.monotonic() < start + PATIENCE:
                time.sleep(0.05)
            took, shown = time.monotonic() - start, display.picture()
            while process.poll() is None and time.monotonic() < start + PATIENCE:
                time.sleep(0.1)
                latest = display.picture()
                shown = latest if latest.std() > 20 else shown
            self.assertEqual(process.wait(), 0)
        busy = max(1, os.getloadavg()[0] / os.cpu_count())
        print(f"first picture after {took:.1f} s, {busy:.1f} programs a processor")
        self.assertLess(took, FIRST_PICTURE_SECONDS * busy)
        screen.save(shown, programs.BINARIES.parent / "show.png")
        self.assertTrue(np.any(np.all(shown == picture.RING, axis=2)))
        lines = screen.read_lines(shown[320:720, 853:1280])
        self.assertTrue(any("tool 1" in line for line in lines), lines)

    def test_a_key_in_the_window_ends_it(self):
        with tempfile.TemporaryDirectory() as folder, screen.Screen(1400, 800) as display:
            environment = {**os.environ, "DISPLAY": display.display}
            process = subprocess.Popen([*SHOW, "--out", folder], env=environment)
            end = time.monotonic() + PATIENCE
            while process.poll() is None and time.monotonic() < end:
                if display.picture().std() > 20:
                    display.type("q")
                time.sleep(0.5)
            self.assertEqual(process.wait(1), 0)

    def test_a_terminal_takes_keys_and_a_video_is_left(self):
        with tempfile.TemporaryDirectory() as folder:
            ours, theirs = pty.openpty()
            process = subprocess.Popen(
                [*SHOW, "--out", folder], env=without_display(), stdin=theirs, stdout=theirs,
                stderr=subprocess.PIPE,
            )  # fmt: skip
            os.close(theirs)
            said = b""
            while b"\xe2\x96\x80" not in said:  # half a block of the picture
                said += os.read(ours, 65536)
            os.write(ours, b"q")
            while b"\x1b[?1049l" not in said:
                said += os.read(ours, 65536)
            self.assertEqual(process.wait(PATIENCE), 0, process.stderr.read())
            process.stderr.close()
            os.close(ours)
            self.assertIn(b"ftyp", (Path(folder) / "show.mp4").read_bytes()[:32])
            self.assertEqual(Image.open(Path(folder) / "show.png").size, (1280, 720))

    def test_what_is_no_robot_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "b.urdf").write_text("<robot><link name='a'/></robot>")
            for what, why in (
                ("nobody", "neither kobian"),
                (folder, "reachd.yaml: no such file"),
                (f"{folder}/b.urdf", "no joint of it moves"),
            ):
                command = [*SHOW, what, "--out", f"{folder}/out"]
                result = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(result.returncode, 1)
                self.assertIn(why, result.stderr)
                self.assertNotIn("Traceback", result.stderr)


class Keys(unittest.TestCase):
    def test_keys_and_clicks_of_a_robot_with_eyes(self):
        with playing(robot_files.named("kobian")) as run:
            scene, operator, places = run.scene, run.operator, layout(True)
            operator.key("t")
            run.go_on(0.5)
            self.assertEqual(scene.truth.tool, 1)
            operator.key("9")
            self.assertIn("no tool 9", operator.said)
            operator.key("0")
            run.go_on(0.5)
            self.assertEqual(scene.truth.tool, 0)
            operator.key("b")
            run.go_on(90, until=run.idle)
            self.assertEqual(scene.status.samples, 15)

            eye = places.images[1]
            operator.click(eye.left + eye.width // 2 + 20, eye.top + eye.height // 2, places)
            run.go_on(3)
            self.assertEqual(scene.status.behaviour, scene.status.REACH)
            self.assertAlmostEqual(
                scene.trace.x_target[0], 30, delta=2
            )  # 20 of 426 px are 30 of 640
            self.assertLess(scene.status.error, 10)

            run.go_on(10, until=run.idle)
            self.click_from_outside(run, places)
            for key, what in (("s", scene.status.REACH), ("x", scene.status.EXPLORE)):
                operator.key(key)
                run.go_on(0.2)
                self.assertEqual(scene.status.behaviour, what)
            operator.key(" ")
            self.assertTrue(operator.paused)
            operator.key("q")
            self.assertTrue(operator.ended)

    def click_from_outside(self, run: Run, places) -> None:
        """Beside the ball as it is seen from outside: the eyes' target is there, too."""
        view, camera = places.images[2], run.scene.cameras["left_view"]
        u, v = camera.see(run.scene.truth.marker)
        scale = view.width / 640
        x, y = (round(view.left + view.width / 2 + scale * (u + 8)),
                round(view.top + view.height / 2 + scale * v))  # fmt: skip
        at = np.rint((u + 320, v + 240)).astype(int)
        red, green, blue = decode(run.scene.views[0])[at[1], at[0]].astype(int)
        self.assertGreater(green, 1.5 * max(red, blue))  # the ball is drawn where it is
        panel, *at = places.at(x, y)
        target = run.operator.target_at(panel, *at)
        place = picture.place_seen(run.scene, *target)
        np.testing.assert_allclose(camera.see(place), at, atol=0.01)
        run.operator.click(x, y, places)
        run.go_on(1.5)  # the target moves there smoothly
        self.assertEqual(run.scene.status.behaviour, run.scene.status.REACH)
        np.testing.assert_allclose(run.scene.trace.x_target, target, atol=1)

    def test_a_urdf_is_enough(self):
        with tempfile.TemporaryDirectory() as folder:
            robot = robot_files.find(str(ROOT / "etc/robots/sixaxis.urdf"), Path(folder))
            self.assertEqual(robot.tools(), 1)
            with playing(robot) as run:
                run.operator.key("s")
                self.assertIn("let it babble first", run.operator.said)
                run.operator.key("b")
                run.go_on(30, until=run.idle)
                run.operator.key("s")
                run.go_on(40, until=run.idle)
                errors = [error for _, error in run.scene.curves.error if not np.isnan(error)]
                self.assertLess(min(errors), 0.003)  # m
                drawn = picture.draw(run.scene, run.operator, layout(False))
                self.assertEqual(drawn.size, (1280, 720))


class Parts(unittest.TestCase):
    def test_a_star_needs_places(self):
        self.assertIsNone(star_of(np.zeros((3, 3))))
        visited = np.random.default_rng(1).normal(size=(100, 3))
        star = np.array(star_of(visited))
        self.assertEqual(star.shape, (16, 3))
        self.assertTrue((star[1::2] == star[1]).all())
        self.assertEqual(len(np.unique(star[::2], axis=0)), 8)

    def test_blocks_fit_the_terminal(self):
        text = blocks(Image.new("RGB", (1280, 720), (1, 2, 3)), 80, 20)
        self.assertLessEqual(text.count("\n") + 1, 20)
        self.assertTrue(all(line.count("▀") <= 80 for line in text.splitlines()))


if __name__ == "__main__":
    unittest.main()
