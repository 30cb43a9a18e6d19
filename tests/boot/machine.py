"""A Debian tree with the project installed, booted in namespaces of its own.

The tree's systemd never sees the machine's files, processes, network or cgroups: it gets a cgroup
below which it is alone, and its root is an overlay over the tree, whose changes end with it.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
NAMESPACES = ["--pid", "--mount", "--net", "--uts", "--ipc", "--cgroup"]


class BootError(Exception):
    """The tree did not come up."""


def _cgroup_root() -> Path:
    for line in Path("/proc/self/mounts").read_text().splitlines():
        _, target, kind, *_ = line.split()
        if kind == "cgroup2":
            return Path(target)
    raise BootError("no cgroup2 is mounted; as root: mount -t cgroup2 cgroup2 /mnt")


class Machine:
    """A context: booted inside it, gone after it."""

    def __init__(self, base: Path, packages: Path):
        self._base, self._packages = base.resolve(), packages.resolve()

    def __enter__(self) -> "Machine":
        self._folder = tempfile.TemporaryDirectory(prefix="reach-boot-")
        self._cgroup = _cgroup_root() / f"reach-boot-{os.getpid()}"
        self._cgroup.mkdir()
        command = [HERE / "inside.sh", self._base, self._packages, self._folder.name]
        self._log = tempfile.TemporaryFile("w+")
        self._unshare = subprocess.Popen(
            ["unshare", *NAMESPACES, "--fork", "--kill-child", *command],
            stdin=subprocess.DEVNULL, stdout=self._log, stderr=subprocess.STDOUT,
            preexec_fn=lambda: (self._cgroup / "cgroup.procs").write_text(str(os.getpid())),
        )  # fmt: skip
        try:
            self._wait_until_up()
        except BaseException:
            self.__exit__(*sys.exc_info())
            raise
        return self

    def __exit__(self, *_) -> None:
        self._unshare.kill()  # its child, the first process of the namespace, and so all of them
        self._unshare.wait()
        self._remove_cgroups()
        self._log.close()
        self._folder.cleanup()

    def run(self, *command: str, check: bool = True) -> str:
        """What the command says on its output, run by root in the tree."""
        entered = ["nsenter", "--target", str(self.first_process()), "--all", "--"]
        done = subprocess.run(
            [*entered, "env", "-i", "PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", *command],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60,
        )  # fmt: skip
        if check and done.returncode:
            raise AssertionError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
        return done.stdout

    def run_beside(self, unit: str, *command: str, check: bool = True) -> str:
        """The same in the unit's network namespace."""
        pid = self.property(unit, "MainPID")
        return self.run("nsenter", "--target", pid, "--net", "--", *command, check=check)

    def property(self, unit: str, name: str) -> str:
        return self.run("systemctl", "show", "--property", name, "--value", unit).strip()

    def first_process(self) -> int:
        """Of the tree, by the machine's number."""
        pid = self._unshare.pid
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        if not children:
            self._log.seek(0)
            raise BootError(f"the tree ended: {self._log.read()}")
        return int(children[0])

    def machine_pid(self, pid: str) -> int:
        """By the machine's number, what has the number `pid` in the tree."""
        namespace = os.readlink(f"/proc/{self.first_process()}/ns/pid")
        for status in Path("/proc").glob("[0-9]*/status"):
            try:
                if os.readlink(status.parent / "ns/pid") != namespace:
                    continue
                numbers = [
                    line.split() for line in status.read_text().splitlines() if "NSpid" in line
                ]
            except OSError:
                continue  # it ended while we looked
            if numbers and numbers[0][-1] == pid:
                return int(status.parent.name)
        raise AssertionError(f"nothing has the number {pid} in the tree")

    def _wait_until_up(self) -> None:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            time.sleep(0.2)
            if self._unshare.poll() is not None:
                self._log.seek(0)
                raise BootError(f"the tree did not boot: {self._log.read()}")
            if Path(f"/proc/{self.first_process()}/comm").read_text().strip() != "systemd":
                continue
            if "running" in self.run("systemctl", "is-system-running", check=False):
                return
        raise BootError(f"the tree is not up after a minute:\n{self._complaints()}")

    def _complaints(self) -> str:
        return self.run("systemctl", "--failed", check=False) + self.run(
            "journalctl", "--no-pager", "--lines", "80", check=False
        )

    def _remove_cgroups(self) -> None:
        """The kernel takes a moment to see that the last process is gone."""
        for folder, _, _ in os.walk(self._cgroup, topdown=False):
            for _ in range(100):
                try:
                    os.rmdir(folder)
                    break
                except OSError:
                    time.sleep(0.05)
