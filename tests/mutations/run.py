"""Shows that tests can fail: puts one deliberate fault at a time into the tree, as this program
alone sees it, and demands that the named test notices it. The tree and its build stay as they are.

Each *.toml beside this file holds entries
    [[mutation]]
    name = "what is wrong then"
    file = "daemon/x.c"
    old = "text that occurs once in the file"
    new = "text in its place"
    killed_by = "ctest_name"
    slow = true            # optional: only with --all
    targets = ["reachctl"] # optional: what to build; otherwise the program named as the test,
                           # or everything where there is none
"""

import argparse
import contextlib
import os
import shutil
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
# A random test may miss a fault now and then; whether it did must not change from run to run.
FIXED_SEED = {"REACH_TEST_SEED": "1"}
# Git is not asked whether the tree was altered: what names the version would be built each time.
NO_GIT = {"GIT_DIR": "/nowhere"}
# A fault may leave something unused, which is not what must notice it.
MAY_BE_UNUSED = '#pragma GCC diagnostic warning "-Wunused"\n#line 1\n'


@dataclass(frozen=True)
class Mutation:
    name: str
    file: str
    old: str
    new: str
    killed_by: str
    slow: bool = False
    targets: tuple[str, ...] = ()


class BadEntryError(Exception):
    """An entry that no longer fits the tree."""


def read_entries(folder: Path) -> list[Mutation]:
    entries = []
    for path in sorted(folder.glob("*.toml")):
        for row in tomllib.loads(path.read_text()).get("mutation", []):
            try:
                entries.append(Mutation(**row | {"targets": tuple(row.get("targets", ()))}))
            except TypeError as error:
                raise BadEntryError(f"{path.name}: {error}") from None
    return entries


def check_entry(mutation: Mutation, source: Path) -> None:
    path = source / mutation.file
    if not path.is_file():
        raise BadEntryError(f"{mutation.name}: there is no {mutation.file}")
    count = path.read_text().count(mutation.old)
    if count != 1:
        raise BadEntryError(f"{mutation.name}: {mutation.file} holds the old text {count} times")


class Workshop:
    """The tree as this process sees it: its own build lies below, and what a fault changes goes to
    memory and is gone after it. So nothing is built twice, and nobody else sees a fault."""

    def __init__(self, source: Path, build: Path, log: Path):
        self.source, self.build = source, build
        log.parent.mkdir(parents=True, exist_ok=True)
        self.log = log.open("w")
        self.memory = build / "mutations"
        self.memory.mkdir(exist_ok=True)
        self.must("mount", "-t", "tmpfs", "tmpfs", self.memory)
        self.layers = [source]  # the uppermost first
        self.mounted = 0
        listing = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], check=True,
                                 capture_output=True, text=True).stdout  # fmt: skip
        self.targets = {line.split(":")[0] for line in listing.splitlines()}

    @contextlib.contextmanager
    def layer(self) -> Iterator[Path]:
        """While it lasts, all that is written below the source goes to this folder."""
        self.mounted += 1
        upper, scratch = (self.memory / f"{name}-{self.mounted}" for name in ("changes", "scratch"))
        upper.mkdir()
        scratch.mkdir()
        places = f"lowerdir={':'.join(map(str, self.layers))},upperdir={upper},workdir={scratch}"
        self.must("mount", "-t", "overlay", "-o", places, "overlay", self.source)
        try:
            yield upper
        finally:
            # A program that a fault left behind may still be in it.
            self.must("umount", "--lazy", self.source)
            shutil.rmtree(scratch, ignore_errors=True)

    def keep(self, upper: Path) -> None:
        """What was written there lies below the layers to come."""
        self.layers.insert(0, upper)

    def must(self, *command) -> None:
        subprocess.run([str(word) for word in command], check=True)

    def run(self, *command, **settings: str) -> bool:
        self.log.write(f"$ {' '.join(map(str, command))}\n")
        self.log.flush()
        return subprocess.run(command, stdout=self.log, stderr=self.log, cwd="/",
                              env=settings | os.environ).returncode == 0  # fmt: skip

    def make(self, mutation: Mutation) -> bool:
        """Builds what the test needs."""
        own = mutation.killed_by if mutation.killed_by in self.targets else "all"
        return self.run("ninja", "-C", self.build, *(mutation.targets or [own]), **NO_GIT)

    def passes(self, test: str) -> bool:
        return self.run("ctest", "--test-dir", self.build, "-R", f"^{test}$", "--no-tests=error",
                        "--output-on-failure", **FIXED_SEED)  # fmt: skip

    def outcome(self, mutation: Mutation) -> str:
        with self.layer() as upper:
            path = self.source / mutation.file
            changed = path.read_text().replace(mutation.old, mutation.new)
            if path.suffix in (".c", ".cc", ".h"):
                changed = MAY_BE_UNUSED + changed
            path.write_text(changed)
            made = self.make(mutation)
            survived = made and self.passes(mutation.killed_by)
        shutil.rmtree(upper, ignore_errors=True)
        return "does not compile" if not made else "SURVIVED" if survived else "killed"


def in_own_mounts() -> None:
    """Begins anew where this process may mount, and where nobody else sees it."""
    user = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    command = ["unshare", *user, "--mount", "--propagation", "private"]
    os.execvp(command[0], [*command, sys.executable, *sys.argv, "--inside"])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--source", type=Path, default=HERE.parent.parent)
    parser.add_argument("--build", type=Path, help="what ./run build made; default SOURCE/build")
    parser.add_argument("--log", type=Path, help="what was called; default BUILD/mutations.log")
    parser.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--all", action="store_true", help="the slow ones too")
    parser.add_argument(
        "--only", default="", help="only mutations whose name or file holds this text"
    )
    options = parser.parse_args()
    source = options.source.resolve()
    build = (options.build or source / "build").resolve()
    if not (build / "build.ninja").is_file():
        print(f"mutations: nothing is built in {build}: ./run build", file=sys.stderr)
        return 2
    try:
        entries = read_entries(source / "tests/mutations")
        for entry in entries:  # also those that are not tried now: the tree has moved on
            check_entry(entry, source)
    except BadEntryError as error:
        print(f"mutations: {error}", file=sys.stderr)
        return 1
    mutations = [
        m for m in entries
        if (options.all or not m.slow) and options.only in m.name + " " + m.file
    ]  # fmt: skip
    if not options.inside:
        in_own_mounts()
    return try_all(Workshop(source, build, options.log or build / "mutations.log"), mutations)


def try_all(shop: Workshop, mutations: list[Mutation]) -> int:
    healthy = {}
    with shop.layer() as built:
        for test, mutation in sorted({m.killed_by: m for m in mutations}.items()):
            healthy[test] = shop.make(mutation) and shop.passes(test)
            if not healthy[test]:
                print(f"mutations: {test} fails without any mutation, see {shop.log.name}")
    shop.keep(built)
    killed = 0
    for mutation in (m for m in mutations if healthy[m.killed_by]):
        start = time.monotonic()
        outcome = shop.outcome(mutation)
        killed += outcome == "killed"
        print(f"{outcome:8} {mutation.name} ({mutation.file}, {mutation.killed_by},"
              f" {time.monotonic() - start:.1f} s)", flush=True)  # fmt: skip
    print(f"mutations: {killed} of {len(mutations)} killed")
    return 0 if killed == len(mutations) else 1


if __name__ == "__main__":
    sys.exit(main())
