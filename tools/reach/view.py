"""What the window of `./run live` shows, by Rerun; wants rerun-sdk, which `./run live` installs."""

import os
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb
from rerun.urdf import UrdfTree

from .messages import bot_core, reach
from .words import body_words

BALL_RADIUS = 0.02  # m
EYES = {bot_core.images_t.LEFT: "left", bot_core.images_t.RIGHT: "right"}
IMAGE_CENTRE = (320, 240)  # px
_UTIME = slice(8, 16)  # where an encoded message has it


class View:
    """Turns messages into what the window shows, on the robot's own time: of each channel at most
    one in `step` microseconds. Without a URDF there is no robot to be seen, and without `images` no
    eyes, but all the rest."""

    def __init__(self, urdf: Path | None, step: int = 1, images: bool = True):
        self._joints = {}
        self._body = ""
        self._start: int | None = None
        self._step = step
        self._shown: dict[str, int] = {}  # channel -> step of its newest message
        self._take: dict[str, tuple[type, Callable]] = {
            "JOINT_STATE": (bot_core.joint_state_t, self._on_joints),
            "STEREO_IMAGES": (bot_core.images_t, self._on_images),
            "MARKER": (reach.marker_t, self._on_marker),
            "SIM_TRUTH": (reach.sim_truth_t, self._on_truth),
            "REACH_STATUS": (reach.status_t, self._on_status),
        }
        rr.log("robot", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        name, root = self._show_robot(urdf) if urdf else ("robot", None)
        rr.send_blueprint(blueprint(name, root, images))

    def _show_robot(self, urdf: Path) -> tuple[str, str]:
        """Its name, and that of its first link's frame."""
        tree = UrdfTree.from_file_path(urdf)
        tree.log_urdf_to_recording()
        self._joints = {joint.name: joint for joint in tree.joints()}
        root = tree.root_link().name
        rr.log("robot/ball", rr.CoordinateFrame(root), static=True)
        return tree.name, root

    def take(self, channel: str, data: bytes) -> None:
        if channel not in self._take:
            return
        step = int.from_bytes(data[_UTIME], "big") // self._step
        if self._shown.get(channel) == step:
            return
        self._shown[channel] = step
        kind, show = self._take[channel]
        message = kind.decode(data)
        if self._start is None:
            self._start = message.utime
        rr.set_time("robot_time", duration=(message.utime - self._start) * 1e-6)
        show(message)

    def _on_joints(self, state) -> None:
        for name, angle in zip(state.joint_name, state.joint_position, strict=True):
            if name in self._joints:
                turned = self._joints[name].compute_transform(angle, clamp=False)
                rr.log(f"robot/joints/{name}", turned)

    def _on_images(self, pair) -> None:
        for kind, image in zip(pair.image_types, pair.images, strict=True):
            if kind in EYES and image.pixelformat == image.PIXEL_FORMAT_MJPEG:
                picture = rr.EncodedImage(contents=image.data, media_type="image/jpeg")
                rr.log(f"eyes/{EYES[kind]}", picture)

    def _on_marker(self, marker) -> None:
        if not marker.seen:
            for eye in EYES.values():
                rr.log(f"eyes/{eye}/ball", rr.Clear(recursive=False))
            return
        u, v = IMAGE_CENTRE[0] + marker.u_right, IMAGE_CENTRE[1] + marker.v_right
        for eye, shift in (("left", marker.disparity), ("right", 0)):
            ring = rr.Boxes2D(centers=[(u + shift, v)], half_sizes=[(marker.radius, marker.radius)],
                              colors=[(255, 200, 0)], radii=1.5)  # fmt: skip
            rr.log(f"eyes/{eye}/ball", ring)

    def _on_truth(self, truth) -> None:
        ball = rr.Points3D([truth.marker], radii=BALL_RADIUS, colors=[(40, 200, 60)])
        rr.log("robot/ball", ball)

    def _on_status(self, status) -> None:
        for name in ("error", "experts", "solutions", "samples", "compute_us"):
            rr.log(f"plots/{name}", rr.Scalars(getattr(status, name)))
        if (words := body_words(status)) != self._body:
            self._body = words
            rr.log("body", rr.TextLog(words))


def blueprint(robot: str, root: str | None, images: bool = True) -> "rrb.Blueprint":
    """Where everything is in the window; `root` is the frame of the robot's first link, if any."""
    shown = EYES.values() if images else ()
    eyes = [rrb.Spatial2DView(origin=f"eyes/{eye}", name=f"{eye} eye") for eye in shown]
    body = rrb.Spatial3DView(
        origin="/", name="robot",
        contents=["/**", "- /eyes/**", "- /plots/**", f"- /{robot}/collision_geometries/**"],
        spatial_information=rrb.SpatialInformation(target_frame=root) if root else None,
    )  # fmt: skip
    titles = {"error": "distance to the target, px or m", "experts": "experts",
              "solutions": "solutions of the prediction", "compute_us": "tick, µs"}  # fmt: skip
    plots = [rrb.TimeSeriesView(origin=f"plots/{name}", name=title)
             for name, title in titles.items()]  # fmt: skip
    plots.append(rrb.TextLogView(origin="body", name="body"))
    upper = rrb.Horizontal(*eyes, body, column_shares=[*(1 for _ in eyes), 1.2])
    at_its_end = rrb.TimePanel(state="collapsed", timeline="robot_time", play_state="following")
    return rrb.Blueprint(rrb.Vertical(upper, rrb.Grid(*plots), row_shares=[1.2, 1]),
                         at_its_end, collapse_panels=True)  # fmt: skip


def open_window() -> None:
    """The viewer is beside Python in its virtual environment, which need not be on the PATH."""
    os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    rr.init("reachd")
    rr.spawn(memory_limit="1GB", hide_welcome_screen=True)


def write_log(events: Iterable, path: Path, urdf: Path | None, step: int, images: bool) -> int:
    """What the window would have shown of a log, as a file of its own. Returns how many messages
    could not be shown, since they are none of their channels'."""
    bad = 0
    with rr.RecordingStream("reachd") as recording:
        recording.save(path)
        view = View(urdf, step, images)
        for event in events:
            try:
                view.take(event.channel, event.data)
            except Exception:  # generated decoders raise anything on bytes like these
                bad += 1
    recording.disconnect()
    return bad


def open_file(path: Path) -> None:
    """Writes what a window would show."""
    rr.init("reachd")
    rr.save(path)
