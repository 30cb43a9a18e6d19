"""What well-known single-valued regressions make of the same rows, with scikit-learn."""

import warnings
from dataclasses import dataclass

import numpy as np
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel
from sklearn.linear_model import RidgeCV
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures, StandardScaler
from threadpoolctl import threadpool_limits

from .data import Samples

_RIDGES = np.logspace(-9, 3, 25)
_GP_FITTED = 400  # rows from which its lengths are found
_GP_ROWS = 2000  # rows that it learns: its cost grows with their cube


@dataclass(frozen=True)
class Rival:
    name: str
    rows: int  # that it learned
    predicted: np.ndarray  # (test rows, outputs)


def _every(samples: Samples, most: int) -> Samples:
    return samples.rows(slice(None, None, -(-len(samples) // most)))


def _ridge(name: str, degree: int, train: Samples, test: Samples) -> Rival:
    model = make_pipeline(StandardScaler(), PolynomialFeatures(degree), StandardScaler(),
                          RidgeCV(_RIDGES, alpha_per_target=True))  # fmt: skip
    model.fit(train.z, train.x)
    return Rival(name, len(train), model.predict(test.z).reshape(test.x.shape))


def _gaussian_process(train: Samples, test: Samples) -> Rival:
    scaler = StandardScaler().fit(train.z)
    mean, deviation = train.x.mean(axis=0), train.x.std(axis=0)
    deviation[deviation == 0] = 1

    def rows(part: Samples):
        return scaler.transform(part.z), (part.x - mean) / deviation

    kernel = ConstantKernel(1.0, (1e-3, 1e5)) * RBF(
        np.full(train.inputs, 2.0), (1e-2, 1e3)
    ) + WhiteKernel(1e-3, (1e-10, 1e1))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)
        found = GaussianProcessRegressor(kernel).fit(*rows(_every(train, _GP_FITTED)))
    part = _every(train, _GP_ROWS)
    model = GaussianProcessRegressor(found.kernel_, optimizer=None).fit(*rows(part))
    predicted = model.predict(scaler.transform(test.z)).reshape(test.x.shape)
    return Rival("Gaussian process", len(part), predicted * deviation + mean)


def compare(train: Samples, test: Samples) -> list[Rival]:
    """All learn the training rows, as far as they can, and predict the held-out ones."""
    degree = 3 if train.inputs <= 8 else 2
    names = {2: "quadratic", 3: "cubic"}
    # Several threads wait for each other where other work fills the processors: ten times as long.
    with threadpool_limits(1):
        return [
            _ridge("ridge regression, linear", 1, train, test),
            _ridge(f"ridge regression, {names[degree]}", degree, train, test),
            _gaussian_process(train, test),
        ]
