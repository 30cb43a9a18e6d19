"""Static proof about the loop thread of reachd, from the compiler's own call graph: no recursion,
no frame of unknown size, a stack that fits into what is touched at start, and no way to a function
of the C library that is not on a short list. The same of the watchdog's way to brake, whose list is
shorter still: no lock, no heap, no pipe. Part of ./run lint.

The sources are compiled once more, with the flags of the build and -fcallgraph-info=su (gcc). Calls
by pointer are not in the graph: CALLS_BY_POINTER below says which table each of them goes through,
and one that it does not name is an error.
"""

import argparse
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("common", "daemon", "learner")  # what the loop is made of
ENTRY = "daemon/realtime/loop.c:run_loop"
BRAKE = "brake_step"
# Called before the first tick alone; what they call does not count.
AT_START = {
    "pthread_self",
    "pthread_setname_np",
    "thread_enter",
    "thread_touch_stack",
    "confine_thread",
}
# Of the libraries, and what each may take of the stack; bytes, generously.
LIBRARY_STACK = 1024
LIBRARY = {
    "memcpy", "memmove", "memset", "memcmp",
    "sqrt", "exp", "log", "log1p", "pow", "ceil", "floor", "fmod", "sin", "cos", "tan", "atan",
    "atan2",
    "lgamma", "round", "llround", "hypot", "cbrt", "acos", "asin", "fmin", "fmax", "ldexp", "frexp",
    "clock_gettime", "clock_nanosleep", "nanosleep", "getrusage", "sem_post", "sem_clockwait",
    "__errno_location", "__stack_chk_fail", "__assert_fail",
}  # fmt: skip
# What may be reached from BRAKE. LCM's encoder is generated: it stores numbers into a buffer.
BRAKE_LIBRARY = {
    "memcpy", "memset", "fmin", "fmax", "clock_gettime", "sendto", "reach_robot_command_t_encode",
    "__stack_chk_fail",
}  # fmt: skip
# Tables of functions, by the type of the table: who calls through which of its members.
CALLS_BY_POINTER = {
    "learner_ops": {
        "learner_update": {"update"},
        "learner_predict": {"predict"},
        "learner_get_statistics": {"experts"},
        "learner_body": {"body"},
        "learner_get_body_change": {"body_change"},
        "body_try": {"predict"},
        "learner_kept_samples": {"kept_samples"},
    },
    "behaviour_ops": {"tick_decide": {"step"}, "tick_take_requests": {"accepts", "start"}},
    "model_port_ops": {
        "tick_learn": {"note", "learned"},
        "tick_awaits_store": {"works", "full"},
        "tick_take_requests": {"poll", "begin_save", "begin_load", "begin_forgetting", "tell_body"},
        "tick_report": {"report", "moment"},
    },
}
# Whoever else calls by pointer within the learner does so through these.
LEARNER_TABLES = ("kernels", "feature_map_ops")
LEARNER_SOURCE = re.compile(
    r"learner/(body|imle|lwpr|features)/|imle|whitener|feature_map|lwpr|contexts_|follow_|tied_"
)
# Eigen takes scratch matrices from the stack, at most 16 x 16 doubles each here, and would take
# larger ones from the heap; that it never does is seen by tests/system/test_loop_promises.py.
EIGEN_SCRATCH = 16 * 1024
EIGEN = re.compile(r"(daemon/control/kinematics/taskspace\.cc:)?_ZN\w*5Eigen")
# The guards are of a constant that the first product computes.
EIGEN_LIBRARY = {"malloc", "calloc", "free", "__cxa_guard_acquire", "__cxa_guard_release"}
DECODED = re.compile(r"^(\w+): \{ (.*) \}$")
TEXT = re.compile(r'(\w+) ?: "((?:[^"\\]|\\.)*)"')


@dataclass
class Function:
    stack: int = -1  # bytes, -1 = not ours
    unbounded: bool = False
    calls: set = field(default_factory=set)


def compile_graph(entry: dict, folder: Path) -> Path:
    """Where the compiler has written the graph of this source."""
    source = Path(entry["file"])
    output = folder / (str(source.relative_to(ROOT)).replace("/", "__") + ".o")
    words = shlex.split(entry["command"])
    words = words[1:] if Path(words[0]).name == "ccache" else words
    at = words.index("-o")
    words[at + 1] = str(output)
    graph = output.with_suffix(".ci")
    for flag, takes in (("-MD", 0), ("-MT", 1), ("-MF", 1)):
        if flag in words:
            at = words.index(flag)
            del words[at : at + 1 + takes]
    subprocess.run([*words, "-fcallgraph-info=su"], cwd=entry["directory"], check=True)
    return graph


def name_of(title: str) -> str:
    """Static functions carry their source's path."""
    return title.replace(f"{ROOT}/", "").removeprefix("./")


def read_graph(path: Path, functions: dict[str, Function]) -> None:
    for line in path.read_text().splitlines():
        match = DECODED.match(line.strip())
        if not match:
            continue
        values = dict(TEXT.findall(match[2]))
        if match[1] == "node":
            function = functions.setdefault(name_of(values["title"]), Function())
            size = re.search(r"(\d+) bytes \(([\w,]+)\)", values["label"])
            if size:
                function.stack = int(size[1])
                function.unbounded = size[2] == "dynamic"
        elif match[1] == "edge":
            caller = functions.setdefault(name_of(values["sourcename"]), Function())
            caller.calls.add(name_of(values["targetname"]))


def read_tables(functions: dict[str, Function]) -> dict[str, dict[str, set[str]]]:
    """Type of table -> member -> functions, from the initialisers in the sources."""
    tables: dict[str, dict[str, set[str]]] = {}
    for path in sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.[ch]")):
        text = path.read_text()
        for kind, body in re.findall(r"^(?:static )?const struct (\w+) \w+ = \{\n(.*?)^\};", text,
                                     re.M | re.S):  # fmt: skip
            for member, name in re.findall(r"\.(\w+) = (\w+),", body):
                # A table in kernels_body.h is compiled into each source that includes it.
                files = r"kernels_\w+" if path.suffix == ".h" else re.escape(path.stem)
                place = re.escape(str(path.parent.relative_to(ROOT)))
                own = re.compile(rf"({place}/{files}\.c:)?{name}$")
                found = {function for function in functions if own.match(function)}
                tables.setdefault(kind, {}).setdefault(member, set()).update(found)
    return tables


def resolve_pointers(functions: dict[str, Function]) -> None:
    """Puts what a call by pointer may reach in its place; what nobody has named stays."""
    tables = read_tables(functions)
    for name, function in functions.items():
        if "__indirect_call" not in function.calls:
            continue
        targets: set[str] = set()
        for table, callers in CALLS_BY_POINTER.items():
            for member in callers.get(name, ()):
                targets |= tables[table][member]
        if not targets and LEARNER_SOURCE.match(name):
            for table in LEARNER_TABLES:
                targets |= set().union(*tables.get(table, {}).values(), set())
        if targets:
            function.calls = function.calls - {"__indirect_call"} | targets


def is_eigen(name: str) -> bool:
    return bool(EIGEN.match(name)) or name.startswith("taskspace_")


class Proof:
    """Walks the graph from the entry; `faults` are sentences."""

    def __init__(
        self, functions: dict[str, Function], entry: str = ENTRY, library: set[str] = LIBRARY
    ):
        self._functions, self._allowed = functions, library
        self._whose = "the loop" if entry == ENTRY else "the brake"
        self._deepest: dict[str, tuple[int, list[str]]] = {}
        self._path: list[str] = []
        self.faults: list[str] = []
        self.depth, self.deepest_path = 0, []
        if functions.get(entry, Function()).stack < 0:
            self.faults.append(f"{entry} is not in the graph")
        else:
            self.depth, self.deepest_path = self._walk(entry)

    @property
    def visited(self) -> int:
        return len(self._deepest)

    def _walk(self, name: str) -> tuple[int, list[str]]:
        if name in self._deepest:
            return self._deepest[name]
        if name in self._path:
            ring = self._path[self._path.index(name) :]
            self.faults.append(f"recursion: {' -> '.join([*ring, name])}")
            return 0, []
        function = self._functions.get(name, Function())
        if function.stack < 0:
            return self._library(name)
        self._path.append(name)
        below = max((self._walk(call) for call in sorted(function.calls - AT_START)),
                    default=(0, []))  # fmt: skip
        self._path.pop()
        result = self._frame(name, function) + below[0], [name, *below[1]]
        self._deepest[name] = result
        return result

    def _frame(self, name: str, function: Function) -> int:
        if not function.unbounded:
            return function.stack
        if not is_eigen(name):
            self.faults.append(f"{name} has a frame of unknown size")
        return function.stack + EIGEN_SCRATCH

    def _library(self, name: str) -> tuple[int, list[str]]:
        caller = self._path[-1]
        if name == "__indirect_call":
            self.faults.append(f"{caller} calls by pointer; say in tools/dev/loop_stack.py what")
        elif name not in self._allowed and not (name in EIGEN_LIBRARY and is_eigen(caller)):
            self.faults.append(f"{' -> '.join([*self._path, name])}: not for {self._whose}")
        return LIBRARY_STACK, [name]


def sources() -> list[dict]:
    entries = json.loads((ROOT / "build/compile_commands.json").read_text())
    ours = {}
    for entry in entries:
        if any(Path(entry["file"]).is_relative_to(ROOT / folder) for folder in FOLDERS):
            ours.setdefault(entry["file"], entry)
    return list(ours.values())


def limit() -> int:
    """What thread.h says is touched at start."""
    text = (ROOT / "common/base/thread.h").read_text()
    words = re.search(r"THREAD_STACK_TOUCHED \((\d+) \* (\d+)\)", text)
    return int(words[1]) * int(words[2])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--verbose", action="store_true", help="print the deepest path")
    options = parser.parse_args()
    folder = ROOT / "build/loop_stack"
    folder.mkdir(exist_ok=True)
    functions: dict[str, Function] = {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for path in pool.map(lambda entry: compile_graph(entry, folder), sources()):
            read_graph(path, functions)
    resolve_pointers(functions)
    proof = Proof(functions)
    if options.verbose:
        print("\n".join(f"{functions.get(n, Function()).stack:8} {n}" for n in proof.deepest_path))
    if proof.depth > limit():
        proof.faults.append(f"the stack may be {proof.depth} bytes deep, {limit()} are touched")
    brake = Proof(functions, BRAKE, BRAKE_LIBRARY)
    for fault in proof.faults + brake.faults:
        print(f"loop_stack: {fault}")
    print(f"loop_stack: {proof.visited} functions, at most {proof.depth} bytes of stack,"
          f" {limit()} are touched; {brake.visited} to brake")  # fmt: skip
    return 1 if proof.faults or brake.faults else 0


if __name__ == "__main__":
    sys.exit(main())
