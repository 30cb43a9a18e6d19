"""docs/howto/extend.md is carried out in a copy of the tree: its files written, its differences
applied, its test built and run. Built is only what is needed, and what has changed since."""

import filecmp
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import markdown
from scratch import BUILD, SOURCE

WORK = BUILD / "extend"
FRESH, COPY, BUILT = WORK / "fresh", WORK / "source", WORK / "build"
TARGETS = ("test_wave", "test_config", "test_new_behaviour", "reachd", "reachctl", "reach-log")
GOLDEN = SOURCE / "tests/golden/lockstep.lcmlog.xz"


def run(*command, **options) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def copy_tree(source: Path, copy: Path) -> None:
    """What git would take along, as it is now."""
    listed = run("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", cwd=source)
    for name in listed.split("\0"):
        if name and (source / name).is_file():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / name, copy / name)


def carry_out(page: markdown.Page) -> int:
    """Returns how many blocks there were."""
    blocks = [b for b in page.blocks if b.file or b.language == "diff"]
    for block in blocks:
        if block.file:
            (FRESH / block.file).write_text(block.text)
        else:
            run("patch", "-p1", "--no-backup-if-mismatch", input=block.text, cwd=FRESH)
    return len(blocks)


def bring_up_to_date() -> None:
    """What is the same in the tree that is built keeps its time."""
    names = {path.relative_to(FRESH) for path in FRESH.rglob("*") if path.is_file()}
    for name in names:
        if not (COPY / name).is_file() or not filecmp.cmp(FRESH / name, COPY / name, shallow=False):
            (COPY / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(FRESH / name, COPY / name)
    for path in [p for p in COPY.rglob("*") if p.is_file()]:
        if path.relative_to(COPY) not in names:
            path.unlink()


def launcher() -> list[str]:
    """The same as of the tree, if it has one."""
    return [f"-DCMAKE_{language}_COMPILER_LAUNCHER={found}" for language in ("C", "CXX")
            if (found := os.environ.get(f"CMAKE_{language}_COMPILER_LAUNCHER"))]  # fmt: skip


class Extend(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(FRESH, ignore_errors=True)
        copy_tree(SOURCE, FRESH)
        cls.blocks = carry_out(markdown.read(SOURCE / "docs/howto/extend.md"))
        bring_up_to_date()
        run("cmake", "-S", COPY, "-B", BUILT, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
            "-DCMAKE_C_FLAGS=-O1", "-DCMAKE_CXX_FLAGS=-O1", "-DREACH_INSTALL=OFF",
            f"-DREACH_PYTHON={sys.executable}", *launcher())  # fmt: skip
        run("ninja", "-C", BUILT, *TARGETS)

    def test_its_test_passes(self):
        self.assertGreater(self.blocks, 5)
        run("ctest", "--test-dir", BUILT, "-R", "^(test_wave|test_config|test_new_behaviour)$",
            "--no-tests=error", "--output-on-failure")  # fmt: skip

    def test_programs_know_it(self):
        self.assertIn("wave N", run(BUILT / "bin/reachctl", "--help"))
        self.assertIn("wave.angle: 20", run(BUILT / "bin/reachd", "--check-config", "--config",
                                            COPY / "etc/icub.yaml"))  # fmt: skip

    def test_old_logs_lose_their_status_and_are_replayed(self):
        log = WORK / "golden.lcmlog"
        log.write_bytes(subprocess.run(["xz", "-dc", GOLDEN], check=True,
                                       capture_output=True).stdout)  # fmt: skip
        lines = run(BUILT / "bin/reach-log", "info", log).splitlines()
        (status,) = [line for line in lines if line.startswith("REACH_STATUS")]
        self.assertIn("not ours", status)
        run(BUILT / "bin/reachd", "--replay", log)
        verified = subprocess.run([BUILT / "bin/reachd", "--replay", log, "--verify"],
                                  capture_output=True, text=True)  # fmt: skip
        self.assertEqual(verified.returncode, 1)
        self.assertIn("REACH_STATUS", verified.stderr)


if __name__ == "__main__":
    unittest.main()
