"""What the tests of the documentation want of Markdown: fenced blocks, links, headings, code."""

import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Block:
    """A fenced block. `info` is what follows the fence: "sh", or "yaml some.yaml"."""

    info: str
    text: str
    line: int  # of the fence, from 1

    @property
    def language(self) -> str:
        return self.info.split(" ")[0]

    @property
    def file(self) -> str:
        """The file that the text is to be written into, "" for none."""
        return self.info.partition(" ")[2]


@dataclass(frozen=True)
class Page:
    path: Path
    prose: str  # the text with fenced blocks and comments blanked, line by line
    blocks: list[Block]
    comments: list[tuple[int, str]]  # (line, text)

    def line_of(self, offset: int) -> int:
        return self.prose.count("\n", 0, offset) + 1


def _blank(text: str) -> str:
    return re.sub(r"[^\n]", " ", text)


def read(path: Path) -> Page:
    text = path.read_text()
    blocks = []
    for found in re.finditer(r"^```([^\n]*)\n(.*?)^```$", text, re.M | re.S):
        line = text.count("\n", 0, found.start()) + 1
        blocks.append(Block(found[1].strip(), found[2], line))
    prose = re.sub(r"^```[^\n]*\n.*?^```$", lambda m: _blank(m[0]), text, flags=re.M | re.S)
    comments = [
        (prose.count("\n", 0, found.start()) + 1, found[1].strip())
        for found in re.finditer(r"<!--(.*?)-->", prose, re.S)
    ]
    prose = re.sub(r"<!--.*?-->", lambda m: _blank(m[0]), prose, flags=re.S)
    return Page(path, prose, blocks, comments)


def anchors(page: Page) -> set[str]:
    """Where a link may point within the page: its headings, as GitHub names them."""
    names: set[str] = set()
    for heading in re.findall(r"^#{1,6} +(.+?) *$", page.prose, re.M):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        candidate, count = name, 0
        while candidate in names:
            count += 1
            candidate = f"{name}-{count}"
        names.add(candidate)
    return names


def links(page: Page) -> list[tuple[int, str]]:
    """(line, target) of each link and picture."""
    without_code = re.sub(r"`[^`\n]*`", lambda m: _blank(m[0]), page.prose)
    found = re.finditer(r"\]\(([^)\s]+)\)", without_code)
    return [(page.line_of(m.start()), m[1]) for m in found]


def inline_code(page: Page) -> list[tuple[int, str]]:
    """(line, text) of what stands between backticks."""
    found = re.finditer(r"`([^`]+)`", page.prose)
    return [(page.line_of(m.start()), re.sub(r"\s+", " ", m[1])) for m in found]
