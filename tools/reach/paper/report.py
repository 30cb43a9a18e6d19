"""report.html and report.pdf: every figure redrawn beside its numbers, and the whole table."""

import argparse
import html
from datetime import date
from pathlib import Path

from matplotlib.backends.backend_pdf import PdfPages

from .. import page
from .drawing import Data, Shown
from .pdf import figure_page, table_pages
from .plan import Run, version

_INTRO = """<p>Each figure of the paper's results redrawn from the simulated robots, beside the
paper's numbers. <i>Ours</i> is the mean over seeds, with their standard deviation. Pixels do not
compare with the paper's, whose cameras differ; percent of range do. The truth is the simulator's
and reaches neither daemon nor vision. docs/paper.md says how each number is measured.</p>"""
_HEADS = ("", "paper", "ours", "aim", "")


def write(out: Path, table: list[dict], runs: list[Run], warnings: list[str],
          options: argparse.Namespace) -> None:  # fmt: skip
    """From the complete runs; a figure whose runs are missing is named as missing."""
    drawn, missing = _draw(out, runs, options)
    parts = [_INTRO, _runs(runs, options)]
    parts += [f"<p><b>{html.escape(warning)}.</b></p>" for warning in warnings]
    if missing:
        parts.append(f"<p>Not there yet: figures {html.escape(', '.join(missing))}.</p>")
    title = "The paper's experiments, redrawn"
    with PdfPages(out / "report.pdf", metadata={"CreationDate": None}) as pdf:
        for shown, figure, data in drawn:
            rows = rows_of(shown, table)
            parts += _section(shown, figure, rows, data, out)
            pdf.savefig(figure_page(shown, figure, [cells(row, words) for row in rows]))
        for sheet in table_pages([named(row) for row in table], _HEADS):
            pdf.savefig(sheet)
    parts += ["<h2>Everything in one table</h2>", _table(table, with_id=True)]
    subtitle = html.escape(f"{version()}; {date.today().isoformat()}")
    (out / "report.html").write_text(page.whole(title, subtitle, parts))


def _draw(out: Path, runs: list[Run], options: argparse.Namespace) -> tuple[list, list[str]]:
    drawn, missing = [], []
    for group in dict.fromkeys(run.group for run in runs):
        data = Data()
        for run in runs:
            if run.group is group:
                folder = out / "runs" / run.name / "series"
                data.folders.setdefault(run.learner, []).append(folder)
        for shown in group.figures(options.only):
            if data.has(shown.learner):
                drawn.append((shown, shown.draw(data), data))
            else:
                missing.append(shown.number)
    return drawn, missing


def rows_of(shown: Shown, table: list[dict]) -> list[dict]:
    """In the order in which the figure names them."""
    return [row for start in shown.rows for row in table if row["id"].startswith(start)]


def _section(shown: Shown, figure, rows: list[dict], data: Data, out: Path) -> list[str]:
    title = f"Figure {shown.number}: {shown.title}"
    paths = [data.path(name, shown.learner) for name in shown.series]
    links = ", ".join(f'<a href="{path.relative_to(out)}">{path.name}</a>'
                      for path in paths if path.exists())  # fmt: skip
    caption = f"{html.escape(shown.caption)} Series: {links}."
    return [f"<h2>{html.escape(title)}</h2>", page.embed(figure, caption, title),
            _table(rows) if rows else ""]  # fmt: skip


def _table(rows: list[dict], with_id: bool = False) -> str:
    lines = []
    for row in rows:
        what, paper, ours, aim, _ = cells(row, html.escape)
        if with_id:
            what = f"<code>{html.escape(row['id'])}</code><br>{what}"
        lines.append((what, paper, ours, aim, page.mark(row["met"])))
    return page.table(_HEADS, lines)


def words(text: str) -> str:
    return text


def named(row: dict) -> tuple[str, ...]:
    """Its cells with the id in the metric's place."""
    unit = f", {row['unit']}" if row["unit"] else ""
    return (row["id"] + unit, *cells(row, words)[1:])


def cells(row: dict, escape) -> tuple[str, str, str, str, str]:
    """A row of the table as text: metric, paper's, ours, aim, verdict."""
    paper, unit = row["paper"], row["unit"]
    metric = row["metric"] + (f", {unit}" if unit else "")
    paper = "" if paper is None else paper if isinstance(paper, str) else f"{paper:g}"
    ours = "not measured"
    if row["mean"] is not None:
        spread = f" ± {row['std']:.2g}" if row["n"] > 1 else ""
        ours = f"{row['mean']:.3g}{spread} (n = {row['n']})"
    aim = "" if row["bar"] is None else f"{row['bar']:g}"
    verdict = {True: "met", False: "not met"}.get(row["met"], "")
    return escape(metric), escape(paper), escape(ours), aim, verdict


def _runs(runs: list[Run], options: argparse.Namespace) -> str:
    if not runs:
        return "<p>No run is complete.</p>"
    names = ", ".join(f'<a href="runs/{run.name}">{run.name}</a>' for run in runs)
    sizes = "few samples (--quick): the numbers are no results" if options.quick else "full size"
    return f"<p>{len(runs)} complete runs, {sizes}: {names}.</p>"
