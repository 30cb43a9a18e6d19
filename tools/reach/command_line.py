"""What the command lines of all tools have in common: --version, and one line for wrong usage."""

import argparse
from typing import NoReturn

EXIT_CODES = "exit code: 0 done, 1 failed, 2 wrong usage"


class Parser(argparse.ArgumentParser):
    """Explains exit codes at the end of its help."""

    def __init__(self, **settings):
        super().__init__(epilog=EXIT_CODES, add_help=False, **settings)
        self.add_argument("-h", "--help", action="help", help="this text")
        self.add_argument("-V", "--version", action=_Version, help="version and git revision")

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; {self.prog} --help tells more\n")


class _Version(argparse.Action):
    """In the tree, git is asked for it: not before somebody wants to know."""

    def __init__(self, **settings):
        super().__init__(nargs=0, **settings)

    def __call__(self, parser: argparse.ArgumentParser, *_) -> NoReturn:
        from .version import VERSION

        print(parser.prog, VERSION)
        parser.exit()
