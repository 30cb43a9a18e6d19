"""Commands of the how-tos that need neither a robot nor cameras, executed as they stand there."""

import json
import re
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import markdown
import numpy as np
from PIL import Image
from scratch import SOURCE, Scratch

# Another machine: a network namespace at the other end of a cable.
OTHER_MACHINE = """
unshare --net sleep 100 & other=$!
in_other() { nsenter --net --target $other "$@"; }
until in_other ip link set lo up 2>/dev/null && [ -z "$(in_other ip route)" ]; do sleep 0.1; done
ip link add name eth0 type veth peer name far
ip link set far netns $other
ip address add 10.77.0.1/24 dev eth0
ip link set eth0 up
in_other ip address add 10.77.0.2/24 dev far
in_other ip link set far up
in_other ip route add default dev far
"""
PROGRAMS = """
in_other build/bin/reach-simrobot --config etc/simrobot-icub.yaml --realtime &
build/bin/reachd --config etc/icub.yaml --no-rt &
build/bin/reachctl status --timeout 20 > /dev/null
in_other build/bin/reachctl status --timeout 20
"""


def block(page: str, word: str) -> str:
    """The block of commands of a how-to that holds this word."""
    blocks = markdown.read(SOURCE / "docs/howto" / page).blocks
    (found,) = [b.text for b in blocks if b.language == "sh" and word in b.text]
    return found


class HowTo(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scratch = Scratch(self.folder)

    def run_all(self, commands: str) -> str:
        result = self.scratch.run(commands)
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout)
        return result.stdout

    def test_several_machines(self):
        """Here the loopback has the multicast route, as reach-lcm-setup leaves it."""
        where = block("lan.md", "ip route get")
        look = block("lan.md", "top").replace("doctor", "doctor || true")
        said = self.run_all(
            OTHER_MACHINE + block("lan.md", "export") + where
            + block("lan.md", "ip route add").replace("sudo ", "") + where
            + PROGRAMS + look + "kill $(jobs -p)\nwait\n"
        )  # fmt: skip
        self.assertEqual(re.findall(r"^multicast \S+ dev (\w+)", said, re.M), ["lo", "eth0"])
        self.assertRegex(said, r"(?m)^state +\w+, behaviour none")  # as the other machine hears it
        self.assertRegex(said, r"ok +multicast route +239\.255\.76\.67 by eth0")
        self.assertRegex(said, r"ok +senders")
        self.assertRegex(said, r"(?m)^ROBOT_STATE +[1-9]")
        self.assertRegex(said, r"(?m)^joint +1 ")  # the daemon has the other machine's states

    def test_a_picture_of_the_ball(self):
        blocks = markdown.read(SOURCE / "docs/howto/cameras.md").blocks
        (text,) = [b.text for b in blocks if b.language == "yaml"]
        (self.folder / "my-vision.yaml").write_text(text)
        self.run_all("build/bin/reach-simrobot --config etc/simrobot-kobian.yaml --snapshot a.ppm")
        Image.open(self.folder / "a.ppm").save(self.folder / "pair.png")
        said = self.run_all(block("cameras.md", "--bench"))
        self.assertIn("seen", said)
        with Image.open(self.folder / "found.png") as found:
            self.assertEqual(found.size, (1280, 480))

    @unittest.skipUnless(find_spec("optuna"), "without optuna")
    def test_data_of_your_own(self):
        """As the page goes, with fewer trials."""
        self.assertIn("waist,", self.run_all(block("own-data.md", "head")))
        tune = block("own-data.md", "./run tune")
        tune = tune.replace("./run tune", ".venv/bin/python -m reach.tune")
        tune = tune.replace("--minutes 2", "--trials 12 --no-body --out out/tune")
        said = self.run_all(tune)
        page = (SOURCE / "docs/howto/own-data.md").read_text()
        for line in re.findall(r"^(?:proposed|before|ridge|Gaussian)\D*", said, re.M):
            self.assertIn(line.strip(), page)
        self.assertTrue((self.folder / "out/tune/report.html").exists())
        self.run_all(block("own-data.md", "--rows"))
        rows = (self.folder / "rows.csv").read_text().splitlines()
        self.assertEqual(len(rows), 1 + 140)
        result = json.loads((self.folder / "report.json").read_text())["results"][0]
        self.assertEqual(result["at"], 560)
        learner = self.scratch.run(
            block("own-data.md", "reach-learner").strip() + " & sleep 3; kill $!"
        )
        self.assertIn("ready", learner.stderr)

    def test_the_recipe_of_the_learners_page(self):
        """The cell of its table that the commands make."""
        text = next(b.text for b in markdown.read(SOURCE / "docs/learner.md").blocks
                    if "--pointer" in b.text)  # fmt: skip
        self.run_all(text)
        result = json.loads((self.folder / "report.json").read_text())["results"][0]
        self.assertEqual((result["experts"], round(result["test"]["asked"]["solutions"], 2)),
                         (2, 2.0))  # fmt: skip

    def test_the_scale_of_wide_joints(self):
        page = (SOURCE / "docs/howto/tuning.md").read_text()
        found = re.findall(r"(\d+) mm with ([\d.]+) rad", page)
        self.assertEqual(len(found), 3)
        for millimetres, scale in found:
            self.run_all(block("tuning.md", "--wide").replace("scale=2.1", f"scale={scale}"))
            result = json.loads((self.folder / "report.json").read_text())["results"][0]
            mean = 1000 * result["test"]["asked"]["closest"]["mean"]
            self.assertAlmostEqual(mean, int(millimetres), delta=0.5)

    def test_settings_on_recorded_samples(self):
        rng = np.random.default_rng(1)
        for name in ("train", "test"):
            z = rng.uniform(-1, 1, (300, 7))
            rows = np.hstack([z, np.sin(z[:, :3]) + z[:, 3:6]])
            np.savetxt(self.folder / f"{name}.csv", rows, delimiter=",")
        self.run_all(block("tuning.md", "degree=3"))
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["parameters"]["degree"], 3)


if __name__ == "__main__":
    unittest.main()
