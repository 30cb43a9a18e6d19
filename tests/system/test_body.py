"""The body as a user meets it: found while the robot explores, shown, written as a URDF, begun with
a URDF, forgotten and found again; and all of it replayed to the byte."""

import re
import subprocess
import time
import unittest
from pathlib import Path
from xml.etree import ElementTree

import lcm
import recorded_runs
from reach import programs
from reach.bus import Bus
from reach.clock import HeldClock
from reach.experiment import Experiment
from reach.messages import ROOT, reach
from reach.processes import Processes
from reach.progress import Progress
from replaying import Replay

FOUND, NONE = reach.status_t.BODY_FOUND, reach.status_t.BODY_NONE


class Session:
    """The iCub-like robot in lockstep, and reachctl beside it."""

    def __init__(self, processes: Processes, out: Path, settings: dict):
        programs.start(processes, out, seed=2, robot="icub", channels=recorded_runs.CHANNELS,
                       settings=settings)  # fmt: skip
        self.bus = Bus(programs.LISTENER_URL, processes.check)
        programs.wait_until_ready(self.bus, "icub")
        self.clock = HeldClock(self.bus, recorded=True)
        self.clock.advance(0.5)

    def explore(self, samples: int) -> None:
        Experiment(self.bus, self.clock, Progress({}), []).explore("explore", samples, seed=3)

    def reachctl(self, *words) -> subprocess.CompletedProcess:
        command = [programs.BINARIES / "reachctl", "--url", programs.DEFAULT_URL, *words]
        with subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as process:  # fmt: skip
            while process.poll() is None:
                self.clock.advance(0.02)
                time.sleep(0.02)
            return subprocess.CompletedProcess(command, process.returncode, *process.communicate())


class Body(Replay):
    def run_session(self, act, **settings) -> Path:
        with Processes(self.folder) as processes:
            act(Session(processes, self.folder, settings))
        return self.folder / "run.lcmlog"

    def assert_works(self, result: subprocess.CompletedProcess) -> str:
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_found_shown_forgotten_and_found_again(self):
        log = self.run_session(self.find_show_and_forget)
        self.assert_same(log)

    def find_show_and_forget(self, session: Session) -> None:
        early = session.reachctl("body")
        self.assertEqual(early.returncode, 1)
        self.assertIn("no body is found: none yet", early.stderr)
        self.assertEqual(session.reachctl("forget-body").returncode, 1)
        session.explore(90)
        self.assertEqual(session.bus.status.body, FOUND)
        shown = self.assert_works(session.reachctl("body"))
        self.assertRegex(shown, r"^7 joints, found from \d+ samples")
        self.assertEqual(len(re.findall(r"^ +\d  turns ", shown, re.M)), 7)
        self.assertIn("joint,kind,theta", self.assert_works(session.reachctl("body", "--dh")))
        urdf = self.folder / "found.urdf"
        self.assert_works(session.reachctl("body", "--urdf", urdf))
        joints = ElementTree.parse(urdf).getroot().findall("joint")
        self.assertEqual([joint.get("type") for joint in joints], ["revolute"] * 7)
        nowhere = session.reachctl("body", "--urdf", self.folder / "none/found.urdf")
        self.assertEqual(nowhere.returncode, 1)
        self.assertIn("No such file", nowhere.stderr)
        self.assert_works(session.reachctl("forget-body"))
        self.assertEqual((session.bus.status.body, session.bus.status.contexts), (NONE, 0))
        session.explore(3)
        self.assertEqual(session.bus.status.body, FOUND)

    def test_a_urdf_is_where_the_search_begins(self):
        """The iCub-like robot's own file has the waist where the robot has it: the joints come in
        another order than the arm's, which learner.body.order says."""
        start = ROOT / "etc/robots/icub.urdf"
        settings = {"learner.body.start": start, "learner.body.tip": "hand"}
        log = self.run_session(lambda session: session.explore(15), **settings)
        self.assertTrue(log.exists())
        found = [reach.body_t.decode(event.data) for event in lcm.EventLog(str(log))
                 if event.channel == "REACH_BODY"]  # fmt: skip
        found = [body for body in found if body.outcome == body.FOUND]
        self.assertTrue(found)
        self.assertEqual(found[0].starts, 1)
        self.assertLess(found[0].error, 1.5)
        for option, reason in {"nowhere.urdf": "nowhere.urdf", "/dev/null": "/dev/null"}.items():
            command = [programs.BINARIES / "reachd", "--config", ROOT / "etc/icub.yaml", "--no-rt",
                       "--set", f"learner.body.start={option}"]  # fmt: skip
            refused = subprocess.run(command, capture_output=True, text=True, timeout=20)
            self.assertEqual(refused.returncode, 1)
            self.assertIn(f"learner.body.start: {reason}", refused.stderr)
        eyes = [programs.BINARIES / "reachd", "--config", ROOT / "etc/kobian.yaml", "--no-rt",
                "--set", f"learner.body.start={start}"]  # fmt: skip
        refused = subprocess.run(eyes, capture_output=True, text=True, timeout=20)
        self.assertIn("learner.body.start", refused.stderr)


if __name__ == "__main__":
    unittest.main()
