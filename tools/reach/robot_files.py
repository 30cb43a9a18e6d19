"""Which files make a robot: one of ours by its name, a folder, or nothing but a URDF."""

from dataclasses import dataclass
from pathlib import Path

import yaml

from .messages import ROOT
from .new_robot import choices, files
from .new_robot.urdf import Arm, UnusableError, Urdf

OURS = ("kobian", "icub", "sixaxis", "watched")


class RobotError(Exception):
    """Why it cannot be used; one line for the user."""


@dataclass(frozen=True)
class Robot:
    name: str
    daemon: Path
    simulator: Path
    vision: Path | None  # None: it has no eyes

    def urdf(self) -> Path:
        """What the simulator reads; named from its configuration's folder."""
        return self.simulator.parent / read(self.simulator)["robot"]["urdf"]

    def tools(self) -> int:
        """How many tools the simulator's configuration has."""
        found = read(self.simulator)
        return next(n for n in range(10) if f"tool{n + 1}" not in found)


def named(name: str, etc: Path = ROOT / "etc") -> Robot:
    """One of ours; or of the same files in another folder."""
    eyes = etc / f"vision-{name}.yaml"
    return Robot(
        name,
        etc / f"{name}.yaml",
        etc / f"simrobot-{name}.yaml",
        eyes if eyes.exists() else None,
    )


def in_folder(folder: Path) -> Robot:
    """reachd.yaml and simrobot.yaml in it, as the tutorial has them, and vision.yaml for eyes; or
    what ./run new-robot has written there."""
    made = [path.name[len("simrobot-") : -len(".yaml")] for path in folder.glob("simrobot-*.yaml")]
    if len(made) == 1:
        return named(made[0], folder)
    wanted = folder / "reachd.yaml", folder / "simrobot.yaml"
    for path in wanted:
        if not path.is_file():
            raise RobotError(
                f"{path}: no such file; a robot's folder has reachd.yaml, simrobot.yaml and, where"
                " it has eyes, vision.yaml"
            )
    eyes = folder / "vision.yaml"
    return Robot(folder.resolve().name, *wanted, eyes if eyes.exists() else None)


def find(what: str, made: Path) -> Robot:
    """`what` names one of ours, a folder or a URDF, for which configurations are written into the
    folder `made`."""
    path = Path(what)
    if what in OURS:
        return named(what)
    if path.is_dir():
        return in_folder(path)
    if path.is_file():
        return from_urdf(path, made)
    raise RobotError(f"{what}: neither {', '.join(OURS)} nor a folder nor a URDF")


def read(path: Path) -> dict:
    try:
        return yaml.safe_load(path.read_text()) or {}
    except (yaml.YAMLError, UnicodeDecodeError):
        raise RobotError(f"{path}: is no YAML") from None


def from_urdf(urdf: Path, folder: Path) -> Robot:
    """The robot that ./run new-robot makes of it, with no more than the file to go by."""
    try:
        arm = Arm(Urdf(urdf))
        made = choices.choose(arm)
    except UnusableError as error:
        raise RobotError(str(error)) from None
    folder.mkdir(parents=True, exist_ok=True)
    robot = Robot(urdf.stem, *files.paths(folder, urdf.stem), None)
    robot.daemon.write_text(files.daemon(arm, made))
    robot.simulator.write_text(files.simulator(arm, made, repair_inertia=True))
    return robot
