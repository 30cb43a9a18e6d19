"""What reach-tune makes of a user's files before it looks for parameters."""

import gzip
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np
import yaml
from reach.messages import reach
from reach.tune.columns import look_at
from reach.tune.data import DataError, Samples, read
from reach.tune.parts import counts_up_to, split, thin
from reach.tune.settings import Settings, deviations, most_degree, scales, start_for, yaml_of
from reach.tune.trial import Bench, Measured


def samples(n: int = 100, inputs: int = 4, outputs: int = 3) -> Samples:
    rng = np.random.default_rng(1)
    names = [f"q{i}" for i in range(inputs)] + [f"x{i}" for i in range(outputs)]
    return Samples(names, rng.uniform(-1, 1, (n, inputs)), rng.uniform(-1, 1, (n, outputs)))


class Reading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, text: str | bytes, name: str = "a.csv") -> Path:
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def test_the_shapes_that_programs_write(self):
        rows = samples().z.round(3)
        lines = [[f"{v:g}" for v in row] for row in rows]

        def table(separator: str, decimal: str = ".") -> str:
            return "\n".join(separator.join(row).replace(".", decimal) for row in lines) + "\n"

        marked, quoted = b"\xef\xbb\xbf" + table(",").encode(), '"a","b","c","d"\n' + table(",")
        texts = [table(separator) for separator in (",", ", ", " ", "\t", ";")]
        texts += [table(";", ","), "a,b,c,d\n" + table(","), "a;b;c;d\r\n" + table(";", ",")]
        texts += [marked, quoted, table(",") + "\n\n", gzip.compress(table(",").encode())]
        for text in texts:
            found = read([self.file(text)], 1, 3)
            np.testing.assert_allclose(np.hstack([found.z, found.x]), rows, atol=1e-9)
        self.assertEqual(read([self.file("a,b,c,d\n" + table(","))], 1, 3).names, list("abcd"))

    def test_which_columns_are_outputs(self):
        path = self.file("\n".join(["1,2,3,4,5"] * 60))
        for given, wanted in (((None, None), (2, 3)), ((4, None), (4, 1)), ((None, 1), (4, 1)),
                              ((2, 2), (2, 2))):  # fmt: skip
            self.assertEqual(read([path], *given).dimensions, wanted)
        for given in ((5, None), (4, 2), (None, 5)):
            with self.assertRaises(DataError):
                read([path], *given)

    def test_mistakes_are_named_with_their_place(self):
        good = "1,2,3,4\n"
        for text, reason in (
            (good * 3 + "1,2,3\n", r"a\.csv:4: 3 columns, the first line has 4"),
            (good + "1,two,3,4\n", r"a\.csv:2: column 2: 'two' is no finite number"),
            (good + "1,2,inf,4\n", r"a\.csv:2: column 3"),
            (good, "1 samples are too few"),
            ("", "no row of numbers"),
            ("a,b,c,d\n", "no row of numbers"),
            (gzip.compress(good.encode())[:-9], "damaged gzip"),
            (b"\xff\xfe\x00\x01", "no text"),
        ):
            with self.assertRaisesRegex(DataError, reason):
                read([self.file(text)], None, None)
        with self.assertRaisesRegex(DataError, r"none\.csv: No such file"):
            read([self.folder / "none.csv"], None, None)

    def test_samples_of_a_log(self):
        path = self.folder / "run.lcmlog"
        with path.open("wb") as file:
            for number in range(60):
                sample = reach.sample_t()
                sample.seq, sample.n_inputs, sample.n_outputs = number, 4, 3
                sample.q[:4], sample.x[:3] = [number, 1, 2, 3], [4, 5, number / 2]
                data = sample.encode()
                file.write(b"\xed\xa1\xda\x01" + number.to_bytes(8, "big") + bytes(8)
                           + len(b"REACH_SAMPLE").to_bytes(4, "big")
                           + len(data).to_bytes(4, "big") + b"REACH_SAMPLE" + data)  # fmt: skip
        found = read([path], None, None)
        self.assertEqual(found.dimensions, (4, 3))
        np.testing.assert_allclose(found.z[:, 0], range(60))
        np.testing.assert_allclose(found.x[:, 2], np.arange(60) / 2)

    def test_what_is_written_is_what_was_read(self):
        data = Samples(["joint 1", "b,c", "x", "y", "z"], samples(60, 2).z, samples(60, 2).x)
        again = read([data.write(self.folder / "out.csv")], 2, 3)
        np.testing.assert_allclose(again.z, data.z, rtol=1e-8)
        self.assertEqual(again.names, ["joint_1", "b_c", "x", "y", "z"])


class Looking(unittest.TestCase):
    def test_units_are_guessed(self):
        data = samples(500)
        scale = np.array([1, 90, 40000, 0])
        data = Samples(data.names, np.round(data.z * scale, 3), data.x)
        guesses = [column.guess for column in look_at(data).inputs]
        self.assertEqual(guesses, ["rad", "degrees?", "ticks?", "constant"])
        data.z[:, 1] = np.round(data.z[:, 1])
        self.assertEqual(look_at(data).inputs[1].guess, "whole numbers: encoder ticks?")

    def test_remarks(self):
        data = samples(500)
        data.z[:, 1] = 0.5
        data.z[:, 2] = 2 * data.z[:, 0]
        data.z[7, 3] = 1000
        data.z[9], data.x[9] = data.z[8], data.x[8]
        remarks = " | ".join(look_at(data).remarks)
        for said in ("q1 is 0.5 in all rows", "q0 and q2 say the same", "q3 has wild values",
                     "1 rows are there twice"):  # fmt: skip
            self.assertIn(said, remarks)
        self.assertEqual(look_at(samples(500)).remarks, [])

    def test_order(self):
        data = samples(500)
        self.assertFalse(look_at(data).is_walk)
        walk = Samples(data.names, np.sort(data.z, axis=0), data.x)
        self.assertTrue(look_at(walk).is_walk)

    def test_a_body_wants_joints_in_rad_and_a_place(self):
        data = samples(500)
        self.assertTrue(look_at(data).may_be_a_body)
        self.assertFalse(look_at(Samples(data.names, 50 * data.z, data.x)).may_be_a_body)
        mixed = data.x * [1, 1, 50]  # two angles and a disparity
        self.assertFalse(look_at(Samples(data.names, data.z, mixed)).may_be_a_body)


class Parting(unittest.TestCase):
    def test_no_row_is_in_two_parts(self):
        n = 1000
        data = Samples(["n", "x"], np.arange(n)[:, None] * 1.0, np.zeros((n, 1)))
        parts = split(data)
        learn, choose, both, judge = (
            set(part.z[:, 0]) for part in (parts.learn, parts.choose, parts.both, parts.judge)
        )
        self.assertEqual((len(learn), len(choose), len(judge)), (600, 200, 200))
        self.assertEqual(both, learn | choose)
        self.assertFalse(both & judge or learn & choose)
        self.assertTrue(np.all(np.diff(parts.both.z[:, 0]) > 0))
        for part in (choose, judge):  # in stretches, in every third of the stream
            self.assertEqual(sum(v + 1 in part for v in part), 195)
            for third in range(3):
                self.assertTrue(any(third * n / 3 <= v < (third + 1) * n / 3 for v in part))

    def test_thinned_rows_are_stretches_in_order(self):
        data = Samples(["n", "x"], np.arange(9999.0)[:, None], np.zeros((9999, 1)))
        few = thin(data, 800).z[:, 0]
        self.assertEqual(len(few), 800)
        steps = np.diff(few)
        self.assertTrue(np.all(steps > 0))
        self.assertEqual((steps > 1).sum(), 39)
        self.assertEqual((few[0], few[-1]), (0, 9998))
        self.assertEqual(len(thin(data, 20000)), 9999)

    def test_counts_of_a_curve(self):
        self.assertEqual(counts_up_to(10), [10])
        counts = counts_up_to(1000)
        self.assertEqual((counts[0], counts[-1], counts == sorted(set(counts))), (20, 1000, True))


class Proposing(unittest.TestCase):
    def test_the_file_says_what_the_settings_mean(self):
        data = samples(2000)
        look = look_at(Samples(data.names, data.z, data.x * [1, 1, 0.5]))
        settings = Settings(width=0.5, doubt=0.02, noise=0.1, p0=1e-4, ridge=1e-6, degree=3)
        text = yaml_of(settings, look, "Of a test.")
        found = yaml.safe_load(text)
        self.assertEqual((found["experts"], found["degree"], found["p0"]), ("polynomial", 3, 1e-4))
        np.testing.assert_allclose(found["scale"], [0.98] * 4, atol=0.01)  # half of 98 % of 2
        np.testing.assert_allclose(found["psi0"], [(0.02 * 1.96) ** 2] * 3, rtol=0.02)
        self.assertAlmostEqual(found["noise_share"], 0.01)
        for name in ("degree", "reference", "scale", "psi0", "noise_share", "p0", "ridge"):
            (line,) = [line for line in text.splitlines() if line.startswith(f"{name}:")]
            self.assertIn("  # ", line)
        self.assertEqual(yaml.safe_load(yaml_of(settings.as_body(), look, ""))["experts"], "body")

    def test_inputs_and_outputs_of_other_units_have_their_own(self):
        data = samples(2000)
        look = look_at(Samples(data.names, data.z * [1, 100, 1, 1], data.x * [1, 1, 50]))
        settings = Settings(width=0.5, doubt=0.02)
        np.testing.assert_allclose(scales(settings, look), [0.98, 98, 0.98, 0.98], rtol=0.02)
        np.testing.assert_allclose(deviations(settings, look), [0.039, 0.039, 1.96], rtol=0.02)

    def test_experts_stay_small(self):
        for d in range(1, 17):
            degree = most_degree(d)
            self.assertTrue(degree == 1 or math.comb(d + degree, degree) <= 800)
        self.assertEqual((most_degree(4), most_degree(7), most_degree(16)), (6, 5, 2))
        self.assertEqual(start_for(look_at(samples(60, 16))).degree, 2)


class Scoring(unittest.TestCase):
    def score(self, error: np.ndarray, solutions: float = 1.0) -> float:
        n, D = error.shape
        bench = Bench(Path(), Path(), Path(), Path(), np.zeros((n, D)), np.full(D, 2.0), (4, D))
        measured = Measured(error, error, np.full(n, solutions), {}, [])
        return bench.score(measured)

    def test_the_error_is_in_shares_of_the_range(self):
        self.assertAlmostEqual(self.score(np.full((100, 3), 0.1)), 0.05)

    def test_a_few_wrong_rows_do_not_choose(self):
        error = np.full((100, 3), 0.1)
        error[:5] = 100
        self.assertAlmostEqual(self.score(error), 0.05)
        error[5] = 100
        self.assertGreater(self.score(error), 1)

    def test_solutions_at_random_are_no_gain(self):
        """The nearest of many random places is nearer by chance: that must not count."""
        rng = np.random.default_rng(1)
        places = rng.uniform(-1, 1, (4000, 64, 3))
        truth = rng.uniform(-0.3, 0.3, (4000, 1, 3))
        off = places - truth
        scores = []
        for n in (8, 64):
            nearest = np.argmin(np.linalg.norm(off[:, :n], axis=2), axis=1)
            scores.append(self.score(off[np.arange(4000), nearest], n))
        self.assertGreater(scores[1], 1.5 * scores[0])
        self.assertAlmostEqual(self.score(np.full((9, 3), 0.1), 8), 8 * 0.05)

    def test_rows_without_an_answer_count_as_the_whole_range(self):
        self.assertAlmostEqual(self.score(np.full((100, 3), np.nan)), 1)


if __name__ == "__main__":
    unittest.main()
