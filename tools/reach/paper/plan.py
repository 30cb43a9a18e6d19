"""Which runs there are, and which of them need not be done again.

A run is a folder. It is complete when its run.json names the inputs that it would have today:
configuration files, sizes, seed, version of the programs.
"""

import hashlib
import json
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from ..programs import BINARIES, LEARNERS, OURS, ROOT
from . import packed

LEARNER_NAMES = (OURS, *LEARNERS)


@dataclass(frozen=True)
class Run:
    """`group` is the protocol: the module kobian or icub, or one of explore's or practice's."""

    group: Any
    learner: str
    seed: int
    quick: bool

    @property
    def name(self) -> str:
        return f"{self.group.NAME}-{self.learner}-{self.seed}"

    @cached_property
    def settings(self) -> dict:
        """Sizes of the protocol. Kept, so that they go with the run to where it is done."""
        return self.group.settings(self.quick, self.learner)

    @property
    def overlays(self) -> list[Path]:
        """Configuration files of the daemon after the robot's."""
        return self.group.overlays(self.learner)

    def inputs(self, version: str) -> dict:
        """Everything that decides the run."""
        files = sorted({*self.group.configurations(), *self.overlays})
        return {
            "learner": self.learner,
            "seed": self.seed,
            "settings": self.settings,
            "files": {str(path.relative_to(ROOT)): digest([path]) for path in files},
            "version": version,
        }


def plan(groups: Iterable[Any], learners: Iterable[str], seeds: int,
         quick: bool) -> list[Run]:  # fmt: skip
    """Seed by seed, so that what an interruption leaves is whole seeds."""
    return [
        Run(group, learner, seed, quick)
        for seed in range(1, seeds + 1)
        for group in groups
        for learner in learners_of(group, learners)
    ]


def learners_of(group, asked: Iterable[str]) -> tuple[str, ...]:
    """Those that the group is about: all, where it names none."""
    return tuple(name for name in asked if name in getattr(group, "LEARNERS", LEARNER_NAMES))


def digest(paths: Iterable[Path]) -> str:
    total = hashlib.sha256()
    for path in paths:
        total.update(path.read_bytes())
    return total.hexdigest()


def version() -> str:
    """Of the daemon that would run: number and git revision."""
    done = subprocess.run([BINARIES / "reachd", "--version"], capture_output=True, text=True)
    return done.stdout.strip()


def described(folder: Path) -> dict | None:
    """What the folder's run.json says; None without a readable one."""
    try:
        return json.loads((folder / "run.json").read_text())
    except (OSError, ValueError):
        return None


def is_complete(folder: Path, inputs: dict, any_version: bool = False) -> bool:
    """Whether the folder holds this run, finished, with these inputs."""
    description = described(folder)
    if description is None or not packed.exists(folder):
        return False
    had = dict(description.get("inputs", {}))
    if any_version:
        had["version"] = inputs["version"]
    return had == json.loads(json.dumps(inputs))
