"""The verdict of a soak: each promise that is broken must be seen."""

import unittest

import numpy as np
from reach.soak_verdict import judge

LOOKS = 40


def kept() -> dict:
    """A soak in which every promise is kept."""
    rng = np.random.default_rng(3)
    rows = [
        {
            "robot_s": 60.0 * k,
            "error": (rng.normal(size=(8, 3)) * 0.01).tolist(),
            "x": rng.normal(size=(8, 3)).tolist(),
            "memory_kb": {"reachd": 20000 + int(rng.integers(100)), "simrobot": 90000},
            "experts": 2,
            "alarms": 0,
            "samples_stored": 15 * k,
        }
        for k in range(1, LOOKS + 1)
    ]
    kills = [{"program": "reachd", "robot_s": 500.0, "stored": 90, "recovered": 92}]
    return {"rows": rows, "kills": kills}


class Verdict(unittest.TestCase):
    def setUp(self):
        self.seen = kept()

    def broken(self) -> list[str]:
        lines, passed = judge(self.seen)
        found = [line.split()[0] for line in lines if "BROKEN" in line]
        self.assertEqual(passed, not found)
        return found

    def test_a_good_soak_passes(self):
        self.assertEqual(self.broken(), [])
        self.assertIn("reachd 1", judge(self.seen)[0][0])

    def test_growing_memory_is_seen(self):
        for k, row in enumerate(self.seen["rows"]):
            row["memory_kb"]["reachd"] += 300 * k
        self.assertEqual(self.broken(), ["memory"])

    def test_growing_experts_are_seen(self):
        for k, row in enumerate(self.seen["rows"]):
            row["experts"] += k // 4
        self.assertEqual(self.broken(), ["experts"])

    def test_growing_errors_are_seen(self):
        for k, row in enumerate(self.seen["rows"]):
            row["error"] = (np.array(row["error"]) * (1 + k)).tolist()
        self.assertEqual(self.broken(), ["error"])

    def test_false_alarms_are_seen(self):
        self.seen["rows"][7]["alarms"] = 64
        self.assertEqual(self.broken(), ["alarms"])

    def test_lost_samples_are_seen(self):
        kill = {"program": "reachd", "robot_s": 900.0, "stored": 200, "recovered": 199}
        self.seen["kills"].append(kill)
        self.assertEqual(self.broken(), ["samples"])

    def test_a_short_soak_is_not_judged(self):
        del self.seen["rows"][3:]
        lines, passed = judge(self.seen)
        self.assertFalse(passed)
        self.assertIn("too few", lines[0])


if __name__ == "__main__":
    unittest.main()
