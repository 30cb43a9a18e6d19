"""The meeting place of a cluster: workers come to it (./run worker), and sweeps (--scheduler).

Whoever reaches it can run anything on all workers, unless TLS is set up: docs/howto/cluster.md.
"""

import argparse
import asyncio
import signal
import sys

from ..command_line import Parser


def parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = Parser(prog="./run scheduler", description=__doc__,
                    formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("--host", default="127.0.0.1", metavar="ADDRESS",
                        help="where to listen, and with tls:// before it encrypted;"
                             " default %(default)s: this machine alone")  # fmt: skip
    parser.add_argument("--port", type=int, default=8786, help="default %(default)s")
    return parser.parse_args(arguments)


async def serve(host: str, port: int) -> int:
    from .library import HTTP, distributed

    ending = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, ending.set)
    protocol, _, name = host.rpartition("://")
    try:
        async with distributed.Scheduler(
            host=name,
            port=port,
            protocol=protocol or None,
            dashboard=False,
            dashboard_address=HTTP,
        ) as scheduler:
            print(f"scheduler: listens at {scheduler.address}", flush=True)
            await ending.wait()
    except (OSError, TypeError, ValueError) as error:
        print(f"scheduler: {host}:{port}: {error}", file=sys.stderr)
        return 1
    return 0


def main(arguments: list[str] | None = None) -> int:
    options = parse(arguments)
    return asyncio.run(serve(options.host, options.port))


if __name__ == "__main__":
    sys.exit(main())
