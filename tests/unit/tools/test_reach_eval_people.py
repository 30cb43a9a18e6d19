"""reach-eval for people with data of their own: what it tells beside the RMSE, and warns of."""

import csv
import os
import unittest
from pathlib import Path

import numpy as np
from reach_eval_bed import SLOPE, STEP, Fixture, run, samples

ETC = Path(os.environ["REACH_SOURCE_DIR"]) / "etc"


def smallest_not_exceeded(values, share: float) -> float:
    return np.sort(values)[int(np.ceil(share * len(values))) - 1]


class Told(Fixture):
    def noisy_test(self, n: int = 80, deviation: float = 0.1):
        rows = samples(n, 5)
        errors = np.random.default_rng(6).normal(0, deviation, (n, 2))
        rows[:, 3:] += errors
        return self.write("t.csv", rows), errors

    def test_median_and_95_percent_point_of_the_distance(self):
        test, errors = self.noisy_test()
        report = self.evaluate("--train", self.write("train.csv", samples(400, 1)),
                               "--test", f"t={test}")  # fmt: skip
        distance = np.linalg.norm(errors, axis=1)
        for kind in ("closest", "strongest", "single"):
            found = report["results"][0]["test"]["t"][kind]
            for key, share in (("median", 0.5), ("p95", 0.95)):
                wanted = smallest_not_exceeded(distance, share)
                self.assertAlmostEqual(found[key], wanted, delta=1e-4)

    def test_errors_of_the_stated_size_are_calibrated(self):
        """psi0 is the noise's own variance: ratios are those of a Gaussian, 0.67 and 1.96."""
        train = samples(4000, 1)
        train[:, 3:] += np.random.default_rng(2).normal(0, 0.1, (4000, 2))
        test, _ = self.noisy_test(4000)
        report = self.evaluate("--train", self.write("train.csv", train), "--test", f"t={test}")
        calibration = report["results"][0]["test"]["t"]["calibration"]
        self.assertEqual(calibration["n"], 8000)
        self.assertAlmostEqual(calibration["median"], 0.674, delta=0.04)
        self.assertAlmostEqual(calibration["p95"], 1.96, delta=0.08)

    def test_rows_are_what_the_report_sums_up(self):
        rows = self.folder / "rows.csv"
        test, _ = self.noisy_test()
        report = self.evaluate(
            "--train", self.write("a.csv", samples(300, 1)),
            self.write("b.csv", samples(300, 2, STEP)), "--at", "0,600",
            "--test", f"t={test}", "--track", f"w={test}", "--rows", rows,
        )  # fmt: skip
        table = list(csv.DictReader(rows.read_text().splitlines()))
        self.assertEqual([(r["set"], r["row"]) for r in table],
                         [("t", str(k)) for k in range(1, 81)]
                         + [("w", str(k)) for k in range(2, 81)])  # fmt: skip
        last = report["results"][-1]
        for name, kinds in (("t", ("closest", "strongest", "single")),
                            ("w", ("closest", "strongest", "followed"))):  # fmt: skip
            of_set = [r for r in table if r["set"] == name]
            score = last["test" if name == "t" else "track"][name]
            self.assertAlmostEqual(np.mean([int(r["solutions"]) for r in of_set]),
                                   score["solutions"], delta=1e-9)  # fmt: skip
            for kind in kinds:
                error = [[float(r[f"{kind}{i}"]) - float(r[f"x{i}"]) for i in (1, 2)]
                         for r in of_set]  # fmt: skip
                rmse = np.sqrt(np.mean(np.square(error), axis=0))
                np.testing.assert_allclose(rmse, score[kind]["rmse"], rtol=1e-6)
        share = [abs(float(r[f"closest{i}"]) - float(r[f"x{i}"])) / float(r[f"closest_sd{i}"])
                 for r in table if r["set"] == "t" for i in (1, 2)]  # fmt: skip
        calibration = last["test"]["t"]["calibration"]
        self.assertAlmostEqual(smallest_not_exceeded(share, 0.95), calibration["p95"], delta=1e-5)
        self.assertEqual((table[0]["followed1"], table[-1]["single1"]), ("", ""))

    def test_the_table_for_people_has_strongest_and_median(self):
        test, _ = self.noisy_test()
        said = run(*self.words("--train", self.write("a.csv", samples(300, 1)),
                               "--test", f"t={test}", "--track", f"w={test}")).stdout  # fmt: skip
        for name in ("t", "w"):
            (line,) = [line for line in said.splitlines() if line.startswith(f"  {name} ")]
            for word in ("closest", "strongest", "median", "error/sd"):
                self.assertIn(word, line)

    def test_a_hundred_files(self):
        files = [self.write(f"{k}.csv", samples(4, k)) for k in range(100)]
        tests = [f"n{k}={path}" for k, path in enumerate(files)]
        report = self.evaluate("--train", *files, "--test", *tests)
        self.assertEqual([entry["rows"] for entry in report["train"]], [4] * 100)
        self.assertEqual(len(report["results"][0]["test"]), 100)

    def test_lists_without_brackets(self):
        train = self.write("a.csv", samples(300, 1))
        report = self.evaluate("--train", train, "--param", "reference=0,1,2", "scale=3")
        self.assertEqual(report["parameters"]["reference"], [0, 1, 2])
        self.assertEqual(report["parameters"]["scale"], [3, 3, 3])

    def test_a_spreadsheet_marks_its_files(self):
        train = self.folder / "a.csv"
        rows = "\r\n".join(",".join(map(str, row)) for row in samples(20, 1))
        train.write_bytes(b"\xef\xbb\xbf" + rows.encode())
        self.assertEqual(self.evaluate("--train", train)["train"][0]["rows"], 20)


class Warned(Fixture):
    def walk(self, n: int = 600) -> np.ndarray:
        """Slow and smooth, with measured outputs."""
        z = np.sin(np.outer(np.arange(n), [0.011, 0.017, 0.023]))
        return np.hstack([z, z @ SLOPE.T + np.random.default_rng(1).normal(0, 1e-3, (n, 2))])

    def test_a_frozen_tracker_is_told_and_not_learned(self):
        rows = self.walk()
        rows[200:300, 3:] = rows[200, 3:]
        train, test = self.write("a.csv", rows), self.write("t.csv", self.walk())
        words = self.words("--train", train, "--test", f"t={test}")
        (warning,) = self.warnings_of(*words)
        self.assertRegex(warning, r"in (9[789]|100) of 600 samples .* first in sample 20[2-4]:")
        (kept,) = [w for w in self.warnings_of(*words, "--keep-frozen") if "stood still" in w]
        self.assertEqual(kept, warning)

    def test_frozen_samples_are_counted(self):
        rows = self.walk()
        rows[200:300, 3:] = rows[200, 3:]
        words = ["--train", self.write("a.csv", rows)]
        for more, learned in (([], 0), (["--keep-frozen"], 1)):
            run(*self.words(*words, *more))
            result = self.report()["results"][0]
            self.assertGreaterEqual(result["frozen"], 97)
            handed = result["samples"] + result["outliers"] + result["full"]
            self.assertEqual(handed, 600 - result["frozen"] * (1 - learned))

    def test_degrees_taken_for_radians(self):
        """Column, value and scale are named, in training and in test files."""
        rng = np.random.default_rng(1)
        z = rng.uniform(-1, 1, (300, 7))
        rows = np.hstack([z, z @ rng.uniform(-0.1, 0.1, (7, 3))])
        rows[100, 4] = 80.0
        config = ["--config", ETC / "learner-icub.yaml", "--param", "psi0=1"]
        names = "a,b,c,d,elbow,f,g,x,y,z"
        wrong = self.write("deg.csv", rows, names)
        rows[100, 4] = 0.8
        right = self.write("rad.csv", rows, names)
        start = ["--learner", "imle", "--inputs", 7, "--outputs", 3, "--json", self.json, *config]
        told = "is 80 in sample 101, 53 scales from its reference 0.7 (scale 1.5)"
        self.assertEqual(self.warnings_of(*start, "--train", right), [])
        (warning,) = self.warnings_of(*start, "--train", wrong)
        self.assertIn(f"training: input 5 (elbow) {told}", warning)
        (warning,) = self.warnings_of(*start, "--train", right, "--test", f"t={wrong}")
        self.assertIn(f"{wrong}: input 5 (elbow) {told}", warning)

    def test_a_constant_column(self):
        rows = samples(300, 1)
        rows[:, 1] = 0.25
        rows[:, 3:] = rows[:, :3] @ SLOPE.T
        (warning,) = self.warnings_of(*self.words("--train", self.write("a.csv", rows)))
        self.assertIn("input 2 is 0.25 in all 300 samples", warning)

    def test_a_configuration_that_was_taken_by_default(self):
        rng = np.random.default_rng(1)
        z = rng.uniform(-1, 1, (300, 4))
        rows = np.hstack([z, z @ rng.uniform(-9, 9, (4, 3))])
        start = ["--learner", "imle", "--inputs", 4, "--outputs", 3, "--json", self.json,
                 "--train", self.write("a.csv", rows)]  # fmt: skip
        (warning,) = self.warnings_of(*start)
        self.assertIn("no --config: learner-kobian-offline.yaml was taken by default for 4 inputs "
                      "and 3 outputs", warning)  # fmt: skip
        self.assertEqual(
            self.warnings_of(*start, "--config", ETC / "learner-kobian-offline.yaml"), []
        )

    def test_dropped_samples_and_too_many_experts(self):
        """300 random postures, births as published: 16 experts, and most rows are dropped."""
        rng = np.random.default_rng(1)
        z = rng.uniform(-1, 1, (300, 7))
        rows = np.hstack([z, np.sin(2 * z[:, :3]) + np.cos(2 * z[:, 3:6])])
        start = ["--learner", "imle", "--inputs", 7, "--outputs", 3, "--json", self.json,
                 "--train", self.write("a.csv", rows),
                 "--config", ETC / "learner-icub.yaml"]  # fmt: skip
        warnings = " ".join(
            self.warnings_of(
                *start, "--param", "p0=0.1", "psi0=1e-4", "births=published", "n_outliers=3"
            )
        )
        self.assertRegex(warnings, r"of 300 samples .* were dropped: all 16 experts are in use")
        self.assertRegex(warnings, r"of 300 samples .* were dropped as outliers")
        self.assertRegex(warnings, r"16 experts from \d+ samples: more than there are branches")


if __name__ == "__main__":
    unittest.main()
