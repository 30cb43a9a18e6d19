"""summary.json: the run's numbers, from its log and the description of its phases.

Everything outside the key "wall" is decided by seed and configuration.
"""

import numpy as np

from . import metrics
from .messages import reach
from .record import Record

TRACK = 5  # status_t.phase
# Frames exposed later than this before the end may still be on their way when all is stopped.
IN_FLIGHT_US = 200_000
DIGITS = 6


def samples_of(record: Record, phase: dict) -> np.ndarray:
    """The pairs gathered in one phase."""
    samples = record["REACH_SAMPLE"]
    return samples[samples["request_seq"] == phase["request_seq"]]


def phase_named(run: dict, name: str) -> dict:
    return next(phase for phase in run["phases"] if phase["name"] == name)


def true_positions(record: Record, at: np.ndarray) -> np.ndarray:
    """Where the head would truly have fixated the ball at these instants."""
    truth = record["SIM_TRUTH"]
    return metrics.interpolate(truth["utime"], truth["x_fixation"], at)


def test_errors(record: Record, samples: np.ndarray, span: np.ndarray) -> dict:
    """Errors of the predictions that the daemon acted on; `span` is the range in people's units."""
    measured = metrics.to_people(samples["x"])
    predicted = metrics.to_people(samples["x_predicted"])
    values = metrics.to_people(samples["values"])
    truth = metrics.to_people(true_positions(record, samples["utime"]))
    closest = metrics.closest_solution(values, samples["solutions"], measured, span)
    error = metrics.rmse(predicted, measured)
    return {
        "samples": len(samples),
        "rmse": error,
        "rmse_pct": 100 * error / span,
        "rmse_true": metrics.rmse(predicted, truth),
        "rmse_closest": metrics.rmse(closest, measured),
        "measured_to_true": metrics.rmse(measured, truth),
    }


def babbling(record: Record, run: dict) -> dict:
    tests = {
        name: samples_of(record, phase_named(run, f"test_{name}")) for name in ("hand", "tool")
    }
    span = metrics.union_range(*(metrics.to_people(rows["x"]) for rows in tests.values()))
    result = {}
    for name, rows in tests.items():
        errors = test_errors(record, rows, span)
        errors["tests"] = errors.pop("samples")
        learned = samples_of(record, phase_named(run, f"learn_{name}"))
        result[name] = {"samples": len(learned), **errors}
    again = samples_of(record, phase_named(run, "retest_hand"))
    final = test_errors(record, again, span)
    result["hand"]["final"] = {key: final[key] for key in ("rmse", "rmse_pct", "rmse_true")}
    result["range"] = span
    return result


def star_segments(record: Record, phase: dict) -> list[tuple[int, int]]:
    """First and last instant of each target of a STAR; us."""
    status = record["REACH_STATUS"]
    mine = (status["request_seq"] == phase["request_seq"]) & (status["phase"] == TRACK)
    rows = status[mine]
    return [
        (int(part["utime"][0]), int(part["utime"][-1]))
        for n in np.unique(rows["progress"])
        if len(part := rows[rows["progress"] == n]) > 1
    ]


def true_track(record: Record, start: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Instants (us) and rows [u, v, disparity] of the ball's true image."""
    truth = record.between("SIM_TRUTH", start, end)
    truth = truth[truth["exposure"] == 0]
    return truth["utime"], np.stack(
        [truth[n] for n in ("u_right", "v_right", "disparity")], axis=-1
    )


def star(record: Record, phase: dict) -> dict:
    """Each target on the true track."""
    final, straightness, settling = [], [], []
    targets = metrics.star_targets()
    segments = star_segments(record, phase)
    for target, (start, end) in zip(targets, segments, strict=False):
        times, track = true_track(record, start, end)
        final.append(metrics.final_error(times, track, target))
        straightness.append(metrics.line_deviation(track, track[0], target))
        settling.append(metrics.settling_time(times, track, target, radius=5.0))
    spread = {"final_error_px": final, "straightness": straightness, "settling_s": settling}
    return {
        "targets": len(segments),
        **{key: {"median": float(np.median(v)), "max": max(v)} for key, v in spread.items()},
    }


def robot_seconds(run: dict) -> float:
    return (run["phases"][-1]["end"] - run["phases"][0]["start"]) * 1e-6


def wall(record: Record, run: dict) -> dict:
    return {
        "seconds": run["wall_seconds"],
        "real_time_factor": robot_seconds(run) / run["wall_seconds"],
        "tick_us": metrics.quantiles(record["REACH_STATUS"]["compute_us"]),
        "vision_us": metrics.quantiles(record["MARKER"]["compute_us"]),
        "log_lost": record.lost(),
    }


def body(last: np.ndarray) -> dict | None:
    """What the experts stand on in the end, None where that is no body."""
    if int(last["body"]) != reach.status_t.BODY_FOUND:
        return None
    return {
        "samples": int(last["body_samples"]),
        "error": float(last["body_error"]),
        "doubt": float(last["body_doubt"]),
        "searches": int(last["body_searches"]),
        "not_rigid": metrics.to_people(last["body_not_rigid"]).tolist(),
    }


def summarise(record: Record, run: dict) -> dict:
    start, end = run["phases"][0]["start"], run["phases"][-1]["end"]
    frames = (record.between(c, start, end - IN_FLIGHT_US) for c in ("MARKER", "SIM_TRUTH"))
    marker = metrics.marker_errors(*frames)
    tests = [samples_of(record, p) for p in run["phases"] if "test" in p["name"]]
    last = record.between("REACH_STATUS", start, end)[-1]
    std_u, std_v, std_d = marker["std"]
    return rounded(
        {
            "seed": run["seed"],
            "learner": run["experts"],
            "babbling": babbling(record, run),
            "star": {n: star(record, phase_named(run, f"star_{n}")) for n in ("hand", "tool")},
            "experts": int(last["experts"]),
            "contexts": int(last["contexts"]),
            "body": body(last),
            "solutions_mean": float(np.concatenate(tests)["solutions"].mean()),
            "marker_error_px": {"std_u": std_u, "std_v": std_v, "std_d": std_d,
                                "mean": marker["mean"]},
            "frames": marker["frames"],
            "missed_frames": marker["missed"],
            "wrong_frames": marker["wrong"],
            "skipped": {phase["name"]: phase["skipped"] for phase in run["phases"]},
            "bad_inputs": int(last["bad_inputs"]),
            "gated": int(last["gated"]),
            "robot_seconds": robot_seconds(run),
            "wall": wall(record, run),
        }
    )  # fmt: skip


def rounded(value):
    """Plain numbers, short enough to read; JSON has no NaN."""
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [rounded(item) for item in value]
    if isinstance(value, float | np.floating):
        return round(float(value), DIGITS) if np.isfinite(value) else None
    return int(value) if isinstance(value, np.integer) else value
