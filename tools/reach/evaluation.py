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
               config: Path | None = None, parameters: Iterable[str] = (), *,
               rows: Path | None = None, timeout: float | None = None) -> dict:  # fmt: skip
    """What it says after each count. `rows` takes the last one's predictions; more than `timeout`
    seconds are an error."""
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
    command += ["--rows", rows] if rows else []
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True,
                              timeout=timeout)  # fmt: skip
    except subprocess.TimeoutExpired:
        raise EvaluationError(f"not done in {timeout:.0f} s") from None
    if done.returncode != 0:
        raise EvaluationError(done.stderr.strip())
    return {result["at"]: result for result in json.loads(report.read_text())["results"]}
