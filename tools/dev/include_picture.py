"""Draws the graph of tools/dev/include_graph.py with Graphviz: a box for each folder, an arrow from
a room to one that it uses. What several arrows in a row say already has no arrow of its own."""

import html
import re
import subprocess

# By folder: its box, the arrows that leave it.
COLOURS = {
    "common": ("#eceff1", "#546e7a"),
    "learner": ("#e3f2e1", "#43a047"),
    "daemon": ("#e1ecf9", "#1e6fc0"),
    "simrobot": ("#fdf0dc", "#ef8f00"),
    "vision": ("#f3e6f5", "#8e24aa"),
    "tools": ("#fbe9e7", "#d2603a"),
}
FONT = 'fontname="Helvetica,Arial,sans-serif"'
SETTINGS = f"""  newrank=true; nodesep=0.22; ranksep=0.42; pad=0.15;
  {FONT}; fontsize=13; labeljust=l; labelloc=t;
  node [{FONT} fontsize=11 shape=box style="filled,rounded" fillcolor=white color="#78909c"
        height=0.3 margin="0.1,0.04"];
  edge [arrowsize=0.6];
"""
CLOSING = 'color="#c62828" style=dashed constraint=false'
TEXT = re.compile(r"<desc>\n(.*?)</desc>", re.S)


def draw(used: dict[str, set[str]], closing: set[tuple[str, str]], text: str) -> str:
    """The SVG; `text` goes into it, so that a check can tell whether the picture is of today."""
    dot = subprocess.run(
        ["dot", "-Tsvg"], input=describe(used, closing), capture_output=True, text=True, check=True
    )
    # The comments name the version of Graphviz.
    picture = re.sub(r"<!--.*?-->\n?", "", dot.stdout, flags=re.S)
    return re.sub(
        r"(<svg[^>]*>\n)",
        lambda match: f"{match[1]}<desc>\n{html.escape(text, quote=False)}</desc>\n",
        picture,
        count=1,
    )


def text_of(picture: str) -> str:
    match = TEXT.search(picture)
    return html.unescape(match[1]) if match else ""


def describe(used: dict[str, set[str]], closing: set[tuple[str, str]]) -> str:
    """In Graphviz's language."""
    rows = [SETTINGS]
    for top in sorted({room.split("/")[0] for room in used}):
        rows += box(top, sorted(used))
    for room, others in sorted(reduce(used).items()):
        colour = COLOURS[room.split("/")[0]][1]
        rows += [f'  "{room}" -> "{other}" [color="{colour}"];' for other in sorted(others)]
    rows += [f'  "{room}" -> "{other}" [{CLOSING}];' for room, other in sorted(closing)]
    rows.append(f'  label="{note(closing)}"; labelloc=b; fontsize=11;')
    return "digraph rooms {\n" + "\n".join(rows) + "\n}\n"


def note(closing: set[tuple[str, str]]) -> str:
    words = (
        r"An arrow: includes headers of. A way of several arrows stands for the direct one, too.\l"
    )
    if closing:
        words += (
            r"Red and dashed: still to be opened; it closes a circle, or goes where it may not.\l"
        )
    return words


def box(folder: str, rooms: list[str]) -> list[str]:
    """A folder with what is in it; one without folders of its own is a plain node."""
    inside = [room for room in rooms if room.startswith(f"{folder}/")]
    name = folder.rsplit("/", 1)[-1]
    if not inside:
        return [f'  "{folder}" [label="{name}"];']
    colour = COLOURS[folder][0] if folder in COLOURS else "#ffffff99"
    rows = [f'  subgraph "cluster_{folder}" {{ label="{folder}/"; style="filled,rounded";']
    rows.append(f'  color="#b0bec5"; fillcolor="{colour}";')
    if folder in rooms:
        rows.append(f'  "{folder}" [label="{name}/*" style=filled];')
    children = sorted({room[len(folder) + 1 :].split("/")[0] for room in inside})
    for child in children:
        rows += box(f"{folder}/{child}", rooms)
    return [*rows, "  }"]


def reduce(used: dict[str, set[str]]) -> dict[str, set[str]]:
    """Without the arrows that a longer way says already; `used` has no circle."""
    below: dict[str, set[str]] = {}

    def all_below(room: str) -> set[str]:
        if room not in below:
            below[room] = set().union(*({o} | all_below(o) for o in used[room]), set())
        return below[room]

    return {
        room: {o for o in others if not any(o in all_below(p) for p in others)}
        for room, others in used.items()
    }
