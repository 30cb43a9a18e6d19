"""reachd from Python: `Reach` talks to it, `Learner` to reach-learner, `read_log` reads what was
said on the bus; beside that, the project's experiments and their reports."""

from .bus import NoAnswerError
from .client import Reach, RefusedError
from .learner import LateError, Learner, RestartedError
from .record import Record, read_log

__all__ = [
    "LateError",
    "Learner",
    "NoAnswerError",
    "Reach",
    "Record",
    "RefusedError",
    "RestartedError",
    "read_log",
]
