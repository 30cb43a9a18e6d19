"""reachctl doctor in networks and under limits where something is wrong, and reach-lcm-setup, which
mends the network. Each case has a network namespace of its own."""

import json
import os
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import lcm
from background import Background
from reach.bus import DEFAULT_URL
from reach.messages import ROOT, bot_core, reach

BINARIES = Path(os.environ["REACH_BUILD_DIR"]) / "bin"
NETNS = ROOT / "tools/netns.sh"
RMEM_MAX = Path("/proc/sys/net/core/rmem_max")


def run(*command, **environment) -> subprocess.CompletedProcess:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          timeout=60, env={**os.environ, **environment})  # fmt: skip


def examine(*before, **environment) -> tuple[dict[str, list[dict]], int]:
    """The checks by name, and the exit code, of a doctor behind the command `before`."""
    result = run(*before, BINARIES / "reachctl", "doctor", "--json", **environment)
    # What else the commands before said is in front.
    checks: dict[str, list[dict]] = {}
    for entry in json.loads(result.stdout[result.stdout.index("[{") :]):
        checks.setdefault(entry["check"], []).append(entry)
    return checks, result.returncode


def shell(commands: str) -> list:
    return ["sh", "-c", f'{commands}; exec "$@"', "sh"]


class Case(unittest.TestCase):
    def assert_finding(self, checks: dict, check: str, text: str, remedy: str) -> None:
        found = [entry for entry in checks.get(check, []) if entry["verdict"] == "finding"]
        self.assertEqual(len(found), 1, checks)
        self.assertRegex(found[0]["text"], text)
        self.assertRegex(found[0]["remedy"], remedy)

    def assert_verdict(self, checks: dict, check: str, verdict: str) -> None:
        self.assertEqual([entry["verdict"] for entry in checks[check]], [verdict], checks)


class Network(Case):
    def test_multicast_works(self):
        checks, code = examine(NETNS)
        for check in ("multicast route", "multicast flag", "messages", "senders"):
            self.assert_verdict(checks, check, "ok")
        self.assertTrue(all(entry["verdict"] == "skipped" for entry in checks["version"]))
        wrong = any(e["verdict"] == "finding" for entries in checks.values() for e in entries)
        self.assertEqual(code, 1 if wrong else 0)

    def test_no_route(self):
        checks, code = examine(NETNS, "--no-route")
        self.assertEqual(code, 1)
        self.assert_finding(checks, "multicast route", "cannot be reached", "ip route add 224")
        self.assert_finding(checks, "messages", "none gets through", "see above")

    def test_no_flag(self):
        checks, code = examine(NETNS, *shell("ip link set lo multicast off"))
        self.assertEqual(code, 1)
        self.assert_finding(checks, "multicast flag", "lo lacks it", "ip link set lo multicast on")

    def test_set_up_mends_it(self):
        commands = f"ip link set lo multicast off; {BINARIES}/reach-lcm-setup; echo code $?"
        commands += f"; {BINARIES}/reach-lcm-setup; echo again"
        result = run(NETNS, "--no-route", *shell(commands), "true")
        if not RMEM_MAX.exists() or int(RMEM_MAX.read_text()) >= 1843200:
            self.assertEqual(result.stdout, "ip link set lo multicast on\n"
                             "ip route add 224.0.0.0/4 dev lo\ncode 0\nagain\n")  # fmt: skip
        checks, _ = examine(NETNS, "--no-route", *shell(commands))
        for check in ("multicast route", "multicast flag", "messages"):
            self.assert_verdict(checks, check, "ok")

    def test_a_dry_run_mends_nothing(self):
        result = run(NETNS, "--no-route", BINARIES / "reach-lcm-setup", "--dry-run")
        self.assertIn("ip route add 224.0.0.0/4 dev lo\n", result.stdout)
        self.assertEqual(result.returncode, 0)
        checks, _ = examine(
            NETNS, "--no-route", *shell(f"{BINARIES}/reach-lcm-setup --dry-run >/dev/null")
        )
        self.assert_verdict(checks, "multicast route", "finding")

    def test_set_up_usage(self):
        self.assertEqual(run(BINARIES / "reach-lcm-setup", "--no-such").returncode, 2)
        self.assertIn("usage:", run(BINARIES / "reach-lcm-setup", "--help").stdout)
        self.assertRegex(run(BINARIES / "reach-lcm-setup", "--version").stdout, r"\d+\.\d+\.\d+ \(")


class Limits(Case):
    def test_real_time_and_memory(self):
        confined = ["setpriv", "--bounding-set=-sys_nice,-ipc_lock,-sys_resource"]
        checks, code = examine(NETNS, *shell("ulimit -l 1000; ulimit -r 0"), *confined)
        self.assertEqual(code, 1)
        self.assert_finding(checks, "real time", "not permitted", r"rtprio \d+")
        self.assert_finding(checks, "memory lock", "cannot be locked", r"memlock \d+")

    def test_inside_a_user_namespace_the_user_outside_is_named(self):
        somebody = ["setpriv", "--reuid=12345", "--clear-groups"]
        if os.geteuid() != 0:
            self.skipTest("only root can become somebody else")
        checks, _ = examine(*somebody, "unshare", "--user", "--map-root-user", "--net")
        remedies = [entry["remedy"] for entry in checks["real time"] + checks["memory lock"]]
        self.assertTrue(all("':12345 - " in remedy for remedy in remedies), remedies)

    def test_a_renderer_that_warns_first_is_none_the_less(self):
        """What it says at first is not what draws, and it is not ended while it speaks."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (
                ("reachctl", None),
                ("reach-simrobot", "#!/bin/sh\necho MESA: warning: odd >&2\n"
                 "seq 200000 || exit 3\necho 'llvmpipe of a test'\n"),
            ):  # fmt: skip
                path = Path(folder) / name
                path.write_bytes(text.encode() if text else (BINARIES / name).read_bytes())
                path.chmod(0o755)
            result = run(NETNS, Path(folder) / "reachctl", "doctor", "--json")
        found = {entry["check"]: entry for entry in json.loads(result.stdout)}["EGL renderer"]
        self.assertEqual((found["verdict"], found["text"]), ("ok", "llvmpipe of a test"))

    def test_no_graphics(self):
        checks, code = examine(NETNS, __EGL_VENDOR_LIBRARY_FILENAMES="/dev/null")
        self.assertEqual(code, 1)
        self.assert_finding(checks, "EGL renderer", "EGL", "apt-get install")


class Company(Background):
    """What others say on the bus, over and over."""

    def __init__(self, say, n: int = 1):
        super().__init__()
        self._buses = [lcm.LCM(DEFAULT_URL) for _ in range(n)]
        self._say = say
        self._buses[0].subscribe("REACH_HELLO", self._on_hello)

    def _on_hello(self, _, data):
        hello = reach.hello_t.decode(data)
        if hello.role == hello.DAEMON and not hello.answer:
            hello.answer = 1
            hello.revision = [*b"0.0 \x1b[2J".ljust(len(hello.revision), b"\0")]
            self._buses[0].publish("REACH_HELLO", hello.encode())

    def run(self):
        while not self._halt.is_set():
            self._buses[0].handle_timeout(20)
            for bus in self._buses:
                self._say(bus)


class Bus(Case):
    """Runs in the namespace that the test was started in."""

    def test_two_senders(self):
        command = reach.robot_command_t().encode()
        with Company(lambda bus: bus.publish("ROBOT_COMMAND", command), 2):
            checks, code = examine()
        self.assertEqual(code, 1)
        self.assert_finding(
            checks, "senders", r"ROBOT_COMMAND comes from \S+:\d+ and \S+:\d+", "ss "
        )

    def test_many_may_ask(self):
        request = reach.request_t().encode()
        with Company(lambda bus: bus.publish("REACH_REQUEST", request), 2):
            self.assert_verdict(examine()[0], "senders", "ok")

    def test_another_version(self):
        with Company(lambda bus: bus.publish("MARKER", b"12345678" * 5)):
            checks, code = examine()
        self.assertEqual(code, 1)
        self.assert_finding(checks, "layout", "MARKER", "build")
        self.assert_finding(checks, "version", r"reachd is 0\.0 \\x1b\[2J, reachctl is \d",
                            "reachd anew")  # fmt: skip

    def say_state(self, seconds: float, lockstep: int):
        state = reach.robot_state_t()
        state.lockstep = lockstep

        def say(bus):
            state.utime = int((time.time() + seconds) * 1e6)
            bus.publish("ROBOT_STATE", state.encode())

        return say

    def test_clocks(self):
        with Company(self.say_state(-5, 0)):
            checks, code = examine()
        self.assertEqual(code, 1)
        self.assert_finding(checks, "robot's clock", r"^-[45]\.\d+ s", "timedatectl")
        with Company(self.say_state(0, 0)):
            self.assert_verdict(examine()[0], "robot's clock", "ok")
        with Company(self.say_state(-5, 1)):  # lockstep has a time of its own
            self.assertNotIn("robot's clock", examine()[0])

    def test_a_fault_and_a_refused_joint_are_named(self):
        status, names = reach.status_t(), bot_core.joint_state_t()
        status.state, status.fault, status.fault_joint = status.FAULT, status.FAULT_STILL, 2
        status.refused_joint, status.refused_value = 1, 2.5
        names.joint_name = ["waist \x1b[2J", "elbow"]
        names.num_joints = len(names.joint_name)
        names.joint_position = names.joint_velocity = names.joint_effort = [0.0, 0.0]

        def say(bus):
            status.refused_state += 1
            status.refused[0][status.VALUE] += 1
            bus.publish("REACH_STATUS", status.encode())
            bus.publish("JOINT_STATE", names.encode())
            for cut in range(len(names.encode())):  # lengths that lie
                bus.publish("JOINT_STATE", names.encode()[:cut])

        with Company(say):
            checks, code = examine()
        self.assertEqual(code, 1)
        self.assert_finding(checks, "fault", r"does not move: joint 2 .*\(joint 2 is elbow\)",
                            "too weak .*reset-fault")  # fmt: skip
        self.assert_finding(checks, "refused messages", r"joint 1 is waist \\x1b\[2J\)",
                            "arm.min, arm.max")  # fmt: skip


if __name__ == "__main__":
    unittest.main()
