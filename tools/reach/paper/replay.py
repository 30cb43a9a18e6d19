"""A recorded stream of samples, learned once more by reach-eval: curves of error against samples.

The learner is that of the daemon: its configuration files are translated to reach-eval's
parameters, whose names are those of struct learner_config. Angles of outputs are in degrees there:
reach-eval takes the solution for the closest whose outputs, all as they are, differ least, and
beside pixels a radian would count for nothing.
"""

import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml

from ..programs import BINARIES, LEARNERS, OURS, ROOT


class ReplayError(Exception):
    """One line for the user."""


@dataclass(frozen=True)
class Robot:
    """Configuration of the daemon, that of learners other than ours after it, and which of its
    options is the noise of each output."""

    configuration: Path
    overlays: dict[str, Path]
    noise: tuple[str, ...]

    @property
    def degrees(self) -> np.ndarray:
        """What a message's outputs are multiplied by for reach-eval."""
        return np.array([np.degrees(1) if name.endswith("_angle") else 1.0 for name in self.noise])


KOBIAN = Robot(
    ROOT / "etc/kobian.yaml",
    LEARNERS,
    ("noise_angle", "noise_angle", "noise_disparity"),
)
ICUB = Robot(
    ROOT / "etc/icub.yaml",
    LEARNERS | {name: ROOT / f"etc/icub-{name}.yaml" for name in ("linear", "lwpr")},
    ("noise_position",) * 3,
)

_LEARNER = "learner."
# All others have the same names for both.
_DAEMON_ONLY = {"kind", "queue", "quota", "body.order", "body.start", "body.tip"}
# Those of other shape or unit: standard deviations, degrees, and numbers of each output, of which a
# file may have those of other robots, too.
_CONVERTED = {"reach", "reference"}
_OF_OUTPUTS = ("noise_angle", "noise_disparity", "noise_position", "lwpr.norm_")


def options(robot: Robot, learner: str) -> dict:
    """The daemon's learner options, dotted, as they hold with the overlay over the robot's file."""
    files = [word for path in (robot.configuration, *overlays(robot, learner))
             for word in ("--config", path)]  # fmt: skip
    told = subprocess.run([BINARIES / "reachd", *files, "--check-config"], check=True,
                          capture_output=True, text=True).stdout  # fmt: skip
    options = yaml.safe_load(told)
    return {name.removeprefix(_LEARNER): value for name, value in options.items()
            if name.startswith(_LEARNER)}  # fmt: skip


def overlays(robot: Robot, learner: str) -> list[Path]:
    """Configuration of the daemon after the robot's."""
    return [] if learner == OURS else [robot.overlays[learner]]


def learners(robot: Robot) -> tuple[str, ...]:
    return (OURS, *robot.overlays)


def input_order(given: dict, n_inputs: int) -> list[int]:
    """Inputs in the order in which reach-eval gets them: experts on a body want the joints from the
    base to the tip, and the daemon's option that says so is none of reach-eval's."""
    has_body = given["kind"] == "imle" and given["experts"] == "body"
    order = given.get("body.order") if has_body else None
    return [number - 1 for number in order] if order else list(range(n_inputs))


def parameters(robot: Robot, given: dict) -> list[str]:
    """The same as reach-eval's NAME=VALUE."""
    is_lwpr = given["kind"] == "lwpr"
    norms = [name.replace("noise", "lwpr.norm") for name in robot.noise]
    result = {
        "psi0": [float(given[name]) ** 2 for name in robot.noise],
        "sigma0": float(given["reach"]) ** 2,
        "reference": [
            float(np.radians(float(given["reference"][i])))
            for i in input_order(given, len(given["reference"]))
        ],
    }
    if is_lwpr:
        result["lwpr.norm_out"] = [float(given[name]) for name in norms]
    for name, value in given.items():
        converted = name in _CONVERTED or name.startswith(_OF_OUTPUTS)
        of_kind = is_lwpr or not name.startswith("lwpr.")
        if name not in _DAEMON_ONLY and not converted and of_kind:
            result[name] = value
    result["body.degrees"] = result["body.space"] == "eyes"
    return [f"{name}={_text(value)}" for name, value in result.items()]


def _text(value) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(map(_text, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    return ".inf" if value == float("inf") else str(value)


def counts(lengths: list[int], early: int = 5, later: int = 20, window: int = 200) -> np.ndarray:
    """Numbers of samples to measure at: in each phase every `early` of the first `window`, then
    every `later`."""
    result, first = [], 0
    for length in lengths:
        near = min(length, window)
        result += [*range(first, first + near, early), *range(first + near, first + length, later)]
        first += length
    return np.array([n for n in result if n > 0] + [first])


def curve(robot: Robot, learner: str, phases: list[np.ndarray], tests: dict[str, np.ndarray],
          at: np.ndarray) -> dict[str, np.ndarray]:  # fmt: skip
    """Teaches the phases' rows (inputs, outputs as in messages) in order.

    By test set: RMSE of the solution closest to the set's output, a row for each count; and the
    number of experts."""
    given = options(robot, learner)
    n_outputs = len(robot.noise)
    n_inputs = phases[0].shape[1] - n_outputs
    order = input_order(given, n_inputs)

    def write(path: Path, rows: np.ndarray) -> Path:
        return _write(path, np.hstack([rows[:, order], rows[:, n_inputs:] * robot.degrees]))

    with tempfile.TemporaryDirectory(prefix="reach-replay-") as name:
        folder = Path(name)
        train = [write(folder / f"train{i}.csv", rows) for i, rows in enumerate(phases)]
        report = folder / "report.json"
        command = [BINARIES / "reach-eval", "--learner", given["kind"], "--quiet",
                   "--inputs", n_inputs, "--outputs", n_outputs, "--config", _empty(folder),
                   "--train", ",".join(map(str, train)), "--at", ",".join(map(str, at)),
                   "--json", report]  # fmt: skip
        for key, rows in tests.items():
            command += ["--test", f"{key}={write(folder / f'{key}.csv', rows)}"]
        command += [word for text in parameters(robot, given) for word in ("--param", text)]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if done.returncode != 0:
            raise ReplayError(done.stderr.strip())
        results = json.loads(report.read_text())["results"]
    errors = {key: _array([r["test"][key]["closest"]["rmse"] for r in results]) / robot.degrees
              for key in tests}  # fmt: skip
    return {**errors, "experts": np.array([r["experts"] for r in results])}


def _empty(folder: Path) -> Path:
    """A configuration of its own keeps reach-eval from taking one that ships."""
    path = folder / "nothing.yaml"
    path.write_text("{}\n")
    return path


def _write(path: Path, rows: np.ndarray) -> Path:
    np.savetxt(path, rows, "%.12g", ",")
    return path


def _array(rows: list) -> np.ndarray:
    """Without an answer, no number."""
    return np.array([[np.nan if v is None else v for v in row] for row in rows])
