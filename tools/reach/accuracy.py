"""`./run accuracy`: how accurate the shipped learner is, on streams of our own making.

Every study (reach.studies) is drawn several times; build/bin/reach-eval learns and measures. What
remains in the folder: accuracy.json, table.md.
"""

import argparse
import json
import sys
import tempfile
import zlib
from functools import partial
from pathlib import Path

import numpy as np

from . import body_accuracy, vision_accuracy
from .body_accuracy import HARD
from .body_stream import BODY, POLYNOMIAL
from .command_line import Parser
from .curves import run as curves
from .evaluation import EvaluationError, reach_eval
from .paper.replay import ReplayError
from .programs import ROOT
from .progress import Progress
from .session import Stop
from .studies import Study, studies
from .sweep import add_options
from .sweep.run_process import Told
from .sweep.sweep import Sweep, SweepError


def evaluate(name: str, quick: bool, parameters: list[str], draw: int, told: Told) -> dict:
    """reach-eval's results by number of samples: a run of a sweep, which makes the study anew."""
    (study,) = (study for study in studies(quick) if study.name == name)
    seed = [zlib.crc32(study.name.encode()), draw]
    counts = sorted({bar.at for bar in study.bars})
    with tempfile.TemporaryDirectory(prefix="reach-accuracy-") as name:
        folder = Path(name)
        files = study.make(folder, np.random.default_rng(seed))
        return reach_eval(study.dimensions, files, counts, folder / "report.json",
                          parameters=[*study.parameters, *parameters])  # fmt: skip


def rows_of(study: Study, draws: list[dict]) -> list[dict]:
    rows = []
    for bar in study.bars:
        values = [float(bar.value(results[bar.at])) for results in draws]
        mean = float(np.mean(values))
        rows.append({
            "study": study.name, "metric": bar.name, "unit": bar.unit, "mean": mean,
            "std": float(np.std(values)), "least": min(values), "greatest": max(values),
            "n": len(values), "bar": bar.most, "target": bar.target, "met": bar.met(mean),
        })  # fmt: skip
    return rows


def table(rows: list[dict], what: dict[str, str]) -> str:
    lines = ["| study | | mean | spread | wanted | |", "|---|---|---|---|---|---|"]
    named = ""
    for row in rows:
        wanted = (f"at most {row['bar']:g}" if row["target"] is None
                  else f"{row['target']:g} +- {row['bar']:g}")  # fmt: skip
        study = what[row["study"]] if row["study"] != named else ""
        named = row["study"]
        lines.append(f"| {study} | {row['metric']} | {row['mean']:.3g} {row['unit']} |"
                     f" {row['least']:.3g} .. {row['greatest']:.3g} | {wanted} |"
                     f" {'met' if row['met'] else 'NOT met'} |")  # fmt: skip
    return "\n".join(lines) + "\n"


def run(options: argparse.Namespace, sweep: Sweep) -> list[dict]:
    chosen = [s for s in studies(options.quick)
              if (s.name in options.only if options.only else s.kept)]  # fmt: skip
    progress = Progress({s.name: max(bar.at for bar in s.bars) for s in chosen})
    rows: list[dict] = []
    for study in chosen:
        progress.update(study.name, 0.0, f"{options.draws} draws")
        draws = sweep.map(study.name, partial(evaluate, study.name, options.quick, options.param),
                          options.draws, progress)  # fmt: skip
        rows += rows_of(study, draws)
        missed = [row["metric"] for row in rows if row["study"] == study.name and not row["met"]]
        progress.finish(study.name, f"not met: {', '.join(missed)}" if missed else "all met")
        options.out.mkdir(parents=True, exist_ok=True)
        summary = {"draws": options.draws, "quick": options.quick, "param": options.param}
        summary["rows"] = rows
        (options.out / "accuracy.json").write_text(json.dumps(summary, indent=1) + "\n")
        (options.out / "table.md").write_text(table(rows, {s.name: s.what for s in chosen}))
    return rows


def _add_only(parser: Parser, names: list[str], groups: dict[str, list[str]]) -> None:
    parser.add_argument(
        "--only",
        nargs="+",
        choices=[
            *names,
            *(name for group in groups.items() for name in (group[0], *group[1])),
            vision_accuracy.STUDY,
        ],
        metavar="STUDY",
        default=[],
        help=f"run only these studies, of {', '.join(names)}; or those of experts on a body: all"
        f" ({BODY}), or of {', '.join(groups[BODY])}; or those of streams that are hard for"
        f" polynomials: all ({HARD}), or of {', '.join(groups[HARD])}; or hard pictures for"
        f" reach-vision: {vision_accuracy.STUDY}",
    )


def _add_of_groups(parser: Parser) -> None:
    """What studies of a body and hard ones take besides."""
    parser.add_argument(
        "--data",
        type=Path,
        metavar="DIR",
        help="of a body: the folder of the reference data, for their studies",
    )
    parser.add_argument(
        "--commit",
        metavar="HASH",
        help="of body and hard: draw the seeds from this hash; default: HEAD's",
    )
    parser.add_argument(
        "--learners",
        nargs="+",
        choices=[BODY, POLYNOMIAL],
        default=[],
        help="of body and hard: measure these alone; default both",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="of body and hard: leave out the draws that a run before has measured with the same"
        " program, files and options; OUT/draws has them",
    )


def _parser(names: list[str], groups: dict[str, list[str]]) -> argparse.ArgumentParser:
    parser = Parser(prog="./run accuracy", description=__doc__.splitlines()[0])
    parser.add_argument(
        "--draws",
        type=int,
        help="draws of every study; default 5, of a body 10, of hard 3, or 2 with --quick; pictures"
        f" of each kind; default {vision_accuracy.COUNT}, or {vision_accuracy.QUICK_COUNT} with"
        " --quick",
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="use a fifth of the samples; of a body run the cheap studies",
    )
    _add_only(parser, names, groups)
    parser.add_argument(
        "--curves",
        action="store_true",
        help="draw errors of four learners against samples instead: curves.svg",
    )
    parser.add_argument(
        "--param",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="set a parameter of the learner; may be repeated",
    )
    _add_of_groups(parser)
    add_options(parser, 2, "draws")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "accuracy")
    return parser


def parse(arguments: list[str] | None) -> argparse.Namespace:
    groups = {group: [study.name for study in body_accuracy.studies_of(group)]
              for group in (BODY, HARD)}  # fmt: skip
    parser = _parser([study.name for study in studies(True)], groups)
    options = parser.parse_args(arguments)
    options.vision = options.only == [vision_accuracy.STUDY]
    if vision_accuracy.STUDY in options.only and not options.vision:
        parser.error(f"{vision_accuracy.STUDY} runs on its own")
    asked = {next((g for g, names in groups.items() if name == g or name in names), None)
             for name in options.only}  # fmt: skip
    if len(asked) > 1:
        parser.error("studies of a body, and hard ones, run on their own")
    options.group = asked.pop() if asked else None
    if options.curves and (options.only or options.param):
        parser.error("--curves has no studies and no parameters to choose")
    if options.draws is None and options.vision:
        options.draws = vision_accuracy.QUICK_COUNT if options.quick else vision_accuracy.COUNT
    if options.draws is None:
        options.draws = (
            5
            if options.group is None
            else body_accuracy.QUICK_DRAWS
            if options.quick
            else body_accuracy.DRAWS[options.group]
        )
    if options.draws < 1:
        parser.error("--draws must be at least 1")
    if options.scheduler and (options.vision or options.data or options.resume):
        parser.error(
            "--scheduler has no pictures for vision, no reference data, no draws to resume"
        )
    return options


def measure(options: argparse.Namespace) -> None:
    """What reach-eval measures."""
    failures = (EvaluationError, ReplayError, OSError)
    with Sweep(options.jobs, Stop(), options.scheduler, failures) as sweep:
        if options.curves:
            picture = curves.run(options, sweep)
            print(f"accuracy: {picture} shows them, curves.json beside it has them")
        else:
            (body_accuracy.run if options.group else run)(options, sweep)


def main(arguments: list[str] | None = None) -> int:
    options = parse(arguments)
    try:
        if options.vision:
            vision_accuracy.run(options)
        else:
            measure(options)
    except (EvaluationError, SweepError, OSError) as error:
        print(f"accuracy: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\naccuracy: stopped; studies that were complete are written", file=sys.stderr)
        return 130
    if options.curves:
        return 0
    group = vision_accuracy.STUDY if options.vision else options.group
    name, numbers = (f"{group}.md", f"{group}.json") if group else ("table.md", "accuracy.json")
    print((options.out / name).read_text(), end="")
    print(f"accuracy: {options.out}/{numbers} has every number")
    return 0


if __name__ == "__main__":
    sys.exit(main())
