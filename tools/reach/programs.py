"""The programs of an experiment, started as a user would start them."""

import os
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from . import robot_files, run_folder
from .bus import DEFAULT_URL, Bus
from .messages import ROOT, reach
from .processes import Processes
from .recorder import ALL_BUT_IMAGES

BINARIES = Path(os.environ.get("REACH_BUILD_DIR", ROOT / "build")) / "bin"
# Who listens to everything needs room for what comes while it does not run; the kernel grants up
# to its net.core.rmem_max.
LISTENER_URL = f"{DEFAULT_URL}&recv_buf_size=8388608"

ETC = ROOT / "etc"
OURS = "body"  # the learner that ships: a robot's configuration alone
# Others, each in a file that the daemon reads after a robot's configuration.
LEARNERS = {name: ETC / f"learner-{name}.yaml" for name in ("polynomial", "linear", "lwpr")}


def start(
    processes: Processes,
    out: Path,
    *,
    seed: int,
    robot: str | robot_files.Robot = "kobian",
    configurations: Sequence[Path] = (),
    realtime: bool = False,
    settings: Mapping[str, object] = MappingProxyType({}),
    channels: str = ALL_BUT_IMAGES,
    simrobot: tuple = (),
) -> None:
    """Starts recorder, reach-finder, reachd, simrobot, whose further options are `simrobot`, and
    vision where the robot has eyes.

    reachd reads `configurations` over the robot's, and over them `settings` of single options;
    the log is of the channels that match."""
    clock = ["--realtime"] if realtime else ["--lockstep", "--hold"]
    daemon_clock = "--no-rt" if realtime else "--lockstep"
    url = ["--url", DEFAULT_URL]
    robot = _files_of(robot)
    files = (robot.daemon, *configurations)
    daemon = [word for path in files for word in ("--config", path)]
    daemon += [word for item in settings.items() for word in ("--set", "{}={}".format(*item))]
    commands = {
        "recorder": [sys.executable, "-m", "reach.recorder", "--url", LISTENER_URL,
                     "--channels", channels, out / "run.lcmlog"],
        "finder": [BINARIES / "reach-finder", *url],
        "reachd": [BINARIES / "reachd", *daemon, *url, daemon_clock],
        "vision": [BINARIES / "reach-vision", "--config", robot.vision, *url],
        "simrobot": [BINARIES / "reach-simrobot", "--config", robot.simulator, *url,
                     *clock, "--seed", str(seed), *simrobot],
    }  # fmt: skip
    if not robot.vision:
        del commands["vision"]
    run_folder.set_log_aside(out)
    for name, command in commands.items():
        processes.start(name, command)
        if name == "recorder":  # a log that begins later than the daemon cannot be replayed
            _wait_for(out / "run.lcmlog", processes)


def _wait_for(path: Path, processes: Processes) -> None:
    while not path.exists():
        processes.check()
        time.sleep(0.02)


def _files_of(robot: str | robot_files.Robot) -> robot_files.Robot:
    return robot_files.named(robot) if isinstance(robot, str) else robot


def wait_until_ready(bus: Bus, robot: str | robot_files.Robot = "kobian") -> None:
    """Until the log is being written and the programs have answered on the bus."""
    hello = reach.hello_t
    bus.wait_for_role(hello.RECORDER, "the recorder")
    bus.wait_for_role(hello.FINDER, "reach-finder")
    bus.wait_for_role(hello.DAEMON, "reachd")
    if _files_of(robot).vision:
        bus.wait_for_role(hello.VISION, "vision")
    bus.wait_for_role(hello.SIMULATOR, "simrobot")
