"""The programs of an experiment, started as a user would start them."""

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from .bus import DEFAULT_URL, Bus
from .messages import ROOT, reach
from .processes import Processes
from .recorder import ALL_BUT_IMAGES

BINARIES = Path(os.environ.get("REACH_BUILD_DIR", ROOT / "build")) / "bin"
# Who listens to everything needs room for what comes while it does not run; the kernel grants up
# to its net.core.rmem_max.
LISTENER_URL = f"{DEFAULT_URL}&recv_buf_size=8388608"

LEARNERS = {"linear": ROOT / "etc/learner-linear.yaml", "lwpr": ROOT / "etc/learner-lwpr.yaml"}


def start(
    processes: Processes,
    out: Path,
    *,
    seed: int,
    robot: str = "kobian",
    configurations: Sequence[Path] = (),
    realtime: bool = False,
    keep_images: bool = False,
    channels: str | None = None,
    simrobot: tuple = (),
) -> None:
    """Starts recorder, reachd, simrobot, whose further options are `simrobot`, and vision where the
    robot has eyes.

    reachd reads `configurations` over the robot's. `channels`: a pattern of what is logged."""
    channels = channels or (".*" if keep_images else ALL_BUT_IMAGES)
    clock = ["--realtime"] if realtime else ["--lockstep", "--hold"]
    daemon_clock = "--no-rt" if realtime else "--lockstep"
    etc, url = ROOT / "etc", ["--url", DEFAULT_URL]
    files = (etc / f"{robot}.yaml", *configurations)
    daemon = [word for path in files for word in ("--config", path)]
    eyes = etc / f"vision-{robot}.yaml"
    commands = {
        "recorder": [sys.executable, "-m", "reach.recorder", "--url", LISTENER_URL,
                     "--channels", channels, out / "run.lcmlog"],
        "reachd": [BINARIES / "reachd", *daemon, *url, daemon_clock],
        "vision": [BINARIES / "vision", "--config", eyes, *url],
        "simrobot": [BINARIES / "simrobot", "--config", etc / f"simrobot-{robot}.yaml", *url,
                     *clock, "--seed", str(seed), *simrobot],
    }  # fmt: skip
    if not eyes.exists():
        del commands["vision"]
    for name, command in commands.items():
        processes.start(name, command)


def wait_until_ready(bus: Bus, out: Path, robot: str = "kobian") -> None:
    """Until the log is being written and the programs have answered on the bus."""
    bus.wait((out / "run.lcmlog").exists, "the recorder", lambda: None)
    hello = reach.hello_t
    bus.wait_for_role(hello.DAEMON, "reachd")
    if (ROOT / f"etc/vision-{robot}.yaml").exists():
        bus.wait_for_role(hello.VISION, "vision")
    bus.wait_for_role(hello.SIMULATOR, "simrobot")
