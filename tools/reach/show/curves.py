"""The curves of the last minute of the robot's time: errors on a logarithmic scale, contexts and
experts as steps. Where the tool changed there is a line."""

from itertools import pairwise

import numpy as np

from .drawing import DARK_LINE, GRID, INK, LIGHT_LINE, PALE, font
from .layout import Panel
from .scene import Scene

SECONDS = 60.0
ERRORS = {True: (0.1, 1000.0), False: (0.1, 1000.0)}  # px; mm
MARGINS = (52, 30, 12, 26)  # left, top, right, bottom


class _Axes:
    """From seconds and 0 .. 1 to pixels of a panel, with its frame drawn."""

    def __init__(self, canvas, scene: Scene, panel: Panel, title: str):
        left, top, right, bottom = MARGINS
        self.canvas = canvas
        self.box = (panel.left + left, panel.top + top, panel.left + panel.width - right,
                    panel.top + panel.height - bottom)  # fmt: skip
        now = scene.status.utime * 1e-6 if scene.status else 0.0
        self.end = max(now, SECONDS)
        canvas.text((self.box[0], panel.top + 8), title, font=font(13), fill=INK)
        for second in range(int(self.end - SECONDS) // 10 * 10, int(self.end) + 1, 10):
            if second >= self.end - SECONDS:
                x = self.x(second)
                canvas.line((x, self.box[1], x, self.box[3]), fill=GRID)
                canvas.text((x, self.box[3] + 4), f"{second}" + (" s" if second % 60 == 0 else ""),
                            font=font(11), fill=PALE, anchor="ma")  # fmt: skip
        for time, tool in scene.curves.tool:
            if time > self.end - SECONDS:
                x = self.x(time)
                canvas.line((x, self.box[1], x, self.box[3]), fill=PALE, width=2)
                canvas.text((x + 3, self.box[1] + 1), f"tool {tool}" if tool else "hand",
                            font=font(11), fill=PALE)  # fmt: skip

    def x(self, second: float) -> float:
        share = (second - self.end + SECONDS) / SECONDS
        return self.box[0] + share * (self.box[2] - self.box[0])

    def y(self, share: float) -> float:
        return self.box[3] - min(max(share, 0.0), 1.0) * (self.box[3] - self.box[1])

    def level(self, share: float, text: str) -> None:
        y = self.y(share)
        self.canvas.line((self.box[0], y, self.box[2], y), fill=GRID)
        self.canvas.text((self.box[0] - 6, y), text, font=font(11), fill=PALE, anchor="rm")

    def recent(self, points) -> list:
        """The newest come last; a point a pixel is enough."""
        kept, last = [], None
        for point in points:
            if point[0] > self.end - SECONDS and (x := int(self.x(point[0]))) != last:
                kept.append(point)
                last = x
        return kept


def draw_error(canvas, scene: Scene, panel: Panel) -> None:
    unit, factor = ("px", 1.0) if scene.sees else ("mm", 1e3)
    low, high = ERRORS[scene.sees]
    axes = _Axes(canvas, scene, panel, "")
    _legend(canvas, panel, (f"distance to the target, {unit}", DARK_LINE, "line"),
            (f"prediction off, {unit}", LIGHT_LINE, "dot"))  # fmt: skip

    def share(error: float) -> float:
        return float(np.log(max(error * factor, 1e-12) / low) / np.log(high / low))

    for decade in (0.1, 1, 10, 100, 1000):
        axes.level(share(decade / factor), f"{decade:g}")
    for time, error in axes.recent(scene.curves.wrong):
        x, y = axes.x(time), axes.y(share(error))
        canvas.ellipse((x - 3, y - 3, x + 3, y + 3), outline=LIGHT_LINE, width=2)
    before = None
    for time, error in axes.recent(scene.curves.error):
        point = None if np.isnan(error) else (axes.x(time), axes.y(share(error)))
        if point and before:
            canvas.line((*before, *point), fill=DARK_LINE, width=2)
        before = point


def draw_contexts(canvas, scene: Scene, panel: Panel) -> None:
    axes = _Axes(canvas, scene, panel, "")
    _legend(canvas, panel, ("context in use", DARK_LINE, "line"), ("experts", LIGHT_LINE, "dashes"))
    points = axes.recent(scene.curves.context)
    top = max([4, *(max(context, experts) for _, context, experts in points)])
    for level in range(0, top + 1, max(1, top // 4)):
        axes.level(level / (1.1 * top), str(level))
    for which, colour in ((1, DARK_LINE), (2, LIGHT_LINE)):  # the dashed one lies above
        for number, (a, b) in enumerate(pairwise(points)):
            x, y, next_x, next_y = (axes.x(a[0]), axes.y(a[which] / (1.1 * top)), axes.x(b[0]),
                                    axes.y(b[which] / (1.1 * top)))  # fmt: skip
            if which == 1 or number % 8 < 5 or y != next_y:
                canvas.line((x, y, next_x, y), fill=colour, width=2)
            if y != next_y and (which == 1 or next_y < y):
                canvas.line((next_x, y, next_x, next_y), fill=colour, width=2)


def _legend(canvas, panel: Panel, *entries) -> None:
    x, y = panel.left + MARGINS[0], panel.top + 15
    for text, colour, form in entries:
        if form == "dot":
            canvas.ellipse((x + 6, y - 4, x + 14, y + 4), outline=colour, width=2)
        else:
            canvas.line((x, y, x + (20 if form == "line" else 8), y), fill=colour, width=3)
            if form == "dashes":
                canvas.line((x + 12, y, x + 20, y), fill=colour, width=3)
        canvas.text((x + 26, y), text, font=font(12), fill=INK, anchor="lm")
        x += 26 + font(12).getlength(text) + 18
