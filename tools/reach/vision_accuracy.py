"""`./run accuracy --only vision`: how often the ball is found in hard pictures, and how exactly.

build/bin/hard-pictures draws them, always the same, and lets reach-vision and two usual chains of
OpenCV's functions look. What remains in the folder: vision.json, vision.md.
"""

import argparse
import json
import subprocess

from .evaluation import EvaluationError
from .programs import BINARIES

STUDY = "vision"
COUNT = 60
QUICK_COUNT = 12
HEAD = ("found", "missed", "wrong", "error")


def _cells(chain: dict) -> str:
    error = chain["error_median_px"]
    return (f"{chain['found']} / {chain['missed']} / {chain['wrong']}"
            f" | {'' if error is None else f'{error:.2f}'}")  # fmt: skip


def _sum(rows: dict, name: str) -> dict:
    """All rows' counts; the error is the median of the rows'."""
    chains = [row[name] for row in rows.values()]
    total = {key: sum(chain[key] for chain in chains) for key in HEAD[:3]}
    errors = sorted(c["error_median_px"] for c in chains if c["error_median_px"] is not None)
    return total | {"error_median_px": errors[len(errors) // 2] if errors else None}


def table(rows: dict) -> str:
    names = list(next(iter(rows.values())))
    rows = rows | {"all": {name: _sum(rows, name) for name in names}}
    lines = [
        "| pictures | " + " | ".join(f"{name} | px" for name in names) + " |",
        "|---|" + "---|---|" * len(names),
    ]
    lines += [f"| {title} | " + " | ".join(_cells(row[name]) for name in names) + " |"
              for title, row in rows.items()]  # fmt: skip
    return "\n".join(lines) + "\n\nfound / missed / wrong, and the centre's median error\n"


def run(options: argparse.Namespace) -> dict:
    options.out.mkdir(parents=True, exist_ok=True)
    numbers = options.out / "vision.json"
    command = [BINARIES / "hard-pictures", "--count", options.draws, "--json", numbers]
    if subprocess.run(list(map(str, command))).returncode != 0:
        raise EvaluationError("hard-pictures failed")
    rows = json.loads(numbers.read_text())
    (options.out / "vision.md").write_text(table(rows))
    return rows
