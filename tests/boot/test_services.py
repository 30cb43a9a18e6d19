"""The services under a real systemd, in a Debian tree: they start, see and move the robot, outlive
each other, obey, and end with everything stored."""

import json
import os
import re
import time
import unittest
from pathlib import Path

from machine import Machine

BUILD = Path(os.environ["REACH_BUILD_DIR"])
ALL = ["reachd.service", "reach-finder.service", "reach-vision.service", "reach-simrobot.service"]
LEARNER = "reach-learner.service"
STOP_SECONDS = 2.0
LARGEST_EXPOSURE = 2.0


def eventually(condition, what: str, seconds: float = 20):
    """Its first true value, within so many seconds."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        time.sleep(0.1)
    raise AssertionError(f"not within {seconds} s: {what}")


class Services(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.machine = cls.enterClassContext(Machine(BUILD / "boot/base", BUILD / "packages"))

    def setUp(self):
        self.start()

    def start(self) -> None:
        self.machine.run("systemctl", "reset-failed")
        self.machine.run("systemctl", "start", "reach.target")
        eventually(
            lambda: {self.state(unit) for unit in ALL} == {"active"}, "all services are active"
        )

    def state(self, unit: str) -> str:
        return self.machine.property(unit, "ActiveState")

    def pids(self) -> dict[str, str]:
        return {unit: self.machine.property(unit, "MainPID") for unit in ALL}

    def status(self) -> dict:
        text = self.machine.run_beside(
            "reachd.service", "reachctl", "status", "--json", check=False
        )
        return json.loads(text) if text.startswith("{") else {}

    def babble(self, samples: int) -> None:
        eventually(lambda: self.status().get("state") == "idle", "the daemon is idle")
        self.machine.run_beside("reachd.service", "reachctl", "babble", str(samples))

    def learns(self, samples: int) -> None:
        """Babbles, and waits until the model has so many samples more."""
        before = self.status().get("samples", 0)
        self.babble(samples)
        eventually(
            lambda: self.status().get("samples", 0) >= before + samples,
            f"{samples} samples more; {self.journal()}", 60,
        )  # fmt: skip

    def journal(self) -> str:
        return self.machine.run("journalctl", "--no-pager", "--lines", "40", check=False)

    def test_people_can_read_how_it_goes(self):
        self.learns(2)
        text = self.machine.property("reachd.service", "StatusText")
        self.assertRegex(
            text, r"^\w+, \w+ \(\w+\) \d+ of \d+; \d+ samples, \d+ to be stored, \d+ experts; worst"
        )
        for unit in ("reach-vision.service", "reach-simrobot.service"):
            self.assertTrue(self.machine.property(unit, "StatusText"), unit)

    def test_the_network_is_their_own(self):
        networks = {
            os.readlink(f"/proc/{self.machine.machine_pid(pid)}/ns/net")
            for pid in self.pids().values()
        }
        self.assertEqual(len(networks), 1)
        outside = os.readlink(f"/proc/{self.machine.first_process()}/ns/net")
        self.assertNotIn(outside, networks | {os.readlink("/proc/self/ns/net")})
        self.assertEqual(
            re.findall(r"^\d+: (\w+)", self.machine.run_beside(ALL[0], "ip", "link"), re.M), ["lo"]
        )

    def test_the_loop_is_a_real_time_thread(self):
        pid = self.machine.machine_pid(self.pids()["reachd.service"])
        folder = Path(f"/proc/{pid}")
        policies = {
            (task / "comm").read_text().strip(): os.sched_getscheduler(int(task.name))
            for task in (folder / "task").iterdir()
        }
        self.assertEqual(policies["reachd-loop"], os.SCHED_FIFO)
        self.assertEqual(os.sched_getscheduler(pid), os.SCHED_OTHER)  # housekeeping
        locked = re.search(r"VmLck:\s+(\d+) kB", (folder / "status").read_text())
        self.assertGreater(int(locked[1]), 1000)

    def test_nobody_is_root(self):
        for unit, pid in self.pids().items():
            user = os.stat(f"/proc/{self.machine.machine_pid(pid)}").st_uid
            self.assertGreater(user, 60000, unit)  # where systemd keeps its dynamic users

    def kill(self, unit: str, signal: str) -> None:
        before = self.pids()
        self.machine.run("systemctl", "kill", "--signal", signal, unit)
        eventually(
            lambda: self.pids()[unit] not in ("0", before[unit]) and self.state(unit) == "active",
            f"{unit} is back; {self.journal()}", 30,
        )  # fmt: skip
        after = self.pids()
        for other in ALL:
            if other != unit:
                self.assertEqual(after[other], before[other], f"{other} fell with {unit}")

    def test_one_is_killed_and_the_others_hold(self):
        for unit in ALL:
            with self.subTest(unit):
                self.babble(1000)
                eventually(lambda: self.status().get("progress", 0) > 0, "it babbles", 60)
                self.kill(unit, "SIGKILL")
                eventually(lambda: self.status().get("staleness", 9) < 0.1, "states come again")
                self.assertNotEqual(self.status()["state"], "fault")
                self.machine.run_beside("reachd.service", "reachctl", "stop")
                self.learns(2)

    def test_a_stopped_daemon_is_started_anew(self):
        """SIGSTOP: no exit that one could see, only the watchdog."""
        self.kill("reachd.service", "SIGSTOP")
        self.assertIn("Watchdog timeout", self.machine.run("journalctl", "--no-pager"))
        self.learns(1)

    def test_the_target_does_not_claim_what_has_failed(self):
        """A service that systemd gives up takes the target with it; a new start clears it."""
        robot = self.machine.run("cat", "/etc/reach/robot.env")
        self.machine.run("sh", "-c", "echo ROBOT=nobody >/etc/reach/robot.env")
        self.machine.run("systemctl", "restart", "reachd.service", check=False)
        eventually(lambda: self.state("reach-failed.target") == "active", "the failure is told")
        self.assertEqual(self.state("reachd.service"), "failed")
        eventually(lambda: self.state("reach.target") == "inactive", "the target is off")
        self.machine.run("sh", "-c", f"echo '{robot.strip()}' >/etc/reach/robot.env")
        self.start()
        self.assertEqual(self.state("reach-failed.target"), "inactive")

    def test_what_was_learned_outlives_a_stop(self):
        self.learns(3)
        learned = self.status()["samples_stored"]
        began = time.monotonic()
        self.machine.run("systemctl", "stop", "reachd.service")
        self.assertLess(time.monotonic() - began, STOP_SECONDS)
        self.assertEqual(self.machine.property("reachd.service", "Result"), "success")
        self.start()
        eventually(lambda: self.status().get("samples_stored", 0) >= learned, "the model is back")

    def test_a_reload_is_refused_or_taken(self):
        file = "/etc/reach/kobian.yaml"
        before = self.machine.property("reachd.service", "MainPID")
        self.addCleanup(self.machine.run, "cp", f"{file}.kept", file)
        self.machine.run("cp", file, f"{file}.kept")
        self.machine.run("sed", "-i", "s/arm_velocity: 40 /arm_velocity: 20 /", file)
        self.reload("1 options differ")
        self.machine.run("sed", "-i", "s/period: 0.02 /period: 0.01 /", file)
        self.reload("period cannot change")
        self.assertEqual(self.machine.property("reachd.service", "MainPID"), before)
        self.learns(1)

    def reload(self, answer: str) -> None:
        self.machine.run("systemctl", "reload", "reachd.service")
        eventually(lambda: answer in self.journal(), f"the log says {answer}")

    def test_the_target_stops_all(self):
        self.machine.run("systemctl", "stop", "reach.target")
        for unit in ALL:
            eventually(lambda unit=unit: self.state(unit) == "inactive", unit, STOP_SECONDS)
            self.assertEqual(self.machine.property(unit, "Result"), "success", unit)

    def test_the_learner_for_others(self):
        """Started when somebody wants it; its model outlives a kill."""
        self.machine.run("systemctl", "start", LEARNER)
        self.assertEqual(self.state(LEARNER), "active")
        eventually(
            lambda: self.machine.property(LEARNER, "StatusText").startswith("0 samples, "),
            "it says how it goes",
        )
        self.machine.run("systemctl", "kill", "--signal", "SIGKILL", LEARNER)
        eventually(
            lambda: "generation 0" in self.journal() and self.state(LEARNER) == "active",
            f"it takes its model up again; {self.journal()}",
        )
        self.machine.run("systemctl", "stop", LEARNER)
        self.assertEqual(self.machine.property(LEARNER, "Result"), "success")

    def test_exposure(self):
        units = [*ALL, LEARNER]
        table = self.machine.run("systemd-analyze", "security", "--no-pager", *units)
        figures = {
            unit: float(re.search(rf"exposure level for {unit}: ([\d.]+)", table)[1])
            for unit in units
        }
        print("exposure:", figures)
        for unit, exposure in figures.items():
            self.assertLessEqual(exposure, LARGEST_EXPOSURE, unit)


if __name__ == "__main__":
    unittest.main()
