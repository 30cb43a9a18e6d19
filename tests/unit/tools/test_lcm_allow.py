"""reach-lcm-setup --allow: whom the kernel's filter lets speak, between two network namespaces."""

import os
import shutil
import socket
import subprocess
import sys
import unittest
from pathlib import Path

SETUP = Path(os.environ["REACH_BUILD_DIR"]) / "bin/reach-lcm-setup"
GROUP, PORT = "239.255.76.67", 7667
HERE, FRIEND, STRANGER = "10.99.0.1", "10.99.0.2", "10.99.0.3"
SEND = """
import socket, sys
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
s.bind((sys.argv[1], 0))
s.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(sys.argv[1]))
s.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 1)
s.sendto(sys.argv[1].encode(), (sys.argv[2], int(sys.argv[3])))
"""


def run(*command, code: int = 0) -> str:
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, timeout=30, check=False
    )
    if done.returncode != code:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def can_filter() -> bool:
    if not shutil.which("nft"):
        return False
    done = subprocess.run(["nft", "add table inet probe; delete table inet probe"],
                          capture_output=True, check=False)  # fmt: skip
    return done.returncode == 0


class Words(unittest.TestCase):
    def test_what_is_no_address_is_refused(self):
        for words in (["--allow"], ["--allow", "robot"], ["--allow", "10.0.0.1; flush ruleset"],
                      ["--port", "x", "--allow", HERE], ["--no-such"]):  # fmt: skip
            self.assertIn("--help", run(SETUP, "--dry-run", *words, code=2))


@unittest.skipUnless(can_filter(), "there is no nft, or it may not filter here")
class Filter(unittest.TestCase):
    """This process is in a namespace of its own (tools/netns.sh), the senders in another."""

    @classmethod
    def setUpClass(cls):
        cls.other = subprocess.Popen(["unshare", "--net", "sleep", "120"])
        cls.addClassCleanup(cls.other.wait)
        cls.addClassCleanup(cls.other.kill)
        while os.readlink(f"/proc/{cls.other.pid}/ns/net") == os.readlink("/proc/self/ns/net"):
            pass
        run("ip", "link", "add", "robot0", "type", "veth", "peer", "name", "far0", "netns",
            cls.other.pid)  # fmt: skip
        run("ip", "address", "add", f"{HERE}/24", "dev", "robot0")
        run("ip", "link", "set", "robot0", "up")
        for address in (FRIEND, STRANGER):
            cls.there("ip", "address", "add", f"{address}/24", "dev", "far0")
        cls.there("ip", "link", "set", "far0", "up")

    @classmethod
    def there(cls, *command) -> None:
        run("nsenter", "--net", "--target", cls.other.pid, *command)

    def heard(self, port: int = PORT) -> set[str]:
        """Who of friend, stranger and this machine is heard."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as ear:
            ear.bind((GROUP, port))
            membership = socket.inet_aton(GROUP) + socket.inet_aton(HERE)
            ear.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
            ear.settimeout(0.5)
            for address in (FRIEND, STRANGER):
                self.there(sys.executable, "-c", SEND, address, GROUP, port)
            run(sys.executable, "-c", SEND, HERE, GROUP, port)
            senders = set()
            try:
                while True:
                    senders.add(ear.recvfrom(100)[0].decode())
            except TimeoutError:
                return senders

    def test_only_who_may_speak_is_heard(self):
        everybody = {HERE, FRIEND, STRANGER}
        self.assertEqual(self.heard(), everybody)
        run(SETUP, "--allow", FRIEND)
        self.assertEqual(self.heard(), {HERE, FRIEND})
        self.assertEqual(self.heard(PORT + 1), everybody)  # of other buses nothing was said
        run(SETUP, "--allow", STRANGER, "10.98.0.0/16")  # in place of the rule before
        self.assertEqual(self.heard(), {HERE, STRANGER})
        self.assertIn("drop", run(SETUP, "--dry-run", "--allow", HERE))
        self.assertEqual(self.heard(), {HERE, STRANGER})
        run(SETUP, "--allow-all")
        self.assertEqual(self.heard(), everybody)


if __name__ == "__main__":
    unittest.main()
