"""E3's two runs: what they ask of the robot, what they measure, and that each row comes once."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import synthetic
from reach.paper import __main__ as paper
from reach.paper import plan, practice, track
from reach.record import read_log

BOTH = (practice.WITHOUT, practice.WITH)


class Asked:
    """An experimenter that notes what it is asked for."""

    def __init__(self):
        self.said = []

    def __getattr__(self, name):
        return lambda *words, **named: self.said.append((name, *words, named))


class Practice(unittest.TestCase):
    def measured(self, group: practice.Practice, beside: float) -> dict:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            targets = dict.fromkeys(practice.ROUNDS, track.star())
            run = synthetic.make(folder, 5, ("babbled", *practice.ROUNDS), targets, beside)
            return group.analyse(read_log(folder / "run.lcmlog"), run, folder)

    def test_both_are_asked_for_the_same(self):
        asked = [Asked(), Asked()]
        for group, one in zip(BOTH, asked, strict=True):
            group.perform(one, group.settings(True, "body"), seed=3)
        self.assertEqual(str(asked[0].said), str(asked[1].said))
        self.assertEqual([entry[0] for entry in asked[0].said], ["babble", "star", "star"])
        self.assertTrue(all(entry[-1]["learn"] for entry in asked[0].said))

    def test_one_may_practise(self):
        without, allowed = (group.overlays("body") for group in BOTH)
        self.assertEqual([path.name for path in allowed if path not in without], ["practice.yaml"])

    def test_a_target_within_five_pixels_is_reached(self):
        for group in BOTH:
            near, far = self.measured(group, 4.9), self.measured(group, 5.1)
            for name in practice.ROUNDS:
                key = f"E3.{group.word}.{name}_reached_pct"
                self.assertEqual((near[key], far[key]), (100, 0))

    def test_every_row_has_a_number_and_comes_once(self):
        for group in BOTH:
            numbers = self.measured(group, 0.0)
            self.assertEqual([r.id for r in group.rows(("body",)) if r.id not in numbers], [])
        ids = [row.id for row in paper._asked(paper.parse(["--only", "E3"]))]
        self.assertEqual(len(ids), len(set(ids)))
        self.assertEqual(ids.count("E3.lost_ticks"), 1)

    def test_it_is_about_the_shipped_learner_alone(self):
        runs = plan.plan(BOTH, plan.LEARNER_NAMES, 1, True)
        self.assertEqual([run.name for run in runs],
                         ["practice-without-body-1", "practice-with-body-1"])  # fmt: skip
        self.assertEqual(plan.plan(BOTH, ("lwpr",), 1, True), [])


if __name__ == "__main__":
    unittest.main()
