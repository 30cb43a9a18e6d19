"""tools/dev/include_graph.py finds what must not be in the graph of includes between folders."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/dev"))
import include_graph
import include_picture

GOOD = {
    "common/base/arena.h": "#include <stddef.h>\n",
    "learner/learner.h": "",
    "learner/store/store.h": '#include "learner/learner.h"\n',
    "daemon/config/config.h": '#include "learner/learner.h"\n',
    "daemon/control/tick.h": "",
    "daemon/control/tick.c": '// Step\n#include "tick.h"\n\n#include "daemon/config/config.h"\n',
    "daemon/control/limits/limits.c": '#include "common/base/arena.h"\n',
    "daemon/replay/replay.h": '#  include "daemon/control/tick.h"\n',
    "simrobot/world/world.h": "#include <ode/ode.h>\n",
    "vision/ball/ball.h": "",
}


def read(additions: dict[str, str]) -> include_graph.Graph:
    with tempfile.TemporaryDirectory() as folder:
        files = dict(GOOD)
        for name, text in additions.items():
            files[name] = files.get(name, "") + text
        for name, text in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return include_graph.read_graph(Path(folder))


class IncludeGraph(unittest.TestCase):
    def assert_finds(self, additions: dict[str, str], *words: str) -> None:
        faults = include_graph.find_faults(read(additions))
        self.assertEqual(len(faults), len(words), faults)
        for fault, pattern in zip(faults, words, strict=True):
            self.assertRegex(fault, pattern)

    def test_a_good_tree(self):
        self.assert_finds({})

    def test_the_order_puts_what_is_used_first(self):
        graph = read({})
        order = include_graph.in_order(graph, set())
        self.assertEqual(
            order,
            ["common/base", "learner", "learner/store", "daemon/config", "daemon/control",
             "daemon/control/limits", "daemon/replay", "simrobot/world", "vision/ball"],
        )  # fmt: skip
        text = include_graph.as_text(graph, set())
        self.assertIn("daemon/replay         -> daemon/control\n", text)
        self.assertIn("vision/ball           -> -\n", text)

    def test_circle_of_two(self):
        self.assert_finds(
            {"daemon/config/config.h": '#include "daemon/control/tick.h"\n'},
            r"circle daemon/config -> daemon/control -> daemon/config: "
            r"daemon/config/config\.h:2 includes daemon/control/tick\.h; "
            r"daemon/control/tick\.c:4 includes daemon/config/config\.h; open it between",
        )

    def test_circle_over_several_rooms(self):
        self.assert_finds(
            {"daemon/config/config.h": '#include "daemon/replay/replay.h"\n'},
            "circle daemon/config -> daemon/replay -> daemon/control -> daemon/config",
        )

    def test_circle_of_a_folder_and_one_in_it(self):
        self.assert_finds(
            {
                "daemon/control/tick.c": '#include "daemon/control/limits/limits.h"\n',
                "daemon/control/limits/limits.h": '#include "daemon/control/tick.h"\n',
            },
            "circle daemon/control -> daemon/control/limits -> daemon/control",
        )

    def test_two_circles_are_two_faults(self):
        self.assert_finds(
            {
                "daemon/config/config.h": '#include "daemon/control/tick.h"\n',
                "learner/learner.h": '#include "learner/store/store.h"\n',
            },
            "circle daemon/config -> daemon/control",
            "circle learner -> learner/store -> learner",
        )

    def test_the_upper_floors(self):
        for name, header in (
            ("common/base/arena.h", "learner/learner.h"),
            ("learner/store/store.h", "daemon/control/tick.h"),
            ("learner/store/store.h", "simrobot/world/world.h"),
            ("daemon/replay/replay.h", "vision/ball/ball.h"),
            ("simrobot/world/world.h", "vision/ball/ball.h"),
            ("vision/ball/ball.h", "simrobot/world/world.h"),
            ("tools/eval/main.c", "daemon/control/tick.h"),
        ):
            with self.subTest(name=name, header=header):
                rooms = " may not use ".join(str(Path(n).parent) for n in (name, header))
                self.assert_finds(
                    {name: f'#include "{header}"\n'},
                    rf"^{rooms}: {name}:\d includes {header}; move",
                )

    def test_the_bench_measures_a_tick(self):
        self.assert_finds({"tools/bench/tick.c": '#include "daemon/control/tick.h"\n'})

    def test_headers_that_are_not_there(self):
        for header in ('"gone.h"', '"daemon/gone.h"', "<daemon/gone.h>", '"../control/tick.h"',
                       '"control/tick.h"', '"tests/unit/suite.h"'):  # fmt: skip
            with self.subTest(header=header):
                self.assert_finds(
                    {"daemon/replay/replay.h": f"\n#include {header}\n"},
                    rf"^daemon/replay/replay\.h:3 includes {header[1:-1]}, which is no header",
                )

    def test_what_is_left_out_to_draw_a_wrong_tree(self):
        additions = {
            "daemon/config/config.h": '#include "daemon/control/tick.h"\n',
            "learner/store/store.h": '#include "vision/ball/ball.h"\n',
        }
        wrong = {("daemon/config", "daemon/control"), ("learner/store", "vision/ball")}
        self.assertEqual(include_graph.closing_edges(read(additions)), wrong)

    def test_an_arrow_that_a_longer_way_says_is_not_drawn(self):
        used = {"a": {"b", "c"}, "b": {"c"}, "c": set(), "d": {"a", "c"}}
        self.assertEqual(
            include_picture.reduce(used), {"a": {"b"}, "b": {"c"}, "c": set(), "d": {"a"}}
        )

    def test_a_picture_of_yesterday(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / include_graph.PICTURE
            self.assertRegex(include_graph.check_picture(Path(folder), "")[0], "lint --graph")
            path.parent.mkdir(parents=True)
            path.write_text("<svg><desc>\na -&gt; b\n</desc></svg>")
            self.assertEqual(include_graph.check_picture(Path(folder), "a -> b\n"), [])
            self.assertEqual(len(include_graph.check_picture(Path(folder), "a -> c\n")), 1)


if __name__ == "__main__":
    unittest.main()
