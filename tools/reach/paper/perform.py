"""Does one run, and measures one that is done."""

import json
import shutil
import time
from pathlib import Path

import numpy as np

from .. import recording, summary
from ..bus import NoAnswerError
from ..experiment import Experiment, ExperimentError
from ..processes import ProcessDiedError
from ..progress import Part
from ..record import read_log
from ..session import Stop, session
from . import packed, replay, rows
from .plan import Run, described, digest

_HERE = Path(__file__).parent


# Ways of a run to fail.
FAILURES = (ExperimentError, NoAnswerError, ProcessDiedError, replay.ReplayError, OSError)


def do(run: Run, version: str | None, told: Part, folder: Path) -> str | None:
    """Performs it, where a version is given, and measures it: the task of a sweep."""
    stop = Stop()
    lacks = perform(run, folder, version, told, stop) if version else None
    stop.release()
    measure(run, folder)
    return lacks


def perform(run: Run, folder: Path, version: str, progress: Part, stop: Stop) -> str | None:
    """Leaves log, recording and run.json, which is written last and says that the run is complete.
    Returns why there is no recording, or None."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    start, phases, inputs = time.monotonic(), [], run.inputs(version)
    options = run.group.programs(folder)
    configurations = [*run.overlays, *options.pop("configurations", [])]
    with session(
        folder, stop, seed=run.seed, configurations=configurations, **options
    ) as (bus, clock):  # fmt: skip
        experiment = Experiment(bus, clock, progress, phases)
        run.group.perform(experiment, run.settings, run.seed)
    description = {"group": run.group.NAME, "learner": run.learner, "seed": run.seed,
                   "settings": run.settings, "phases": phases, "inputs": inputs,
                   "wall_seconds": round(time.monotonic() - start, 1)}  # fmt: skip
    missing = recording.beside(folder / packed.NAME)
    packed.pack(folder)
    write_json(folder / "run.json", description)
    return missing


def measured(folder: Path) -> dict | None:
    """The run's summary.json, unless run or analysis have changed since."""
    had = _read(folder / "summary.json")
    good = had and had["analysis"] == _analysis() and had["run"] == digest([folder / "run.json"])
    return had if good else None


def measure(run: Run, folder: Path) -> dict:
    """The run's summary.json, made anew when run or analysis have changed."""
    if had := measured(folder):
        return had
    description = described(folder)
    with packed.unpacked(folder) as path:
        record = read_log(path)
    numbers = run.group.analyse(record, description, folder / "series")
    numbers |= {rows.lost(name).id: record.lost() for name in run.group.EXPERIMENTS}
    result = summary.rounded({
        "learner": run.learner, "seed": run.seed, "version": description["inputs"]["version"],
        "metrics": {key: float(np.float64(value)) for key, value in numbers.items()},
        "robot_seconds": summary.robot_seconds(description),
        "wall": summary.wall(record, description),
        "run": digest([folder / "run.json"]), "analysis": _analysis(),
    })  # fmt: skip
    write_json(folder / "summary.json", result)
    return result


def _analysis() -> str:
    """What a summary depends on besides the run."""
    others = (_HERE.parent / name for name in ("metrics.py", "summary.py", "record.py"))
    return digest([*sorted(_HERE.glob("*.py")), *others])


def _read(path: Path) -> dict | None:
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return None


def write_json(path: Path, value) -> None:
    """Whole or not at all."""
    aside = path.with_suffix(".new")
    aside.write_text(json.dumps(value, indent=1) + "\n")
    aside.replace(path)
