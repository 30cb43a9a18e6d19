"""Does what docs/tutorial.md says, from its first block to its last, in one shell: writes the files
that it shows, runs its commands, and holds what they print, and the daemon's status, to the page.

    .venv/bin/python tests/docs/test_tutorial.py --pictures docs/img

leaves the pictures of such a run there."""

import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

import markdown
from PIL import Image, ImageChops
from scratch import SOURCE, Scratch

PAGE = SOURCE / "docs/tutorial.md"
FOLDER = "out/desk-arm"  # where the page works, below the tree
PICTURES = {"stick.png": "tutorial-stick.jpg", "learning_curve.png": "tutorial-learning.png"}
_COMPARE = {"<": float.__lt__, ">=": float.__ge__, "==": float.__eq__}


def script(page: markdown.Page) -> str:
    """The page as one script. After each block of commands it prints a mark, the daemon's status if
    there is a check, and another mark."""
    parts = []
    for block in page.blocks:
        if block.file:
            parts.append(f"cat > {block.file} <<'END_OF_FILE'\n{block.text}END_OF_FILE\n")
        elif block.language == "sh":
            status = "reachctl status --json\n" if checks(page, block) else ""
            parts.append(f"{block.text}echo\necho @@ {block.line}\n{status}echo\necho @@\n")
    return "".join(parts)


def following(page: markdown.Page, block: markdown.Block) -> float:
    """The line where the next block of commands or file begins."""
    later = [b.line for b in page.blocks if b.line > block.line and b.language != "text"]
    return min(later, default=float("inf"))


def checks(page: markdown.Page, block: markdown.Block) -> list[str]:
    """Conditions such as "experts == 2", of the comments between this block and the next."""
    return [
        condition.strip()
        for line, text in page.comments
        if block.line < line < following(page, block) and text.startswith("check:")
        for condition in text.removeprefix("check:").split(",")
    ]


def shown(page: markdown.Page, block: markdown.Block) -> list[str]:
    """Lines that the page shows as what the commands print."""
    return [
        line
        for other in page.blocks
        if other.language == "text" and block.line < other.line < following(page, block)
        for line in other.text.splitlines()
    ]


def masked(line: str) -> str:
    """Without what differs from run to run: numbers."""
    return re.sub(r"\s+", " ", re.sub(r"-?\d+(\.\d+)?", "#", line)).strip()


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.work = Path(scratch.name) / FOLDER
        cls.page = markdown.read(PAGE)
        cls.result = Scratch(Path(scratch.name)).run(script(cls.page))
        found = re.findall(r"(.*?)^@@ (\d+)$(.*?)^@@$", cls.result.stdout, re.M | re.S)
        cls.said = {int(line): (output, status) for output, line, status in found}

    def commands(self):
        return [b for b in self.page.blocks if b.language == "sh"]

    def test_every_command_succeeds(self):
        missing = [b.line for b in self.commands() if b.line not in self.said]
        self.assertFalse(missing, f"the block at line {missing[:1]} failed:\n{self.result.stderr}")
        self.assertEqual(self.result.returncode, 0)

    def test_they_print_what_the_page_shows(self):
        compared = 0
        for block in self.commands():
            output = [masked(line) for line in self.said[block.line][0].splitlines()]
            for line in shown(self.page, block):
                with self.subTest(line=block.line, shown=line):
                    self.assertIn(masked(line), output)
                    compared += 1
        self.assertGreater(compared, 5)

    def test_the_numbers_are_as_good_as_the_page_says(self):
        compared = 0
        for block in self.commands():
            for condition in checks(self.page, block):
                name, relation, limit = condition.split()
                output, status = self.said[block.line]
                for value in self.values(name, output, status):
                    with self.subTest(line=block.line, condition=condition):
                        self.assertTrue(_COMPARE[relation](float(value), float(limit)), value)
                        compared += 1
        self.assertGreater(compared, 10)

    def values(self, name: str, output: str, status: str) -> list[float]:
        """Each error that the commands printed, in mm, or a field of the status."""
        if name != "error":
            return [json.loads(status)[name]]
        errors = re.findall(r"error ([\d.]+) mm$", output, re.M)
        self.assertTrue(errors, "no error was printed")
        return errors

    def test_the_robot_is_in_both_halves_of_the_picture(self):
        picture = Image.open(self.work / "stick.png").convert("RGB")
        width, height = picture.size
        self.assertEqual((width, height), (1280, 480))
        for left in (0, width // 2):
            red, green, blue = picture.crop((left, 0, left + width // 2, height)).split()
            greener = ImageChops.subtract(green, ImageChops.lighter(red, blue))
            ball = sum(greener.point(lambda difference: 255 * (difference > 60)).histogram()[255:])
            self.assertGreater(ball, 100)  # px
            self.assertLess(ball, 2000)
        bare = Image.open(self.work / "arm.png").convert("RGB")
        self.assertIsNotNone(ImageChops.difference(bare, picture).getbbox())

    def test_there_is_a_picture_of_learning(self):
        picture = Image.open(self.work / "learning_curve.png")
        self.assertGreater(len(picture.convert("L").getcolors()), 20)


def keep_pictures(folder: Path) -> None:
    """Runs the page and leaves its pictures, small."""
    with tempfile.TemporaryDirectory() as scratch:
        result = Scratch(Path(scratch)).run(script(markdown.read(PAGE)))
        if result.returncode:
            sys.exit(result.stderr)
        for name, kept in PICTURES.items():
            picture = Image.open(Path(scratch) / FOLDER / name).convert("RGB")
            picture.thumbnail((960, 960))
            picture.save(folder / kept, optimize=True, quality=85)
        print(result.stdout)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--pictures"]:
        keep_pictures(Path(sys.argv[2]))
    else:
        unittest.main()
