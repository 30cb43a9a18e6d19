"""reach-eval on every kind of mistake: refused in one line, with the right code."""

import gzip
import unittest

from reach_eval_bed import Fixture, run, samples


class Mistakes(Fixture):
    def refused(self, code: int, *words) -> str:
        """One line, the code, and no report."""
        result = run(*words)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertFalse(self.json.exists())
        return result.stderr

    def refused_file(self, name: str, content: str) -> str:
        return self.refused(1, *self.words("--train", self.text(name, content)))

    def test_rows(self):
        good = "1,2,3,4,5\n"
        for content, where, reason in (
            (good + "1,2,3,4\n", ":2: ", "4 columns, the lines before have 5"),
            (good + "1,2,3,4,5,6\n", ":2: ", "6 columns"),
            (good + "1,2,3,4,5\0,6\n", ":2: ", "zero byte"),
            (good + good + "1,2,nan,4,5\n", ":3: ", "column 3: 'nan' is not a finite number"),
            (good + "1,2,3,inf,5\n", ":2: ", "column 4: 'inf'"),
            (good + "1,2,3,4,five\n", ":2: ", "column 5: 'five'"),
            (good + "1,2,3,4,\n", ":2: ", "column 5: ''"),
            (good + "\n" + good, ":2: ", "the line is empty"),
            ("a,b,c,4,e\n" + good, ":1: ", "column 1: 'a'"),
            ("a,b,c,d,e\n", ":2: ", "no row of numbers"),
            ("", ":1: ", "no row of numbers"),
            ("1,2,3,4\n", ":1: ", "4 columns; wanted: 5 (3 inputs, 2 outputs), or 11 with the"),
            ("a,b,c,d\n" + good, ":1: ", "4 columns; wanted: 5"),
            ("1," * 300 + "\n", ":1: ", "256 columns or more"),
            ("1" * 70000 + "\n", ":1: ", "the line is too long"),
            ("1;2;3;4;5\n", ":1: ", "the separator is a semicolon; wanted: a comma"),
            ("1,5;2,5;3,5;4,5;5,5\n", ":1: ", "the separator is a semicolon"),
            ("a;b;c;d;e\n1;2;3;4;5\n", ":1: ", "the separator is a semicolon"),
            ("1 2 3 4 5\n", ":1: ", "the separator is a space"),
            ("  1  2 3 4 5 \n", ":1: ", "the separator is a space"),
            ("1\t2\t3\t4\t5\n", ":1: ", "the separator is a tab"),
            (good + "1;2;3;4;5\n", ":2: ", "the separator is a semicolon"),
            ("a,b,c,d,e\n1 2 3 4 5\n", ":2: ", "the separator is a space"),
        ):
            error = self.refused_file("bad.csv", content)
            self.assertIn(f"{self.folder}/bad.csv{where}", error)
            self.assertIn(reason, error)

    def test_files(self):
        good = self.write("good.csv", samples(10, 1))
        error = self.refused(1, *self.words("--train", self.folder / "none.csv"))
        self.assertIn("none.csv: No such file", error)
        self.assertIn("directory", self.refused(1, *self.words("--train", self.folder)))
        packed = gzip.compress("".join(f"{i},2,3,4,5\n" for i in range(2000)).encode())
        (self.folder / "cut.csv.gz").write_bytes(packed[: len(packed) // 2])
        error = self.refused(1, *self.words("--train", self.folder / "cut.csv.gz"))
        self.assertRegex(error, r"cut\.csv\.gz:\d+: ")
        (self.folder / "bad.csv.gz").write_bytes(packed[:-8] + bytes(8))
        error = self.refused(1, *self.words("--train", self.folder / "bad.csv.gz"))
        self.assertRegex(error, r"bad\.csv\.gz:\d+: the compressed file is damaged")
        error = self.refused(1, *self.words("--train", f"{good},{self.folder}/x.csv"))
        self.assertIn("x.csv: No such file", error)
        error = self.refused(1, *self.words("--train", good, "--test", f"t={self.folder}/t.csv"))
        self.assertIn("t.csv: No such file", error)
        one = self.write("one.csv", samples(1, 1))
        error = self.refused(1, *self.words("--train", good, "--track", f"t={one}"))
        self.assertIn("one.csv: a track needs two rows", error)

    def test_too_few_samples(self):
        good = self.write("good.csv", samples(10, 1))
        error = self.refused(1, *self.words("--train", good, "--at", "5,11"))
        self.assertIn("good.csv: --at 11 is beyond the 10 training samples", error)

    def test_parameters(self):
        train = ["--train", self.write("good.csv", samples(10, 1))]
        for words, reason in (
            (["--param", "speed=1"], "--param:1: speed: unknown option"),
            (["--param", "degree=two"], "--param:1: degree: 'two' is not a number"),
            (["--param", "degree"], "'degree': name=value is wanted"),
            (["--param", "psi0=[1, 2, 3]"], "psi0 has 3 entries; wanted: 2, or one number"),
            (["--param", "psi0=1,2,3"], "psi0 has 3 entries; wanted: 2, or one number"),
            (["--param", "psi0=1,two"], "--param:1: psi0: 'two' is not a number"),
            (["--param", "alpha=0.5"], "--param:1: alpha: 0.5 is out of range 0.9 .. 1"),
            (["--param", "clustering=none"], "'none' is not one of published|split|leader"),
            (["--config", self.folder / "no.yaml"], "no.yaml: No such file"),
            (["--config", self.text("bad.yaml", "degree: 2\nkind: imle\n")],
             "bad.yaml:2: kind: unknown option"),
            (["--config", self.text("twice.yaml", "degree: 2\ndegree: 3\n")],
             "twice.yaml:2: degree: given twice"),
        ):  # fmt: skip
            self.assertIn(reason, self.refused(1, *self.words(*train, *words)))
        error = self.refused(1, "--learner", "imle", "--inputs", 3, "--outputs", 2, *train,
                             "--json", self.json)  # fmt: skip
        self.assertIn("psi0 must be given", error)

    def test_models(self):
        train = ["--train", self.write("good.csv", samples(30, 1))]
        model = self.folder / "model"
        self.assertEqual(run(*self.words(*train, "--save", model)).returncode, 0)
        self.json.unlink()
        whole = model.read_bytes()
        for content, reason in (
            (whole[:-1], "cut short"),
            (whole[:20], "cut short"),
            (whole[:300] + b"x" + whole[301:], "checksum"),
            (b"x" * 1000, "not a saved learner"),
        ):
            (self.folder / "bad").write_bytes(content)
            error = self.refused(1, *self.words(*train, "--load", self.folder / "bad"))
            self.assertIn(f"{self.folder}/bad: ", error)
            self.assertIn(reason, error)
        error = self.refused(1, *self.words(*train, "--param", "ridge=1", "--load", model))
        self.assertIn("model: saved with other parameters", error)
        error = self.refused(1, *self.words(*train, "--load", self.folder / "none"))
        self.assertIn("none: No such file", error)

    def test_outputs_that_cannot_be(self):
        train = ["--train", self.write("good.csv", samples(30, 1))]
        for option in ("--save", "--rows", "--json"):
            error = self.refused(1, *self.words(*train, option, self.folder / "no/where"))
            self.assertIn("no/where: No such file", error)
            error = self.refused(1, *self.words(*train, option, self.folder))
            self.assertIn("is not a file", error)

    def test_wrong_usage(self):
        train = ["--train", self.write("good.csv", samples(10, 1))]
        for words, reason in (
            (["--fly"], "unrecognized option"),
            (["--learner", "none"], "unknown learner 'none'"),
            (["--inputs", "0"], "--inputs: a whole number from 1 to 16"),
            (["--inputs", "17"], "--inputs: a whole number from 1 to 16"),
            (["--outputs", "9"], "--outputs: a whole number from 1 to 8"),
            (["--outputs", "two"], "--outputs: a whole number"),
            (["--at", "10,5"], "--at: numbers must grow"),
            (["--at", "5,5"], "--at: numbers must grow"),
            (["--at", "ten"], "--at: whole numbers"),
            (["--at", "-1"], "--at: whole numbers"),
            (["--test", "name"], "--test: NAME=FILE is wanted, not 'name'"),
            (["--track", "=x"], "--track: NAME=FILE is wanted"),
            (["--test", "a=x", "a=y"], "the name a is given twice"),
            (["--train", "a,,b"], "a file's name is missing"),
            (["--quiet", "word"], "unexpected word 'word'"),
        ):
            self.assertIn(reason, self.refused(2, *self.words(*train, *words)))
        self.assertIn("--learner is missing", self.refused(2, "--inputs", 3))
        start = ["--learner", "imle"]
        self.assertIn("--inputs is missing", self.refused(2, *start, "--outputs", 2))
        start += ["--inputs", 3]
        self.assertIn("--outputs is missing", self.refused(2, *start))
        start += ["--outputs", 2]
        self.assertIn("--train is missing", self.refused(2, *start, "--json", self.json))
        self.assertIn("--json is missing", self.refused(2, *start, *train))


if __name__ == "__main__":
    unittest.main()
