"""report.html: the run's figures beside the paper's numbers, in one file that opens from disk."""

import html
import re
from pathlib import Path

from . import figures, metrics, page
from .record import Record

_STAR_LIMITS = {"median": 2.0, "max": 5.0}  # px
_RMSE_FACTOR = 1.5  # of the paper's percentages


def write(out: Path, record: Record, run: dict, result: dict) -> None:
    parts = ["<h2>What came out</h2>", _errors(result), _table(_rows(result)), _NOTES]
    shown = [
        ("What the eyes see", figures.eyes(out / "images"), _EYES),
        ("Learning", figures.learning(record, run, result), _LEARNING),
        ("Reaching: the STAR", figures.stars(record, run), _STARS),
        ("Reaching in time", figures.star_series(record, run), _SERIES),
        ("What it costs", figures.times(record), _TIMES),
    ]
    drawn = out / "figures"
    drawn.mkdir(exist_ok=True)
    for title, figure, caption in shown:
        if figure is not None:
            parts += [f"<h2>{title}</h2>", page.embed(figure, caption, title)]
            name = re.sub(r"\W+", "-", title.lower())
            figure.savefig(drawn / f"{name}.pdf", metadata={"CreationDate": None})
    parts += ["<h2>The run</h2>", _phases(run)]
    title = "A robot learns its arm, a rubber tube, and reaches with both"
    subtitle = (
        f"seed {result['seed']}, {result['learner']} experts, {run['samples']} samples"
        f" with the hand, {run.get('tool_samples', run['samples'])} with the tool;"
        f" {result['robot_seconds']:.0f} s of robot time in {result['wall']['seconds']:.0f} s"
        f" ({run['clock']} clock)"
    )
    (out / "report.html").write_text(page.whole(title, subtitle, parts))
    if (picture := figures.result(record, run, out / "images")) is not None:
        picture.savefig(out / "result.png", dpi=100)


def five_lines(out: Path, record: Record, result: dict) -> list[str]:
    hand, tool = (result["babbling"][name] for name in ("hand", "tool"))
    star, wall = result["star"], result["wall"]
    size = (out / "run.lcmlog").stat().st_size / 1e6
    reached = "; ".join(
        f"{name} median {star[name]['final_error_px']['median']:.1f},"
        f" worst {star[name]['final_error_px']['max']:.1f} px"
        for name in ("hand", "tool")
    )
    return [
        f"report   {out / 'report.html'}: open it in a browser; video {out / 'demo.mp4'}",
        f"summary  {out / 'summary.json'}: test errors hand {_list(hand['rmse_pct'])} %, tool"
        f" {_list(tool['rmse_pct'])} % of range (yaw, pitch, disparity)",
        f"log      {out / 'run.lcmlog'}: {result['robot_seconds']:.0f} s of robot time,"
        f" {size:.0f} MB",
        f"reaching final error over 16 targets: {reached}",
        f"speed    {wall['real_time_factor']:.1f} times real time; a tick takes"
        f" {wall['tick_us']['p999']:.0f} us, a stereo pair {wall['vision_us']['p999']:.0f} us"
        " (99.9 % of them at most)",
    ]


def _list(values) -> str:
    return "[" + " ".join("-" if v is None else f"{v:.2g}" for v in values) + "]"


_COMPONENTS = ("yaw", "pitch", "disparity")


def _errors(result: dict) -> str:
    """Errors of predictions on unseen configurations, a column for each component."""
    babbling = result["babbling"]
    units, shares = ("deg", "deg", "px"), ("%",) * 3
    rows = []
    for name in ("hand", "tool"):
        ours, paper = babbling[name], metrics.PAPER_RMSE_PCT[name]
        met = all(
            a <= _RMSE_FACTOR * b + 1e-9 for a, b in zip(ours["rmse_pct"], paper, strict=True)
        )
        rows += [
            (f"{name}, of the range", ours["rmse_pct"], paper, shares, met),
            (name, ours["rmse"], metrics.PAPER_RMSE[name], units, None),
            (f"{name}, against the truth", ours["rmse_true"], None, units, None),
        ]
    again = babbling["hand"]["final"]["rmse_pct"]
    rows.append(("hand again, after the tool, of the range", again, None, shares, None))
    if result["body"]:
        rest = result["body"]["not_rigid"]
        what = "motion that no rigid chain explains, with the tool of the last search"
        rows.append((what, rest, None, units, None))
    heads = ("test error", *_COMPONENTS, *(f"paper: {name}" for name in _COMPONENTS), "aim")
    cells = [
        (html.escape(what), *_cells(ours, units), *_cells(paper or (None,) * 3, units),
         page.mark(met))
        for what, ours, paper, units, met in rows
    ]  # fmt: skip
    return page.table(heads, cells)


def _cells(values, units) -> list[str]:
    return ["" if value is None else f"{value:.2g} {unit}"
            for value, unit in zip(values, units, strict=True)]  # fmt: skip


def _star_rows(star: dict) -> list[tuple]:
    rows = []
    for name in ("hand", "tool"):
        error, straight = star[name]["final_error_px"], star[name]["straightness"]
        met = error["median"] <= _STAR_LIMITS["median"] and error["max"] <= _STAR_LIMITS["max"]
        rows += [
            (f"STAR, {name}: final error, median / worst, px", "reached",
             f"{error['median']:.2f} / {error['max']:.2f}", met),
            (f"STAR, {name}: deviation from the straight line / its length, median / worst",
             "almost straight", f"{straight['median']:.3f} / {straight['max']:.3f}", None),
        ]  # fmt: skip
    return rows


def _rows(result: dict) -> list[tuple]:
    """(what, the paper's, ours, met or None)."""
    wall, found = result["wall"], result["body"]
    wrong = result["wrong_frames"] / max(1, result["frames"])
    return [
        *_star_rows(result["star"]),
        ("body: samples it was found from; error, of the noise; searches", "", _body(found), None),
        ("experts; contexts told apart; solutions on average", "", f"{result['experts']};"
         f" {result['contexts']}; {result['solutions_mean']:.2f}", None),
        *((f"vision's error of {what}, standard deviation, px", "about 2",
           f"{result['marker_error_px'][key]:.2g}", None)
          for what, key in (("u", "std_u"), ("v", "std_v"), ("disparity", "std_d"))),
        ("frames: all / ball missed / wrong", "",
         f"{result['frames']} / {result['missed_frames']} / {result['wrong_frames']}",
         wrong < 0.001),
        ("speed against real time", "", f"{wall['real_time_factor']:.2f}",
         wall["real_time_factor"] >= 2),
    ]  # fmt: skip


def _body(found: dict | None) -> str:
    if found is None:
        return "none"
    return f"{found['samples']}; {found['error']:.2f}; {found['searches']}"


def _table(rows: list[tuple]) -> str:
    """(what, the paper's, ours, met or None)."""
    cells = [(*map(html.escape, row[:3]), page.mark(row[3])) for row in rows]
    return page.table(("", "paper", "this run", "aim"), cells)


def _phases(run: dict) -> str:
    rows = [
        (phase["name"], "tube" if phase["tool"] else "hand", "yes" if phase["learn"] else "frozen",
         f"{(phase['end'] - phase['start']) * 1e-6:.0f} s", phase["skipped"], phase["experts"])
        for phase in run["phases"]
    ]  # fmt: skip
    heads = ("phase", "holding", "learning", "robot time", "given up", "experts after")
    return page.table(heads, rows)


_NOTES = """<p class="small">Aims: test errors at most 1.5 times the paper's percentages; STAR
median 2 px, every target within 5 px; wrong detections under 0.1 % of frames; twice real time.
Test configurations are unseen, visited with learning frozen; the prediction is the one that the
daemon acts on. Percentages are of the union of both test sets' ranges. Pixels do not compare with
the paper's, whose cameras differ.</p>"""
_EYES = """Both cameras at the end of the tests with the hand and with the tube. The circle is the
ball that vision found, the cross its centre; it saw nothing but these images."""
_LEARNING = """Errors of predictions made before each sample was learned (dots; line: root mean
square of the last three, or of up to ten where samples are many), hand first, then the tube, which
nobody announced to the daemon. Diamonds: the test sets. Dashed: the paper's final error as a
percentage of our range (figure 16)."""
_STARS = """The ball in the right image while the arm reaches for eight ends and back, the head at
rest (paper, figures 21 and 24). The true track is the simulator's, without noise."""
_SERIES = """Above: distance of the true ball to the present target in (u, v, disparity); dashed:
5 px. Below: all joints, against where they were when the STAR began."""
_TIMES = """Processor time of each control tick and of each stereo pair, decoding apart."""
