"""Makes arm.csv, samples as somebody with an arm and a motion tracker would record them.

    .venv/bin/python examples/own_data/make_arm.py arm.csv
    .venv/bin/python examples/own_data/make_arm.py wide.csv --rows 3000 --hand 3000 --wide 1.5

The arm has four joints (rad) and links of 30 and 25 cm. The tracker's mark (m, noise of 1 mm) is
at its wrist in the first 400 rows, then at the tip of a pointer in the hand. No column says so."""

import argparse

import numpy as np

LOW = np.radians([-60, -30, 10, -45])
HIGH = np.radians([60, 60, 110, 45])
POINTER = np.array([0.15, 0.03, 0.0])  # m, in the frame of the hand


def turn(axis: int, angles: np.ndarray) -> np.ndarray:
    """Rotations about x, y or z, one for each angle."""
    one, other = (axis + 1) % 3, (axis + 2) % 3
    matrices = np.tile(np.eye(3), (len(angles), 1, 1))
    matrices[:, one, one] = matrices[:, other, other] = np.cos(angles)
    matrices[:, one, other], matrices[:, other, one] = -np.sin(angles), np.sin(angles)
    return matrices


def tip(q: np.ndarray, tool: np.ndarray) -> np.ndarray:
    """Where the mark is: waist about z, shoulder and elbow about y, wrist about x."""
    upper = turn(2, q[:, 0]) @ turn(1, q[:, 1])
    lower = upper @ turn(1, q[:, 2])
    hand = lower @ turn(0, q[:, 3])
    return upper @ [0.3, 0, 0] + lower @ [0.25, 0, 0] + hand @ tool


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("path")
    add("--rows", type=int, default=700, help="samples in all; default %(default)s")
    add("--hand", type=int, default=400, help="those of the hand; the pointer's follow")
    add("--wide", type=float, default=1.0, help="range of the joints, times the usual one")
    add("--pointer", type=float, default=1.0, help="length of the pointer, times the usual one")
    add("--seed", type=int, default=7, help="of the random numbers; default %(default)s")
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    middle, half = (LOW + HIGH) / 2, options.wide * (HIGH - LOW) / 2
    q = rng.uniform(middle - half, middle + half, (options.rows, 4))
    hand, tool = q[: options.hand], q[options.hand :]
    x = np.vstack([tip(hand, np.zeros(3)), tip(tool, options.pointer * POINTER)])
    x += rng.normal(0, 0.001, x.shape)
    header = "waist,shoulder,elbow,wrist,x,y,z"
    np.savetxt(options.path, np.hstack([q, x]), fmt="%.4f", delimiter=",", header=header,
               comments="")  # fmt: skip


if __name__ == "__main__":
    main()
