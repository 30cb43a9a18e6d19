"""The version of the tools, with the git revision; an installed package has it as a constant."""

import subprocess

from .messages import ROOT

VERSION = subprocess.run(
    [ROOT / "tools/dev/version.sh"], stdout=subprocess.PIPE, text=True, check=True
).stdout.strip()
