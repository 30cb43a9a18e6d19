"""Appends the true Jacobian to the rows of iCub-like samples, for reach-eval to compare with.

    python -m reach.arm_jacobians --tool stick S2.csv.gz S2-jacobian.csv.gz

The arm: waist yaw, roll, pitch; shoulder pitch, abduction, axial rotation; elbow (rad) to the
position of the tool's tip (m). Rows whose position is not that of this arm are refused.
"""

import gzip
import sys
from pathlib import Path

import numpy as np

from .arm import TOOLS, Arm
from .command_line import Parser

LARGEST_ERROR = 0.01  # m: a position farther off belongs to another arm or tool


def _open(path: Path, mode: str):
    return gzip.open(path, mode + "t") if path.suffix == ".gz" else path.open(mode)


def _read(path: Path) -> np.ndarray:
    with _open(path, "r") as file:
        header = 1 if any(c.isalpha() and c not in "eE" for c in file.readline()) else 0
    with _open(path, "r") as file:
        return np.loadtxt(file, delimiter=",", skiprows=header, ndmin=2)


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("--tool", choices=TOOLS, required=True)
    parser.add_argument("source", type=Path, help="CSV of 7 inputs and 3 outputs, plain or gzip")
    parser.add_argument("target", type=Path)
    options = parser.parse_args()
    try:
        rows = _read(options.source)
    except (OSError, ValueError) as error:
        print(f"arm_jacobians: {options.source}: {error}", file=sys.stderr)
        return 1
    if rows.shape[1] != 10:
        print(f"arm_jacobians: {options.source}: {rows.shape[1]} columns, not 10", file=sys.stderr)
        return 1
    arm, q, tool = Arm(), rows[:, :7], TOOLS[options.tool]
    error = np.abs(arm.tip(q, tool) - rows[:, 7:]).max(axis=1)
    if error.max() > LARGEST_ERROR:
        print(f"arm_jacobians: {options.source}: row {error.argmax() + 1} is {error.max():.3f} m"
              f" off this arm with tool {options.tool}", file=sys.stderr)  # fmt: skip
        return 1
    with _open(options.target, "w") as file:
        np.savetxt(file, np.hstack([rows, arm.jacobian(q, tool).reshape(-1, 21)]), "%.9g", ",")
    return 0


if __name__ == "__main__":
    sys.exit(main())
