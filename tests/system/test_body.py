"""The body as a user meets it: found while the robot explores, shown, written as a URDF, begun with
a URDF, forgotten and found again; and all of it replayed to the byte."""

import re
import struct
import subprocess
import time
import unittest
import zlib
from collections.abc import Sequence
from itertools import groupby
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
FROM_URDF = {"learner.body.start": ROOT / "etc/robots/icub.urdf", "learner.body.tip": "hand"}


class Session:
    """The iCub-like robot in lockstep, and reachctl beside it."""

    def __init__(self, processes: Processes, out: Path, settings: dict):
        programs.start(processes, out, seed=2, robot="icub", channels=recorded_runs.CHANNELS,
                       settings=settings)  # fmt: skip
        self.processes = processes
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


class WrongFinder:
    """In reach-finder's place: it finds a body whose second axis is another, and later says that
    the body in use is none."""

    def __init__(self, session: Session, right: reach.body_t):
        self.bus = session.bus._lcm
        self.refutes = False
        self.wrong = altered(right)
        session.bus._listen("REACH_BODY_REQUEST", reach.body_request_t, self.answer)

    def answer(self, request: reach.body_request_t) -> None:
        answer = self.wrong
        if self.refutes:
            answer = reach.body_t()
            answer.outcome = answer.REFUTED
            answer.why = [*b"it is none".ljust(160, b"\0")]
            answer.checksum = checksum(answer.numbers)
        answer.seq, answer.request_utime = request.seq, request.utime
        self.bus.publish("REACH_BODY", answer.encode())


def checksum(numbers: Sequence[float]) -> int:
    """As body_t has it."""
    unsigned = zlib.crc32(struct.pack(f"<{len(numbers)}d", *numbers))
    return (unsigned ^ 0x80000000) - 0x80000000


def altered(right: reach.body_t) -> reach.body_t:
    wrong = reach.body_t.decode(right.encode())
    first = 1 + 16 + 16  # learner/body/chain/body_numbers.c: n, slides, middle; then axes
    numbers = list(wrong.numbers)
    numbers[first + 3 : first + 6] = [*numbers[first + 4 : first + 6], numbers[first + 3]]
    wrong.numbers, wrong.checksum = numbers, checksum(numbers)
    return wrong


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

    def test_a_wrong_one_is_given_up(self):
        log = self.run_session(self.believe_and_refute, **FROM_URDF)
        self.assert_same(log)
        traces = [reach.trace_t.decode(event.data) for event in lcm.EventLog(str(log))
                  if event.channel == "REACH_TRACE"]  # fmt: skip
        given = [trace.body for trace in traces if trace.body]
        self.assertEqual([sign for sign, _ in groupby(body > 0 for body in given)],
                         [True, False, True, False])  # fmt: skip
        said = (self.folder / "reachd.log").read_text()
        self.assertRegex(said, r"refused: \d REACH_BODY")
        self.assertIn("given up, it explains the samples no more: it is none", said)

    def believe_and_refute(self, session: Session) -> None:
        """A right one, a wrong one, none; and the search begins anew."""
        heard = []
        listening = session.bus._lcm.subscribe("REACH_BODY", lambda _, data: heard.append(data))
        session.explore(15)
        session.bus._lcm.unsubscribe(listening)
        self.assertEqual(session.bus.status.body, FOUND)
        answers = map(reach.body_t.decode, heard)
        right = [body for body in answers if body.outcome == body.FOUND][-1]
        session.processes.kill("finder")
        finder = WrongFinder(session, right)
        self.assert_works(session.reachctl("forget-body"))
        session.explore(5)
        self.assertEqual(session.bus.status.body, FOUND)
        self.refuse_nonsense(session, finder.wrong)
        finder.refutes = True
        self.explore_until_it_is_gone(session)
        self.assertEqual(session.bus.status.body_samples, 0)
        searches = session.bus.status.body_searches
        session.explore(30)
        self.assertGreater(session.bus.status.body_searches, searches)
        self.assertNotEqual(session.bus.status.body, FOUND)
        self.assertGreater(session.bus.status.experts, 0)

    def refuse_nonsense(self, session: Session, body: reach.body_t) -> None:
        """Counted, and said; the body in use stays."""
        whole = body.encode()
        unlike = whole[:-1] + bytes([whole[-1] ^ 1])  # as its checksum says
        for data in (b"", whole[:-1], unlike):
            session.bus._lcm.publish("REACH_BODY", data)
        session.clock.advance(2.0)
        refused = session.bus.status.refused[reach.status_t.CHANNEL_BODY]
        self.assertEqual(refused[reach.status_t.MALFORMED], 3)
        self.assertEqual(session.bus.status.body, FOUND)

    def explore_until_it_is_gone(self, session: Session) -> None:
        for _ in range(10):
            session.explore(10)
            if session.bus.status.body != FOUND:
                return
        self.fail("the body is still in use")

    def test_a_urdf_is_where_the_search_begins(self):
        """The iCub-like robot's own file has the waist where the robot has it: the joints come in
        another order than the arm's, which learner.body.order says."""
        log = self.run_session(lambda session: session.explore(15), **FROM_URDF)
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
                "--set", f"learner.body.start={FROM_URDF['learner.body.start']}"]  # fmt: skip
        refused = subprocess.run(eyes, capture_output=True, text=True, timeout=20)
        self.assertIn("learner.body.start", refused.stderr)


if __name__ == "__main__":
    unittest.main()
