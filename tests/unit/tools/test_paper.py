"""From complete runs to the report: what is done again and what is not, on made-up logs."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

import balanced
import synthetic
from reach import metrics
from reach.paper import __main__ as paper
from reach.paper import k1, k2, kobian, packed, perform, plan, report, track
from reach.record import Record
from reach.run_folder import claimed

PHASES = ("learn_hand", "test_hand_500", "learn_tool", "test_tool_1000", "test_hand_1000",
          "learn_again", "test_hand_1300", "frozen_hand", "coordinate_hand", "star_hand",
          "test_tool_1300", "frozen_tool", "coordinate_tool", "star_tool")  # fmt: skip
RESTING = np.zeros((17, 3))
TARGETS = {"frozen": RESTING, "coordinate": RESTING,
           "star": np.vstack([track.LEAD_IN, metrics.star_targets()])}  # fmt: skip
SIZES = {"hand": 12, "tool": 12, "again": 12, "tests": 12, "turn_seconds": 2.0,
         "star_seconds": 2.0}  # fmt: skip


def finish(run: plan.Run, folder: Path, version: str) -> None:
    """A complete run of 12 samples a phase."""
    folder.mkdir(parents=True, exist_ok=True)
    made = synthetic.make(folder, 12, PHASES, TARGETS)
    made |= {"group": "kobian", "learner": run.learner, "seed": run.seed,
             "settings": run.settings, "inputs": run.inputs(version)}  # fmt: skip
    packed.pack(folder)
    (folder / "run.json").write_text(json.dumps(made))


class Resuming(unittest.TestCase):
    """A run is done again when its inputs have changed, and only then."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        self.run_ = plan.Run(kobian, "body", 1, True)
        self.inputs = self.run_.inputs("v1")
        (self.folder / "run.lcmlog.gz").touch()
        (self.folder / "run.json").write_text(json.dumps({"inputs": self.inputs}))

    def test_same_inputs_are_complete(self):
        self.assertTrue(plan.is_complete(self.folder, self.inputs))

    def test_an_unfinished_or_damaged_folder_is_not(self):
        (self.folder / "run.json").write_text('{"inputs": ')
        self.assertFalse(plan.is_complete(self.folder, self.inputs))
        (self.folder / "run.json").unlink()
        self.assertFalse(plan.is_complete(self.folder, self.inputs))

    def test_another_version_is_not_unless_it_may_be(self):
        inputs = self.run_.inputs("v2")
        self.assertFalse(plan.is_complete(self.folder, inputs))
        self.assertTrue(plan.is_complete(self.folder, inputs, any_version=True))

    def test_other_sizes_seeds_or_learners_are_not(self):
        for other in (plan.Run(kobian, "body", 1, False), plan.Run(kobian, "body", 2, True),
                      plan.Run(kobian, "linear", 1, True)):  # fmt: skip
            self.assertFalse(plan.is_complete(self.folder, other.inputs("v1"), True))

    def test_a_changed_configuration_file_is_noticed(self):
        changed = self.folder / "kobian.yaml"
        changed.write_text("period: 0.02\n")
        with mock.patch.object(kobian, "configurations", lambda: [changed]), \
             mock.patch.object(kobian, "overlays", lambda learner: []), \
             mock.patch.object(plan, "ROOT", self.folder):  # fmt: skip
            before = self.run_.inputs("v1")
            changed.write_text("period: 0.01\n")
            self.assertNotEqual(before, self.run_.inputs("v1"))

    def test_the_plan_goes_seed_by_seed(self):
        names = [run.name for run in plan.plan([kobian], ("body", "lwpr"), 2, True)]
        self.assertEqual(names, ["kobian-body-1", "kobian-lwpr-1", "kobian-body-2",
                                 "kobian-lwpr-2"])  # fmt: skip


@mock.patch.object(kobian, "settings", lambda quick, learner: SIZES)
class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.out = Path(cls.temporary.name)
        cls.arguments = ["--quick", "--only", "K1,K2,K3,K4", "--learner", "body",
                         "--out", str(cls.out)]  # fmt: skip
        run = plan.Run(kobian, "body", 1, True)
        cls.folder = cls.out / "runs" / run.name
        with mock.patch.object(kobian, "settings", lambda quick, learner: SIZES):
            finish(run, cls.folder, plan.version())
            cls.said = cls.call()
        cls.rows = {row["id"]: row for row in json.loads((cls.out / "summary.json").read_text())}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def call(cls) -> str:
        with contextlib.redirect_stdout(io.StringIO()) as said, \
             contextlib.redirect_stderr(io.StringIO()) as complained:  # fmt: skip
            status = paper.main(cls.arguments)
        if status != 0:
            raise AssertionError(complained.getvalue())
        return said.getvalue()

    def test_every_row_is_filled(self):
        self.assertEqual([i for i, row in self.rows.items() if row["n"] != 1], [])
        lost = [name for name in self.rows if name.endswith(".lost_ticks")]
        self.assertEqual(lost, ["K1.lost_ticks", "K2.lost_ticks", "K3.lost_ticks", "K4.lost_ticks"])
        self.assertEqual(len(self.rows), len(kobian.rows(("body",))) + len(lost))

    def test_numbers_are_those_that_were_put_in(self):
        pct = 100 * 0.5 / np.degrees(0.11)
        self.assertAlmostEqual(self.rows["K1.s1.yaw_measured_pct"]["mean"], pct, places=3)
        self.assertAlmostEqual(self.rows["K1.s1.change_pct"]["mean"], 0.0)
        self.assertAlmostEqual(self.rows["K2.hand.median_px"]["mean"], synthetic.FINAL_ERROR)
        self.assertAlmostEqual(self.rows["K2.hand.measured_median_px"]["mean"], np.sqrt(10), 5)
        star = self.rows["K3.tool.final_error_max_px"]
        self.assertAlmostEqual(star["mean"], synthetic.FINAL_ERROR)
        self.assertEqual((self.rows["K3.tool.reached"]["mean"], star["met"]), (16.0, True))
        self.assertEqual(self.rows["K2.hand.median_px"]["met"], False)
        self.assertEqual(self.rows["K4.max_deg"]["mean"], 0.0)

    def test_the_page_has_every_figure_and_is_whole(self):
        page = (self.out / "report.html").read_text()
        checker = balanced.Balanced()
        checker.feed(page)
        self.assertEqual(checker.open, [])
        for number in range(14, 28):
            self.assertIn(f"Figure {number}:", page)
        self.assertEqual(page.count("data:image/png;base64,"), 14)
        self.assertNotIn("http", page)
        self.assertTrue((self.out / "report.pdf").read_bytes().startswith(b"%PDF"))

    def test_links_to_series_lead_somewhere(self):
        page = (self.out / "report.html").read_text()
        links = [part.split('"')[0] for part in page.split('href="')[1:]]
        self.assertIn("runs/kobian-body-1/series/k2_hand.csv", links)
        self.assertEqual([link for link in links if not (self.out / link).exists()], [])

    def test_rows_that_are_not_met_are_named(self):
        self.assertIn("not met  K2.hand.median_px: 3 px, wanted 1.5", self.said)

    def test_a_log_with_gaps_is_named_everywhere(self):
        self.assertEqual((self.rows["K1.lost_ticks"]["mean"], self.rows["K1.lost_ticks"]["met"]),
                         (0, True))  # fmt: skip
        self.assertNotIn("lacks", self.said)
        with mock.patch.object(Record, "lost", lambda _: 7), \
             mock.patch.object(perform, "_read", lambda _: None), \
             mock.patch.object(perform, "write_json") as written:  # fmt: skip
            self.assertIn("warning  kobian-body-1: its log lacks 7 control steps", self.call())
        self.assertIn("log lacks 7 control steps", (self.out / "report.html").read_text())
        table = next(call.args[1] for call in written.mock_calls if isinstance(call.args[1], list))
        row = next(row for row in table if row["id"] == "K3.lost_ticks")
        self.assertEqual((row["mean"], row["met"]), (7, False))

    def test_it_is_not_measured_again(self):
        path = self.folder / "summary.json"
        os.utime(path, (1, 1))
        with mock.patch.object(report, "write"):
            self.call()
        self.assertEqual(path.stat().st_mtime, 1)

    def test_the_noise_floor_is_named_for_each_component(self):
        for component in k1.COMPONENTS:
            self.assertIn(f"K1.s2.{component}_noise_pct", self.rows)


class Claim(unittest.TestCase):
    def test_two_do_not_work_in_one_folder(self):
        with tempfile.TemporaryDirectory() as name:
            arguments = ["--quick", "--only", "E3", "--learner", "lwpr", "--out", name]
            with claimed(Path(name)), contextlib.redirect_stderr(io.StringIO()) as said, \
                 mock.patch.object(paper, "work") as work:  # fmt: skip
                self.assertEqual(paper.main(arguments), 1)
            self.assertIn(f"{Path(name).resolve()}: another run writes there", said.getvalue())
            work.assert_not_called()
            with mock.patch.object(paper, "work", return_value=0) as work:
                self.assertEqual(paper.main(arguments), 0)
            work.assert_called_once()


class Sizes(unittest.TestCase):
    def test_every_target_has_time_to_become_steady(self):
        for quick in (False, True):
            for learner in plan.LEARNER_NAMES:
                sizes = kobian.settings(quick, learner)
                self.assertGreater(sizes["turn_seconds"], k2.STEADY_SECONDS + 0.1)


class Arguments(unittest.TestCase):
    def test_seeds_are_five_or_with_quick_one(self):
        self.assertEqual(paper.parse([]).seeds, 5)
        self.assertEqual(paper.parse(["--quick"]).seeds, 1)
        self.assertEqual(paper.parse(["--quick", "--seeds", "3"]).seeds, 3)

    def test_an_unknown_experiment_is_refused(self):
        with (
            contextlib.redirect_stderr(io.StringIO()) as said,
            self.assertRaises(SystemExit) as end,
        ):
            paper.parse(["--only", "K9"])
        self.assertEqual(end.exception.code, 2)
        self.assertIn("K9", said.getvalue())


if __name__ == "__main__":
    unittest.main()
