"""Every installed program: --help, --version, wrong usage, manual page, completion."""

import gzip
import os
import re
import subprocess
import unittest
from collections.abc import Callable
from pathlib import Path

import tree


def options(text: str) -> set[str]:
    """Those that a help explains."""
    return set(re.findall(r"^ +(?:-\w, )?(--[a-z-]+)", text, re.MULTILINE))


class Programs(unittest.TestCase):
    def each(self, check: Callable[[Path], None]) -> None:
        found = tree.programs()
        self.assertGreaterEqual(len(found), 9)
        for program in found:
            with self.subTest(program.name):
                check(program)

    def help_of(self, program: Path) -> str:
        result = tree.call(program, "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_help(self):
        def check(program: Path) -> None:
            text = self.help_of(program)
            self.assertTrue(text.startswith(f"usage: {program.name}"), text)
            self.assertRegex(text, r"(?i)\nexit (code|codes|status): 0 .*, 1 .*, 2 wrong usage")
            self.assertTrue({"--help", "--version"} <= options(text), text)

        self.each(check)

    def test_version(self):
        told = set()

        def check(program: Path) -> None:
            result = tree.call(program, "--version")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            name, version = result.stdout.split(" ", 1)
            self.assertEqual(name, program.name)
            self.assertRegex(version, r"^\d+\.\d+\.\d+ \(\w+(-dirty)?\)\n$")
            told.add(version)

        self.each(check)
        self.assertEqual(len(told), 1, told)

    def test_wrong_usage(self):
        def check(program: Path) -> None:
            result = tree.call(program, "--no-such-option")
            self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
            self.assertRegex(result.stderr, rf"^{program.name}: [^\n]*\n$")

        self.each(check)

    def page_of(self, program: Path) -> Path:
        section = 8 if program.parent.name == "sbin" else 1
        return tree.PREFIX / f"share/man/man{section}/{program.name}.{section}.gz"

    def test_manual(self):
        def check(program: Path) -> None:
            text = gzip.decompress(self.page_of(program).read_bytes()).decode()
            for heading in ("NAME", "SYNOPSIS", "OPTIONS", "EXIT STATUS", "SEE ALSO"):
                self.assertIn(f"\n.Sh {heading}\n", text)
            plain = text.replace(r"\-", "-").replace(r"\fB", "").replace(r"\fR", "")
            tagged = re.findall(r"^\.It (?:-\w, )?(--[a-z-]+)", plain, re.MULTILINE)
            self.assertEqual(options(self.help_of(program)), set(tagged))

        self.each(check)

    def test_manual_of_configurations(self):
        page = tree.PREFIX / "share/man/man5/reach.yaml.5.gz"
        text = gzip.decompress(page.read_bytes()).decode()
        for option in ("arm.min", "ball.radius", "robot.urdf"):
            self.assertIn(f"\n.It Cm {option}\n", text)

    def test_manuals_are_sound_and_refer_to_what_there_is(self):
        pages = sorted(tree.PREFIX.glob("share/man/man?/*.gz"))
        names = {page.name.removesuffix(".gz") for page in pages}
        for page in pages:
            result = tree.run("mandoc", "-T", "lint", "-W", "warning", page)
            self.assertEqual(result.stdout + result.stderr, "")
            text = gzip.decompress(page.read_bytes()).decode()
            for name, section in re.findall(r"^\.Xr (\S+) (\d)", text, re.MULTILINE):
                self.assertIn(f"{name}.{section}", names, page.name)

    def complete(self, program: Path, *words: str) -> list[str]:
        """What bash offers in place of the last word."""
        script = tree.PREFIX / f"share/bash-completion/completions/{program.name}"
        ask = (
            f"source {script}; complete -p {program.name} >/dev/null || exit;"
            'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _reach "$1"; echo "${COMPREPLY[*]}"'
        )
        result = tree.run("bash", "-c", ask, "bash", program, *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return sorted(result.stdout.split())

    def test_completion(self):
        def check(program: Path) -> None:
            if program.read_bytes().startswith(b"#!/usr/bin/python3"):
                return  # it wants the system's numpy
            self.assertEqual(set(self.complete(program, "--")), options(self.help_of(program)))

        self.each(check)

    def test_completion_in_the_source_tree(self):
        root = Path(os.environ["REACH_SOURCE_DIR"])

        def complete(program: str, *words: str) -> list[str]:
            line = " ".join(f"'{word}'" for word in (program, *words))
            function = "_reach_run" if program == "./run" else "_reach"
            script = (
                "source tools/install/completion/reach.bash; complete -p run >/dev/null || exit 1;"
                f" COMP_WORDS=({line}); COMP_CWORD={len(words)}; {function} {program} 2>/dev/null;"
                ' printf "%s\\n" "${COMPREPLY[@]}"'
            )
            said = subprocess.run(["bash", "-c", script], cwd=root, capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stderr)
            return said.stdout.split()

        self.assertEqual(complete("./run", "so"), ["soak"])
        self.assertLessEqual({"show", "demo", "test"}, set(complete("./run", "")))
        self.assertIn("--seconds", complete("./run", "show", "--s"))

    def test_completion_of_commands(self):
        reachctl = tree.PREFIX / "bin/reachctl"
        self.assertEqual(self.complete(reachctl, "re"), ["reach", "reset-fault"])
        self.assertEqual(self.complete(reachctl, "--timeout", "3", "sim", "re"),
                         ["reset", "resume"])  # fmt: skip
        self.assertEqual(self.complete(reachctl, "--timeout", ""), [])
        self.assertIn("explore", self.complete(reachctl, ""))


if __name__ == "__main__":
    unittest.main()
