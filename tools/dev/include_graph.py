"""The graph of includes between the folders of our C and C++ sources. Part of ./run lint.

Every folder that holds sources is a room. A room may include from the rooms that MAY_USE names, and
no way of includes leads from a room back to itself: of two rooms in a circle, neither can be read,
tested or linked without the other. --graph prints the graph and draws it into docs/img/rooms.svg.
"""

import argparse
import itertools
import re
import sys
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

import include_picture

ROOT = Path(__file__).resolve().parents[2]
PICTURE = "docs/img/rooms.svg"
SUFFIXES = {".c", ".h", ".cc", ".cpp"}
# What a folder and those below it may include besides themselves. The longest path that fits
# counts; the order is that of the printed graph.
MAY_USE = {
    "common": set(),
    "learner": {"common"},
    "daemon": {"common", "learner"},
    "simrobot": {"common"},
    "vision": {"common"},
    "tools": {"common", "learner"},
    "tools/bench": {"common", "learner", "daemon", "tools"},  # it measures a tick without the bus
    "tools/pictures": {"common", "vision", "tools"},  # it lets vision find the ball
}
TOPS = [path for path in MAY_USE if "/" not in path]
INCLUDE = re.compile(r'\s*#\s*include\s*(["<])([^">]+)[">]')

Edge = tuple[str, str]


@dataclass
class Graph:
    rooms: set[str] = field(default_factory=set)
    # Which lines make an edge, as "FILE:LINE includes FILE".
    edges: dict[Edge, list[str]] = field(default_factory=lambda: defaultdict(list))
    faults: list[str] = field(default_factory=list)

    def used_by(self, without: set[Edge] = frozenset()) -> dict[str, set[str]]:
        used = {room: set() for room in self.rooms}
        for edge in self.edges:
            if edge not in without:
                used[edge[0]].add(edge[1])
        return used


def read_graph(root: Path) -> Graph:
    graph = Graph()
    for path in sorted(path for top in TOPS for path in (root / top).rglob("*")):
        if path.suffix in SUFFIXES:
            graph.rooms.add(str(path.parent.relative_to(root)))
            read_source(root, path, graph)
    return graph


def read_source(root: Path, path: Path, graph: Graph) -> None:
    room = str(path.parent.relative_to(root))
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        ours = match[1] == '"' or match[2].split("/")[0] in TOPS
        place = f"{path.relative_to(root)}:{number}"
        target = match[2] if "/" in match[2] else f"{room}/{match[2]}"
        if not ours:
            continue
        if target.split("/")[0] not in TOPS or not (root / target).is_file():
            graph.faults.append(
                f"{place} includes {match[2]}, which is no header of ours: name it from the root of"
                " the tree, or by its bare name in its own folder; others go into <>"
            )
        elif str(Path(target).parent) != room:
            graph.edges[room, str(Path(target).parent)].append(f"{place} includes {target}")


def is_allowed(edge: Edge) -> bool:
    """By MAY_USE."""
    user = max((p for p in MAY_USE if f"{edge[0]}/".startswith(f"{p}/")), key=len)
    return any(f"{edge[1]}/".startswith(f"{path}/") for path in MAY_USE[user] | {user})


def shortest_way(used: dict[str, set[str]], start: str, end: str) -> list[str]:
    """Rooms from `start` to `end`; empty if there is no way."""
    came_from = {start: ""}
    queue = [start]
    for room in queue:
        for other in sorted(used[room]):
            if other == end:
                way = [end, room]
                while came_from[way[-1]]:
                    way.append(came_from[way[-1]])
                return way[::-1]
            if other not in came_from:
                came_from[other] = room
                queue.append(other)
    return []


def find_circles(graph: Graph, without: set[Edge]) -> list[list[str]]:
    """The shortest circles such that none is left without the thinnest edge of each."""
    circles, opened = [], set(without)
    while True:
        used = graph.used_by(opened)
        ways = [shortest_way(used, room, room) for room in sorted(graph.rooms)]
        circle = min((way for way in ways if way), key=len, default=None)
        if circle is None:
            return circles
        circles.append(circle)
        opened.add(thinnest(graph, circle))


def thinnest(graph: Graph, circle: list[str]) -> Edge:
    return min(itertools.pairwise(circle), key=lambda edge: len(graph.edges[edge]))


def find_faults(graph: Graph) -> list[str]:
    faults = list(graph.faults)
    for edge in sorted(graph.edges):
        if not is_allowed(edge):
            faults.append(
                f"{edge[0]} may not use {edge[1]}: {lines(graph, edge)}; move what it needs into a"
                " folder that it may use"
            )
    for circle in find_circles(graph, set()):
        edge = thinnest(graph, circle)
        made_by = "; ".join(lines(graph, edge) for edge in itertools.pairwise(circle))
        faults.append(
            f"circle {' -> '.join(circle)}: {made_by}; open it between {edge[0]} and {edge[1]}, by"
            " moving what both need into a folder below"
        )
    return faults


def lines(graph: Graph, edge: Edge) -> str:
    """The first three lines that make an edge, and how many more."""
    made_by = graph.edges[edge]
    more = f" and {len(made_by) - 3} more" if len(made_by) > 3 else ""
    return ", ".join(made_by[:3]) + more


def closing_edges(graph: Graph) -> set[Edge]:
    """What to leave out for the graph to have an order."""
    wrong = {edge for edge in graph.edges if not is_allowed(edge)}
    return wrong | {thinnest(graph, circle) for circle in find_circles(graph, wrong)}


def in_order(graph: Graph, without: set[Edge]) -> list[str]:
    """Every room after those that it uses; where that leaves a choice, by folder and name."""
    used, order = graph.used_by(without), []
    while used:
        ready = min(
            (room for room, others in used.items() if others <= set(order)),
            key=lambda room: (TOPS.index(room.split("/")[0]), room),
        )
        order.append(ready)
        del used[ready]
    return order


def as_text(graph: Graph, without: set[Edge]) -> str:
    used = graph.used_by()
    width = max(map(len, graph.rooms), default=0)
    rows = (
        f"{room:{width}} -> {' '.join(sorted(used[room])) or '-'}"
        for room in in_order(graph, without)
    )
    return "\n".join(rows) + "\n"


def check_picture(root: Path, text: str) -> list[str]:
    path = root / PICTURE
    if path.exists() and include_picture.text_of(path.read_text()) == text:
        return []
    return [f"{PICTURE} does not show today's includes: ./run lint --graph draws it"]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--graph", action="store_true", help=f"print the graph and draw it into {PICTURE}"
    )
    options = parser.parse_args()
    graph = read_graph(ROOT)
    closing = closing_edges(graph)
    text = as_text(graph, closing)
    if options.graph:
        print(text, end="")
        drawing = include_picture.draw(graph.used_by(closing), closing, text)
        (ROOT / PICTURE).write_text(drawing)
    faults = find_faults(graph) + check_picture(ROOT, text)
    for fault in faults:
        print(f"rooms: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
