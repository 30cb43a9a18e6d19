"""`./run accuracy --only body` or `hard`: what `experts: body` and polynomials reach, side by side.

Each study (reach.body_studies, reach.hard_studies) is drawn with seeds from the commit's hash; both
learners learn the same files. What remains in the folder: body.json or hard.json, with .md, .html.
"""

import argparse
import json
import math
import subprocess
import tempfile
import zlib
from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from html import escape
from pathlib import Path

import numpy as np

from . import page
from .body_stream import BODY, POLYNOMIAL, BodyStudy, NeverWorse
from .body_studies import body_studies
from .evaluation import EvaluationError, reach_eval
from .hard_studies import hard_studies
from .kept_draws import KeptDraws
from .programs import ROOT
from .progress import Progress
from .studies import Bar
from .sweep.run_process import Told
from .sweep.sweep import Sweep

HARD = "hard"
TITLES = {BODY: "The learner on a body that it found", HARD: "The learner on hard streams"}
DRAWS = {BODY: 10, HARD: 3}
QUICK_DRAWS = 2


def commit() -> str:
    """The hash of the tree's commit; zeros where there is no git."""
    done = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else 40 * "0"


def seeds_of(hash_: str, draws: int) -> list[int]:
    state = np.random.SeedSequence(int(hash_[:12], 16)).generate_state(draws)
    return [int(seed) for seed in state]


BATCH = "batch"
AS_BATCH = 1.2  # a bar that no fit of the same rows can reach is that many times what one has


def evaluate(options: argparse.Namespace, seeds: list[int], name: str, draw: int,
             told: Told) -> dict:  # fmt: skip
    """reach-eval's results by learner (those of options.learners, or both) and number of samples: a
    run of a sweep, which makes the study anew."""
    (study,) = (s for s in studies_of(options.group, options.data) if s.name == name)
    # Workers elsewhere have no folder of this machine.
    kept = KeptDraws(None if options.scheduler else options.out / "draws", options.resume)
    return results_of(study, draw, seeds[draw], options, kept)


def results_of(
    study: BodyStudy, draw: int, seed: int, options: argparse.Namespace, kept: KeptDraws
) -> dict:
    rng = np.random.default_rng([zlib.crc32(study.name.encode()), seed])
    numbered = [draw] if study.numbered else []
    counts = sorted({bar.at for bar in study.bars})
    parameters = [*study.parameters, *options.param]
    results = {}
    with tempfile.TemporaryDirectory(prefix="reach-accuracy-") as name:
        folder, files = Path(name), None
        for learner, config in zip(study.columns, study.files, strict=True):
            if options.learners and learner not in options.learners:
                continue
            path, named = ROOT / "etc" / config, f"{study.name}-{seed}-{learner}"
            key = kept.key([draw, counts, parameters, str(options.data)], path)
            results[learner] = kept.read(named, key)
            if results[learner] is not None:
                continue
            if files is None:
                files = study.make(folder, rng, *numbered)
            results[learner] = reach_eval(study.dimensions, files, counts, folder / "report.json",
                                          config=path, parameters=parameters)  # fmt: skip
            kept.write(named, key, results[learner])
        if study.batch:
            results[BATCH] = study.batch(files or study.make(folder, rng, *numbered))
    return results


def _number(bar: Bar, results: dict[int, dict] | None) -> float:
    try:
        return math.nan if results is None else bar.of(results)
    except (KeyError, TypeError):  # nothing was answered, or it has no such number
        return math.nan


def _values(bars: list[Bar], learner: str, draws: list[dict]) -> list[float]:
    """One of each draw: the mean over bars of one name."""
    return [float(np.mean([_number(bar, draw.get(learner)) for bar in bars]))
            for draw in draws]  # fmt: skip


def _row(study: BodyStudy, bars: list[Bar], draws: list[dict]) -> dict:
    bar = bars[0]
    ours, theirs = (_values(bars, learner, draws) for learner in study.columns)
    batch = float(np.mean([draw.get(BATCH, {}).get(bar.name, math.nan) for draw in draws]))
    if not math.isnan(batch):
        bar = replace(bar, most=max(bar.most, AS_BATCH * batch))
    mean, other = float(np.mean(ours)), float(np.mean(theirs))
    if isinstance(bar, NeverWorse):
        bar = replace(bar, most=bar.share * other)
    return {
        "study": study.name, "what": study.what, "metric": bar.name, "unit": bar.unit,
        "mean": mean, "median": float(np.median(ours)), "values": ours,
        "batch": None if math.isnan(batch) else batch, "learner": study.columns[0],
        "beside": other, "beside_values": theirs,
        "bar": bar.most, "target": bar.target, "never_worse": isinstance(bar, NeverWorse),
        "share": getattr(bar, "share", None),
        "met": None if math.isinf(bar.most) else bool(bar.met(mean)),
        "draws_met": sum(bar.met(value) for value in ours),
    }  # fmt: skip


def rows_of(study: BodyStudy, draws: list[dict]) -> list[dict]:
    names = dict.fromkeys(bar.name for bar in study.bars)
    return [_row(study, [bar for bar in study.bars if bar.name == name], draws) for name in names]


def _short(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.3g}"


def _wanted(row: dict) -> str:
    if row["met"] is None:
        return ""
    if row["target"] is not None:
        return f"{row['target']:g} +- {row['bar']:g}" if row["bar"] else f"{row['target']:g}"
    if row["never_worse"]:
        return "as polynomials" if row["share"] == 1 else f"{row['share']:g} of polynomials"
    return f"at most {row['bar']:.3g}"


def _verdict(row: dict) -> str:
    if row["met"] is None:
        return ""
    words = "met" if row["met"] else "NOT met"
    return f"{words} ({row['draws_met']} of {len(row['values'])})"


WORDS = {BODY: "body", POLYNOMIAL: "polynomials"}


def heads(rows: list[dict]) -> list[str]:
    judged, beside = (BODY, POLYNOMIAL) if rows[0]["learner"] == BODY else (POLYNOMIAL, BODY)
    return ["study", "", WORDS[judged], "median, spread", WORDS[beside], "wanted", ""]


def cells_of(rows: list[dict]) -> list[list[str]]:
    cells, named = [], ""
    for row in rows:
        first = row["what"] if row["study"] != named else ""
        named = row["study"]
        spread = f"{_short(min(row['values']))} .. {_short(max(row['values']))}"
        spread = f"{_short(row['median'])}, {spread}"
        metric = row["metric"]
        metric += f" (batch fit: {_short(row['batch'])})" if row["batch"] is not None else ""
        cells.append([first, metric, f"{_short(row['mean'])} {row['unit']}", spread,
                      _short(row["beside"]), _wanted(row), _verdict(row)])  # fmt: skip
    return cells


def table(rows: list[dict]) -> str:
    lines: Iterable = [heads(rows), ["---"] * 7, *cells_of(rows)]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def _page(summary: dict) -> str:
    cells = [[escape(cell) for cell in cells] for cells in cells_of(summary["rows"])]
    subtitle = (f"commit {summary['commit'][:12]}, seeds {', '.join(map(str, summary['seeds']))};"
                " mean, median, least and greatest of the draws; RMSE a coordinate")  # fmt: skip
    return page.whole(
        TITLES[summary["group"]], subtitle, [page.table(heads(summary["rows"]), cells)]
    )


def studies_of(group: str, data: Path | None = None) -> list[BodyStudy]:
    return hard_studies() if group == HARD else body_studies(data)


def chosen_of(options: argparse.Namespace) -> list[BodyStudy]:
    names = [name for name in options.only if name != options.group]
    every = studies_of(options.group, options.data)
    if names:
        chosen = [study for study in every if study.name in names]
        without = [study.name for study in chosen if study.wants_data and options.data is None]
        if without:
            raise EvaluationError(f"{without[0]} wants --data DIR, the reference data")
        return chosen
    return [study for study in every
            if study.kept and (study.quick or not options.quick)
            and (options.data is not None or not study.wants_data)]  # fmt: skip


def _write(out: Path, summary: dict) -> None:
    out.mkdir(parents=True, exist_ok=True)
    name = summary["group"]
    (out / f"{name}.json").write_text(json.dumps(summary, indent=1) + "\n")
    (out / f"{name}.md").write_text(table(summary["rows"]))
    (out / f"{name}.html").write_text(_page(summary))


def run(options: argparse.Namespace, sweep: Sweep) -> list[dict]:
    chosen = chosen_of(options)
    seeds = seeds_of(options.commit or commit(), options.draws)
    summary = {"group": options.group, "commit": options.commit or commit(), "seeds": seeds,
               "quick": options.quick, "param": options.param, "rows": []}  # fmt: skip
    print(f"accuracy: seeds of commit {summary['commit'][:12]}: {', '.join(map(str, seeds))}")
    progress = Progress({s.name: max(bar.at for bar in s.bars) for s in chosen})
    for study in chosen:
        draws = min(options.draws, study.most_draws or options.draws)
        progress.update(study.name, 0.0, f"{draws} draws")
        found = sweep.map(study.name, partial(evaluate, options, seeds, study.name), draws,
                          progress, at_once=1 if study.alone else None)  # fmt: skip
        rows = rows_of(study, found)
        summary["rows"] += rows
        missed = [row["metric"] for row in rows if row["met"] is False]
        progress.finish(study.name, f"not met: {', '.join(missed)}" if missed else "all met")
        _write(options.out, summary)
    return summary["rows"]
