"""reach-tune from a user's file to parameters and a page."""

import contextlib
import io
import os
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from unittest import mock

import numpy as np
import yaml
from reach.tune import rivals
from reach.tune.__main__ import main
from reach.tune.columns import look_at
from reach.tune.data import Samples, read
from reach.tune.parts import split
from reach.tune.search import look_for, make_search, rows_that_fit, try_body
from reach.tune.settings import start_for

ARM = Path(os.environ["REACH_SOURCE_DIR"]) / "examples/own_data/arm.csv"


class Silent:
    def update(self, *_):
        pass

    finish = update


class Tune(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def call(self, *words) -> tuple[int, str, str]:
        out, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            code = main([str(word) for word in words])
        return code, out.getvalue(), error.getvalue()

    def search(self, name: str, trials: int):
        parts = split(read([ARM], 4, 3))
        look = look_at(parts.learn)
        search = make_search(self.folder / name, parts.learn, parts.choose, look)
        look_for(search, 1e6, trials, Silent())
        return search

    def test_the_search_begins_with_the_recipe_and_repeats_itself(self):
        one, other = self.search("one", 6), self.search("other", 6)
        self.assertEqual(one.tried, other.tried)
        first = one.tried[0]
        recipe = start_for(one.look)
        for name in ("width", "doubt", "p0", "ridge", "degree"):
            self.assertAlmostEqual(getattr(first.settings, name), getattr(recipe, name), places=9)
        self.assertEqual(len(one.tried), 6)
        self.assertLess(one.best()[0].score, first.score)

    def test_fewer_rows_are_learned_where_time_is_short(self):
        self.assertEqual(rows_that_fit(0.1, 5000, 60), 5000)  # 30 trials of 0.1 s
        self.assertEqual(rows_that_fit(4, 5000, 60), 2500)
        self.assertEqual(rows_that_fit(400, 5000, 60), 500)
        self.assertEqual(rows_that_fit(400, 300, 60), 300)

    def test_a_body_that_makes_solutions_is_left_out(self):
        """Of the rows of the search, or of more rows."""
        search, more = self.search("one", 1), self.search("more", 1)
        (best,) = search.best()
        for factors, taken in (((1.05, 1.05), 2), ((1.5, 1), 1), ((1, 1.5), 1)):
            for part, factor in zip((search, more), factors, strict=True):
                tried = replace(best, solutions=factor * best.solutions)
                part.try_out = mock.Mock(return_value=tried)
            try_body(search, more, 10, Silent())
            self.assertEqual(len(search.tried), taken)
            del search.tried[1:]

    def test_two_tools_are_found(self):
        """Nobody says which row is of which: 2 solutions, near the noise of 1 mm an axis, where
        the Gaussian process lies between both."""
        out = self.folder / "out"
        code, said, error = self.call(ARM, "--trials", 30, "--no-body", "--out", out)
        self.assertEqual(code, 0, error)
        table = {line[:32].strip(): line[32:].split() for line in said.splitlines()}
        ours, others = table["proposed, closest"], table["Gaussian process"]
        self.assertLess(float(ours[1]), 0.004)
        self.assertGreater(float(others[1]), 0.05)
        self.assertAlmostEqual(float(ours[3]), 2, delta=0.1)
        self.assertIn("input  waist", said)
        found = yaml.safe_load((out / "learner.yaml").read_text())
        self.assertEqual((found["experts"], len(found["reference"])), ("polynomial", 4))
        page = (out / "report.html").read_text()
        for title in ("What came out", "Error against samples", "Residuals by joint", "Branches",
                      "The search", "The columns", "The parameters"):  # fmt: skip
            self.assertIn(f"<h2>{title}</h2>", page)
        self.assertEqual(page.count("data:image/png"), 4)

    def test_mistakes_end_in_one_line(self):
        (self.folder / "bad.csv").write_text("1,2,three,4\n" * 60)
        for words, code, reason in (
            ([self.folder / "none.csv"], 1, "none.csv: No such file"),
            ([self.folder / "bad.csv"], 1, "bad.csv:2: column 3"),
        ):
            found, _, error = self.call(*words, "--out", self.folder / "out")
            self.assertEqual((found, error.count("\n")), (code, 1))
            self.assertIn(reason, error)
        for words in ([], [ARM, "--minutes", "0"], [ARM, "--inputs", "four"]):
            with self.assertRaises(SystemExit) as ended:
                self.call(*words)
            self.assertEqual(ended.exception.code, 2)


class Others(unittest.TestCase):
    def test_they_learn_what_they_can(self):
        rng = np.random.default_rng(1)
        z = rng.uniform(-1, 1, (300, 2))
        x = np.stack([3 * z[:, 0] - z[:, 1], np.sin(2 * z[:, 0]) * z[:, 1]], axis=1)
        data = Samples(["a", "b", "x", "y"], z, x)
        train, test = data.rows(slice(0, 250)), data.rows(slice(250, None))
        found = {rival.name: rival for rival in rivals.compare(train, test)}
        error = {name: np.abs(r.predicted - test.x).mean(axis=0) for name, r in found.items()}
        self.assertLess(error["ridge regression, linear"][0], 1e-6)
        self.assertGreater(error["ridge regression, linear"][1], 0.1)
        self.assertLess(error["ridge regression, cubic"][1], 0.1)
        self.assertLess(error["Gaussian process"].max(), 0.01)
        self.assertEqual(found["Gaussian process"].rows, 250)


if __name__ == "__main__":
    unittest.main()
