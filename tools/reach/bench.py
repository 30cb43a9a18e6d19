"""`./run bench`: what the learner costs, as a table and a picture; build/bin/reach-bench measures.

What remains in the folder: bench.json (also copied to --json), table.md, cost.png.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

from matplotlib.figure import Figure

from .command_line import Parser
from .figures import LEARNERS, PAPER
from .programs import BINARIES, OURS, ROOT

STYLES = {"ours": LEARNERS[OURS], "textbook": LEARNERS["linear"], "lwpr": LEARNERS["lwpr"]}
LIMIT = 1000  # us that a call may take


def _times(row: dict, who: str) -> str:
    """Median / 99.9th percentile / greatest."""
    times = row[f"{who}_us"]
    return " / ".join(f"{times[k]:,.0f}" for k in ("p50", "p999", "max")) if times else ""


def _ratio(value: float | None) -> str:
    return "" if value is None else f"{value:.1f}" if value < 10 else f"{value:.0f}"


def _solutions(row: dict) -> str:
    return "" if row["solutions"] is None else f"{row['solutions']:.1f}"


def table(rows: list[dict]) -> str:
    """Markdown, a line for each call of each case."""
    lines = [
        "| call | d | experts | ours | textbook | LWPR | faster: p50 / p99.9 | streaming"
        " | solutions |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        faster = " / ".join(filter(None, (_ratio(row["ratio_p50"]), _ratio(row["ratio_p999"]))))
        streaming = f"{row['stream_us']:,.0f} ({row['bytes'] / 2**20:.1f} MB)"
        lines.append(
            f"| {row['name']} | {row['d']} | {row['experts']} | {_times(row, 'ours')}"
            f" | {_times(row, 'textbook')} | {_times(row, 'lwpr')} | {faster} | {streaming}"
            f" | {_solutions(row)} |"
        )
    return "\n".join(lines) + "\n"


def _curve(axis, rows: list[dict], who: str) -> None:
    known = [row for row in rows if row[f"{who}_us"]]
    experts = [row["experts"] for row in known]
    name = {"ours": "ours", "textbook": "textbook", "lwpr": "LWPR, with its own fields"}[who]
    for key, line, share in (("p50", "-", "median"), ("p999", "--", "99.9 %")):
        values = [row[f"{who}_us"][key] for row in known]
        axis.plot(experts, values, line, ms=4, label=f"{name}, {share}", **STYLES[who])


def _panel(axis, rows: list[dict], call: str, d: int) -> None:
    experts = [row["experts"] for row in rows]
    for who in STYLES:
        if any(row[f"{who}_us"] for row in rows):
            _curve(axis, rows, who)
    axis.plot(experts, [row["stream_us"] for row in rows], ":", color=PAPER,
              label="reading the experts once")  # fmt: skip
    axis.axhline(LIMIT, color="#b02020", lw=0.8, label="limit: 1 ms")
    axis.set(xscale="log", yscale="log", ylim=(2, 1e5), title=f"{call}, d = {d}, D = 3",
             xlabel="experts", ylabel="time of a call, µs")  # fmt: skip
    axis.set_xticks(experts, [str(n) for n in experts])
    axis.minorticks_off()


def picture(rows: list[dict]) -> Figure:
    """Cost against experts, linear ones, with the bound of reading their bytes once."""
    figure = Figure(figsize=(9.0, 7.6), layout="constrained")
    axes = figure.subplots(2, 2, squeeze=False)
    for i, d in enumerate((7, 4)):
        for k, call in enumerate(("update", "predict")):
            here = [row for row in rows if row["d"] == d and row["name"] == call]
            _panel(axes[i][k], here, call, d)
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=8)
    return figure


def main() -> int:
    parser = Parser(prog="./run bench", description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--json", type=Path, help="write the rows to this file, too")
    add("--out", type=Path, default=ROOT / "out/bench", help="folder of the results")
    add("--calls", type=int, default=4000, help="updates and predictions of each case")
    add("--only", default="", help="only cases whose label holds this, such as 'linear d=7'")
    add("--from", dest="source", type=Path, help="do not measure: draw the rows of this file")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    result = options.out / "bench.json"
    if options.source:
        shutil.copyfile(options.source, result)
    else:
        command = [BINARIES / "reach-bench", "--json", result, "--only", options.only,
                   "--calls", str(options.calls)]  # fmt: skip
        if subprocess.run(command).returncode:
            return 1
    rows = json.loads(result.read_text())
    if options.json and options.json.resolve() != result.resolve():
        shutil.copyfile(result, options.json)
    text = table(rows)
    (options.out / "table.md").write_text(text)
    picture(rows).savefig(options.out / "cost.png", dpi=140)
    print("Microseconds on one core: median / 99.9th percentile / greatest.\n\n" + text)
    print(f"in {options.out}: bench.json, table.md, cost.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
