"""The numbers of the experiments, as pure functions of arrays.

Task positions are rows [yaw rad, pitch rad, disparity px]; people get degrees. Image positions are
rows [u, v, disparity] in px.
"""

import numpy as np

# The paper, section 7.1: percent of the union of both ranges, and its errors in people's units.
PAPER_RMSE_PCT = {"hand": (0.5, 1.8, 2.9), "tool": (1.2, 3.0, 2.5)}
PAPER_RMSE = {"hand": (0.44, 0.53, 7.39), "tool": (0.97, 0.91, 6.33)}

WRONG_MARKER_PX = 10.0  # a detection further than this from the ball is not the ball
VISIBLE_SHARE = 0.5  # vision owes an answer when at least this share of the ball is in sight
REST_SECONDS = 0.5  # the end of a reach over which its error is averaged

_TO_PEOPLE = np.array([180.0 / np.pi, 180.0 / np.pi, 1.0])


def to_people(x: np.ndarray) -> np.ndarray:
    """[rad, rad, px] to [deg, deg, px]."""
    return np.asarray(x)[..., :3] * _TO_PEOPLE


_ENDS = [(50, 0), (50, 50), (0, 50), (-50, 50), (-50, 0), (-50, -50), (0, -50), (50, -50)]


def star_targets() -> np.ndarray:
    """The 16 targets of section 7.3: each of 8 ends, every one followed by the centre."""
    return np.array([row for u, v in _ENDS for row in ((u, v, 0.0), (0.0, 0.0, 0.0))], float)


def coordination_targets() -> np.ndarray:
    """The same asterisk for a head that turns to each target (section 7.2): from an end, the centre
    is where the opposite end was."""
    return np.array([row for u, v in _ENDS for row in ((u, v, 0.0), (-u, -v, 0.0))], float)


def rmse(predicted: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """Root mean square of each component, in the unit of the rows."""
    return np.sqrt(np.mean((np.asarray(predicted) - np.asarray(measured)) ** 2, axis=0))


def union_range(*sets: np.ndarray) -> np.ndarray:
    """Largest minus smallest of each component over all sets."""
    rows = np.concatenate(sets)
    return rows.max(axis=0) - rows.min(axis=0)


def closest_solution(values: np.ndarray, count: np.ndarray, measured: np.ndarray,
                     scale: np.ndarray) -> np.ndarray:  # fmt: skip
    """Of each row's solutions the one closest to what was measured, components over `scale`."""
    distance = np.linalg.norm((values - measured[:, None, :]) / scale, axis=2)
    distance[np.arange(values.shape[1])[None, :] >= count[:, None]] = np.inf
    return values[np.arange(len(values)), distance.argmin(axis=1)]


def interpolate(times: np.ndarray, rows: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Linear between rows; `times` may hold an instant twice."""
    times, first = np.unique(times, return_index=True)
    rows = np.asarray(rows)[first]
    return np.stack([np.interp(at, times, column) for column in rows.T], axis=-1)


def running_rms(errors: np.ndarray, window: int) -> np.ndarray:
    """Root mean square over the last `window` rows (fewer at the start), for each component."""
    total = np.cumsum(np.vstack([np.zeros((1, errors.shape[1])), errors**2]), axis=0)
    end = np.arange(1, len(errors) + 1)
    start = np.maximum(end - window, 0)
    return np.sqrt((total[end] - total[start]) / (end - start)[:, None])


def line_deviation(track: np.ndarray, start: np.ndarray, target: np.ndarray) -> float:
    """Largest distance of the track from the line start-target, over the line's length."""
    direction = target - start
    length = np.linalg.norm(direction)
    offset = track - start
    along = np.outer(offset @ direction / length**2, direction)
    return float(np.linalg.norm(offset - along, axis=1).max() / length)


def final_error(times: np.ndarray, track: np.ndarray, target: np.ndarray) -> float:
    """Mean distance to the target over the last half second; times in us."""
    last = times > times[-1] - REST_SECONDS * 1e6
    return float(np.linalg.norm(track[last] - target, axis=1).mean())


def path_length(track: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(track, axis=0), axis=1).sum())


def settling_time(times: np.ndarray, track: np.ndarray, target: np.ndarray, radius: float) -> float:
    """Seconds from the first row until the track stays within `radius` of the target."""
    outside = np.flatnonzero(np.linalg.norm(track - target, axis=1) > radius)
    if len(outside) == 0:
        return 0.0
    last = min(outside[-1] + 1, len(times) - 1)
    return float((times[last] - times[0]) * 1e-6)


def marker_errors(marker: np.ndarray, truth: np.ndarray) -> dict:
    """Vision against the truth of the same exposures.

    marker: rows of marker_t; truth: rows of sim_truth_t. The errors are of frames that were seen.
    """
    exposures = truth[truth["exposure"] == 1]
    _, i, j = np.intersect1d(marker["utime"], exposures["utime"], return_indices=True)
    marker, exposures = marker[i], exposures[j]
    seen = marker["seen"] == 1
    due = (exposures["in_view"] == 1) & (exposures["visible"] >= VISIBLE_SHARE)
    names = ("u_right", "v_right", "disparity")
    error = np.stack([(marker[n] - exposures[n])[seen] for n in names], axis=-1)
    wrong = np.linalg.norm(error, axis=1) > WRONG_MARKER_PX
    spread = error.std(axis=0) if len(error) else np.full(3, np.nan)
    return {
        "std": spread,
        "mean": error.mean(axis=0) if len(error) else np.full(3, np.nan),
        "frames": len(marker),
        "seen": int(seen.sum()),
        "missed": int((due & ~seen).sum()),
        "wrong": int(wrong.sum()),
    }


def quantiles(values: np.ndarray) -> dict[str, float]:
    """Median, 99.9th percentile and largest."""
    if len(values) == 0:
        return {"p50": float("nan"), "p999": float("nan"), "max": float("nan")}
    p50, p999 = np.quantile(values, [0.5, 0.999])
    return {"p50": float(p50), "p999": float(p999), "max": float(np.max(values))}
