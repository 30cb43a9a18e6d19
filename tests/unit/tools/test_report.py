"""From a log to summary.json and report.html, on a made-up run whose numbers are known."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

import lcm
import synthetic
from balanced import Balanced
from reach import demo, figures, report, summary
from reach.record import read_log


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.out = Path(cls.temporary.name)
        cls.run_description = synthetic.make(cls.out)
        cls.record = read_log(cls.out / "run.lcmlog")
        cls.result = summary.summarise(cls.record, cls.run_description)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_errors_of_predictions(self):
        hand = self.result["babbling"]["hand"]
        self.assertEqual(hand["samples"], 12)
        np.testing.assert_allclose(hand["rmse"], [0.5, 0, 0], atol=1e-6)
        span = np.degrees(0.11)
        np.testing.assert_allclose(hand["rmse_pct"], [100 * 0.5 / span, 0, 0], atol=1e-4)
        self.assertEqual(self.result["solutions_mean"], 2.0)

    def test_the_running_error_follows_where_samples_are_few(self):
        self.assertEqual([figures.window(n) for n in (10, 30, 70, 150)], [3, 3, 7, 10])

    def test_a_body_wants_few_samples(self):
        sizes = {name: demo.parse_arguments(["--experts", name]) for name in ("body", "linear")}
        self.assertEqual([(o.samples, o.tool_samples, o.tests) for o in sizes.values()],
                         [(30, 10, 20), (150, 150, 50)])  # fmt: skip
        given = demo.parse_arguments(["--samples", "7", "--tests", "3"])
        self.assertEqual((given.samples, given.tool_samples, given.tests), (7, 7, 3))

    def test_star_on_the_true_track(self):
        star = self.result["star"]["tool"]
        self.assertEqual(star["targets"], 16)
        self.assertAlmostEqual(star["final_error_px"]["median"], synthetic.FINAL_ERROR, places=4)
        # From the centre to (50, 0, 3) against the line to (50, 0, 0): 3 px at a length of 50.
        self.assertAlmostEqual(star["straightness"]["max"], 3 / 50, places=2)

    def test_vision(self):
        marker = self.result["marker_error_px"]
        self.assertAlmostEqual(marker["mean"][0], 1.0)
        self.assertAlmostEqual(marker["std_u"], 0.0)
        self.assertEqual(self.result["missed_frames"], 0)

    def test_wall_figures_stand_apart(self):
        self.assertEqual(self.result["wall"]["seconds"], 10.0)
        self.assertEqual(self.result["wall"]["vision_us"]["max"], 900.0)
        rest = {key: value for key, value in self.result.items() if key != "wall"}
        self.assertNotIn("_us", json.dumps(rest))

    def test_the_page_is_whole_and_self_contained(self):
        report.write(self.out, self.record, self.run_description, self.result)
        page = (self.out / "report.html").read_text()
        checker = Balanced()
        checker.feed(page)
        self.assertEqual(checker.open, [])
        self.assertEqual(page.count("data:image/png;base64,"), 5)
        self.assertNotIn("http://", page)
        self.assertIn("<th>yaw</th><th>pitch</th><th>disparity</th>", page)
        self.assertRegex(page, r"<td>hand</td><td>0\.5 deg</td><td>0 deg</td><td>0 px</td>")
        drawn = {path.stem for path in (self.out / "figures").glob("*.pdf")}
        self.assertLessEqual({"learning", "reaching-in-time", "what-it-costs"}, drawn)
        self.assertNotIn("nan", page.split("base64")[0])

    def test_five_lines(self):
        lines = report.five_lines(self.out, self.record, self.result)
        self.assertEqual(len(lines), 5)
        self.assertIn("report.html", lines[0])

    def test_messages_of_another_layout_are_counted(self):
        path = self.out / "damaged.lcmlog"
        log = lcm.EventLog(str(path), "w", overwrite=True)
        log.write_event(1, "MARKER", b"\0" * 66)
        log.write_event(2, "MARKER", b"short")
        log.write_event(3, "SOMETHING_ELSE", b"x")
        log.close()
        record = read_log(path)
        self.assertEqual(record.refused, 2)
        self.assertEqual(len(record["MARKER"]), 0)


if __name__ == "__main__":
    unittest.main()
