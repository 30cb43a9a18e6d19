"""The installed tree that ctest names on the command line."""

import subprocess
import sys
from pathlib import Path

PREFIX = Path(sys.argv.pop(1))


def run(*command, **settings) -> subprocess.CompletedProcess:
    words = [str(word) for word in command]
    return subprocess.run(words, capture_output=True, text=True, timeout=60, **settings)


def programs() -> list[Path]:
    return sorted([*PREFIX.glob("bin/*"), *PREFIX.glob("sbin/*")])


def call(program: Path, *arguments) -> subprocess.CompletedProcess:
    """Python programs by the interpreter that has their packages."""
    is_python = program.read_bytes().startswith(b"#!/usr/bin/python3")
    return run(*([sys.executable] if is_python else []), program, *arguments)
