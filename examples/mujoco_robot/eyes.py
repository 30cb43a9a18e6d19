"""Two eyes on a robot's head, rendered as cameras would see it: pairs of pictures for reach-vision.

Each eye is a body of the model that looks along its x axis, with z up. They see a green ball at the
tip, and whatever else the model shows."""

import math
import os

os.environ.setdefault("MUJOCO_GL", "egl")  # without a display; before mujoco is imported

import mujoco
from reach.messages import bot_core

WIDTH, HEIGHT = 640, 480  # px
FOCAL = 1200.0  # px, as in etc/vision-kobian.yaml
BALL = 0.02  # m
LOOKS_ALONG_X = [0.5, 0.5, -0.5, -0.5]  # a camera of MuJoCo looks along -z


def put_in(spec: mujoco.MjSpec, names: list[str], tip: str, rod: float) -> None:
    """Cameras, light and the ball, before the model is compiled. KeyError: there is no such eye."""
    for name in names:
        body = spec.body(name)
        if body is None:
            raise KeyError(f"there is no body '{name}'")
        fovy = 2 * math.degrees(math.atan(HEIGHT / 2 / FOCAL))
        body.add_camera(name=name, fovy=fovy, quat=LOOKS_ALONG_X)
    spec.visual.global_.offwidth, spec.visual.global_.offheight = WIDTH, HEIGHT
    spec.worldbody.add_light(pos=[0.5, 0.5, 2], dir=[-0.2, -0.2, -1])
    spec.body(tip).add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[BALL, 0, 0], pos=[0, 0, rod], mass=0.005,
        rgba=[0.05, 0.75, 0.1, 1],
    )  # fmt: skip


class Eyes:
    def __init__(self, arm, names: list[str]):
        self._arm, self._names = arm, names
        self._renderer = mujoco.Renderer(arm.model, HEIGHT, WIDTH)
        self._renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0

    def expose(self, utime: int) -> bytes:
        """The pair of now, as STEREO_IMAGES has it."""
        pair = bot_core.images_t()
        pair.utime, pair.n_images = utime, 2
        pair.image_types = [pair.LEFT, pair.RIGHT]
        pair.images = [self._picture(name, utime) for name in self._names]
        return pair.encode()

    def _picture(self, name: str, utime: int) -> bot_core.image_t:
        self._renderer.update_scene(self._arm.data, camera=name)
        picture = bot_core.image_t()
        picture.utime, picture.width, picture.height = utime, WIDTH, HEIGHT
        picture.row_stride, picture.pixelformat = 3 * WIDTH, picture.PIXEL_FORMAT_RGB
        picture.data = self._renderer.render().tobytes()
        picture.size = len(picture.data)
        return picture
