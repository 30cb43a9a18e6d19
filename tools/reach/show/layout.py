"""Where everything is in the picture: the eyes and views above, curves and words below."""

from dataclasses import dataclass

WIDTH, HEIGHT = 1280, 720
IMAGE = (640, 480)  # of a camera


@dataclass(frozen=True)
class Panel:
    name: str
    title: str
    left: int
    top: int
    width: int
    height: int


@dataclass(frozen=True)
class Layout:
    images: tuple[Panel, ...]
    error: Panel
    contexts: Panel
    words: Panel

    def at(self, x: int, y: int) -> tuple[str | None, float, float]:
        """The image there, and the place in it in px from its centre; None: no image."""
        for panel in self.images:
            across, down = x - panel.left, y - panel.top
            if 0 <= across < panel.width and 0 <= down < panel.height:
                scale = IMAGE[0] / panel.width
                return panel.name, scale * across - IMAGE[0] / 2, scale * down - IMAGE[1] / 2
        return None, 0.0, 0.0


def layout(sees: bool) -> Layout:
    """For a robot with eyes: three images, and all else below. For one that is seen from outside
    alone two larger ones, and words beside them."""
    if sees:
        titles = {"left_eye": "left eye", "right_eye": "right eye", "left_view": "from outside"}
        width, height = WIDTH // 3, 320
        split, words = 480, Panel("words", "", 2 * width, height, width, HEIGHT - height)
        end = 2 * width
    else:
        titles = {"left_view": "from its left", "right_view": "from its right"}
        width, height = 480, 360
        split, words = 760, Panel("words", "", 2 * width, 0, WIDTH - 2 * width, height)
        end = WIDTH
    images = tuple(
        Panel(name, title, i * width, 0, width, height)
        for i, (name, title) in enumerate(titles.items())
    )
    below = HEIGHT - height
    return Layout(
        images,
        Panel("error", "", 0, height, split, below),
        Panel("contexts", "", split, height, end - split, below),
        words,
    )
