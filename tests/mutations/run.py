"""Shows that tests can fail: puts one deliberate fault at a time into a copy of the tree and
demands that the named test notices it.

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
import os
import shutil
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
# A random test may miss a fault now and then; whether it did must not change from run to run.
FIXED_SEED = {"REACH_TEST_SEED": "1"}


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


def copy_tree(source: Path, copy: Path) -> None:
    """Brings the copy up to date; files that are the same keep their time, for short rebuilds."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=source, check=True, capture_output=True, text=True,
    ).stdout.split("\0")  # fmt: skip
    wanted = {name for name in listed if name and (source / name).is_file()}
    for name in wanted:
        target = copy / name
        if not target.is_file() or target.read_bytes() != (source / name).read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / name, target)
    for old in [
        p for p in copy.rglob("*") if p.is_file() and str(p.relative_to(copy)) not in wanted
    ]:
        old.unlink()


class Workshop:
    """The copy of the tree and its build."""

    def __init__(self, source: Path, work: Path):
        self.copy, self.build = work / "source", work / "build"
        work.mkdir(parents=True, exist_ok=True)
        self.log = (work / "log.txt").open("w")
        copy_tree(source, self.copy)
        # -w: a fault may leave something unused, which is not what must notice it.
        flags = [f"-DCMAKE_{language}_FLAGS=-O1 -w" for language in ("C", "CXX")]
        self.run("cmake", "-S", self.copy, "-B", self.build, "-G", "Ninja",
                 "-DCMAKE_BUILD_TYPE=None", "-DREACH_INSTALL=OFF",
                 f"-DREACH_PYTHON={sys.executable}", *flags)  # fmt: skip
        command = ["ninja", "-C", self.build, "-t", "targets", "all"]
        listing = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        self.targets = {line.split(":")[0] for line in listing.splitlines()}

    def run(self, *command) -> bool:
        self.log.write(f"$ {' '.join(map(str, command))}\n")
        self.log.flush()
        return subprocess.run(command, stdout=self.log, stderr=self.log,
                              env=FIXED_SEED | os.environ).returncode == 0  # fmt: skip

    def make(self, mutation: Mutation) -> bool:
        """Builds what the test needs."""
        own = mutation.killed_by if mutation.killed_by in self.targets else "all"
        return self.run("ninja", "-C", self.build, *(mutation.targets or [own]))

    def passes(self, test: str) -> bool:
        return self.run("ctest", "--test-dir", self.build, "-R", f"^{test}$", "--no-tests=error",
                        "--output-on-failure")  # fmt: skip

    def outcome(self, mutation: Mutation) -> str:
        path = self.copy / mutation.file
        original = path.read_text()
        path.write_text(original.replace(mutation.old, mutation.new))
        try:
            if not self.make(mutation):
                return "does not compile"
            return "SURVIVED" if self.passes(mutation.killed_by) else "killed"
        finally:
            path.write_text(original)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--source", type=Path, default=HERE.parent.parent)
    parser.add_argument(
        "--work", type=Path, required=True, help="folder for the copy and its build"
    )
    parser.add_argument("--all", action="store_true", help="the slow ones too")
    parser.add_argument(
        "--only", default="", help="only mutations whose name or file holds this text"
    )
    options = parser.parse_args()
    try:
        entries = read_entries(options.source / "tests/mutations")
        for entry in entries:  # also those that are not tried now: the tree has moved on
            check_entry(entry, options.source)
    except BadEntryError as error:
        print(f"mutations: {error}", file=sys.stderr)
        return 1
    mutations = [
        m for m in entries
        if (options.all or not m.slow) and options.only in m.name + " " + m.file
    ]  # fmt: skip
    return try_all(Workshop(options.source, options.work), mutations)


def try_all(shop: Workshop, mutations: list[Mutation]) -> int:
    healthy = {}
    for test, mutation in sorted({m.killed_by: m for m in mutations}.items()):
        healthy[test] = shop.make(mutation) and shop.passes(test)
        if not healthy[test]:
            print(f"mutations: {test} fails without any mutation, see {shop.log.name}")
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
