"""Prints the programs' sources in a compile_commands.json, one a line (for clang-tidy)."""

import json
import sys
from pathlib import Path

LEFT_OUT = ("build", "tests")


def own_sources(commands_path: Path) -> list[str]:
    """Paths relative to the project, without tests and what the build generates."""
    root = Path(__file__).resolve().parents[2]
    files = {Path(entry["file"]).resolve() for entry in json.loads(commands_path.read_text())}
    inside = [file.relative_to(root) for file in files if file.is_relative_to(root)]
    return sorted(str(file) for file in inside if file.parts[0] not in LEFT_OUT)


if __name__ == "__main__":
    print("\n".join(own_sources(Path(sys.argv[1]))))
