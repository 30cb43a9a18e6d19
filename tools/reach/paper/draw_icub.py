"""Figures 5 to 13."""

import numpy as np

from ..figures import canvas
from ..programs import OURS
from . import series
from .drawing import LEARNER_WORDS, LEARNERS, Data, Shown, band, legend

_AXES = ("x, m", "y, m", "z, m")


def errors(data: Data):
    """Test set S1, S2, and the set of the tool in the hand."""
    figure, axes = canvas(1, 3, 3.6, sharey=True)
    for learner, style in LEARNERS.items():
        curves = data.all("i1_curve", learner)
        if not curves:
            continue
        counts = curves[0]["samples"]
        s1, s2 = (np.array([series.wide(c, key).mean(axis=1) for c in curves])
                  for key in ("s1", "s2"))  # fmt: skip
        third = counts <= _end_of_phase(counts, 3)
        tool = (counts > _end_of_phase(counts, 1)) & (counts <= _end_of_phase(counts, 2))
        shown = (s1, s2, np.where(tool, s2, s1))
        for axis, rows in zip(axes[0], shown, strict=True):
            band(axis, counts[third], rows[:, third], label=LEARNER_WORDS[learner], **style)
    for axis, title in zip(axes[0], ("S1, hand", "S2, stick", "as in the hand"), strict=True):
        axis.set(title=title, xlabel="training samples", yscale="log")
        axis.locator_params(axis="x", nbins=4)
    axes[0, 0].set_ylabel("RMSE, mean of the components, mm")
    legend(figure, axes[0, 0])
    return figure


def _end_of_phase(counts: np.ndarray, phase: int) -> float:
    """Of five phases of equal length."""
    return counts[-1] * phase / 5


def _cube(axis, data: Data, name: str, learner: str, title: str) -> None:
    axis.set(title=title, xlabel=_AXES[0], ylabel=_AXES[1], zlabel=_AXES[2])
    axis.tick_params(labelsize=6)
    if not data.has(learner):
        axis.text2D(0.5, 0.5, "not run", transform=axis.transAxes, ha="center", color="#777777")
        return
    rows = data.first(name, learner)
    x, wanted = series.wide(rows, "x"), series.wide(rows, "target")
    axis.plot(*x.T, color=LEARNERS[learner]["color"], lw=1)
    axis.plot(*np.unique(wanted, axis=0).T, "k+", ms=7, ls="none")
    for which, limits in zip("xyz", np.stack([wanted.min(0) - 0.05, wanted.max(0) + 0.05]).T,
                             strict=True):  # fmt: skip
        axis.set(**{f"{which}lim": limits})
    axis.locator_params(nbins=4)
    axis.set_box_aspect((1, 1, 1), zoom=0.78)


def cubes(*shown: tuple[str, str, str]):
    """(series, learner, title), two in a row."""

    def draw(data: Data):
        rows = (len(shown) + 1) // 2
        figure, axes = canvas(rows, 2, 3.6 * rows, subplot_kw={"projection": "3d"})
        for axis, (name, learner, title) in zip(axes.flat, shown, strict=True):
            _cube(axis, data, name, learner, title)
        return figure

    return draw


def _by_learner(name: str):
    return cubes(*((f"i2_{name}", learner, words) for learner, words in LEARNER_WORDS.items()))


def error_in_time(data: Data):
    figure, axes = canvas()
    rows = data.first("i2_hand")
    axes[0, 0].plot(rows["t"], rows["error"], color=LEARNERS[OURS]["color"])
    axes[0, 0].set(xlabel="time, s", ylabel="sum of absolute components, m", ylim=(0, None))
    return figure


def _shown(number: str, title: str, name: str) -> Shown:
    caption = ("Track of the end-effector through the cube's corners (+) and two diagonals, model"
               " frozen.")  # fmt: skip
    rows = (f"I2.{name}.", *(f"I2.{other}.{name}." for other in LEARNERS if other != OURS))
    return Shown(number, title, caption, rows, (f"i2_{name}",), _by_learner(name))


FIGURES = [
    Shown("5", "Errors of the forward model while babbling",
          "Hand, stick, hand. The recorded samples of each learner's run, learned once more; the"
          " solution closest to the truth (mean and range over seeds).",
          ("I1.",), ("i1_curve",), errors),
    _shown("6", "Cube with the hand, after babbling with it", "hand"),
    Shown("7", "Error along the cube of figure 6", "Of ours. Every target is a step up.", (),
          ("i2_hand",), error_in_time),
    _shown("8", "Cube with the stick, after babbling with it", "stick"),
    _shown("9", "Cube with the hand, after babbling with the stick", "hand_after_stick"),
    Shown("10", "Cube after a third babbling, with the hand", "Ours: hand and stick.",
          ("I2.hand_third.", "I2.stick_third."), ("i2_hand_third", "i2_stick_third"),
          cubes(("i2_hand_third", OURS, "hand"), ("i2_stick_third", OURS, "stick"))),
    Shown("11", "Cube with a stick that was never babbled with",
          "Ours, learning while it reaches: iterations 1 and 3.",
          ("I2.stick_new_1.", "I2.stick_new_3."), ("i2_stick_new_1", "i2_stick_new_3"),
          cubes(("i2_stick_new_1", OURS, "iteration 1"),
                ("i2_stick_new_3", OURS, "iteration 3"))),
    _shown("12", "Cube with the L, after babbling with it", "L"),
    _shown("13", "Cube with the L, after more babbling with the hand", "L_later"),
]  # fmt: skip
