"""What exists: programs with their options and commands, configuration keys, messages, files."""

import functools
import os
import re
import subprocess
import sys
from pathlib import Path

import reference

SOURCE = Path(os.environ["REACH_SOURCE_DIR"])
BUILD = Path(os.environ["REACH_BUILD_DIR"])
# Where files of the project lie; what a build or a run leaves behind is none of them.
FOLDERS = ("common", "daemon", "docs", "etc", "examples", "lcmtypes", "learner", "simrobot",
           "tests", "tools", "vision", "cmake")  # fmt: skip


@functools.cache
def _help(*command: str) -> str:
    environment = os.environ | {"COLUMNS": "200"}
    result = subprocess.run([*command, "--help"], capture_output=True, text=True, env=environment)
    return result.stdout + result.stderr


@functools.cache
def program_help(name: str) -> str:
    """What a program of ours says with --help; "" where there is no such program."""
    path = BUILD / "bin" / name
    return _help(str(path)) if path.exists() else ""


@functools.cache
def module_help(name: str) -> str:
    """The same of a Python module; "" where there is none."""
    path = SOURCE / "tools" / name.replace(".", "/")
    if not path.with_suffix(".py").exists() and not (path / "__main__.py").exists():
        return ""
    return _help(sys.executable, "-m", name)


@functools.cache
def run_commands() -> dict[str, str]:
    """What ./run help says of each command."""
    text = subprocess.run([SOURCE / "run", "help"], check=True, capture_output=True, text=True)
    found = re.findall(r"^  ([a-z-]+)\b(.*?)(?=^  [a-z]|\Z)", text.stdout, re.M | re.S)
    return dict(found)


def run_help(command: str) -> str:
    return run_commands()[command] + module_help(f"reach.{command.replace('-', '_')}")


def options_in(text: str) -> set[str]:
    return set(re.findall(r"(?<![\w-])--?[a-zA-Z][\w-]*", text))


def reachctl_commands() -> set[str]:
    """Commands, those to the simulator with "sim " before them."""
    return set(re.findall(r"^  ((?:sim )?[a-z-]+) ", program_help("reachctl"), re.M))


@functools.cache
def keys(program: str) -> set[str]:
    return {option.name for option in reference.options_of(BUILD, program)}


@functools.cache
def all_keys() -> set[str]:
    return {key for p, more in reference.PROGRAMS.items() if more is not None for key in keys(p)}


@functools.cache
def message_fields() -> dict[str, set[str]]:
    """Fields and constants of each message, by its type's name and by its channels."""
    result = {}
    for message in reference.messages():
        names = {re.sub(r"\[.*", "", f.name) for f in message.fields}
        constants = " ".join(c for f in message.fields for c in f.constants)
        names |= set(re.findall(r"\b([A-Z_0-9]+) = ", constants))
        for name in (message.name, *message.channels):
            result[name] = names
    return result


def is_file(name: str) -> bool:
    """A file of the tree, or a test that the build makes."""
    if name.startswith("build/tests/"):
        return (BUILD / name.removeprefix("build/")).is_file()
    return (SOURCE / name).is_file()


@functools.cache
def file_names() -> set[str]:
    names = {p.name for folder in FOLDERS for p in (SOURCE / folder).rglob("*")}
    return names | {p.name for p in SOURCE.iterdir()}


@functools.cache
def tests() -> set[str]:
    """Names of tests: of this build, of others (sanitizers leave some out), functions in Python."""
    listed = subprocess.run(["ctest", "--test-dir", BUILD, "-N"], check=True, capture_output=True,
                            text=True).stdout  # fmt: skip
    named = set(re.findall(r"Test +#\d+: (\w+)", listed))
    for path in (SOURCE / "tests").rglob("*.py"):
        named |= set(re.findall(r"def (test_\w+)", path.read_text()))
    for path in (SOURCE / "tests").rglob("CMakeLists.txt"):
        named |= set(re.findall(r"\w+", path.read_text()))
    return named
