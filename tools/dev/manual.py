"""Makes a manual page (mdoc) from what a program says of itself and from docs/man/.

    manual.py SOURCE OUTPUT BIN [PROGRAM [ARGUMENTS]]

SYNOPSIS, the first paragraphs of DESCRIPTION, OPTIONS and EXIT STATUS are what PROGRAM --help
prints, so that they cannot lie; SOURCE, named NAME.SECTION, has the rest. A line "@options WORDS@"
in it stands for the options that the command WORDS, of the folder BIN, lists. Standard library
only: it runs in the build.
"""

import gzip
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path

from reference import parse_options

AFTER_EXIT_STATUS = {"EXAMPLES", "DIAGNOSTICS", "SEE ALSO"}


@dataclass
class Group:
    """Entries of one kind, such as options or commands: what is typed, and what it does."""

    title: str
    entries: list[tuple[str, str]] = field(default_factory=list)


@dataclass
class Help:
    usage: list[str] = field(default_factory=list)
    paragraphs: list[str] = field(default_factory=list)
    groups: list[Group] = field(default_factory=list)
    exit_codes: list[tuple[str, str]] = field(default_factory=list)


def parse_help(text: str) -> Help:
    """Layout of our programs' --help: usage, paragraphs, and entries indented by two."""
    found, opened = Help(), None
    lines = text.rstrip().splitlines()
    while lines and (not found.usage or lines[0].startswith(" ")):
        found.usage.append(lines.pop(0).removeprefix("usage:").strip())
    for line in lines:
        if match := re.match(r"(?i)exit (?:code|codes|status): (.*)", line):
            codes = re.split(r", (?=\d )", match[1].rstrip("."))
            found.exit_codes = [tuple(code.split(" ", 1)) for code in codes]
        elif not line.strip():
            opened = None
        elif line.startswith(" " * 8) and found.groups:
            _continue(found.groups[-1].entries, line.strip())
        elif line.startswith("  "):
            _entry(found, line)
        elif line.endswith(":"):
            found.groups.append(Group(line.removesuffix(":")))
        elif opened is None:
            found.paragraphs.append(opened := line)
        else:
            found.paragraphs[-1] += f" {line}"
    return found


def _entry(found: Help, line: str) -> None:
    typed, _, meaning = line.strip().partition("  ")
    if not found.groups:
        found.groups.append(Group("options"))
    found.groups[-1].entries.append((typed, meaning.strip()))


def _continue(entries: list[tuple[str, str]], more: str) -> None:
    typed, meaning = entries.pop()
    entries.append((typed, f"{meaning} {more}".strip()))


def escape(text: str) -> str:
    """Plain text for roff; no line may begin with its control characters."""
    text = text.replace("\\", r"\e").replace("-", r"\-").replace("'", r"\(aq")
    return rf"\&{text}" if text.startswith((".", r"\(aq")) else text


def sentences(text: str) -> list[str]:
    """A line for each, as roff wants it."""
    return [escape(line) for line in re.split(r"(?<=\.) (?=[A-Z])", text) if line]


def typed_text(text: str) -> str:
    """Options bold, what stands for a value (FILE, N) italic."""
    pieces = re.split(r"(?<![\w-])(--?[a-zA-Z][\w-]*)|(?<![\w$])([A-Z][A-Z_]*|[dD])(?!\w)", text)
    marked = ""
    for plain, option, value in zip_longest(pieces[::3], pieces[1::3], pieces[2::3]):
        marked += escape(plain) if plain else ""
        marked += rf"\fB{escape(option)}\fR" if option else ""
        marked += rf"\fI{escape(value)}\fR" if value else ""
    return marked


def tagged(entries: list[tuple[str, str]]) -> list[str]:
    lines = [".Bl -tag -width Ds"]
    for typed, meaning in entries:
        lines += [f".It {typed_text(typed)}", *sentences(meaning)]
    return [*lines, ".El"]


def paragraphs(texts: list[str]) -> list[str]:
    lines: list[str] = []
    for text in texts:
        lines += [*([".Pp"] if lines else []), *sentences(text)]
    return lines


def synopsis(name: str, usage: list[str]) -> list[str]:
    lines = []
    for use in re.split(rf"(?:^| ){re.escape(name)} ?", " ".join(usage))[1:]:
        lines += [f".Nm {name}", *([typed_text(use)] if use else [])]
    return lines


def sections(source: str) -> dict[str, list[str]]:
    """Lines by heading; what stands before the first heading is under ''."""
    found: dict[str, list[str]] = {"": []}
    title = ""
    for line in source.splitlines():
        if line.startswith(".Sh "):
            title = line[4:]
            found[title] = []
        elif not line.startswith('.\\"'):
            found[title].append(line)
    return found


def option_list(words: str, folder: Path) -> list[str]:
    """What the program's --help-options lists."""
    command = shlex.split(words)
    command[0] = str(folder / command[0])
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [".Bl -tag -width Ds"]
    for option in parse_options(text):
        kind = [option.type, *([f"in {option.unit}"] if option.unit else [])]
        kind += [f"one of {option.range}" if "," in option.range else option.range] * bool(
            option.range
        )
        kind += [
            "must be given" if option.default is None else f"default {option.default or 'none'}"
        ]
        lines += [
            f".It Cm {escape(option.name)}",
            *sentences(f"{option.meaning} ({'; '.join(kind)})"),
        ]
    return [*lines, ".El"]


def page(source: Path, said: Help | None, folder: Path) -> str:
    name, _, section = source.name.rpartition(".")
    own = sections(source.read_text())
    date, about = own.pop("")
    out = [date, f".Dt {name.upper()} {section}", ".Os reachd", ".Sh NAME", f".Nm {name}", about]
    if said:
        out += [".Sh SYNOPSIS", *synopsis(name, said.usage)]
    out += [".Sh DESCRIPTION", *(paragraphs(said.paragraphs) if said else [])]
    out += [*([".Pp"] if said and said.paragraphs else []), *own.pop("DESCRIPTION")]
    for group in said.groups if said else []:
        out += [f".Sh {group.title.upper()}", *tagged(group.entries)]
    codes = [".Sh EXIT STATUS", *tagged(said.exit_codes)] if said else []
    for title, lines in own.items():
        if title in AFTER_EXIT_STATUS:
            out += codes
            codes = []
        out += [f".Sh {title}", *lines]
    text = "\n".join([*out, *codes]) + "\n"
    return re.sub(
        r"^@options (.*)@$", lambda m: "\n".join(option_list(m[1], folder)), text, flags=re.M
    )


def main() -> None:
    source, output, folder, *command = sys.argv[1:]
    said = None
    if command:
        asked = subprocess.run([*command, "--help"], check=True, capture_output=True, text=True)
        said = parse_help(asked.stdout)
    text = page(Path(source), said, Path(folder))
    Path(output).write_bytes(gzip.compress(text.encode(), mtime=0))


if __name__ == "__main__":
    main()
