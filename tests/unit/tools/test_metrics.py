"""The experiments' numbers on cases that can be worked out by hand."""

import unittest

import numpy as np
from reach import messages, metrics


class Metrics(unittest.TestCase):
    def test_star_has_16_targets_every_second_the_centre(self):
        targets = metrics.star_targets()
        self.assertEqual(targets.shape, (16, 3))
        self.assertTrue((targets[1::2] == 0).all())
        self.assertEqual(len({tuple(row) for row in targets[::2]}), 8)
        self.assertEqual(set(np.abs(targets[:, :2]).ravel()), {0.0, 50.0})

    def test_people_get_degrees_and_pixels(self):
        x = metrics.to_people(np.array([[np.pi, -np.pi / 2, 7.0]]))
        np.testing.assert_allclose(x, [[180, -90, 7]])

    def test_rmse_is_by_component(self):
        error = metrics.rmse([[1, 0, 3], [1, 0, -3]], [[0, 0, 0], [0, 2, 0]])
        np.testing.assert_allclose(error, [1, np.sqrt(2), 3])

    def test_range_is_that_of_the_union(self):
        span = metrics.union_range(np.array([[0, 1, 2], [1, 5, 2]]), np.array([[-3, 2, 4]]))
        np.testing.assert_allclose(span, [4, 4, 2])

    def test_closest_solution_looks_only_at_those_offered(self):
        values = np.array([[[5.0, 0, 0], [1.0, 0, 0], [0.0, 0, 0]]])
        closest = metrics.closest_solution(values, np.array([2]), np.zeros((1, 3)), np.ones(3))
        np.testing.assert_allclose(closest, [[1, 0, 0]])

    def test_closest_solution_is_measured_in_ranges(self):
        values = np.array([[[1.0, 0, 0], [0.0, 0, 5]]])
        span = np.array([1.0, 1, 100])
        closest = metrics.closest_solution(values, np.array([2]), np.zeros((1, 3)), span)
        np.testing.assert_allclose(closest, [[0, 0, 5]])

    def test_interpolation_takes_doubled_instants(self):
        rows = np.array([[0.0, 1.0], [0.0, 1.0], [10.0, 2.0]])
        result = metrics.interpolate(np.array([0, 0, 10]), rows, np.array([5]))
        np.testing.assert_allclose(result, [[5, 1.5]])

    def test_running_rms_uses_the_last_samples(self):
        running = metrics.running_rms(np.array([[3.0], [4.0], [0.0], [0.0]]), 2)
        np.testing.assert_allclose(running[:, 0], [3, np.sqrt(12.5), np.sqrt(8), 0])

    def test_line_deviation_is_a_share_of_the_length(self):
        track = np.array([[0, 0, 0], [5, 1, 0], [5, 0, -2], [10, 0, 0], [12, 0, 0.0]])
        deviation = metrics.line_deviation(track, track[0], np.array([10.0, 0, 0]))
        self.assertAlmostEqual(deviation, 0.2)

    def test_final_error_is_of_the_last_half_second(self):
        times = np.arange(0, 1_000_001, 20_000)
        track = np.zeros((len(times), 3))
        track[times <= 500_000] = 100.0
        track[times > 500_000, 1] = 4.0
        self.assertAlmostEqual(metrics.final_error(times, track, np.array([0, 1.0, 0])), 3.0)

    def test_settling_is_when_it_stays_within_the_radius(self):
        times = np.arange(5) * 1_000_000
        track = np.array([[9, 0, 0], [1, 0, 0], [8, 0, 0], [2, 0, 0], [1, 0, 0.0]])
        self.assertAlmostEqual(metrics.settling_time(times, track, np.zeros(3), 5.0), 3.0)

    def test_quantiles_of_nothing_are_no_numbers(self):
        self.assertTrue(np.isnan(metrics.quantiles(np.array([]))["max"]))
        self.assertEqual(metrics.quantiles(np.arange(1001.0))["p50"], 500.0)


class MarkerErrors(unittest.TestCase):
    """Vision against the truth of the same exposure."""

    def setUp(self):
        self.marker = np.zeros(5, messages.dtype_of("marker_t"))
        self.truth = np.zeros(6, messages.dtype_of("sim_truth_t"))
        self.marker["utime"] = [10, 20, 30, 40, 50]
        self.marker["seen"] = [1, 1, 0, 0, 1]
        self.marker["u_right"] = [1, 3, 0, 0, 80]
        self.truth["utime"] = [10, 20, 30, 40, 50, 20]
        self.truth["exposure"] = [1, 1, 1, 1, 1, 0]
        self.truth["in_view"] = 1
        self.truth["visible"] = [1, 1, 1, 0.2, 1, 1]
        self.truth["u_right"] = [0, 0, 0, 0, 0, 77]

    def test_counts(self):
        errors = metrics.marker_errors(self.marker, self.truth)
        self.assertEqual(errors["frames"], 5)
        self.assertEqual(errors["seen"], 3)
        self.assertEqual(errors["missed"], 1, "a hidden ball is not owed")
        self.assertEqual(errors["wrong"], 1)

    def test_spread_and_mean(self):
        self.marker["u_right"][4] = 2
        errors = metrics.marker_errors(self.marker, self.truth)
        self.assertAlmostEqual(errors["mean"][0], 2)
        self.assertAlmostEqual(errors["std"][0], np.sqrt(2 / 3))


if __name__ == "__main__":
    unittest.main()
