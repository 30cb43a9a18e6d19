"""reach-eval on generated data whose answers are known."""

import json
import os
import re
import unittest
from pathlib import Path

import numpy as np
from reach_eval_bed import SLOPE, STEP, Fixture, run, samples

SOURCE = Path(os.environ["REACH_SOURCE_DIR"])


def fields_of(struct: str, prefix: str = "") -> set[str]:
    """The fields of a struct in learner/learner.h; those of a struct in it as "outer.inner"."""
    header = re.sub(r"/\*.*?\*/", "", (SOURCE / "learner/learner.h").read_text(), flags=re.S)
    body = re.search(rf"struct {struct} \{{(.*?)\n\}};", header, re.S).group(1)
    fields = set()
    for kind, name in re.findall(r"([\w ]+?) (\w+)(?:\[\w+\])?;", body):
        inner = re.fullmatch(r"\s*struct (\w+)", kind)
        fields |= fields_of(inner[1], f"{name}.") if inner else {prefix + name}
    return fields


class Numbers(Fixture):
    def two_tools(self) -> list:
        """Learned: a function, and the same with a step added."""
        return ["--train", self.write("a.csv", samples(300, 1)),
                self.write("b.csv.gz", samples(300, 2, STEP))]  # fmt: skip

    def test_errors_are_those_of_the_test_set(self):
        offset = np.array([0.03, -0.04])
        train = self.write("train.csv", samples(400, 1))
        report = self.evaluate(
            "--train", train,
            "--test", f"exact={self.write('t.csv', samples(50, 2))}",
            f"off={self.write('o.csv', samples(50, 3, offset))}",
        )  # fmt: skip
        (result,) = report["results"]
        self.assertEqual((result["at"], result["experts"]), (400, 1))
        for kind in ("closest", "strongest", "single"):
            exact, off = (result["test"][name][kind] for name in ("exact", "off"))
            self.assertLess(exact["mean"], 1e-4)
            self.assertEqual(off["n"], 50)
            np.testing.assert_allclose(off["rmse"], abs(offset), atol=1e-4)
            self.assertAlmostEqual(off["mean"], 0.035, delta=1e-4)

    def test_a_curve_may_have_hundreds_of_counts(self):
        train, test = self.write("a.csv", samples(400, 1)), self.write("t.csv", samples(5, 2))
        counts = list(range(1, 401))
        report = self.evaluate("--train", train, "--at", ",".join(map(str, counts)),
                               "--test", f"t={test}")  # fmt: skip
        self.assertEqual([result["at"] for result in report["results"]], counts)

    def test_rmse_is_the_root_of_the_mean_square(self):
        """Errors of unequal size, which a mean of absolute values would get wrong."""
        rows = samples(60, 5)
        errors = np.random.default_rng(6).normal(0, 0.1, (60, 2))
        rows[:, 3:] += errors
        report = self.evaluate("--train", self.write("train.csv", samples(400, 1)),
                               "--test", f"t={self.write('t.csv', rows)}")  # fmt: skip
        wanted = np.sqrt((errors**2).mean(axis=0))
        found = report["results"][0]["test"]["t"]["closest"]
        np.testing.assert_allclose(found["rmse"], wanted, atol=1e-4)
        self.assertAlmostEqual(found["mean"], wanted.mean(), delta=1e-4)

    def test_two_branches(self):
        second = samples(40, 9, STEP)
        report = self.evaluate(*self.two_tools(),
                               "--test", f"first={self.write('f.csv', samples(40, 8))}",
                               f"second={self.write('s.csv', second)}")  # fmt: skip
        test = report["results"][0]["test"]
        for name in ("first", "second"):
            self.assertEqual(test[name]["solutions"], 2)
            self.assertEqual(test[name]["solutions_histogram"][2], 40)
            self.assertLess(test[name]["closest"]["mean"], 0.01)
        # At each query one branch is the strongest: the errors of the two sets are the whole step.
        squares = sum(np.array(test[n]["strongest"]["rmse"]) ** 2 for n in ("first", "second"))
        self.assertGreater(max(squares), 0.1)

    def test_wrong_branches_are_counted(self):
        rows = samples(31, 11)
        rows[:, :3] = 0.01 * np.arange(31)[:, None] * np.ones(3)  # slow: shorter than a step
        on_second = (np.arange(31) // 10) % 2 == 1  # changes at 10, 20 and 30
        rows[:, 3:] = rows[:, :3] @ SLOPE.T + np.outer(on_second, STEP)
        report = self.evaluate(*self.two_tools(),
                               "--track", f"walk={self.write('w.csv', rows)}")  # fmt: skip
        track = report["results"][0]["track"]["walk"]
        self.assertEqual((track["rows"], track["wrong"], track["unanswered"]), (30, 3, 0))
        self.assertAlmostEqual(track["wrong_branch"], 0.1)
        wanted = STEP * np.sqrt(3 / 30)
        np.testing.assert_allclose(track["followed"]["rmse"], wanted, atol=0.005)
        self.assertLess(track["closest"]["mean"], 0.01)

    def test_jacobians_are_compared_where_a_file_has_them(self):
        rows = samples(30, 4)
        true = np.hstack([rows, np.tile(SLOPE.ravel(), (30, 1))])
        double = np.hstack([rows, np.tile(2 * SLOPE.ravel(), (30, 1))])
        report = self.evaluate("--train", self.write("train.csv", samples(400, 1)), "--test",
                               f"true={self.write('t.csv', true)}",
                               f"double={self.write('d.csv', double)}",
                               f"none={self.write('n.csv', rows)}")  # fmt: skip
        test = report["results"][0]["test"]
        self.assertLess(test["true"]["jacobian"]["median"], 1e-3)
        self.assertEqual(test["double"]["jacobian"]["n"], 30)
        for key in ("median", "mean"):
            self.assertAlmostEqual(test["double"]["jacobian"][key], 0.5, delta=1e-3)
            self.assertIsNone(test["none"]["jacobian"][key])

    def test_measured_at_every_count(self):
        report = self.evaluate("--train", self.write("a.csv", samples(50, 1)),
                               self.write("b.csv", samples(50, 2, STEP)), "--at", "0,10,50,80",
                               "--test", f"second={self.write('s.csv', samples(20, 3, STEP))}",
                               )  # fmt: skip
        results = report["results"]
        self.assertEqual([r["at"] for r in results], [0, 10, 50, 80])
        self.assertEqual([r["samples"] + r["outliers"] for r in results], [0, 10, 50, 80])
        self.assertEqual([r["update_us"]["n"] for r in results], [0, 10, 40, 30])
        self.assertEqual([r["experts"] for r in results], [0, 1, 1, 2])
        empty = results[0]["test"]["second"]
        self.assertEqual((empty["unanswered"], empty["solutions"]), (20, 0))
        self.assertIsNone(empty["closest"]["mean"])
        self.assertIsNone(results[0]["update_us"]["p50"])
        self.assertAlmostEqual(results[2]["test"]["second"]["closest"]["mean"], 0.75, delta=0.01)
        self.assertLess(results[3]["test"]["second"]["closest"]["mean"], 0.05)

    def test_times_are_ordered(self):
        report = self.evaluate("--train", self.write("a.csv", samples(500, 1)),
                               "--test", f"t={self.write('t.csv', samples(300, 2))}")  # fmt: skip
        for key, n in (("update_us", 500), ("predict_us", 300)):
            times = report["results"][0][key]
            self.assertEqual(times["n"], n)
            self.assertTrue(0 < times["p50"] <= times["p99"] <= times["p999"] <= times["max"])

    def test_header_and_gzip_change_nothing(self):
        rows = samples(100, 1)
        found = []
        for train in (self.write("plain.csv", rows), self.write("packed.csv.gz", rows),
                      self.write("named.csv", rows, "a,b,c,x,y")):  # fmt: skip
            test = self.write("t.csv", samples(20, 2))
            report = self.evaluate("--train", train, "--test", f"t={test}")
            self.assertEqual(report["train"][0]["rows"], 100)
            found.append(report["results"][0]["test"])
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])

    def test_a_saved_model_is_the_same_model(self):
        test = ["--test", f"t={self.write('t.csv', samples(30, 3, STEP))}"]
        model = self.folder / "model"
        learned = self.evaluate(*self.two_tools(), *test, "--save", model)["results"][0]
        loaded = self.evaluate("--load", model, *test)["results"][0]
        self.assertEqual(loaded["at"], 0)
        for key in ("experts", "samples", "outliers", "test"):
            self.assertEqual(loaded[key], learned[key])
        more = self.evaluate("--load", model, "--train", self.folder / "a.csv", "--at", "0,300")
        self.assertEqual([r["samples"] for r in more["results"]],
                         [learned["samples"], learned["samples"] + 300])  # fmt: skip

    def test_parameters_are_reported(self):
        config = self.text("c.yaml", "degree: 2\nexperts: polynomial\nreference: [0.1, 0.2, 0]\n")
        train = self.write("a.csv", samples(300, 1))
        report = self.evaluate("--train", train, "--config", config, "--param", "degree=4")
        parameters = report["parameters"]
        self.assertEqual((parameters["degree"], parameters["experts"]), (4, "polynomial"))
        self.assertEqual(parameters["reference"], [0.1, 0.2, 0])
        self.assertEqual(parameters["psi0"], [0.01, 0.01])
        self.assertEqual(parameters["prior_psi"], ".inf")
        self.assertEqual(report["config"], [str(config)])

    def test_every_parameter_of_the_learner_is_an_option(self):
        fields = fields_of("learner_config")
        self.assertIn("gamma_floor", fields)
        listed = run("--learner", "imle", "--inputs", 3, "--outputs", 2, "--help-options").stdout
        options = set(re.findall(r"^([\w.]+) ", listed, re.M))
        not_listed = {"kind", "n_inputs", "n_outputs", "features", "body.order"}
        expected = fields - not_listed | {"experts"}
        self.assertEqual(expected, options)
        self.assertRegex(listed, r"hyper_sigma .*\n +number, default 8, ")  # 2^d

    def test_shipped_configurations_are_taken(self):
        rng = np.random.default_rng(1)
        for n, robot in ((7, "icub"), (4, "kobian-offline")):
            train = self.write(f"{n}.csv", rng.uniform(-1, 1, (30, n + 3)))
            shape = ["--inputs", n, "--outputs", 3, "--json", self.json, "--train", train]
            for learner, name in (("imle", robot), ("lwpr", f"{robot}-lwpr")):
                result = run("--learner", learner, *shape)
                self.assertEqual(result.returncode, 0, result.stderr)
                (config,) = json.loads(self.json.read_text())["config"]
                self.assertEqual(Path(config).name, f"learner-{name}.yaml")
            linear = SOURCE / f"etc/learner-{robot}-linear.yaml"
            result = run("--learner", "imle", *shape, "--config", linear)
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_help_and_version(self):
        self.assertIn("--track NAME=FILE", run("--help").stdout)
        self.assertRegex(run("--version").stdout, r"^reach-eval \d+\.\d+\.\d+ \(.+\)\n$")


if __name__ == "__main__":
    unittest.main()
