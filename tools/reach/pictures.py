"""What the eyes saw at a moment of the experiment, kept as PNG with the ball that vision found."""

import io
import json
from pathlib import Path

import numpy as np
from PIL import Image

from .bus import Bus

SECONDS = 0.2  # robot time in which several pairs come
RGB, BGR, GRAY, MJPEG = 859981650, 861030210, 1497715271, 1196444237


def take(bus: Bus, clock, out: Path, name: str) -> None:
    """Writes images/NAME-{left,right}.png and NAME.json, the marker found in them."""
    markers = {}
    bus.take_images(on=True)
    for _ in range(round(SECONDS / 0.02)):
        clock.advance(0.02)
        if bus.marker is not None:
            markers[bus.marker.utime] = bus.marker
    pairs = [p for p in bus.take_images(on=False) if p.utime in markers and p.n_images == 2]
    if not pairs:
        return  # the report then has no picture of this moment
    pair, folder = pairs[-1], out / "images"
    folder.mkdir(exist_ok=True)
    for side, image in zip(("left", "right"), pair.images, strict=True):
        Image.fromarray(decode(image)).save(folder / f"{name}-{side}.png")
    marker = markers[pair.utime]
    found = {
        key: getattr(marker, key) for key in ("seen", "u_right", "v_right", "disparity", "radius")
    }
    (folder / f"{name}.json").write_text(json.dumps(found))


def decode(image) -> np.ndarray:
    """A bot_core image as rows of RGB."""
    if image.pixelformat == MJPEG:
        return np.asarray(Image.open(io.BytesIO(bytes(image.data))).convert("RGB"))
    rows = np.frombuffer(bytes(image.data), np.uint8).reshape(image.height, image.row_stride)
    if image.pixelformat == GRAY:
        return np.repeat(rows[:, : image.width, None], 3, axis=2)
    pixels = rows[:, : 3 * image.width].reshape(image.height, image.width, 3)
    return pixels[:, :, ::-1].copy() if image.pixelformat == BGR else pixels
