"""What docs/faq.md says of LCM is what LCM does here."""

import re
import subprocess
import unittest

import lcm_facts
from reach.messages import ROOT

ROW = re.compile(r"^\| `(\w+)` \| .+? \| `(.+)` \|$", re.MULTILINE)


def of_debian() -> bool:
    """Whether lcm-logger is of the version that the page speaks of."""
    command = ["dpkg-query", "-W", "-f", "${Version}", "liblcm-bin"]
    said = subprocess.run(command, capture_output=True, text=True).stdout
    return said.startswith("1.3.1")


class Facts(unittest.TestCase):
    def test_the_page_says_what_happens(self):
        page = (ROOT / "docs/faq.md").read_text()
        said = {name: text.replace("\\|", "|") for name, text in ROW.findall(page)}
        self.assertEqual(set(said), set(lcm_facts.FACTS))
        if not of_debian():
            self.skipTest("liblcm-bin is not of version 1.3.1")
        for name, text in said.items():
            with self.subTest(name):
                self.assertEqual(self.coarse(lcm_facts.show(name)), self.coarse(text))

    def coarse(self, text: str) -> str:
        """Seconds, which depend on the machine, are rounded."""
        return re.sub(r"(\d+\.\d) s", lambda found: f"{round(float(found[1]))} s", text)


if __name__ == "__main__":
    unittest.main()
