"""Writes docs/reference/ from what the programs say of themselves and from lcmtypes/*.lcm.

    .venv/bin/python tools/dev/reference.py            writes the pages
    .venv/bin/python tools/dev/reference.py --check    exit code 1 when a page is out of date

A test does the latter, so that the pages cannot lie. Exit code 2: wrong usage."""

import argparse
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from reach.message_fields import Message, parse_message  # noqa: E402

MEND = ".venv/bin/python tools/dev/reference.py"

# What a user calls, with what --help-options wants besides; None: it has no configuration.
PROGRAMS: dict[str, tuple[str, ...] | None] = {
    "reachd": (),
    "reach-vision": (),
    "reach-simrobot": (),
    "reach-learner": (),
    "reach-finder": None,
    "reachctl": None,
    "reach-eval": ("--learner", "imle", "--inputs", "7", "--outputs", "3"),
    "reach-bench": None,
    "reach-log": None,
    "reach-new-robot": None,
    "reach-spy": None,
    "reach-lcm-setup": None,
}

_OPTION = re.compile(
    r"(?P<type>.+?), (must be given|default (?P<default>.*?))"
    r"(, unit (?P<unit>.+?))?(, one of (?P<choices>\S+))?(, range (?P<range>.+))?"
)


class SourceError(Exception):
    """A source does not look as expected."""


@dataclass(frozen=True)
class Option:
    name: str
    meaning: str
    type: str
    default: str | None
    unit: str
    range: str


def said(build: Path, program: str, *arguments: str) -> str:
    command = [build / "bin" / program, *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def parse_options(text: str) -> list[Option]:
    """What common/options/options.h prints: two lines an option."""
    lines = text.splitlines()
    options = []
    for first, second in zip(lines[::2], lines[1::2], strict=True):
        name, meaning = first.split(maxsplit=1)
        found = _OPTION.fullmatch(second.strip())
        if not found:
            raise SourceError(f"option {name}: '{second.strip()}' is not understood")
        limits = found["choices"].replace("|", ", ") if found["choices"] else found["range"]
        options.append(
            Option(
                name, meaning, found["type"], found["default"], found["unit"] or "", limits or ""
            )
        )
    return options


def options_of(build: Path, program: str) -> list[Option]:
    more = PROGRAMS[program]
    return parse_options(said(build, program, *more, "--help-options")) if more is not None else []


def changeable(root: Path = ROOT) -> list[str]:
    """Names, or with a dot at the end groups, of what SIGHUP may change: config/reloadable.c."""
    source = (root / "daemon/config/reloadable.c").read_text()
    found = re.search(r"live\[\] = \{(.*?)\};", source, re.S)
    if not found:
        raise SourceError("daemon/config/reloadable.c: no list named live")
    return re.findall(r'"(.+?)"', found[1])


def messages(root: Path = ROOT) -> list[Message]:
    paths = sorted((root / "lcmtypes").glob("*.lcm")) + sorted(
        (root / "lcmtypes/bot_core").glob("*.lcm")
    )
    return [parse_message(path.read_text()) for path in paths]


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    head = list(head)
    yield f"| {' | '.join(head)} |"
    yield "|" + "---|" * len(head)
    for row in rows:
        cells = [cell.replace("|", "\\|") for cell in row]
        yield re.sub(r"  +", " ", f"| {' | '.join(cells)} |")
    yield ""


def code(text: str) -> str:
    return f"`{text}`" if text else ""


def note(source: str) -> list[str]:
    return [f"<!-- Made from {source} by `{MEND}`; edit those. -->", ""]


def fold_tools(options: list[Option]) -> list[Option]:
    """The rows of tool1, tool2, .. as one set named toolN."""
    sets: dict[str, list[Option]] = {}
    for option in options:
        if found := re.fullmatch(r"tool(\d+)(\..+)", option.name):
            row = Option(f"toolN{found[2]}", *list(vars(option).values())[1:])
            sets.setdefault(found[1], []).append(row)
    first = next(iter(sets.values()), [])
    if any(rows != first for rows in sets.values()):
        raise SourceError("the tools have different options")
    return [o for o in options if not re.match(r"tool\d", o.name)] + first


def option_rows(options: list[Option], live: list[str]) -> Iterator[list[str]]:
    for o in options:
        may = any(o.name == name or (name[-1] == "." and o.name.startswith(name)) for name in live)
        default = code(o.default) if o.default is not None else "must be given"
        yield [
            code(o.name),
            o.type,
            o.unit,
            default,
            o.range,
            o.meaning,
            *(["yes" if may else ""] if live else []),
        ]


def configuration_page(build: Path) -> str:
    lines = ["# Configuration: every option", "", *note("the option tables of the programs")]
    lines += [
        "How files and overrides work: [configuration.md](../configuration.md).",
        "`--help-options` of each program prints the same in a terminal. Where the unit is deg,",
        "degrees are written. A range holds for each number of a list.",
        "",
    ]
    for program, more in PROGRAMS.items():
        if more is None:
            continue
        options = options_of(build, program)
        tools = sum(bool(re.match(r"tool\d+\.kind$", o.name)) for o in options)
        lines += [f"## {program}", ""]
        if more:
            lines += [f"As with `{' '.join(more)}`; some defaults depend on these.", ""]
        if tools:
            lines += [f"`toolN` stands for `tool1` to `tool{tools}`.", ""]
        head = ["option", "type", "unit", "default", "range", "meaning"]
        live: list[str] = []
        if program == "reachd":
            live = changeable()
            head.append("reload")
            lines += ["`reload`: may change while the daemon runs (`systemctl reload reachd`).", ""]
        for row in table(head, option_rows(fold_tools(options), live)):
            lines.append(row)
    return "\n".join(lines).rstrip() + "\n"


def message_lines(message: Message) -> Iterator[str]:
    yield f"## {message.package}.{message.name}"
    yield ""
    yield message.about
    yield ""
    rows = []
    for f in message.fields:
        meaning = f.meaning
        if f.constants:
            meaning = re.sub(r"[:,;]? ?one of the constants below", "", meaning).rstrip(". ")
            meaning = f"{meaning}: " if meaning else ""
            meaning += ", ".join(f.constants)
        rows.append([code(f.name), code(f.type), f.unit, meaning])
    yield from table(["field", "type", "unit", "meaning"], rows)


def messages_page() -> str:
    everything = messages()
    lines = ["# Messages: every field", "", *note("`lcmtypes/`")]
    lines += [
        "What holds for all of them, and who sends what to whom: [messages.md](../messages.md).",
        "",
        *table(
            ["channel", "type"],
            sorted(
                [code(channel), f"[{m.package}.{m.name}](#{m.package}{m.name})"]
                for m in everything
                for channel in m.channels
            ),
        ),
    ]
    for message in everything:
        lines += message_lines(message)
    return "\n".join(lines).rstrip() + "\n"


def programs_page(build: Path) -> str:
    lines = ["# Programs: options and exit codes", "", *note("what `--help` of each says")]
    for program in PROGRAMS:
        text = said(build, program, "--help").rstrip()
        lines += [f"## {program}", "", "```text", text, "```", ""]
    run = subprocess.run([ROOT / "run", "help"], check=True, capture_output=True, text=True).stdout
    lines += ["## ./run", "", "```text", run.rstrip(), "```", ""]
    lines += [
        "Exit code: 0 done, 1 something failed, 2 wrong usage. Commands with options of their"
    ]
    lines += ["own list them with `./run COMMAND --help`.", ""]
    return "\n".join(lines).rstrip() + "\n"


def pages(build: Path) -> dict[str, str]:
    """Text of each page, by its file's name."""
    return {
        "configuration.md": configuration_page(build),
        "messages.md": messages_page(),
        "programs.md": programs_page(build),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--build", type=Path, default=ROOT / "build", help="where programs are built"
    )
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    options = parser.parse_args()
    folder = ROOT / "docs/reference"
    try:
        made = pages(options.build)
    except (SourceError, OSError, subprocess.CalledProcessError) as error:
        print(f"reference: {error}", file=sys.stderr)
        return 1
    stale = [
        name for name, text in made.items()
        if not (folder / name).is_file() or (folder / name).read_text() != text
    ]  # fmt: skip
    if options.check:
        for name in stale:
            print(f"reference: docs/reference/{name} is out of date; {MEND}", file=sys.stderr)
        return 1 if stale else 0
    folder.mkdir(exist_ok=True)
    for name in stale:
        (folder / name).write_text(made[name])
    return 0


if __name__ == "__main__":
    sys.exit(main())
