"""tools/dev/loop_stack.py finds what must not be in the loop's call graph."""

import sys
import tempfile
import unittest
from pathlib import Path

from reach.messages import ROOT

sys.path.insert(0, str(ROOT / "tools/dev"))
import loop_stack

GOOD = """graph: { title: "loop.c"
node: { title: "daemon/realtime/loop.c:run_loop" label: "run\\nloop.c:1:1\\n100 bytes (static)" }
node: { title: "step" label: "step\\ntick.c:1:1\\n4000 bytes (static)" }
node: { title: "memcpy" label: "memcpy\\n<built-in>" shape : ellipse }
edge: { sourcename: "daemon/realtime/loop.c:run_loop" targetname: "step" label: "loop.c:2:2" }
edge: { sourcename: "step" targetname: "memcpy" label: "tick.c:2:2" }
"""


def prove(text: str, *entry) -> loop_stack.Proof:
    functions: dict[str, loop_stack.Function] = {}
    with tempfile.NamedTemporaryFile("w", suffix=".ci") as file:
        file.write(text + "}\n")
        file.flush()
        loop_stack.read_graph(Path(file.name), functions)
    loop_stack.resolve_pointers(functions)
    return loop_stack.Proof(functions, *entry)


def edge(source: str, target: str) -> str:
    return f'edge: {{ sourcename: "{source}" targetname: "{target}" label: "x" }}\n'


class LoopStack(unittest.TestCase):
    def assert_finds(self, addition: str, words: str) -> None:
        self.assertRegex("; ".join(prove(GOOD + addition).faults), words)

    def test_depth(self):
        proof = prove(GOOD)
        self.assertEqual(proof.faults, [])
        self.assertEqual(proof.depth, 100 + 4000 + loop_stack.LIBRARY_STACK)

    def test_the_brake_shares_nothing(self):
        brake = (loop_stack.BRAKE, loop_stack.BRAKE_LIBRARY)
        node = 'node: { title: "brake_step" label: "brake_step\\nb.c:1:1\\n16 bytes (static)" }\n'
        good = GOOD + node + edge("brake_step", "sendto")
        self.assertEqual(prove(good, *brake).faults, [])
        for other in ("sem_post", "lcm_publish", "pthread_mutex_lock", "write", "malloc"):
            faults = prove(good + edge("brake_step", other), *brake).faults
            self.assertEqual(faults, [f"brake_step -> {other}: not for the brake"])
        self.assertRegex(prove(GOOD, *brake).faults[0], "brake_step is not in the graph")

    def test_recursion(self):
        self.assert_finds(
            edge("step", "daemon/realtime/loop.c:run_loop"),
            "recursion: .*run_loop -> step -> .*run_loop",
        )

    def test_allocation(self):
        self.assert_finds(edge("step", "malloc"), "step -> malloc: not for the loop")

    def test_pointer_that_nobody_named(self):
        self.assert_finds(edge("step", "__indirect_call"), "step calls by pointer")

    def test_frame_of_unknown_size(self):
        node = 'node: { title: "vla" label: "vla\\nx.c:1:1\\n16 bytes (dynamic)" }\n'
        self.assert_finds(node + edge("step", "vla"), "vla has a frame of unknown size")

    def test_the_limit_is_what_is_touched(self):
        self.assertEqual(loop_stack.limit(), 256 * 1024)


if __name__ == "__main__":
    unittest.main()
