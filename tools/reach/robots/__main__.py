"""Public arms, one after the other: does each load as it comes, does the simulator agree with
pinocchio, and does the arm learn and reach over its whole range? A table, in out/robots."""

import argparse
import sys
from pathlib import Path

from ..bus import NoAnswerError
from ..command_line import Parser
from ..messages import ROOT
from ..processes import ProcessDiedError
from . import measure, table
from .arms import OURS, PUBLIC, TEN, Public
from .packages import Packages, usual_folder

SETS = {"ours": OURS, "ten": [arm for arm in PUBLIC if arm.name in TEN], "all": PUBLIC}


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="./run robots", description=__doc__)
    add = parser.add_argument
    add(
        "--only",
        action="append",
        default=[],
        metavar="NAME",
        choices=[arm.name for arm in OURS + PUBLIC],
        help="this arm alone, even if it was measured already; may be repeated",
    )
    add(
        "--set",
        choices=SETS,
        default="all",
        help="which arms: ours of this tree, ten public ones, or all thirty; default %(default)s",
    )
    add("--out", type=Path, default=ROOT / "out/robots", help="folder of the results")
    add(
        "--cache", type=Path, default=usual_folder(), help="of what is fetched; default %(default)s"
    )
    add("--samples", type=int, default=300, help="to explore for; default %(default)s")
    add("--targets", type=int, default=12, help="of each arm; default %(default)s")
    add(
        "--experts",
        choices=tuple(measure.LEARNED),
        help="learn with these alone; default: with each kind anew",
    )
    add("--seed", type=int, default=1, help="which decides every run; default %(default)s")
    add(
        "--again",
        action="store_true",
        help="measure all anew, instead of going on where it was stopped",
    )
    add("--list", action="store_true", help="name the arms, and end")
    return parser.parse_args(arguments)


def chosen(options: argparse.Namespace) -> list[Public]:
    if options.only:
        return [arm for arm in OURS + PUBLIC if arm.name in options.only]
    return list(SETS[options.set])


def run(options: argparse.Namespace) -> list[measure.Row]:
    packages, rows = Packages(options.cache), []
    kinds = (options.experts,) if options.experts else tuple(measure.LEARNED)
    size = measure.Size(options.samples, options.targets, options.seed, kinds)
    arms = chosen(options)
    for i, arm in enumerate(arms, start=1):
        folder = options.out / arm.name
        result = folder / "row.json"
        folder.mkdir(parents=True, exist_ok=True)
        if options.again or options.only or not result.exists():
            print(f"robots: {arm.name}, {i} of {len(arms)}", file=sys.stderr)
            measure.write(measure.measure(arm, packages, folder, size), result)
        rows.append(measure.read(result))
    return rows


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    options.out = options.out.resolve()
    if options.list:
        print("\n".join(arm.name for arm in chosen(options)))
        return 0
    if any(not arm.ours for arm in chosen(options)) and not Packages(options.cache).complete:
        print(f"robots: {options.cache} lacks the packages; ./run robots fetches", file=sys.stderr)
        return 1
    try:
        rows = run(options)
    except KeyboardInterrupt:
        print("\nrobots: stopped; the same command goes on there", file=sys.stderr)
        return 130
    except (NoAnswerError, ProcessDiedError, OSError) as error:
        print(f"robots: {error}; the same command goes on there", file=sys.stderr)
        return 1
    text = table.of(rows, options.targets)
    (options.out / "table.md").write_text(text)
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
