# ---
# A notebook as a script: how the robot's predictions became better while it learned.
#     python examples/learning_curve.py out/demo/run.lcmlog
# ---

# %% REACH_SAMPLE holds each training pair, with what the model had predicted before it learned it.
import sys
from pathlib import Path

import matplotlib
import numpy as np
from reach import read_log

matplotlib.use("Agg")
import matplotlib.pyplot as plt

log = Path(sys.argv[1] if len(sys.argv) > 1 else "out/demo/run.lcmlog")
samples = read_log(log)["REACH_SAMPLE"]
n_outputs = samples["n_outputs"][0]
print(f"{len(samples)} samples, {np.sum(samples['learned'])} of them learned")

# %% A prediction is multi-valued: the daemon acts on the solution that fits what it sees. An oracle
# would take the best of them; the gap between the two is what choosing costs.
measured = samples["x"][:, :n_outputs]
acted_on = np.linalg.norm(samples["x_predicted"][:, :n_outputs] - measured, axis=1)
distances = np.linalg.norm(samples["values"][:, :, :n_outputs] - measured[:, None], axis=2)
offered = np.arange(distances.shape[1]) < np.maximum(samples["solutions"], 1)[:, None]
best = np.where(offered, distances, np.inf).min(axis=1)

# %% Single samples as dots, and means over a window that slides.
window = max(1, min(20, len(samples) // 4))
smooth = np.ones(window) / window
curves = {"the solution in use": (acted_on, "-"), "the best of all": (best, "--")}
figure, axes = plt.subplots(figsize=(8, 4), layout="constrained")
axes.plot(acted_on, ".", color="grey", markersize=2, alpha=0.4, label="each sample")
for name, (errors, line) in curves.items():
    axes.plot(np.convolve(errors, smooth, "valid"), line, color="black", label=name)
    print(f"{name}: {errors[:window].mean():.3g} at first, {errors[-window:].mean():.3g} at last")
axes.set(xlabel="sample", ylabel="error in task space", yscale="log")
axes.legend()
picture = log.with_name("learning_curve.png")
figure.savefig(picture, dpi=120)
print(f"wrote {picture}")
