# ---
# A notebook as a script: a function with two values, learned by reach-learner. It must be running:
#     build/bin/reach-learner --config etc/reach-learner.yaml &
#     python examples/learn_a_function.py
# ---

# %% A client. What it sends again is not done twice, and what comes too late is not done at all.
from pathlib import Path

import matplotlib
import numpy as np
from reach import Learner

matplotlib.use("Agg")
import matplotlib.pyplot as plt

learner = Learner()
print(f"a learner of {learner.inputs} input and {learner.outputs} output")

# %% Samples of two branches, mixed at random, with some noise. Nobody says which is which.
random = np.random.default_rng(1)
BRANCHES = (np.sin, lambda z: 2.5 + 0.5 * z)
z = random.uniform(-3, 3, 600)
which = random.integers(2, size=len(z))
x = np.where(which, BRANCHES[1](z), BRANCHES[0](z)) + random.normal(0, 0.03, len(z))
learned = learner.update_all(z, x)
dropped = sum(sample.how == "outlier" for sample in learned)
known = learner.statistics
print(f"{len(z)} samples, {dropped} of them dropped as outliers, {known.experts} experts")

# %% At each place: all values that it knows.
grid = np.linspace(-3, 3, 121)
predictions = [learner.predict(place) for place in grid]
two = np.mean([len(prediction) == 2 for prediction in predictions])
nearest = [
    min(abs(prediction.values[:, 0] - branch(place)))
    for place, prediction in zip(grid, predictions, strict=True)
    for branch in BRANCHES
]
print(f"two values at {two:.0%} of the places, at most {max(nearest):.3f} off")

# %% The other way round: which z give x = 0.5? Guesses, to be checked by predicting forward.
wanted = 0.5
guesses = learner.predict_inverse(wanted)
print(f"x = {wanted} may come from z =", np.array2string(guesses.inputs[:, 0], precision=2))

# %% A picture. The width of a line is the solution's weight.
figure, axes = plt.subplots(figsize=(8, 4), layout="constrained")
axes.plot(z, x, ".", color="0.8", markersize=4, label="samples")
for place, prediction in zip(grid, predictions, strict=True):
    sizes = 30 * prediction.weights
    axes.scatter(np.full(len(sizes), place), prediction.values[:, 0], sizes, color="tab:blue")
axes.axhline(wanted, color="tab:orange", linewidth=0.8)
axes.plot(guesses.inputs[:, 0], np.full(len(guesses), wanted), "v", color="tab:orange",
          label=f"z for x = {wanted}")  # fmt: skip
axes.set(xlabel="z", ylabel="x")
axes.legend()
picture = Path("learn_a_function.png")
figure.savefig(picture, dpi=120)
print(f"wrote {picture}")
