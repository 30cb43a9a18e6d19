"""One arm through the whole list: load, kinematics, gravity, free swing, learning, reaching."""

import json
import re
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ..experiment import ExperimentError
from ..new_robot import choices, files, trial
from ..new_robot.urdf import Arm, UnusableError, Urdf
from ..programs import BINARIES, LEARNERS
from .arms import Public
from .packages import Packages

POSTURES = 100
BALL = 0.001  # kg, the least
MUCH, STRONG = 1.2, 20  # times the limit speed; times the effort
_EFFORT = re.compile(r'effort="\s*([0-9.eE+-]+)\s*"')
EXACT_STEP = 1  # ms, of the swing: what drifts is the integrator's, and shrinks with the step
LEARNED = {"body": (), "polynomial": (LEARNERS["polynomial"],)}


@dataclass
class Row:
    """Of the table; what could not be measured is None."""

    name: str
    joints: int | None = None
    refused: str = ""  # why
    repaired: int = 0  # links that needed it
    weak: int = 0  # joints that cannot hold the arm everywhere
    kinematics: float | None = None  # m, farthest from pinocchio
    gravity: float | None = None  # N m or N, farthest from pinocchio
    drift: float | None = None  # share of the kinetic energy
    fastest: float | None = None  # joint under random commands, over its limit speed
    fastest_strong: float | None = None  # the same with STRONG times the effort, where that is much
    off_chain: float | None = None  # m, while moving
    body: int = 0  # samples from which it was found; 0 = it was not
    reached: dict[str, int] | None = None  # by kind of expert
    trouble: dict[str, str] | None = None  # likewise: why it was not tried to its end
    real_time_factor: float | None = None


@dataclass(frozen=True)
class Size:
    samples: int = 300
    targets: int = 12
    seed: int = 1
    kinds: tuple[str, ...] = tuple(LEARNED)


def measure(public: Public, packages: Packages, out: Path, size: Size) -> Row:
    """Into the folder `out`. What the arm fails in is in the row, not raised."""
    row = Row(public.name, reached={}, trouble={})
    try:
        arm = Arm(Urdf(public.path(packages.place if not public.ours else out)), public.tip)
        row.joints = len(arm.joints)
        made = choices.choose(arm)
        simulator = _load(row, arm, made, out)
    except UnusableError as error:
        row.refused = str(error)
        return row
    _probe(row, arm, simulator, packages)
    for kind in size.kinds:
        _learn(row, kind, arm, made, out, size)
    return row


def _load(row: Row, arm: Arm, made: choices.Choices, out: Path) -> Path:
    """As it comes; where only masses are wrong, repaired."""
    _, simulator = files.write(out, row.name, arm, made)
    good, lines = trial.check(simulator)
    if not good and all("repair_inertia" in line for line in lines if ": link " in line):
        _, simulator = files.write(out, row.name, arm, made, repair_inertia=True)
        good, lines = trial.check(simulator)
        row.repaired = sum("takes that of a ball" in line for line in lines)
    row.weak = sum("is too weak" in line for line in lines)
    if not good:
        raise UnusableError(lines[0])
    return simulator


def _probe(row: Row, arm: Arm, simulator: Path, packages: Packages) -> None:
    *ours, swing, speeds = _said(simulator, POSTURES)
    row.drift = swing["drift"] / max(swing["kinetic"], 1e-9)
    row.fastest = speeds["fastest"]
    if row.fastest > MUCH:
        stronger = arm.urdf.path.read_text(encoding="utf-8", errors="replace")
        stronger = _EFFORT.sub(lambda found: f'effort="{STRONG * float(found[1])}"', stronger)
        (simulator.parent / "strong.urdf").write_text(stronger)
        row.fastest_strong = _said(simulator, 1, "robot.urdf=strong.urdf")[-1]["fastest"]
    if not packages.complete:
        return
    asked = {"urdf": str(arm.urdf.path), "tip": arm.tip, "ball": BALL,
             "joints": [joint.name for joint in arm.joints],
             "postures": [posture["position"] for posture in ours]}  # fmt: skip
    answer = subprocess.run(
        [str(packages.python), str(Path(__file__).with_name("with_pinocchio.py"))],
        input=json.dumps(asked), capture_output=True, text=True,
    )  # fmt: skip
    if answer.returncode != 0:
        row.trouble["pinocchio"] = (answer.stderr.strip().splitlines() or ["it said nothing"])[-1]
        return
    theirs = json.loads(answer.stdout)
    row.kinematics = _farthest(ours, theirs, "place")
    row.gravity = _farthest(ours, theirs, "gravity")


def _said(simulator: Path, postures: int, *settings: str) -> list[dict]:
    settings = (f"ball.mass={BALL}", f"physics.step={EXACT_STEP}", *settings)
    command = [BINARIES / "reach-simrobot", "--config", simulator, "--probe", postures]
    command += [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)
    return list(map(json.loads, done.stdout.splitlines()))


def _farthest(ours: list[dict], theirs: list[dict], key: str) -> float:
    pairs = zip(ours, theirs, strict=True)
    return max(float(np.abs(np.subtract(a[key], b[key])).max()) for a, b in pairs)


def _learn(row: Row, kind: str, arm: Arm, made: choices.Choices, out: Path, size: Size) -> None:
    plan = trial.Plan(out, row.name, size.samples, size.targets, size.seed, LEARNED[kind])
    try:
        outcome = trial.run(plan, arm, made)
    except ExperimentError as error:
        row.reached[kind] = 0
        row.trouble[kind] = f"{error}{trial.explanation(out)}"
        return
    row.reached[kind] = outcome.good
    row.off_chain = max(row.off_chain or 0.0, outcome.off_chain)
    if kind == "body":
        row.body = outcome.status.body_samples
        row.real_time_factor = outcome.real_time_factor


def write(row: Row, path: Path) -> None:
    path.write_text(json.dumps(asdict(row), indent=2) + "\n")


def read(path: Path) -> Row:
    return Row(**json.loads(path.read_text()))
