"""Appends the true Jacobian to the rows of iCub-like samples, for reach-eval to compare with.

    python -m reach.arm_jacobians --tool stick S2.csv.gz S2-jacobian.csv.gz

The arm: waist yaw, roll, pitch; shoulder pitch, abduction, axial rotation; elbow (rad) to the
position of the tool's tip (m). Rows whose position is not that of this arm are refused.
"""

import argparse
import gzip
import sys
from pathlib import Path

import numpy as np

# Where the tip lies from the palm: along the stick's axis a, and b across it (m).
_A = np.array([np.cos(np.radians(20)), np.sin(np.radians(20)), 0])
_B = np.array([-np.sin(np.radians(20)), np.cos(np.radians(20)), 0])
TOOLS = {"none": 0 * _A, "stick": 0.28 * _A, "L": 0.48 * _A + 0.30 * _B}
LARGEST_ERROR = 0.01  # m: a position farther off belongs to another arm or tool


def _turn(v: np.ndarray, angle: np.ndarray, i: int, k: int) -> np.ndarray:
    """Turns the plane of axes i and k, from i towards k."""
    turned = v.copy()
    turned[..., i] = np.cos(angle) * v[..., i] - np.sin(angle) * v[..., k]
    turned[..., k] = np.sin(angle) * v[..., i] + np.cos(angle) * v[..., k]
    return turned


def tip(q: np.ndarray, tool: np.ndarray) -> np.ndarray:
    """q: n x 7 (real or complex). Rotation about x goes from y to z, about y from z to x."""
    v = np.zeros((*q.shape[:-1], 3), q.dtype) + tool + np.array([0, 0, -0.197])
    v = _turn(v, -q[..., 6], 2, 0)
    v = _turn(v, -q[..., 5], 0, 1) + np.array([0, 0, -0.152])
    v = _turn(v, -q[..., 4], 1, 2)
    v = _turn(v, q[..., 3], 2, 0) + np.array([0, -0.11, 0.18])
    v = _turn(v, q[..., 2], 2, 0)
    v = _turn(v, q[..., 1], 1, 2)
    return _turn(v, q[..., 0], 0, 1)


def jacobian(q: np.ndarray, tool: np.ndarray) -> np.ndarray:
    """n x 3 x 7, by complex steps: exact to rounding."""
    step = 1e-30
    columns = [tip(q + 1j * step * np.eye(7)[k], tool).imag / step for k in range(7)]
    return np.stack(columns, axis=-1)


def _open(path: Path, mode: str):
    return gzip.open(path, mode + "t") if path.suffix == ".gz" else path.open(mode)


def _read(path: Path) -> np.ndarray:
    with _open(path, "r") as file:
        header = 1 if any(c.isalpha() and c not in "eE" for c in file.readline()) else 0
    with _open(path, "r") as file:
        return np.loadtxt(file, delimiter=",", skiprows=header, ndmin=2)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
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
    q, tool = rows[:, :7], TOOLS[options.tool]
    error = np.abs(tip(q, tool) - rows[:, 7:]).max(axis=1)
    if error.max() > LARGEST_ERROR:
        print(f"arm_jacobians: {options.source}: row {error.argmax() + 1} is {error.max():.3f} m"
              f" off this arm with tool {options.tool}", file=sys.stderr)  # fmt: skip
        return 1
    with _open(options.target, "w") as file:
        np.savetxt(file, np.hstack([rows, jacobian(q, tool).reshape(-1, 21)]), "%.9g", ",")
    return 0


if __name__ == "__main__":
    sys.exit(main())
