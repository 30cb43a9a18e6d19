"""Sweeps of independent runs on Dask: on this machine's processors, or on a cluster's."""

import argparse


def add_options(parser: argparse.ArgumentParser, jobs: int, what: str) -> None:
    """What the command lines of all sweeps have."""
    add = parser.add_argument
    add("--jobs", type=count, default=jobs, metavar="N",
        help=f"{what} at once, each on its own processors; default %(default)s; with"
             " --scheduler its workers decide")  # fmt: skip
    add("--scheduler", metavar="ADDRESS",
        help="do them on the workers of this Dask scheduler, HOST:PORT or tls://HOST:PORT; see"
             " docs/howto/cluster.md")  # fmt: skip


def count(text: str) -> int:
    value = int(text)
    if not 1 <= value <= 1000:
        raise argparse.ArgumentTypeError("a number from 1 to 1000 is wanted")
    return value
