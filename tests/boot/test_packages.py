"""The Debian packages: what is in them, and a demo with what is in them, out of a folder."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PACKAGES = Path(sys.argv.pop(1))
HERE = Path(__file__).parent
NAMES = ["libreach-dev", "reach-sim", "reach-tools", "reachd"]


def run(*command) -> str:
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, timeout=200)
    if done.returncode:
        raise AssertionError(f"{' '.join(words)}: {done.stdout}{done.stderr}")
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.packages = {
            run("dpkg-deb", "--field", path, "Package").strip(): path
            for path in PACKAGES.glob("*.deb")
        }
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        for name, path in cls.packages.items():
            run("dpkg-deb", "--raw-extract", path, cls.folder / name)

    def files(self, name: str) -> set[str]:
        root = self.folder / name
        return {
            str(path.relative_to(root)) for path in root.rglob("*")
            if not path.is_dir() and not path.is_relative_to(root / "DEBIAN")
        }  # fmt: skip

    def field(self, package: str, name: str) -> str:
        return run("dpkg-deb", "--field", self.packages[package], name).strip()

    def test_names_and_versions(self):
        self.assertEqual(sorted(self.packages), NAMES)
        versions = {self.field(name, "Version") for name in NAMES}
        self.assertEqual(len(versions), 1, versions)
        self.assertRegex(versions.pop(), r"^\d+\.\d+\.\d+(\+git\d+\.\w+(\.dirty)?)?$")

    def test_no_file_is_in_two(self):
        owners: dict[str, str] = {}
        for name in NAMES:
            for file in self.files(name):
                self.assertNotIn(file, owners, name)
                owners[file] = name

    def test_what_is_where(self):
        for name, file in (
            ("reachd", "usr/sbin/reachd"), ("reachd", "usr/sbin/reach-vision"),
            ("reachd", "usr/sbin/reach-finder"),
            ("reachd", "usr/lib/systemd/system/reach-finder.service"),
            ("reachd", "usr/lib/systemd/system/reachd.service"),
            ("reachd", "usr/share/man/man8/reachd.8.gz"), ("reach-sim", "usr/bin/reach-simrobot"),
            ("reach-sim", "etc/reach/robots/kobian.urdf"), ("reach-tools", "usr/bin/reachctl"),
            ("reach-tools", "usr/lib/python3/dist-packages/reach/record.py"),
            ("libreach-dev", "usr/include/reach/learner.h"),
        ):  # fmt: skip
            self.assertIn(file, self.files(name))
        for name in NAMES:
            documents = self.folder / name / "usr/share/doc" / name
            self.assertIn("License: Expat", (documents / "copyright").read_text())
            self.assertTrue((documents / "changelog.gz").is_file(), name)

    def test_configuration_is_kept(self):
        for name in NAMES:
            listed = self.folder / name / "DEBIAN/conffiles"
            kept = set(listed.read_text().split()) if listed.exists() else set()
            self.assertEqual(kept, {f"/{f}" for f in self.files(name) if f.startswith("etc/")})

    def test_dependencies(self):
        """Libraries are found from the programs; what these start or load is written down."""
        for name, pieces in {
            "reachd": ("libc6 (>=", "liblcm1", "libopencv-core", "libyaml-0-2", "iproute2"),
            "reach-sim": ("libode8", "libegl1", "libgl1-mesa-dri"),
            "reach-tools": ("liblcm1", "python3-numpy", "iproute2"),
        }.items():
            depends = self.field(name, "Depends")
            for piece in pieces:
                self.assertIn(piece, depends, name)

    def test_scripts_are_sound(self):
        for name in ("reachd", "reach-sim", "reach-tools"):
            for script in ("postinst", "prerm", "postrm"):
                path = self.folder / name / "DEBIAN" / script
                self.assertNotIn("@", path.read_text())
                run("sh", "-n", path)

    def test_demo(self):
        """Not where they were built, nor where they are to be installed."""
        root, work = self.folder / "root", self.folder / "work"
        for package in self.packages.values():
            run("dpkg-deb", "--extract", package, root)
        said = run(HERE / "demo.sh", work, root)
        self.assertIn("a model of 6 samples", said)
        status = json.loads((work / "status.json").read_text())
        self.assertEqual((status["samples"], status["marker_seen"]), (6, 1))


if __name__ == "__main__":
    unittest.main()
