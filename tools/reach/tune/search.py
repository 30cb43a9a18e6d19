"""Looks for parameters with Optuna's TPE sampler: each trial learns and measures anew, twice.

When experts are born depends on the order of the rows. So a trial learns them forward and backward,
and the geometric mean of both errors counts: otherwise a lucky stream chooses."""

import math
import time
from dataclasses import dataclass, field
from pathlib import Path

import optuna

from ..evaluation import EvaluationError
from ..progress import Progress
from .columns import Look
from .data import Samples
from .settings import Settings, most_degree, start_for, yaml_of
from .trial import Bench

_WANTED_TRIALS = 30  # at least, by learning fewer rows
_FEWEST_ROWS = 500
_MORE_SOLUTIONS = 1.1
_FINALISTS = 3  # of the search, compared on all rows


@dataclass(frozen=True)
class Tried:
    score: float
    settings: Settings
    solutions: float  # the larger mean of both directions


@dataclass
class Search:
    """Trials on one set of rows."""

    bench: Bench
    look: Look
    rows: int
    tried: list[Tried] = field(default_factory=list)  # in order

    def try_out(
        self, settings: Settings, name: str = "trial", timeout: float | None = None
    ) -> Tried:
        config = write_yaml(self.bench.folder / f"{name}.yaml", settings, self.look, "a trial")
        both = [
            self.bench.measure(config, [self.rows], timeout=timeout, backward=backward)
            for backward in (False, True)
        ]
        return Tried(
            math.prod(self.bench.score(measured) for measured in both) ** 0.5, settings,
            max(measured.solutions.mean() for measured in both),
        )  # fmt: skip

    def take(self, tried: Tried) -> Tried:
        self.tried.append(tried)
        return tried

    def best(self, n: int = 1) -> list[Tried]:
        return sorted(self.tried, key=lambda tried: tried.score)[:n]


def write_yaml(path: Path, settings: Settings, look: Look, origin: str) -> Path:
    path.write_text(yaml_of(settings, look, origin))
    return path


def _proposal(trial: optuna.Trial, inputs: int) -> Settings:
    def logarithmic(name: str, low: float, high: float) -> float:
        return trial.suggest_float(name, low, high, log=True)

    return Settings(
        width=logarithmic("width", 0.3, 5.0),
        doubt=logarithmic("doubt", 1e-3, 0.1),
        noise=logarithmic("noise", 1e-3, 1.0),
        p0=logarithmic("p0", 1e-9, 0.1),
        ridge=logarithmic("ridge", 1e-9, 1e-2),
        degree=trial.suggest_int("degree", 1, most_degree(inputs)),
    )


def _as_parameters(settings: Settings) -> dict:
    names = ("width", "doubt", "noise", "p0", "ridge", "degree")
    return {name: getattr(settings, name) for name in names}


def rows_that_fit(seconds: float, rows: int, budget: float) -> int:
    """How many rows to learn so that the wanted number of trials fits, when `rows` take so long."""
    if seconds * _WANTED_TRIALS <= budget:
        return rows
    return max(min(rows, _FEWEST_ROWS), int(rows * budget / (seconds * _WANTED_TRIALS)))


def look_for(search: Search, budget: float, most_trials: int, progress: Progress) -> None:
    """Until the seconds or the trials are over; the recipe of the pages is the first trial."""
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1, multivariate=True))
    study.enqueue_trial(_as_parameters(start_for(search.look)))
    start = time.monotonic()

    def objective(trial: optuna.Trial) -> float:
        try:
            tried = search.take(search.try_out(_proposal(trial, len(search.look.inputs))))
        except EvaluationError:  # such as an expert that is too large: no reason to end
            return 100.0
        return math.log(max(tried.score, 1e-12))

    def tell(study: optuna.Study, trial) -> None:
        n, spent = len(study.trials), time.monotonic() - start
        share = max(n / most_trials, spent / budget)
        best = math.exp(study.best_value)
        progress.update(
            "search", min(1.0, share), f"{n} trials, best error {best:.2%} of the range"
        )
        if share >= 1:
            study.stop()

    study.optimize(objective, n_trials=most_trials, callbacks=[tell])
    progress.finish("search", f"{len(search.tried)} trials of {search.rows} rows each")


def try_body(search: Search, more: Search, seconds: float, progress: Progress) -> None:
    """The best parameters with experts on a body, if it is found in time. One that makes more
    solutions, of the same rows or of `more`, has taken errors of the body for tools."""
    (best,) = search.best()
    progress.update("body", 0.0, "looking for a chain of joints")
    try:
        tried, again = (
            part.try_out(best.settings.as_body(), "body", timeout=seconds / 4)  # each way
            for part in (search, more)
        )
    except EvaluationError as error:
        progress.finish("body", f"left out: {error}")
        return
    solutions = max(tried.solutions, again.solutions)
    if solutions > _MORE_SOLUTIONS * best.solutions:
        progress.finish("body", f"left out: {solutions:.1f} solutions, not "
                        f"{best.solutions:.1f} as before")  # fmt: skip
        return
    search.take(tried)
    progress.finish("body", f"error {tried.score:.2%} of the range")


def compare_on_all(search: Search, all_rows: Search, progress: Progress) -> None:
    """The few that were best on fewer rows learn all of them."""
    finalists = search.best(_FINALISTS)
    if search.rows == all_rows.rows:
        all_rows.tried += search.tried
        return
    for n, tried in enumerate(finalists):
        progress.update("finalists", n / len(finalists), f"{n} of {len(finalists)} on all rows")
        all_rows.take(all_rows.try_out(tried.settings))
    progress.finish("finalists", f"{len(finalists)} learned all {all_rows.rows} rows")


def make_search(folder: Path, train: Samples, test: Samples, look: Look) -> Search:
    ranges = [column.range for column in look.outputs]
    if look.one_unit_out:
        ranges = [max(ranges)] * len(ranges)
    return Search(Bench.of(folder, train, test, ranges), look, len(train))
