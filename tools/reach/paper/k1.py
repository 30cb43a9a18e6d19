"""K1, motor babbling: errors of the forward model, section 7.1, figures 14 to 16."""

from pathlib import Path

import numpy as np

from .. import metrics, summary
from ..programs import OURS
from ..record import Record
from . import replay, series
from .rows import Row

# Test phases and the training samples before them.
TESTS = ("test_hand_500", "test_hand_1000", "test_hand_1300", "test_tool_1000", "test_tool_1300")
LEARNED = ("learn_hand", "learn_tool", "learn_again")
SETS = {"s1": "test_hand_1000", "s2": "test_tool_1000"}
BALL = {"s1": "hand", "s2": "tool"}
COMPONENTS = {"yaw": "deg", "pitch": "deg", "disparity": "px"}
KINDS = {
    "rmse_true": ("", "against the truth"),
    "rmse": ("measured_", "against measured test points"),
    "rmse_closest": ("closest_", "solution closest to what was measured"),
    "measured_to_true": ("noise_", "noise floor: measured test points against the truth"),
}


def measure(record: Record, run: dict, folder: Path) -> dict[str, float]:
    samples = {name: summary.samples_of(record, summary.phase_named(run, name))
               for name in (*TESTS, *LEARNED)}  # fmt: skip
    span = span_of(samples)
    errors = {name: summary.test_errors(record, samples[name], span) for name in TESTS}
    result = {}
    for name, phase in SETS.items():
        result |= _errors(name, errors[phase], span)
    result |= _changes(errors, span)
    _write_points(folder, samples)
    _write_tests(folder, errors, run)
    result |= _curves(record, run, folder, samples, span)
    at_1000 = summary.phase_named(run, "test_hand_1000")
    result["K1.experts"] = at_1000["experts"]
    result["K1.skipped"] = sum(phase["skipped"] for phase in run["phases"])
    return result


def span_of(samples: dict[str, np.ndarray]) -> np.ndarray:
    """Range of both test sets together, people's units."""
    return metrics.union_range(*(metrics.to_people(samples[name]["x"]) for name in SETS.values()))


def _errors(name: str, errors: dict, span: np.ndarray) -> dict[str, float]:
    result = {}
    for kind, (prefix, _) in KINDS.items():
        for i, (component, unit) in enumerate(COMPONENTS.items()):
            result[f"K1.{name}.{component}_{prefix}pct"] = 100 * errors[kind][i] / span[i]
            result[f"K1.{name}.{component}_{prefix}{unit}"] = errors[kind][i]
    return result


def mean_pct(errors: dict, span: np.ndarray) -> float:
    """One number for an error against the truth: mean of the components, in percent of range."""
    return float(np.mean(100 * np.asarray(errors["rmse_true"]) / span))


def change_pct(before: float, after: float) -> float:
    return 100 * (after - before) / before


def _changes(errors: dict, span: np.ndarray) -> dict[str, float]:
    before, after, again = (mean_pct(errors[f"test_hand_{n}"], span) for n in (500, 1000, 1300))
    tool, later = (mean_pct(errors[f"test_tool_{n}"], span) for n in (1000, 1300))
    return {
        "K1.s1.change_pct": change_pct(before, after),
        "K1.s1.again_change_pct": change_pct(after, again),
        "K1.s2.again_change_pct": change_pct(tool, later),
    }


def samples_to_settle(counts: np.ndarray, errors: np.ndarray, factor: float = 2.0) -> float:
    """Samples from the first count on after which the error stays within `factor` times the
    last."""
    outside = np.flatnonzero(~(errors <= factor * errors[-1]))
    first = outside[-1] + 1 if len(outside) else 0
    return float(counts[min(first, len(counts) - 1)] - counts[0])


def _stream(rows: np.ndarray) -> np.ndarray:
    return np.hstack([rows["q"][:, : rows["n_inputs"][0]], rows["x"][:, : rows["n_outputs"][0]]])


def _true_stream(record: Record, rows: np.ndarray) -> np.ndarray:
    """Test points with the truth in the place of what was measured."""
    truth = summary.true_positions(record, rows["utime"])
    return np.hstack([rows["q"][:, : rows["n_inputs"][0]], truth])


def _curves(record: Record, run: dict, folder: Path, samples: dict,
            span: np.ndarray) -> dict[str, float]:  # fmt: skip
    """Figure 16: the recorded samples once more, to the learner of the run and to the others."""
    phases = [_stream(samples[name]) for name in LEARNED]
    tests = {key: _true_stream(record, samples[name]) for key, name in SETS.items()}
    counts = replay.counts([len(rows) for rows in phases])
    learners = replay.learners(replay.KOBIAN) if run["learner"] == OURS else (run["learner"],)
    result = {}
    for learner in learners:
        curve = replay.curve(replay.KOBIAN, learner, phases, tests, counts)
        errors = {key: metrics.to_people(curve[key]) for key in tests}
        series.write(folder / f"k1_curve_{learner}.csv", samples=counts, experts=curve["experts"],
                     s1=errors["s1"], s2=errors["s2"])  # fmt: skip
        if learner == run["learner"]:
            first, last = len(phases[0]), len(phases[0]) + len(phases[1])
            during = (counts >= first) & (counts <= last)
            pct = np.mean(100 * errors["s2"] / span, axis=1)
            result["K1.tool.samples_to_2x"] = samples_to_settle(counts[during], pct[during])
    return result


def _write_points(folder: Path, samples: dict) -> None:
    """Figures 14 and 15: where arm and head were, in degrees."""
    for ball, learn, test in (("hand", "learn_hand", "test_hand_1000"),
                              ("tool", "learn_tool", "test_tool_1000")):  # fmt: skip
        for kind, name in (("train", learn), ("test", test)):
            rows = samples[name]
            q = np.degrees(rows["q"][:, : rows["n_inputs"][0]])
            series.write(folder / f"k1_{kind}_{ball}.csv", q=q, x=metrics.to_people(rows["x"]))


def _write_tests(folder: Path, errors: dict, run: dict) -> None:
    """The live tests as points of figure 16: errors against truth and measured."""
    counts = np.cumsum([_learned(run, name) for name in LEARNED])
    at = {"500": counts[0], "1000": counts[1], "1300": counts[2]}
    for ball in ("hand", "tool"):
        names = [name for name in TESTS if f"_{ball}_" in name]
        series.write(
            folder / f"k1_live_{ball}.csv",
            samples=[at[name.rpartition("_")[2]] for name in names],
            true=[errors[name]["rmse_true"] for name in names],
            measured=[errors[name]["rmse"] for name in names],
        )


def _learned(run: dict, phase: str) -> int:
    return run["settings"][phase.removeprefix("learn_")]


def rows() -> list[Row]:
    result = []
    for name, ball in BALL.items():
        for kind, (prefix, words) in KINDS.items():
            for i, (component, unit) in enumerate(COMPONENTS.items()):
                pct, absolute = metrics.PAPER_RMSE_PCT[ball][i], metrics.PAPER_RMSE[ball][i]
                is_truth, is_noise = kind == "rmse_true", kind == "measured_to_true"
                text = f"RMSE at sample 1000, {name.upper()}, {component}: {words}"
                result += [
                    Row(f"K1.{name}.{component}_{prefix}pct", text, "% of range",
                        None if is_noise else pct, pct / 2 if is_truth else None),
                    Row(f"K1.{name}.{component}_{prefix}{unit}", text, unit,
                        None if is_noise else absolute),
                ]  # fmt: skip
    return [
        *result,
        Row("K1.s1.change_pct", "S1 error after the tool's samples, relative to before", "%",
            "no degradation", 5.0),
        Row("K1.s1.again_change_pct", "S1 error after more samples with the hand", "%",
            "further improvement"),
        Row("K1.s2.again_change_pct", "S2 error after more samples with the hand", "%"),
        Row("K1.tool.samples_to_2x", "samples with a new tool to come within 2x of the final error",
            "samples", "figure 16", 150),
        Row("K1.experts", "experts at sample 1000", ""),
        Row("K1.skipped", "configurations given up: the ball was not brought into fixation", ""),
    ]  # fmt: skip
