"""The page at the end: what came out, beside other methods on the same rows."""

import html
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import page
from ..version import VERSION
from . import draw
from .columns import Column, Look
from .data import Samples
from .parts import Parts
from .rivals import Rival
from .trial import Bench, Measured


@dataclass(frozen=True)
class Outcome:
    """All that the page tells of."""

    sources: list[str]
    look: Look
    parts: Parts
    bench: Bench  # of the judging rows
    found: Measured
    before: Measured
    rivals: list[Rival]
    scores: list[float]  # of the search, in order
    config: Path
    yaml: str


def rows_of(outcome: Outcome) -> list[tuple]:
    """(who, rows learned, RMSE, median, 95 %, solutions) of the judging rows."""
    bench = outcome.bench

    def line(name: str, learned: int, predicted: np.ndarray, solutions: str) -> tuple:
        distance = bench.distance(predicted)
        known = distance[np.isfinite(distance)]
        if not len(known):
            return name, learned, "-", "-", "-", solutions
        numbers = np.sqrt(np.mean(known**2)), *np.quantile(known, [0.5, 0.95])
        return name, learned, *(f"{number:.3g}" for number in numbers), solutions

    lines = []
    for name, measured in (("proposed", outcome.found), ("before", outcome.before)):
        solutions = f"{measured.solutions.mean():.2f}"
        for kind in ("closest", "strongest"):
            predicted = getattr(measured, kind)
            lines.append(line(f"{name}, {kind}", len(outcome.parts.both), predicted, solutions))
    return lines + [line(r.name, r.rows, r.predicted, "1") for r in outcome.rivals]


def write(path: Path, outcome: Outcome) -> None:
    found, before = outcome.found, outcome.before
    parts = [
        "<h2>What came out</h2>",
        page.table(("", "rows learned", "RMSE", "median", "95 %", "solutions"), rows_of(outcome)),
        _NOTES.format(judge=len(outcome.parts.judge)),
        _warnings(found.warnings),
        *_figure("Error against samples", _CURVE,
                 draw.curve(found, before, outcome.rivals, outcome.bench)),
        *_figure("Residuals by joint", _RESIDUALS,
                 draw.residuals(outcome.bench.distance(found.closest), outcome.parts.judge)),
        *_figure("Branches", _BRANCHES, draw.branches(found, before)),
        *_figure("The search", _SEARCH, draw.history(outcome.scores)),
        "<h2>The columns</h2>", _columns(outcome.look),
        "<h2>The parameters</h2>", f"<pre>{html.escape(outcome.yaml)}</pre>",
        "<h2>What to do with them</h2>",
        f"<pre>{html.escape(commands(outcome.config, outcome.parts.both))}</pre>",
    ]  # fmt: skip
    order = "one walk" if outcome.look.is_walk else "independent postures"
    subtitle = (
        f"{html.escape(', '.join(outcome.sources))}: {len(outcome.parts.both)} rows to learn,"
        f" {len(outcome.parts.judge)} to judge, {outcome.parts.both.inputs} inputs,"
        f" {outcome.parts.both.outputs} outputs, {order}; reach-tune {html.escape(VERSION)}"
    )
    path.write_text(page.whole("The learner on your samples", subtitle, parts))


def commands(config: Path, samples: Samples) -> str:
    d, D = samples.dimensions
    return (f"build/bin/reach-learner --config {config} --set inputs={d} --set outputs={D}\n"
            f"build/bin/reach-eval --learner imle --inputs {d} --outputs {D} --config {config} \\\n"
            "    --train FILE.csv --test new=OTHER.csv --json report.json")  # fmt: skip


def _figure(title: str, caption: str, figure) -> list[str]:
    return [f"<h2>{title}</h2>", page.embed(figure, caption, title)]


def _warnings(warnings: list[str]) -> str:
    return "".join(f'<p class="missed">{html.escape(warning)}</p>' for warning in warnings)


def _columns(look: Look) -> str:
    def row(column: Column, role: str) -> tuple:
        numbers = (
            f"{number:.4g}" for number in (column.least, column.low, column.high, column.most)
        )
        return html.escape(column.name), role, *numbers, html.escape(column.guess)

    rows = [row(c, "input") for c in look.inputs] + [row(c, "output") for c in look.outputs]
    heads = ("column", "", "least", "1 %", "99 %", "most", "unit (a guess)")
    remarks = "".join(f"<p>{html.escape(remark)}</p>" for remark in look.remarks)
    return page.table(heads, rows) + remarks


_NOTES = """<p class="small">Distances to the truth in {judge} rows that neither the learner nor
the search has seen, in the units of the outputs. Closest: of all solutions the nearest to the
truth, as a controller gets that knows its tool; strongest: the solution of largest weight. Before:
what the pages advise where nothing is known. The others learn one value for each posture, so that
data with several tools spoil them.</p>"""
_CURVE = """Median distance to the truth in the judging rows, after so many samples."""
_RESIDUALS = """Each dot is a judging row; lines: median and 95 % point along each input. A line
that rises at an end: too few samples there, or a scale that is too small."""
_BRANCHES = """A branch is one answer to a posture, such as that of one tool. Experts should be as
many as there are branches in the data, and solutions not more."""
_SEARCH = """Each dot is a trial: error in shares of the outputs' range, times the mean number of
solutions, of the best 95 % of the rows that choose."""
