"""What a soak has shown: a line for each promise, whether it was kept, and a picture."""

from pathlib import Path

import numpy as np

from .figures import PAPER, canvas, series

HABITS = ("learn", "learn", "tool", "reach")
FEWEST_ROWS = 6  # looks at the robot that a verdict needs
MEMORY_SHARE, MEMORY_KB = 1.05, 2048  # growth from one half to the other that is none
EXPERTS = 2  # born in the second half
ERROR_SHARE, ERROR_PCT = 1.5, 0.3  # likewise, of the spread of what is measured


def errors_pct(rows: list[dict]) -> np.ndarray:
    """Median error of each look, in percent of the spread of all that was measured."""
    every = np.concatenate([np.array(row["x"]) for row in rows if row["x"]])
    spread = every.std(axis=0)
    return np.array([
        np.median(np.linalg.norm(np.array(row["error"]) / spread, axis=1)) if row["error"]
        else np.nan for row in rows
    ]) * 100  # fmt: skip


def _halves(values) -> tuple[np.ndarray, np.ndarray]:
    """Of what follows the first quarter, in which caches fill and learning is young."""
    values = np.asarray(values)[len(values) // 4 :]
    return values[: len(values) // 2], values[len(values) // 2 :]


def _memory(rows: list[dict]) -> tuple[bool, str]:
    kept, said = True, []
    for name in rows[-1]["memory_kb"]:
        early, late = _halves([row["memory_kb"].get(name, 0) for row in rows])
        kept &= late.max() <= early.max() * MEMORY_SHARE + MEMORY_KB
        said.append(f"{name} {early.max() / 1024:.1f} then {late.max() / 1024:.1f} MB")
    return kept, ", ".join(said)


def judge(seen: dict) -> tuple[list[str], bool]:
    """Lines for people, and whether every promise was kept."""
    rows, kills = seen["rows"], seen["kills"]
    if len(rows) < FEWEST_ROWS:
        return [f"soak: {len(rows)} looks are too few to judge by; give it more minutes"], False
    flat, memory = _memory(rows)
    early, late = _halves([row["experts"] for row in rows])
    first, second = (np.nanmedian(half) for half in _halves(errors_pct(rows)))
    alarms = sum(row["alarms"] != 0 for row in rows)
    lost = [kill for kill in kills if kill.get("recovered", kill["stored"]) < kill["stored"]]
    promises = [
        ("memory", flat, memory),
        ("experts", late.max() <= early.max() + EXPERTS, f"{early.max()} then {late.max()}"),
        ("error", second <= first * ERROR_SHARE + ERROR_PCT,
         f"{first:.2f} then {second:.2f} % of the spread, median"),
        ("alarms", not alarms, f"{alarms} of {len(rows)} looks told of eyes that lie; none did"),
        ("samples", not lost, f"{rows[-1]['samples_stored']} safe on disk; after {len(lost)} of"
         f" {len(kills)} kills fewer than said before"),
    ]  # fmt: skip
    lines = [f"time    {rows[-1]['robot_s'] / 3600:.2f} h of robot time, {len(rows)} looks, kills: "
             + _killed(kills)]  # fmt: skip
    lines += [f"{name:8}{'kept' if kept else 'BROKEN'}: {said}" for name, kept, said in promises]
    return lines, all(kept for _, kept, _ in promises)


def _killed(kills: list[dict]) -> str:
    names = sorted({kill["program"] for kill in kills})
    return ", ".join(f"{name} {sum(k['program'] == name for k in kills)}" for name in names) or "0"


def draw(seen: dict, path: Path) -> None:
    rows = seen["rows"]
    if not rows:
        return
    figure, axes = canvas(3, 1, 6.5, sharex=True)
    hours = [row["robot_s"] / 3600 for row in rows]
    for number, name in enumerate(rows[-1]["memory_kb"]):
        axes[0, 0].plot(hours, [row["memory_kb"].get(name, 0) / 1024 for row in rows], label=name,
                        **series(number))  # fmt: skip
    axes[0, 0].set(ylabel="memory, MB", ylim=(0, None))
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=5, loc="outside upper center")
    axes[1, 0].plot(hours, [row["experts"] for row in rows])
    axes[1, 0].set(ylabel="experts", ylim=(0, None))
    axes[2, 0].semilogy(hours, errors_pct(rows))
    axes[2, 0].set(ylabel="error, % of spread", xlabel="robot time, h")
    for axis in axes[:, 0]:
        for kill in seen["kills"]:
            axis.axvline(kill["robot_s"] / 3600, color=PAPER, lw=0.4, alpha=0.5)
    figure.savefig(path, dpi=120)
