"""The programs of an experiment, started as a user would start them."""

import os
import sys
from pathlib import Path

from .bus import DEFAULT_URL, Bus
from .messages import ROOT, reach
from .processes import Processes
from .recorder import ALL_BUT_IMAGES

BINARIES = Path(os.environ.get("REACH_BUILD_DIR", ROOT / "build")) / "bin"
# Who listens to everything needs room for what comes while it does not run; the kernel grants up
# to its net.core.rmem_max.
LISTENER_URL = f"{DEFAULT_URL}&recv_buf_size=8388608"


def start(
    processes: Processes,
    out: Path,
    *,
    seed: int,
    experts: str = "polynomial",
    realtime: bool = False,
    keep_images: bool = False,
    simrobot: tuple = (),
) -> None:
    """Starts recorder, reachd, vision and simrobot, whose further options are `simrobot`."""
    channels = ".*" if keep_images else ALL_BUT_IMAGES
    clock = ["--realtime"] if realtime else ["--lockstep", "--hold"]
    daemon_clock = "--no-rt" if realtime else "--lockstep"
    etc, url = ROOT / "etc", ["--url", DEFAULT_URL]
    configurations = ["--config", etc / "kobian.yaml"]
    if experts == "linear":  # they want other priors, too
        configurations += ["--config", etc / "learner-linear.yaml"]
    commands = {
        "recorder": [sys.executable, "-m", "reach.recorder", "--url", LISTENER_URL,
                     "--channels", channels, out / "run.lcmlog"],
        "reachd": [BINARIES / "reachd", *configurations, *url, daemon_clock],
        "vision": [BINARIES / "vision", "--config", etc / "vision-kobian.yaml", *url],
        "simrobot": [BINARIES / "simrobot", "--config", etc / "simrobot-kobian.yaml", *url, *clock,
                     "--seed", str(seed), *simrobot],
    }  # fmt: skip
    for name, command in commands.items():
        processes.start(name, command)


def wait_until_ready(bus: Bus, out: Path) -> None:
    """Until the log is being written and the three programs have answered on the bus."""
    bus.wait((out / "run.lcmlog").exists, "the recorder", lambda: None)
    hello = reach.hello_t
    bus.wait_for_role(hello.DAEMON, "reachd")
    bus.wait_for_role(hello.VISION, "vision")
    bus.wait_for_role(hello.SIMULATOR, "simrobot")
