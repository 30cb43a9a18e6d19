"""Colours and letters of the picture. Lines differ in lightness and form, not in colour alone."""

from functools import cache
from importlib.util import find_spec
from pathlib import Path

from PIL import ImageFont

PAPER, INK, PALE, GRID = (250, 250, 247), (25, 25, 30), (110, 110, 115), (222, 222, 222)
DARK_LINE, LIGHT_LINE = (20, 60, 140), (230, 130, 30)


@cache
def font(size: int) -> ImageFont.FreeTypeFont:
    """Matplotlib brings one along; to import it for that would take half a second."""
    place = Path(find_spec("matplotlib").origin).parent / "mpl-data/fonts/ttf/DejaVuSans.ttf"
    return ImageFont.truetype(str(place), size)


def plain_number(value: float) -> str:
    """Three digits at most where there is room for a few letters."""
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"
