"""Command lines in the documentation: does each program exist, and each option that it is given?"""

import itertools
import re
import shlex
from collections.abc import Iterator

import known

# Programs of others that the documentation may use.
OUTSIDE = """
apt-get cat cc cd chrt cmake cpack ctest dpkg echo exit export git head install ip jobs journalctl
jq kill lcm-gen lcm-logger lcm-logplayer lcm-spy make man mkdir nstat openssl pip pkg-config sleep
sysctl systemctl systemd-analyze true wait for while done if fi .venv/bin/rerun
""".split()  # noqa: SIM905, a list of words
# Words before a command, with how many words of their own follow each.
WRAPPERS = {
    "do": 0,
    "then": 0,
    "sudo": 0,
    "time": 0,
    "exec": 0,
    "tools/netns.sh": 0,
    "env": 0,
    "nsenter": 3,
}
PYTHON = (".venv/bin/python", "out/drake/bin/python", "out/franka/bin/python",
          "out/mujoco/bin/python", "python", "python3")  # fmt: skip
# Of the running shell, not of a program.
_ASSIGNMENT = re.compile(r"[A-Za-z_]\w*=")


def lines_of(text: str) -> Iterator[str]:
    """Logical lines: with open quotes and backslashes the next one belongs to it."""
    pending = ""
    for line in text.splitlines():
        pending += line
        if pending.endswith("\\"):
            pending = pending[:-1]
            continue
        try:
            shlex.split(pending, comments=True)
        except ValueError:
            pending += "\n"
            continue
        yield pending
        pending = ""
    if pending.strip():
        yield pending


def simple_commands(line: str) -> Iterator[list[str]]:
    """The commands of a line, without redirections."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    lexer.commenters = "#"
    command: list[str] = []
    redirected = False
    for word in lexer:
        if set(word) <= set(";&|()"):
            if command:
                yield command
            command = []
        elif set(word) <= set("<>"):
            redirected = True
        elif redirected:
            redirected = False
        else:
            command.append(word)
    if command:
        yield command


def problems(text: str) -> Iterator[str]:
    """What is wrong with a script; nothing, hopefully."""
    for line in lines_of(text):
        for command in simple_commands(line):
            yield from _command(command)


def _without_wrappers(words: list[str]) -> list[str]:
    words = [word.removeprefix("$REACH/") for word in words]  # the tree, in the tutorial
    while words and (words[0] in WRAPPERS or _ASSIGNMENT.match(words[0])):
        words = words[1 + WRAPPERS.get(words[0], 0) :]
    return words


def _command(words: list[str]) -> Iterator[str]:
    words = _without_wrappers(words)
    if not words or words[0] in OUTSIDE:
        return
    name, rest = words[0].removeprefix("build/bin/"), words[1:]
    if name in ("sh", "bash"):
        yield from problems(rest[rest.index("-c") + 1]) if "-c" in rest else ()
    elif name == "./run":
        yield from _run(rest)
    elif name in PYTHON:
        yield from _python(rest)
    elif name == "reach-export":
        yield from _options(name, rest, known.module_help("reach.export"))
    elif known.program_help(name):
        yield from _program(name, rest)
    elif not known.is_file(name):
        yield f"there is no {name}; tests/docs/commands.py lists the programs of others"


def _options(name: str, words: list[str], text: str) -> Iterator[str]:
    there = known.options_in(text)
    for word in words:
        if re.match(r"--?[a-zA-Z]", word) and word.split("=")[0] not in there:
            yield f"{name} has no option {word.split('=')[0]}"


def _program(name: str, words: list[str]) -> Iterator[str]:
    yield from _options(name, words, known.program_help(name))
    for option, value in itertools.pairwise(words):
        if option in ("--set", "--param") and value.split("=")[0] not in known.keys(name):
            yield f"{name} has no key {value.split('=')[0]}"
        if option == "--config" and value.startswith("etc/") and not known.is_file(value):
            yield f"there is no {value}"
    if name == "reachctl":
        yield from _reachctl(words)


def _reachctl(words: list[str]) -> Iterator[str]:
    plain = [word for word in words if not word.startswith("-")]
    takes_value = {"--url", "--timeout", "--seed", "--file", "--period"}
    values = {v for o, v in itertools.pairwise(words) if o in takes_value}
    plain = [word for word in plain if word not in values]
    command = " ".join(plain[: 2 if plain[:1] == ["sim"] else 1])
    if command and command not in known.reachctl_commands():
        yield f"reachctl has no command '{command}'"


def _run(words: list[str]) -> Iterator[str]:
    if not words or words[0] == "COMMAND":
        return
    if words[0] not in known.run_commands():
        yield f"./run has no command '{words[0]}'"
    else:
        yield from _options(f"./run {words[0]}", words[1:], known.run_help(words[0]))


def _python(words: list[str]) -> Iterator[str]:
    if words[:1] == ["-m"]:
        if words[1] in ("pip", "venv"):
            return
        text = known.module_help(words[1])
        if not text:
            yield f"there is no module {words[1]}"
        yield from _options(words[1], words[2:], text + "--help")
    elif words and words[0].endswith(".py"):
        if known.is_file(words[0]):
            yield from _options(words[0], words[1:], (known.SOURCE / words[0]).read_text())
        else:
            yield f"there is no {words[0]}"
