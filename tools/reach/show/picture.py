"""Draws the picture of ./run show."""

import numpy as np
from PIL import Image, ImageDraw

from ..pictures import decode
from ..words import body_words
from . import curves
from .drawing import INK, PALE, PAPER, font, plain_number
from .layout import HEIGHT, IMAGE, WIDTH, Layout, Panel
from .operator import Operator
from .scene import Scene

RING, TARGET, EDGE = (255, 215, 0), (255, 70, 200), (0, 0, 0)
STATES = {"WAITING": "waits", "IDLE": "idle", "ACTIVE": "at work", "HOLD": "holds",
          "SUSPENDED": "suspended", "FAULT": "fault"}  # fmt: skip


def draw(scene: Scene, operator: Operator, places: Layout) -> Image.Image:
    picture = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
    canvas = ImageDraw.Draw(picture)
    for panel in places.images:
        _draw_image(picture, canvas, scene, panel)
    curves.draw_error(canvas, scene, places.error)
    curves.draw_contexts(canvas, scene, places.contexts)
    _write(canvas, scene, operator, places.words)
    return picture


def _draw_image(picture, canvas, scene: Scene, panel: Panel) -> None:
    box = (panel.left, panel.top, panel.left + panel.width, panel.top + panel.height)
    image = _image_of(scene, panel.name)
    if image is None:
        canvas.rectangle(box, fill=(60, 60, 64))
    else:
        picture.paste(image.resize((panel.width, panel.height), Image.Resampling.BILINEAR), box[:2])
    scale = panel.width / IMAGE[0]
    middle = (panel.left + panel.width / 2, panel.top + panel.height / 2)
    if (found := _found_in(scene, panel.name)) is not None:
        _ring(canvas, middle, scale, *found)
    if (target := _target_in(scene, panel.name)) is not None:
        _cross(canvas, box, middle, scale, target)
    canvas.text((box[0] + 8, box[1] + 6), panel.title, font=font(15), fill=(255, 255, 255),
                stroke_width=2, stroke_fill=EDGE)  # fmt: skip


def _image_of(scene: Scene, name: str) -> Image.Image | None:
    pair = scene.eyes if name.endswith("eye") else scene.views
    number = 0 if name.startswith("left") else 1
    return Image.fromarray(decode(pair[number])) if len(pair) > number else None


def _found_in(scene: Scene, name: str):
    """u, v and radius of the ball as vision found it."""
    marker = scene.marker
    if marker is None or not marker.seen or not name.endswith("eye"):
        return None
    shift = marker.disparity if name == "left_eye" else 0.0
    return marker.u_right + shift, marker.v_right, marker.radius


def _target_in(scene: Scene, name: str):
    """u, v of the behaviour's target."""
    target = scene.target()
    if target is None:
        return None
    if not scene.sees:
        return scene.cameras[name].see(target) if name in scene.cameras else None
    u, v, disparity = target
    if name.endswith("eye"):
        return u + (disparity if name == "left_eye" else 0.0), v
    place = place_seen(scene, u, v, disparity)
    return scene.cameras[name].see(place) if place is not None else None


def place_seen(scene: Scene, u: float, v: float, disparity: float) -> np.ndarray | None:
    """The place that both eyes see there: the point nearest to both lines of sight."""
    if not {"left_eye", "right_eye", "left_view"} <= scene.cameras.keys():
        return None
    rows = []
    for name, at in (("right_eye", u), ("left_eye", u + disparity)):
        matrix = scene.cameras[name].matrix
        rows += [at * matrix[2] - matrix[0], v * matrix[2] - matrix[1]]
    rows = np.array(rows)
    return np.linalg.lstsq(rows[:, :3], -rows[:, 3], rcond=None)[0]


def _ring(canvas, middle, scale: float, u: float, v: float, radius: float) -> None:
    x, y, r = middle[0] + scale * u, middle[1] + scale * v, scale * radius + 3
    for colour, width, grow in ((EDGE, 5, 1), (RING, 3, 0)):
        canvas.ellipse((x - r - grow, y - r - grow, x + r + grow, y + r + grow),
                       outline=colour, width=width)  # fmt: skip


def _cross(canvas, box, middle, scale: float, target) -> None:
    x, y = middle[0] + scale * target[0], middle[1] + scale * target[1]
    if not (box[0] < x < box[2] and box[1] < y < box[3]):
        return
    for colour, width in ((EDGE, 5), (TARGET, 2)):
        canvas.line((x - 10, y, x + 10, y), fill=colour, width=width)
        canvas.line((x, y - 10, x, y + 10), fill=colour, width=width)


def words(scene: Scene, operator: Operator) -> list[str]:
    """What the run is at, a line each."""
    status, truth = scene.status, scene.truth
    if status is None:
        return ["waits for reachd"]
    names = {getattr(status, name): text for name, text in STATES.items()}
    doing = {status.BABBLE: "babbles", status.COORDINATE: "coordinates", status.REACH: "reaches",
             status.EXPLORE: "explores"}.get(status.behaviour)  # fmt: skip
    progress = f", {status.progress} of {status.progress_total}" if doing else ""
    tool = f"tool {truth.tool}" if truth and truth.tool else "nothing"
    error = "no target"
    if status.error > 0:
        error = plain_number(status.error * (1 if scene.sees else 1e3)) + (
            " px" if scene.sees else " mm")  # fmt: skip
    return [
        f"{status.utime * 1e-6:.1f} s   {doing or names.get(status.state, '?')}{progress}",
        f"in the hand: {tool}",
        f"context in use: {status.context or 'none'} of {status.contexts},"
        f" {status.experts} experts, {status.samples} samples",
        f"distance to the target: {error}",
        f"body: {body_words(status)}",
        operator.said,
    ]


def _write(canvas, scene: Scene, operator: Operator, panel: Panel) -> None:
    x, y = panel.left + 14, panel.top + 12
    width = panel.width - 24
    for number, line in enumerate(words(scene, operator)):
        for part in _wrapped(line, font(15), width):
            canvas.text((x, y), part, font=font(15), fill=INK)
            y += 21
        y += 6 if number == 0 else 0
    parts = _wrapped(operator.keys, font(13), width)
    y = panel.top + panel.height - 8 - 18 * len(parts)
    for part in parts:
        canvas.text((x, y), part, font=font(13), fill=PALE)
        y += 18


def _wrapped(text: str, face, width: int) -> list[str]:
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if face.getlength(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines
