"""reachctl against a scripted daemon and simulator on a bus of their own."""

import json
import tempfile
import time
import unittest
from pathlib import Path

from reach.messages import reach
from scripted import Scripted, reachctl


class Reachctl(unittest.TestCase):
    def refused(self, *words: str) -> str:
        """Wrong usage: code 2 and one line."""
        result = reachctl(*words)
        self.assertEqual(result.returncode, 2, words)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result.stderr

    def test_wrong_usage_gets_one_line_and_code_2(self):
        self.assertIn("unknown command 'fly'", self.refused("fly"))
        self.assertIn("usage: reachctl babble N", self.refused("babble"))
        self.assertIn("whole number", self.refused("babble", "1.5"))
        self.assertIn("number from", self.refused("reach", "a", "0", "0"))
        self.assertIn("usage: reachctl sim attach TOOL", self.refused("sim", "attach"))
        self.assertIn("seconds", self.refused("--timeout", "-1", "status"))
        self.assertIn("unrecognized option", self.refused("--fly"))
        self.assertIn("a command is wanted", self.refused())
        self.assertIn("unknown command '-'", self.refused("-"))

    def test_help_and_version(self):
        self.assertIn("sim run-until T", reachctl("--help").stdout)
        self.assertRegex(reachctl("--version").stdout, r"^reachctl \d+\.\d+\.\d+ \(.+\)\n$")

    def test_silence_is_told(self):
        result = reachctl("--timeout", "0.2", "stop")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no answer from reachd", result.stderr)
        result = reachctl("--timeout", "0.2", "sim", "reset")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no answer from simrobot", result.stderr)

    def test_status_as_json(self):
        with Scripted():
            result = reachctl("status", "--json")
        status = json.loads(result.stdout)
        self.assertEqual(status["state"], "idle")
        self.assertEqual(status["experts"], 7)
        self.assertIsNone(status["staleness"])
        self.assertEqual(len(status["x_predicted"]), 3)

    def test_what_is_sent(self):
        with Scripted() as daemon:
            for words in (["babble", "20", "--seed", "9", "--frozen"], ["star", "--period", "3"],
                          ["reach", "-50", "10", "2.5"], ["save", "4"]):  # fmt: skip
                self.assertEqual(reachctl(*words).returncode, 0, words)
        babble, star, single, save = daemon.requests
        self.assertEqual((babble.kind, babble.count, babble.seed, babble.learn), (1, 20, 9, 0))
        self.assertEqual((star.kind, star.count, star.n_targets, star.period), (3, 1, 16, 3.0))
        self.assertEqual((star.target[2], star.target[3]), ((50, 50, 0), (0, 0, 0)))
        self.assertEqual((single.n_targets, single.target[0]), (1, (-50, 10, 2.5)))
        self.assertEqual((single.count, single.learn), (0, 1))
        self.assertEqual((save.kind, save.count), (4, 4))

    def test_what_the_simulator_is_told(self):
        with Scripted() as simulator:
            for words in (["attach", "1"], ["detach"], ["light", "0.5"], ["run-until", "2.5"]):
                self.assertEqual(reachctl("sim", *words).returncode, 0, words)
        attach, detach, light, until = simulator.sim_requests
        self.assertEqual((attach.kind, attach.tool), (0, 1))
        self.assertEqual((detach.kind, detach.tool), (0, 0))
        self.assertEqual((light.kind, light.value), (2, 0.5))
        self.assertEqual((until.kind, until.until), (6, 2_500_000))

    def test_refusal_is_told(self):
        with Scripted(reach.status_t.REFUSED_VALUE):
            result = reachctl("babble", "5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("refused, a value is out of range", result.stderr)

    def test_waiting_ends_with_the_behaviour(self):
        with Scripted():
            start = time.monotonic()
            result = reachctl("star", "--wait")
        self.assertEqual(result.returncode, 0)
        self.assertLess(time.monotonic() - start, 5)
        # What it came to: the daemon's own error is 0 again when there is no target any more.
        self.assertEqual(result.stdout, "reach: 0 of 0, 0 given up; 7 experts; error 1.2 px\n")

    def test_reaching_nowhere_is_no_success(self):
        with Scripted(distances=(700.0, 1559.0)):
            result = reachctl("reach", "10", "10", "0", "--wait")
        self.assertEqual(result.returncode, 1)
        self.assertIn("not reached; the last of them by 1559.0 px, 700.0 px where", result.stderr)

    def test_a_target_in_the_wrong_unit_is_questioned(self):
        with Scripted(space=reach.status_t.CARTESIAN, distances=(0.01, 0.001)):
            result = reachctl("reach", "-50", "20", "3", "--wait")
            self.assertIn("x, y, z in m, not px", result.stderr)
            self.assertEqual(reachctl("reach", "0.3", "0.1", "0.3", "--wait").stderr, "")
        with Scripted():
            self.assertIn("outside", reachctl("reach", "400", "0", "0", "--wait").stderr)

    def test_reset_fault_waits_until_the_fault_is_left(self):
        with Scripted(faults=20):
            start = time.monotonic()
            self.assertEqual(reachctl("reset-fault").returncode, 0)
            self.assertGreater(time.monotonic() - start, 0.2)
        with Scripted(faults=10**6):
            result = reachctl("reset-fault", "--timeout", "0.5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("still in its fault state", result.stderr)

    def test_a_model_that_is_missing_is_named(self):
        config = reach.config_t()
        text = b"period=0.02\nmodel.directory=/var/models\nmodel.kept=3\n"
        config.text = list(text.ljust(len(config.text), b"\0"))
        with Scripted(reach.status_t.FAILED, also={"REACH_CONFIG": config.encode()}):
            result = reachctl("load", "7")
        self.assertEqual(result.returncode, 1)
        self.assertIn("/var/models/model-7.imle", result.stderr)

    def test_a_lost_request_is_sent_again(self):
        with Scripted(deaf_to=1) as daemon:
            self.assertEqual(reachctl("babble", "5").returncode, 0)
        self.assertEqual(len(daemon.requests), 1)

    def test_a_request_does_not_come_back_after_a_later_one(self):
        later = reach.request_t()
        later.seq = 2**62
        with Scripted(deaf_to=1) as daemon:
            daemon.requests.append(later)
            result = reachctl("babble", "5", "--timeout", "1.5")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(daemon.requests, [later])

    def test_targets_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder, Scripted() as daemon:
            path = Path(folder) / "targets"
            path.write_text("# u v disparity\n10 -20 0\n\n-5 5 1.5 # near\n")
            self.assertEqual(reachctl("coordinate", "--file", path).returncode, 0)
            path.write_text("10 20 0\n10 20\n")
            self.assertIn("targets:2:", self.refused("coordinate", "--file", path))
        request = daemon.requests[0]
        self.assertEqual((request.n_targets, request.target[1]), (2, (-5, 5, 1.5)))
        self.assertEqual(request.period, 2.0)


if __name__ == "__main__":
    unittest.main()
