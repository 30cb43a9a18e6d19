"""reachd from Python: `Reach` talks to it, `Learner` to reach-learner, `read_log` reads what was
said on the bus; beside that, the project's experiments and their reports."""

from importlib import import_module

# Loaded when it is asked for: who only reads logs needs no LCM.
_HOMES = {
    "LateError": "learner",
    "Learner": "learner",
    "NoAnswerError": "bus",
    "Reach": "client",
    "Record": "record",
    "RefusedError": "client",
    "RestartedError": "learner",
    "read_log": "record",
}
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


def __getattr__(name: str):
    if name in _HOMES:
        return getattr(import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
