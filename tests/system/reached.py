"""How far from its targets an experiment's phase ended, by the simulator's truth."""

import numpy as np
from reach.messages import reach


def errors(record, phase: dict, place) -> np.ndarray:
    """Distance to each target of a phase at the end of its time; `place` is where a row of
    SIM_TRUTH has the ball, in the targets' units."""
    status, truth = record["REACH_STATUS"], record["SIM_TRUTH"]
    status = status[(status["request_seq"] == phase["request_seq"])
                    & (status["behaviour"] == reach.status_t.REACH)]  # fmt: skip
    result = []
    for index, target in enumerate(phase["targets"]):
        last = status[status["progress"] == index][-1]["utime"]
        at = truth[(truth["utime"] == last) & (truth["exposure"] == 0)][-1]
        result.append(np.linalg.norm(place(at) - target))
    return np.array(result)
