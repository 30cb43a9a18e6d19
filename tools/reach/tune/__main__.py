"""Finds parameters of the learner for samples of your own, and says how good they are.

DATA: CSV files (inputs, then outputs; plain or gzip) or logs of reachd (.lcmlog), in their order.
What remains in OUT: learner.yaml, with a comment to each line, and report.html."""

import argparse
import sys
import time
from pathlib import Path

from ..command_line import Parser
from ..evaluation import EvaluationError
from ..programs import BINARIES, ROOT
from ..progress import Progress
from .columns import Look, look_at
from .data import DataError, Samples, read
from .parts import Parts, counts_up_to, split, thin
from .settings import Settings, start_for, yaml_of

_SEARCH_SHARE = 0.6  # of the time
_BODY_SHARE = 0.2
_MOST_TRIALS = 400
_MOST_ROWS = 50_000  # some ten seconds to learn


def parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="reach-tune", usage="reach-tune DATA... [--minutes M] [options]",
                    description=__doc__,
                    formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    add = parser.add_argument
    add("data", nargs="+", type=Path, metavar="DATA", help="CSV files or logs")
    add("--minutes", type=_positive(float), default=5.0, metavar="M",
        help="time to spend; default %(default)g")  # fmt: skip
    add("--trials", type=_positive(int), default=_MOST_TRIALS, metavar="N",
        help="most trials; default %(default)s")  # fmt: skip
    add(
        "--inputs", type=_positive(int), metavar="d", help="number of input columns, the first ones"
    )
    add("--outputs", type=_positive(int), metavar="D",
        help="number of output columns after them; default: the last three columns")  # fmt: skip
    add("--no-body", action="store_true", help="do not look for a chain of joints")
    add("--out", type=Path, default=ROOT / "out/tune", help="folder; default %(default)s")
    return parser.parse_args(arguments)


def _positive(kind):
    def number(text: str):
        try:
            value = kind(text)
        except ValueError:
            value = 0
        if not value > 0:
            raise argparse.ArgumentTypeError(f"'{text}' is not a number above 0")
        return value

    return number


def say_columns(samples: Samples, look: Look) -> None:
    order = "one walk" if look.is_walk else "independent postures"
    print(f"{len(samples)} rows ({order}), {samples.inputs} inputs and {samples.outputs} outputs:")
    for role, columns in (("input", look.inputs), ("output", look.outputs)):
        for column in columns:
            print(f"  {role:6} {column.name:12} {column.least:10.4g} .. {column.most:<10.4g} "
                  f"{column.guess}")  # fmt: skip
    for remark in look.remarks:
        print(f"  look at this: {remark}")


def tune(options: argparse.Namespace, parts: Parts, look: Look, progress: Progress):
    """The best settings, and the scores of all trials."""
    from . import search  # wants Optuna

    seconds = 60 * options.minutes
    work = options.out / "work"
    all_rows = search.make_search(work / "all", parts.learn, parts.choose, look)
    start = time.monotonic()
    all_rows.take(all_rows.try_out(start_for(look)))
    rows = search.rows_that_fit(time.monotonic() - start, len(parts.learn), _SEARCH_SHARE * seconds)
    thinned = search.make_search(work / "some", thin(parts.learn, rows), parts.choose, look)
    search.look_for(thinned, _SEARCH_SHARE * seconds, options.trials, progress)
    if not thinned.tried:
        raise EvaluationError("no trial came to an end")
    search.compare_on_all(thinned, all_rows, progress)
    if look.may_be_a_body and not options.no_body:
        more = search.make_search(work / "more", parts.both, parts.choose, look)
        search.try_body(all_rows, more, _BODY_SHARE * seconds, progress)
    return all_rows.best()[0].settings, [tried.score for tried in thinned.tried]


def judge(options: argparse.Namespace, parts: Parts, look: Look, best: Settings,
          scores: list[float], progress: Progress):  # fmt: skip
    """Everything that the page shows."""
    from . import report, rivals, search

    origin = f"Written by reach-tune from {', '.join(path.name for path in options.data)}."
    text = yaml_of(best, look, origin)
    config = options.out / "learner.yaml"
    config.write_text(text)
    bench = search.make_search(options.out / "work/judge", parts.both, parts.judge, look).bench
    counts = counts_up_to(len(parts.both))
    progress.update("judging", 0.0, "learning once more, and the other methods")
    before = search.write_yaml(bench.folder / "before.yaml", start_for(look), look, "the recipe")
    outcome = report.Outcome(
        [path.name for path in options.data], look, parts, bench, bench.measure(config, counts),
        bench.measure(before, counts), rivals.compare(parts.both, parts.judge), scores, config,
        text,
    )  # fmt: skip
    report.write(options.out / "report.html", outcome)
    progress.finish("judging", f"{len(parts.judge)} rows that no trial has seen")
    return outcome


def say_outcome(options: argparse.Namespace, outcome) -> None:
    from . import report

    print(f"{'':32} {'RMSE':>9} {'median':>9} {'95 %':>9} {'solutions':>9}")
    for name, _, rmse, median, p95, solutions in report.rows_of(outcome):
        print(f"{name:32} {rmse:>9} {median:>9} {p95:>9} {solutions:>9}")
    for warning in outcome.found.warnings:
        print(f"warning: {warning}")
    print(f"parameters {outcome.config}")
    print(f"report     {options.out / 'report.html'}: open it in a browser")


def main(arguments: list[str] | None = None) -> int:
    options = parse(arguments)
    try:
        import optuna  # noqa: F401
        import sklearn  # noqa: F401
    except ImportError:
        print("reach-tune: optuna or scikit-learn is missing; ./run tune installs them",
              file=sys.stderr)  # fmt: skip
        return 1
    if not (BINARIES / "reach-eval").exists():
        print(f"reach-tune: there is no {BINARIES / 'reach-eval'}; ./run build", file=sys.stderr)
        return 1
    try:
        samples = read(options.data, options.inputs, options.outputs)
        options.out.mkdir(parents=True, exist_ok=True)
        if len(samples) > _MOST_ROWS:
            print(f"{len(samples)} rows: {_MOST_ROWS} of them are used, in stretches")
            samples = thin(samples, _MOST_ROWS)
        look = look_at(samples)
        say_columns(samples, look)
        parts = split(samples)
        progress = Progress({"search": _SEARCH_SHARE, "body": _BODY_SHARE, "judging": 0.2})
        best, scores = tune(options, parts, look, progress)
        say_outcome(options, judge(options, parts, look, best, scores, progress))
    except (DataError, EvaluationError, OSError) as error:
        print(f"reach-tune: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("reach-tune: ended before the report", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
