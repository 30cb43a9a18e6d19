"""reachd from Python: `Reach` talks to it, `read_log` reads what was said on the bus; beside that,
the project's experiments and their reports."""

from .bus import NoAnswerError
from .client import Reach, RefusedError
from .record import Record, read_log

__all__ = ["NoAnswerError", "Reach", "Record", "RefusedError", "read_log"]
