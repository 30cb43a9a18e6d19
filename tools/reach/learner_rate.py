"""How fast reach-learner answers a client on the same machine.

    tools/netns.sh .venv/bin/python -m reach.learner_rate

Round trips of one Python client, with a model in memory and with one that is kept on disk, where an
update is answered when it is safe; then updates with 32 under way at once.
"""

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from .command_line import Parser
from .learner import Learner
from .processes import ProcessDiedError, Processes
from .programs import BINARIES, ROOT


def round_trips(call: Callable[[], object], count: int) -> str:
    """Median and 99th percentile of so many calls."""
    took = []
    for _ in range(count):
        start = time.perf_counter()
        call()
        took.append(time.perf_counter() - start)
    middle, late = np.percentile(took, (50, 99)) * 1e6
    return f"{middle:.0f} | {late:.0f} | {count / sum(took):.0f}"


def samples(inputs: int, outputs: int, count: int):
    """A smooth map with two values."""
    random = np.random.default_rng(1)
    z = random.uniform(-1, 1, (count, inputs))
    branch = random.integers(2, size=(count, 1))
    return z, np.sin(z.sum(axis=1, keepdims=True) + np.arange(outputs)) + 2 * branch


def measure(learner: Learner, count: int, where: str) -> None:
    zs, xs = samples(learner.inputs, learner.outputs, 4 * count)
    pairs = iter(zip(zs, xs, strict=True))
    row = f"| {where} | {{}} | {{}} |"
    print(row.format("update", round_trips(lambda: learner.update(*next(pairs)), count)))
    rest = list(pairs)
    start = time.perf_counter()
    learner.update_all(*zip(*rest, strict=True))
    rate = len(rest) / (time.perf_counter() - start)
    print(row.format("update, 32 under way", f"| | {rate:.0f}"))
    print(row.format("predict", round_trips(lambda: learner.predict(zs[0]), count)))
    print(row.format("predict_inverse", round_trips(lambda: learner.predict_inverse(xs[0]), count)))
    print(row.format("statistics", round_trips(lambda: learner.statistics, count)))
    print(f"| {where} | | | | {learner.statistics.experts} experts |")


def main() -> int:
    parser = Parser(prog="python -m reach.learner_rate", description=__doc__.splitlines()[0])
    parser.add_argument("--config", type=Path, default=ROOT / "etc/reach-learner.yaml")
    parser.add_argument("--count", type=int, default=1000, help="calls of each kind")
    options = parser.parse_args()
    print("| model | call | median [us] | 99 % [us] | a second |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for where, directory in (("in memory", ""), ("on disk", folder)):
            with Processes(Path(folder)) as processes:
                command = [BINARIES / "reach-learner", "--config", options.config, "--set",
                           f"model.directory={directory}"]  # fmt: skip
                processes.start("reach-learner", command)
                try:
                    measure(Learner(), options.count, where)
                    processes.check()
                except ProcessDiedError as error:
                    print(error, file=sys.stderr)
                    return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
