"""The pages under docs/ and README.md: links lead somewhere, and what they name exists. Commands
are not executed here; those of docs/tutorial.md are, by test_tutorial.py."""

import ast
import importlib
import re
import unittest
from collections.abc import Iterator

import commands
import known
import markdown
import yaml

PAGES = [
    markdown.read(path)
    for path in [known.SOURCE / "README.md", *sorted((known.SOURCE / "docs").rglob("*.md"))]
]
# Files that a reader writes, that programs leave, or that are elsewhere when installed.
ELSEWHERE = {
    "my-vision.yaml", "reachd.yaml", "simrobot.yaml", "table.md", "etc/reach/robot.env",
    "ROBOT.yaml", "vision-ROBOT.yaml", "simrobot-ROBOT.yaml",
}  # fmt: skip
PHASES = {"test_hand", "test_tool"}  # of the experiment
_SUFFIXES = r"c|cc|h|py|sh|lcm|toml|yaml|cmake|md"


def flattened(value, prefix: str = "") -> Iterator[str]:
    """Dotted names of the leaves of nested maps."""
    if not isinstance(value, dict):
        yield prefix
        return
    for key, inner in value.items():
        yield from flattened(inner, f"{prefix}.{key}" if prefix else str(key))


class Pages(unittest.TestCase):
    def each(self, items, check) -> None:
        """`check(page, item)` returns what is wrong, or None; there must be some items."""
        count = 0
        for page in PAGES:
            for line, item in items(page):
                count += 1
                wrong = check(page, item)
                where = f"{page.path.relative_to(known.SOURCE)}:{line}"
                with self.subTest(where=where):
                    self.assertIsNone(wrong, f"{where}: {wrong}")
        self.assertGreater(count, 0)

    def test_links_lead_somewhere(self):
        anchors = {page.path: markdown.anchors(page) for page in PAGES}

        def check(page, target):
            if re.match(r"https?://", target):
                return None
            path, _, anchor = target.partition("#")
            file = (page.path.parent / path).resolve() if path else page.path
            if not file.exists():
                return f"the link to {target} leads nowhere"
            if anchor and anchor not in anchors.get(file, ()):
                return f"{path or 'this page'} has no heading #{anchor}"
            return None

        self.each(markdown.links, check)

    def test_every_page_can_be_found(self):
        start = PAGES[0].path.parent / "docs/README.md"
        linked = {start}
        (top,) = [page for page in PAGES if page.path == start]
        for _, target in markdown.links(top):
            linked.add((start.parent / target.partition("#")[0]).resolve())
        missing = {p.path for p in PAGES[1:]} - linked
        self.assertFalse(missing, "docs/README.md, the map, does not name them")

    def blocks(self, language: str):
        return lambda page: [(b.line, b) for b in page.blocks if b.language == language]

    def test_commands_exist(self):
        def check(_, block):
            return "; ".join(commands.problems(block.text)) or None

        self.each(self.blocks("sh"), check)

    def test_commands_within_text_exist(self):
        ours = r"(\./run|reachctl|reachd|reach-[a-z-]+|build/bin/\S+|tools/netns\.sh) "

        def lines(page):
            return [(n, text) for n, text in markdown.inline_code(page) if re.match(ours, text)]

        self.each(lines, lambda _, text: "; ".join(commands.problems(text)) or None)

    def test_yaml_is_configuration(self):
        def check(_, block):
            unknown = set(flattened(yaml.safe_load(block.text))) - known.all_keys()
            return f"no program has {sorted(unknown)}" if unknown else None

        self.each(self.blocks("yaml"), check)

    def test_python_compiles_and_imports(self):
        def check(_, block):
            for node in ast.walk(ast.parse(block.text)):
                if isinstance(node, ast.ImportFrom):
                    module = importlib.import_module(node.module)
                    lacking = [a.name for a in node.names if not hasattr(module, a.name)]
                    if lacking:
                        return f"{node.module} has no {lacking}"
            return None

        self.each(self.blocks("python"), check)

    def test_options_within_text_exist(self):
        groups = {key.split(".")[0] for key in known.all_keys() if "." in key}

        def keys(page):
            for line, text in markdown.inline_code(page):
                found = re.fullmatch(r"([a-z]+\d?(?:\.[a-z_0-9]+)+|[a-z]+\.\*)(?:[:=] ?.*)?", text)
                name = found[1] if found else ""
                if name.split(".")[0] in groups and not re.search(rf"\.({_SUFFIXES})$", name):
                    yield line, name

        def check(_, key):
            if key.endswith(".*") or key in known.all_keys():
                return None
            return f"no program has {key}"

        self.each(keys, check)

    def test_fields_within_text_exist(self):
        def fields(page):
            for line, text in markdown.inline_code(page):
                found = re.fullmatch(r"([a-z_]+_t|[A-Z]+_[A-Z_]+)\.(\w+)", text)
                if found and found[2] != "lcm":
                    yield line, (found[1], found[2])

        def check(_, name):
            fields_there = known.message_fields().get(name[0])
            if fields_there is None:
                return f"there is no message {name[0]}"
            return None if name[1] in fields_there else f"{name[0]} has no field {name[1]}"

        self.each(fields, check)

    def test_files_within_text_exist(self):
        folders = "|".join(known.FOLDERS)

        def files(page):
            for line, text in markdown.inline_code(page):
                if re.fullmatch(rf"({folders})/[\w./*-]+|[\w-]+\.({_SUFFIXES})", text):
                    yield line, text

        def check(_, text):
            there = any(known.SOURCE.glob(text.rstrip("/"))) or text in known.file_names()
            return None if there or text in ELSEWHERE else f"there is no {text}"

        self.each(files, check)

    def test_tests_within_text_exist(self):
        def tests(page):
            for line, text in markdown.inline_code(page):
                if re.fullmatch(r"(test|system)_\w+", text) and text not in PHASES:
                    yield line, text

        self.each(
            tests, lambda _, name: None if name in known.tests() else f"there is no test {name}"
        )


class Checks(unittest.TestCase):
    """That the checks see what is wrong."""

    WRONG = (
        "build/bin/reachd --confg etc/kobian.yaml",
        "build/bin/reachd --config etc/cobian.yaml",
        "reachd --config etc/kobian.yaml --set task.gian=2 &",
        "tools/netns.sh sh -c 'sleep 1; build/bin/reachctl bable 20 --wait'",
        "reachctl sim atach 1",
        "./run dmeo",
        "./run demo --relatime",
        "time PYTHONPATH=tools .venv/bin/python -m reach.nothing",
        ".venv/bin/python examples/nothing.py",
        "build/tests/test_nothing",
        "tols/netns.sh bash",
        "frobnicate",
    )
    RIGHT = (
        "build/bin/reachd --config etc/kobian.yaml --set task.gain=2 --lockstep & wait",
        "reachctl reach -50 20 3 --period 2 --wait   # a comment",
        "PYTHONPATH=tools .venv/bin/python -m reach.export --help",
        "./run demo --realtime > out.txt",
        "ctest --test-dir build",
    )

    def test_wrong_commands_are_noticed(self):
        for text in self.WRONG:
            with self.subTest(text):
                self.assertEqual(len(list(commands.problems(text))), 1)

    def test_right_commands_are_not(self):
        for text in self.RIGHT:
            with self.subTest(text):
                self.assertEqual(list(commands.problems(text)), [])


if __name__ == "__main__":
    unittest.main()
