"""`./run paper`: every experiment of the paper on the simulated robots, and one report.

A run, one robot with one learner and one seed, is a folder of its own in OUT/runs and is not done
again while its inputs stay the same. What remains in OUT: report.html, report.pdf, summary.json.
"""

import argparse
import os
import sys
from functools import partial
from pathlib import Path

from ..command_line import Parser
from ..programs import ROOT
from ..progress import Progress
from ..run_folder import claimed
from ..session import Stop
from ..sweep import add_options, count
from ..sweep.cluster import ClusterError
from ..sweep.sweep import Job, Sweep
from . import explore, icub, kobian, perform, practice, report, rows
from .plan import LEARNER_NAMES, Run, is_complete, learners_of, plan, version
from .replay import ReplayError

GROUPS = (kobian, icub, explore.ICUB, explore.KOBIAN, practice.WITHOUT, practice.WITH)
EXPERIMENTS = tuple(dict.fromkeys(name for group in GROUPS for name in group.EXPERIMENTS))


def parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(
        prog="./run paper", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    add = parser.add_argument
    add("--only", type=_experiments, default=EXPERIMENTS, metavar="K3[,K4]",
        help=f"only these experiments, of {','.join(EXPERIMENTS)}; default all")  # fmt: skip
    add("--seeds", type=count, metavar="N",
        help="number of seeds, each a run; default 5, with --quick 1")  # fmt: skip
    add("--learner", nargs="+", choices=LEARNER_NAMES, default=LEARNER_NAMES,
        help="body (ours, which ships), polynomial, linear (IMLE as published), lwpr;"
             " default all")  # fmt: skip
    add("--quick", action="store_true", help="few samples and one seed: a smoke check")
    add("--any-version", action="store_true",
        help="keep complete runs that other versions of the programs made")  # fmt: skip
    add_options(parser, len(os.sched_getaffinity(0)), "runs")
    add("--out", type=Path, default=ROOT / "out/paper",
        help="folder of the results; default %(default)s")  # fmt: skip
    options = parser.parse_args(arguments)
    options.seeds = options.seeds or (1 if options.quick else 5)
    options.out = options.out.resolve()
    return options


def _experiments(text: str) -> tuple[str, ...]:
    names = tuple(text.split(","))
    for name in names:
        if name not in EXPERIMENTS:
            raise argparse.ArgumentTypeError(f"{name}: one of {','.join(EXPERIMENTS)} is wanted")
    return names


def folder_of(options: argparse.Namespace, run: Run) -> Path:
    return options.out / "runs" / run.name


def do_missing(options: argparse.Namespace, runs: list[Run], stop: Stop) -> bool:
    """Performs what is not complete, measures what is not measured. False after a failure, of which
    the user is told."""
    present = version()
    missing = [run for run in runs if not is_complete(folder_of(options, run), run.inputs(present),
                                                      options.any_version)]  # fmt: skip
    print(f"paper: {len(runs)} runs, {len(runs) - len(missing)} of them complete", file=sys.stderr)
    progress = Progress({
        f"{run.name}/{phase}": seconds
        for run in missing for phase, seconds in run.group.weights(run.settings).items()
    })  # fmt: skip

    # What is complete lies here, and is measured here.
    todo = [run for run in runs if run in missing
            or not (options.scheduler or perform.measured(folder_of(options, run)))]  # fmt: skip
    if not todo:
        return True
    jobs = [Job(run.name, partial(perform.do, run, present if run in missing else None),
                folder_of(options, run)) for run in todo]  # fmt: skip
    with Sweep(options.jobs, stop, options.scheduler, perform.FAILURES) as sweep:
        outcome = sweep.do(jobs, progress, network=True)
    for remark in sorted(filter(None, set(outcome.results.values()))):
        print(f"paper: {remark}", file=sys.stderr)
    for name, why in outcome.failed.items():
        print(f"paper: {name}: {why}; complete runs are kept", file=sys.stderr)
    return not outcome.failed


def _asked(options: argparse.Namespace) -> list[rows.Row]:
    """The table's rows, each once."""
    every: dict[str, rows.Row] = {}
    for group in GROUPS:
        learners = learners_of(group, options.learner)
        lost = [rows.lost(name) for name in group.EXPERIMENTS]
        own = [row for name in learners for row in rows.of_learner(lost, name)]
        every |= {row.id: row for row in (*group.rows(learners), *own)}
    return [row for row in every.values() if row.experiment in options.only]


def _gaps(measured: dict[str, dict]) -> list[str]:
    return [f"{name}: its log lacks {lost} control steps: its numbers may be wrong"
            for name, run in measured.items() if (lost := run["wall"]["log_lost"])]  # fmt: skip


def conclude(options: argparse.Namespace, runs: list[Run]) -> None:
    """Summaries of the complete runs, the table, the report."""
    present = version()
    complete = [run for run in runs if is_complete(folder_of(options, run), run.inputs(present),
                                                   options.any_version)]  # fmt: skip
    measured = {run.name: perform.measure(run, folder_of(options, run)) for run in complete}
    table = rows.aggregate(_asked(options), measured.values())
    perform.write_json(options.out / "summary.json", table)
    gaps = _gaps(measured)
    report.write(options.out, table, complete, gaps, options)
    for gap in gaps:
        print(f"warning  {gap}")
    met = [row["met"] for row in table if row["met"] is not None]
    print(f"report   {options.out / 'report.html'}, the same for print: report.pdf")
    print(f"summary  {options.out / 'summary.json'}: {len(table)} rows; of {len(met)} with an aim"
          f" {sum(met)} met")  # fmt: skip
    for row in table:
        if row["met"] is False:
            value = "not measured" if row["mean"] is None else f"{row['mean']:.3g} {row['unit']}"
            print(f"not met  {row['id']}: {value}, wanted {row['bar']:g}")


def main(arguments: list[str] | None = None) -> int:
    options = parse(arguments)
    groups = [group for group in GROUPS if set(group.EXPERIMENTS) & set(options.only)]
    runs = plan(groups, options.learner, options.seeds, options.quick)
    try:
        with claimed(options.out):
            return work(options, runs)
    except OSError as error:
        print(f"paper: {error}", file=sys.stderr)
        return 1


def work(options: argparse.Namespace, runs: list[Run]) -> int:
    """Returns the exit code."""
    stop = Stop()
    try:
        status = 0 if do_missing(options, runs, stop) else 1
    except KeyboardInterrupt:
        print("\npaper: stopped; the same command goes on with the runs that are missing",
              file=sys.stderr)  # fmt: skip
        status = 130
    except ClusterError as error:
        print(f"paper: {error}; complete runs are kept", file=sys.stderr)
        status = 1
    stop.release()
    try:
        conclude(options, runs)
    except KeyboardInterrupt:
        print("\npaper: stopped; what was measured is kept", file=sys.stderr)
        return 130
    except (ReplayError, OSError) as error:
        print(f"paper: {error}", file=sys.stderr)
        return 1
    return status


if __name__ == "__main__":
    sys.exit(main())
