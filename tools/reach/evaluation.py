"""Calls build/bin/reach-eval, which learns and measures."""

import json
import subprocess
from collections.abc import Iterable
from pathlib import Path

from .programs import BINARIES
from .studies import Files


class EvaluationError(Exception):
    """One line for the user."""


def reach_eval(dimensions: tuple[int, int], files: Files, counts: list[int], report: Path,
               config: Path | None = None, parameters: Iterable[str] = ()) -> dict:  # fmt: skip
    """What it says after each count."""
    command = [BINARIES / "reach-eval", "--learner", "imle", "--quiet",
               "--inputs", dimensions[0], "--outputs", dimensions[1],
               "--train", ",".join(map(str, files.train)),
               "--at", ",".join(map(str, counts)), "--json", report]  # fmt: skip
    command += ["--config", config] if config else []
    for option, paths in (("--test", files.test), ("--track", files.track)):
        for key, path in paths.items():
            command += [option, f"{key}={path}"]
    for parameter in parameters:
        command += ["--param", parameter]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode != 0:
        raise EvaluationError(done.stderr.strip())
    return {result["at"]: result for result in json.loads(report.read_text())["results"]}
