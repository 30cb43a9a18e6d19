"""Draws robots, learns, writes OUT/curves.json and OUT/curves.svg."""

import argparse
import json
from pathlib import Path

from ..progress import Progress
from ..sweep.run_process import Told
from ..sweep.sweep import Sweep
from . import picture, study


def table(draws: list[dict]) -> str:
    """Means over the draws at some counts."""
    lines = ["| % of range | " + " | ".join(study.LEARNERS) + " |",
             "|---|" + "---|" * len(study.LEARNERS)]  # fmt: skip
    for name, _, _, counts in picture.PANELS:
        for count in (1, 10, 30, 100, 500):
            if count in counts:
                at = counts.index(count)
                means = [picture.curve(draws, learner, name)[:, at].mean()
                         for learner in study.LEARNERS]  # fmt: skip
                numbers = " | ".join(f"{mean:.2g}" for mean in means)
                lines.append(f"| {name}, after {count} | {numbers} |")
    return "\n".join(lines) + "\n"


def draw(number: int, told: Told) -> dict:
    """A run of a sweep."""
    return study.draw(number)


def run(options: argparse.Namespace, sweep: Sweep) -> Path:
    """Returns where the picture is."""
    draws = sweep.map("draw", draw, options.draws, Progress({}))
    options.out.mkdir(parents=True, exist_ok=True)
    numbers = {"hand": study.HAND, "tube": study.TUBE, "draws": draws}
    (options.out / "curves.json").write_text(json.dumps(numbers, indent=1) + "\n")
    picture.write(options.out / "curves.svg", draws)
    print(table(draws), end="")
    return options.out / "curves.svg"
