# ---
# A notebook as a script: run it whole, or cell by cell in an editor that knows "# %%".
#     python examples/reading_a_log.py out/demo/run.lcmlog
# ---

# %% A log becomes one structured numpy array a channel; its columns are the fields of lcmtypes/.
import sys
from pathlib import Path

import matplotlib
import numpy as np
from reach import read_log

matplotlib.use("Agg")
import matplotlib.pyplot as plt

log = Path(sys.argv[1] if len(sys.argv) > 1 else "out/demo/run.lcmlog")
record = read_log(log)
status, marker = record["REACH_STATUS"], record["MARKER"]
print(f"{len(status)} ticks, {record.lost()} of them lost on the way into the log")

# %% Stamps are microseconds, and the same clock on every channel.
start = status["utime"][0]
seconds = (status["utime"] - start) * 1e-6
print(f"{seconds[-1]:.1f} s of the robot's time")

# %% What the eyes saw. Rows where the marker was hidden hold zeros; a mask leaves them out.
seen = marker["seen"] == 1
print(f"the ball was seen in {np.mean(seen):.0%} of {len(marker)} images")

# %% What the daemon's step cost, and how its model grew.
cost = status["compute_us"]
print(f"a tick took {np.median(cost):.0f} us, one of a hundred {np.percentile(cost, 99):.0f} us")
print(f"{status['experts'][-1]} experts at the end")

# %% One picture of it all.
figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 5), layout="constrained")
when = (marker["utime"] - start) * 1e-6
for name, shape, shade in (
    ("u_right", ".", "0.0"),
    ("v_right", "^", "0.4"),
    ("disparity", "x", "0.7"),
):
    upper.plot(when[seen], marker[name][seen], shape, color=shade, markersize=2, label=name)
upper.set(xlabel="time, s", ylabel="place of the ball, px")
upper.legend()
lower.plot(seconds, cost, linewidth=0.5)
lower.set(xlabel="time, s", ylabel="tick, µs", yscale="log")
picture = log.with_name("reading_a_log.png")
figure.savefig(picture, dpi=120)
print(f"wrote {picture}")
