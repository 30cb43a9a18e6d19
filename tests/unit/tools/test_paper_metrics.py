"""The paper's numbers on cases that can be worked out by hand, and the table made of them."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from reach import metrics
from reach.paper import k1, k2, k3, k4, kobian, replay, rows, series, track


class Numbers(unittest.TestCase):
    def test_coordination_returns_to_where_it_began(self):
        turns = metrics.coordination_targets()
        np.testing.assert_allclose(np.cumsum(turns, axis=0)[1::2], 0)
        self.assertEqual(len(turns), 16)

    def test_settling_counts_from_the_change_and_must_last(self):
        counts = np.array([500, 505, 510, 515, 520, 525])
        errors = np.array([9.0, 1.9, 5.0, 2.0, 1.2, 1.0])
        self.assertEqual(k1.samples_to_settle(counts, errors), 15)

    def test_an_error_that_is_no_number_is_not_settled(self):
        self.assertEqual(k1.samples_to_settle(np.array([0, 5, 10]), np.array([np.nan, 1, 1])), 5)

    def test_degradation_is_relative_to_before(self):
        self.assertAlmostEqual(k1.change_pct(2.0, 2.1), 5.0)

    def test_mean_of_components_is_in_percent_of_range(self):
        errors = {"rmse_true": [1.0, 1.0, 3.0]}
        self.assertAlmostEqual(k1.mean_pct(errors, np.array([100, 50, 100])), 2.0)

    def test_steady_is_late_in_each_target(self):
        times = np.array([0.0, 0.9, 1.0, 1.9, 2.0, 2.9, 3.0, 4.1]) * 1e6
        keep = k2.steady(times, [(0, 1_980_000), (2_000_000, 4_000_000)])
        self.assertEqual(list(keep), [False, False, True, True, False, False, True, False])

    def test_lines_of_a_star(self):
        times = np.arange(0, 2_000_001, 20_000)
        share = np.clip(times / 1e6, 0, 1)[:, None]
        straight = share * np.array([[50.0, 0, 0]])
        bent = share * np.array([[0, 50.0, 6]])
        targets = np.array([[50.0, 0, 0], [0, 50, 0], [50, 0, 0]])
        result = k3.lines([(times, straight), (times, bent)], targets, reached=4, settled=5)
        self.assertEqual(result["reached"], 1)
        self.assertAlmostEqual(result["final_error_max"], 6.0)
        self.assertAlmostEqual(result["final_error_median"], 3.0)
        self.assertAlmostEqual(result["straightness_max"], 6 / 50)
        self.assertAlmostEqual(result["path_ratio_median"], (1 + np.hypot(50, 6) / 50) / 2)

    def test_jerk_is_the_third_derivative(self):
        times = np.arange(0, 1_000_001, 20_000)
        angles = ((times * 1e-6) ** 3)[:, None]
        self.assertAlmostEqual(track.rms_jerk(times, angles), 6.0, places=4)

    def test_equation_14_alone_leaves_changes_of_solution_out(self):
        values = np.array([[0.0], [1.0], [9.0], [9.5]])
        estimate = k4.integrated(values, np.array([0, 0, 1, 1]), np.array([0.2]))
        np.testing.assert_allclose(estimate[:, 0], [0.2, 1.2, 1.2, 1.7])

    def test_series_come_back_as_they_were_written(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "deeper/a.csv"
            series.write(path, t=[1, 2], x=np.array([[3, 4], [5, 6]]))
            columns = series.read(path)
        np.testing.assert_array_equal(columns["t"], [1, 2])
        np.testing.assert_array_equal(series.wide(columns, "x"), [[3, 4], [5, 6]])


class Replay(unittest.TestCase):
    """The daemon's learner, by reach-eval's names and units."""

    def of(self, learner: str) -> dict[str, str]:
        given = replay.options(replay.KOBIAN, learner)
        return dict(text.split("=", 1) for text in replay.parameters(replay.KOBIAN, given))

    def test_standard_deviations_become_variances(self):
        values = self.of("body")
        psi = [float(v) for v in values["psi0"].strip("[]").split(",")]
        np.testing.assert_allclose(psi, [0.25, 0.25, 9])
        self.assertEqual(values["body.degrees"], "true")
        self.assertAlmostEqual(float(values["sigma0"]), 3.16**2)
        self.assertEqual((values["experts"], values["body.space"]), ("body", "eyes"))
        self.assertEqual(self.of("polynomial")["experts"], "polynomial")
        self.assertEqual(values["n_outliers"], "1")

    def test_the_overlay_wins(self):
        self.assertEqual(self.of("linear")["clustering"], "published")
        self.assertEqual(self.of("linear")["p0"], "0.1")

    def test_lwpr_has_its_own(self):
        values = self.of("lwpr")
        self.assertEqual(values["lwpr.max_projections"], "4")
        norms = [float(v) for v in values["lwpr.norm_out"].strip("[]").split(",")]
        np.testing.assert_allclose(norms, [1, 1, 3])
        self.assertNotIn("lwpr.w_gen", self.of("body"))

    def test_counts_end_with_all_and_begin_anew_with_each_phase(self):
        counts = replay.counts([500, 300])
        self.assertEqual(counts[-1], 800)
        self.assertIn(505, counts)
        self.assertTrue((np.diff(counts) > 0).all())
        self.assertLess(len(replay.counts([500, 500, 300])), 512)  # what reach-eval takes


class Table(unittest.TestCase):
    LEARNERS = ("body", "polynomial", "linear", "lwpr")

    def test_ids_are_unique_and_the_agreed_ones_are_there(self):
        ids = [row.id for row in kobian.rows(self.LEARNERS)]
        self.assertEqual(len(ids), len(set(ids)))
        for wanted in ("K1.s1.pitch_pct", "K2.hand.p95_px", "K3.tool.final_error_median_px",
                       "K4.max_deg", "K1.lwpr.s1.pitch_pct",
                       "K1.polynomial.s1.pitch_pct"):  # fmt: skip
            self.assertIn(wanted, ids)

    def test_bars_are_those_asked_for(self):
        bars = {row.id: row.bar for row in kobian.rows(("body",))}
        self.assertEqual(bars["K1.s1.pitch_pct"], 0.9)
        self.assertEqual(bars["K1.s2.disparity_pct"], 1.25)
        self.assertEqual(bars["K1.tool.samples_to_2x"], 150)
        self.assertEqual((bars["K2.hand.median_px"], bars["K2.hand.p95_px"]), (1.5, 3.0))
        self.assertEqual((bars["K2.hand.max_px"], bars["K2.tool.max_px"]), (3.0, 5.0))
        self.assertEqual(bars["K3.hand.straightness_max"], 0.2)
        self.assertEqual((bars["K4.mean_deg"], bars["K4.max_deg"]), (0.09, 0.27))

    def test_others_are_beside_and_owe_nothing(self):
        row = next(r for r in kobian.rows(("lwpr",)) if r.id == "K1.lwpr.s1.yaw_pct")
        self.assertEqual((row.learner, row.number, row.bar), ("lwpr", "K1.s1.yaw_pct", None))

    def test_mean_and_spread_are_over_the_runs_of_one_learner(self):
        asked = [rows.Row("K9.a_px", "a", "px", 3.0, 2.0)]
        runs = [{"learner": "body", "metrics": {"K9.a_px": value}} for value in (1.0, 3.0)]
        runs.append({"learner": "lwpr", "metrics": {"K9.a_px": 99.0}})
        (row,) = rows.aggregate(asked, runs)
        self.assertEqual(row, {"id": "K9.a_px", "experiment": "K9", "metric": "a", "unit": "px",
                               "paper": 3.0, "mean": 2.0, "std": 1.0, "n": 2, "bar": 2.0,
                               "met": True})  # fmt: skip

    def test_what_was_not_measured_is_not_met(self):
        (row,) = rows.aggregate([rows.Row("K9.a", "a", "", None, 2.0)], [])
        self.assertEqual((row["mean"], row["n"], row["met"]), (None, 0, False))

    def test_some_are_to_be_large(self):
        row = rows.Row("K9.a", "a", "", 16, 16, at_least=True)
        self.assertEqual([row.met(value) for value in (15.5, 16.0)], [False, True])
        self.assertIsNone(rows.Row("K9.b", "b", "").met(5.0))


if __name__ == "__main__":
    unittest.main()
