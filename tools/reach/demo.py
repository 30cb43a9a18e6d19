"""The experiment end to end: a robot learns its arm, then a rubber tool, and reaches with both."""

import argparse
import json
import shutil
import signal
import sys
import time
from pathlib import Path

from . import film, metrics, pictures, recording, report, run_folder, summary
from .bus import Bus, NoAnswerError
from .command_line import Parser
from .experiment import Experiment, ExperimentError
from .messages import ROOT
from .processes import ProcessDiedError
from .programs import LEARNERS, OURS
from .progress import Progress
from .record import read_log
from .recorder import ALL_BUT_IMAGES
from .session import Stop, session

TOOL = 1  # the simulator's first tool, the rubber tube
# Training samples with the hand and with the tool, and tests.
SIZES = (30, 10, 20)
SIZES_WITHOUT_BODY = (150, 150, 50)
BABBLE_SECONDS = 1.8  # robot time of a sample, about; for the time left


def parse_arguments(arguments: list[str] | None = None) -> argparse.Namespace:
    parser = Parser(prog="./run demo", description=__doc__)
    add = parser.add_argument
    add("--seed", type=int, default=1,
        help="random seed, which decides the whole run; default %(default)s")  # fmt: skip
    add("--out", type=Path, default=ROOT / "out/demo", help="folder of the results")
    add("--samples", type=_count,
        help="training samples with the hand; default 30, without a body 150")  # fmt: skip
    add("--tool-samples", type=_count,
        help="training samples with the tool; default 10, else as --samples")  # fmt: skip
    add("--tests", type=_count,
        help="unseen configurations to test with; default 20, without a body 50")  # fmt: skip
    add("--period", type=float, default=4.0, help="seconds for each target; default %(default)g")
    add("--experts", choices=(OURS, *LEARNERS), default=OURS,
        help="kind of experts, or lwpr for the rival learner; default %(default)s")  # fmt: skip
    add("--realtime", action="store_true", help="run in real time instead of as fast as possible")
    add("--keep-images", action="store_true", help="log the cameras too (some 100 kB a pair)")
    options = parser.parse_args(arguments)
    hand, tool, tests = SIZES if options.experts == OURS else SIZES_WITHOUT_BODY
    options.tool_samples = options.tool_samples or options.samples or tool
    options.samples = options.samples or hand
    options.tests = options.tests or tests
    return options


def _count(text: str) -> int:
    value = int(text)
    if not 1 <= value <= 100000:
        raise argparse.ArgumentTypeError("a number from 1 to 100000 is wanted")
    return value


def perform(experiment: Experiment, bus: Bus, clock, options: argparse.Namespace) -> None:
    """The protocol. Seeds of babbling differ between learning and testing, and between runs."""
    tests, base = options.tests, options.seed * 10
    targets = metrics.star_targets()
    experiment.babble("learn_hand", options.samples, base + 1, learn=True)
    experiment.babble("test_hand", tests, base + 2, learn=False)
    pictures.take(bus, clock, options.out, "hand")
    experiment.take_tool(TOOL)
    experiment.babble("learn_tool", options.tool_samples, base + 3, learn=True)
    experiment.babble("test_tool", tests, base + 4, learn=False)
    pictures.take(bus, clock, options.out, "tool")
    clock.begin("a STAR with the rubber tube")
    experiment.star("star_tool", targets, options.period)
    clock.end()
    experiment.take_tool(0)
    experiment.star("star_hand", targets, options.period)
    # The same configurations as test_hand: has learning the tool cost the hand anything?
    experiment.babble("retest_hand", tests, base + 2, learn=False)


def weights(options: argparse.Namespace) -> dict[str, float]:
    hand, tool = options.samples * BABBLE_SECONDS, options.tool_samples * BABBLE_SECONDS
    test = options.tests * BABBLE_SECONDS
    star = len(metrics.star_targets()) * options.period
    return {"learn_hand": hand, "test_hand": test, "learn_tool": tool, "test_tool": test,
            "star_tool": star, "star_hand": star, "retest_hand": test}  # fmt: skip


def run(options: argparse.Namespace, phases: list[dict]) -> None:
    """Performs the experiment; each phase that is complete is noted in `phases`."""
    learner = [LEARNERS[options.experts]] if options.experts != OURS else []
    with session(
        options.out, Stop(), seed=options.seed, configurations=learner,
        realtime=options.realtime, channels=".*" if options.keep_images else ALL_BUT_IMAGES,
        simrobot=("--view",),
    ) as (bus, clock):  # fmt: skip
        clock = film.FilmedClock(clock, bus, options.out / "demo.mp4")
        clock.rest()
        experiment = Experiment(bus, clock, Progress(weights(options)), phases)
        perform(experiment, bus, clock, options)


def prepare_folder(out: Path) -> None:
    """Old results must not be taken for those of this run."""
    run_folder.set_log_aside(out)
    for name in ("run.json", "summary.json", "report.html", "run.rrd", "demo.mp4"):
        (out / name).unlink(missing_ok=True)
    shutil.rmtree(out / "images", ignore_errors=True)


def write_json(path: Path, value: dict) -> None:
    path.write_text(json.dumps(value, indent=2) + "\n")


def describe(options: argparse.Namespace, phases: list[dict], seconds: float) -> dict:
    return {
        "seed": options.seed,
        "samples": options.samples,
        "tool_samples": options.tool_samples,
        "tests": options.tests,
        "experts": options.experts,
        "clock": "real" if options.realtime else "lockstep",
        "phases": phases,
        "wall_seconds": round(seconds, 1),
    }


def conclude(options: argparse.Namespace) -> None:
    """Summary, report, and the five lines that say where they are and what they say."""
    out = options.out
    description = json.loads((out / "run.json").read_text())
    record = read_log(out / "run.lcmlog")
    result = summary.summarise(record, description)
    write_json(out / "summary.json", result)
    report.write(out, record, description, result)
    if lost := result["wall"]["log_lost"]:
        print(f"demo: the log lacks {lost} ticks: this machine was too busy to write them, and the"
              " summary may differ from that of another run", file=sys.stderr)  # fmt: skip
    if missing := recording.beside(out / "run.lcmlog"):
        print(f"demo: {missing}", file=sys.stderr)
    for line in report.five_lines(out, record, result):
        print(line)


def perform_and_report(options: argparse.Namespace, phases: list[dict]) -> None:
    start = time.monotonic()
    prepare_folder(options.out)
    run(options, phases)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    write_json(options.out / "run.json", describe(options, phases, time.monotonic() - start))
    conclude(options)


def kept(out: Path, phases: list[dict]) -> str:
    if not (out / "run.lcmlog").exists():
        return "nothing was kept"
    names = ", ".join(phase["name"] for phase in phases)
    done = f"complete: {names}" if names else "no phase was complete"
    return f"kept {out / 'run.lcmlog'} and the programs' logs beside it; {done}"


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    options.out = options.out.resolve()
    phases = []
    try:
        with run_folder.claimed(options.out):
            perform_and_report(options, phases)
    except run_folder.FolderInUseError as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"\ndemo: stopped; {kept(options.out, phases)}", file=sys.stderr)
        return 130
    except (ExperimentError, NoAnswerError, ProcessDiedError, OSError) as error:
        print(f"\ndemo: {error}; {kept(options.out, phases)}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
