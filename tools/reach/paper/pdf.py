"""Pages of report.pdf: a figure with its numbers under it, and the table."""

import textwrap

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

PAGE = (8.27, 11.69)  # A4, inches
ROWS = 46  # of the table on a page
_COLUMNS = (0.07, 0.60, 0.70, 0.86, 0.92)  # where metric, paper, ours, aim, verdict begin
_WIDTH = 82  # characters of a metric
_LINE = 0.018  # of the page's height


def figure_page(shown, figure: Figure, rows: list[tuple]) -> Figure:
    """The figure as it is, the rest as text on a taller page."""
    sheet = Figure(figsize=PAGE)
    sheet.text(0.07, 0.95, f"Figure {shown.number}: {shown.title}", weight="bold", size=13)
    picture = _picture(figure)
    height = 0.86 * PAGE[0] * picture.shape[0] / picture.shape[1] / PAGE[1]
    axis = sheet.add_axes((0.07, 0.93 - height, 0.86, height))
    axis.imshow(picture, aspect="auto", interpolation="antialiased")
    axis.set_axis_off()
    top = 0.91 - height
    for line in textwrap.wrap(shown.caption, 105):
        sheet.text(0.07, top, line, size=9)
        top -= _LINE
    _write(sheet, rows, top - _LINE)
    return sheet


def table_pages(rows: list[tuple], heads: tuple) -> list[Figure]:
    sheets = []
    for first in range(0, len(rows), ROWS):
        sheet = Figure(figsize=PAGE)
        sheet.text(0.07, 0.95, "Everything in one table", weight="bold", size=13)
        _write(sheet, [heads, *rows[first : first + ROWS]], 0.92)
        sheets.append(sheet)
    return sheets


def _write(sheet: Figure, rows: list[tuple], top: float) -> None:
    for row in rows:
        for x, cell in zip(_COLUMNS, row, strict=True):
            sheet.text(x, top, textwrap.shorten(cell, _WIDTH, placeholder=" ..."), size=7)
        top -= _LINE


def _picture(figure: Figure):
    figure.set_dpi(220)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())
