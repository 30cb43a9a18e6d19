"""I1, babbling in Cartesian space: errors of the forward model, section 6.1, figure 5."""

from pathlib import Path

import numpy as np

from .. import summary
from ..clock import PERIOD_US
from ..record import Record
from . import i2, replay, series
from .rows import Row

PHASES = ("phase1", "phase2", "phase3", "phase4", "phase5")  # none, stick, none, L, none
OF_FIGURE_5 = PHASES[:3]
SETS = {"s1": "test_s1", "s2": "test_s2"}
TEST_STEP = 10  # every such sample of a test set: neighbours along a move are alike


def measure(record: Record, run: dict, folder: Path) -> dict[str, float]:
    phases = [_samples(record, run, name) for name in PHASES]
    tests = {key: _truth(record, run, name) for key, name in SETS.items()}
    lengths = [len(rows) for rows in phases]
    step = max(lengths) // 25
    counts = replay.counts(lengths, max(1, step // 4), step, 5 * step)
    learner = run["learner"]
    curve = replay.curve(replay.ICUB, learner, phases, tests, counts)
    millimetres = {key: 1e3 * curve[key] for key in tests}
    series.write(folder / "i1_curve.csv", samples=counts, experts=curve["experts"],
                 s1=millimetres["s1"], s2=millimetres["s2"])  # fmt: skip
    ends = np.cumsum(lengths)
    at = {
        name: int(np.flatnonzero(counts == end)[0]) for name, end in zip(PHASES, ends, strict=True)
    }
    result = {f"I1.{key}.{name}_mm": float(millimetres[key][at[name]].mean())
              for key in SETS for name in OF_FIGURE_5}  # fmt: skip
    result["I1.s1.change_pct"] = _change(result, "s1", "phase1", "phase2")
    result["I1.s2.change_pct"] = _change(result, "s2", "phase2", "phase3")
    for words, name in (("hand", "phase1"), ("stick", "phase2"), ("L", "phase4")):
        result[f"I1.experts.{words}"] = float(curve["experts"][at[name]])
        result[f"I1.touching.{words}_pct"] = _touching(record, run, name)
    return result


def _touching(record: Record, run: dict, name: str) -> float:
    """Share of a phase's ticks at which arm or tool touched the body, %."""
    phase = summary.phase_named(run, name)
    rows = record.between("SIM_CONTACTS", phase["start"], phase["end"])
    touched = np.unique(rows["utime"][rows["touching"] > 0])
    return 100 * len(touched) / ((phase["end"] - phase["start"]) / PERIOD_US)


def _change(values: dict, key: str, before: str, after: str) -> float:
    first, last = values[f"I1.{key}.{before}_mm"], values[f"I1.{key}.{after}_mm"]
    return 100 * (last - first) / first


def _samples(record: Record, run: dict, name: str) -> np.ndarray:
    rows = summary.samples_of(record, summary.phase_named(run, name))
    return np.hstack([rows["q"][:, : rows["n_inputs"][0]], rows["x"][:, : rows["n_outputs"][0]]])


def _truth(record: Record, run: dict, name: str) -> np.ndarray:
    """True joints and positions along the frozen babbling of a test set."""
    phase = summary.phase_named(run, name)
    rows = record.between("SIM_TRUTH", phase["start"], phase["end"])
    rows = rows[rows["exposure"] == 0][::TEST_STEP]
    _, x = i2.true_track(record, phase["start"], phase["end"])
    return np.hstack([rows["position"][:, : rows["n_joints"][0]], x[::TEST_STEP]])


_PAPER_EXPERTS = {"hand": 40, "stick": 130, "L": 280}
_BARS = {"s1": 3.0, "s2": 4.0}


def rows() -> list[Row]:
    result = []
    for key, bar in _BARS.items():
        for name in OF_FIGURE_5:
            learned = key == "s1" or name != "phase1"  # the stick is met in phase 2
            result.append(Row(f"I1.{key}.{name}_mm",
                              f"RMSE after {name.replace('phase', 'phase ')}, {key.upper()}", "mm",
                              "figure 5", bar if learned else None))  # fmt: skip
    return [
        *result,
        Row("I1.s1.change_pct", "S1 error after the stick's phase, relative to before", "%",
            "no change", 2.0),
        Row("I1.s2.change_pct", "S2 error after a further phase of the hand, relative to before",
            "%", "almost no change", 2.0),
        *(Row(f"I1.experts.{words}", f"experts after {words}", "", count)
          for words, count in _PAPER_EXPERTS.items()),
        *(Row(f"I1.touching.{words}_pct", f"time of babbling with {words} that it touches the body",
              "%") for words in _PAPER_EXPERTS),
    ]  # fmt: skip
