"""Makes the golden logs anew: short runs of today's reachd, which later versions must repeat to the
byte, and the log that tests/fuzz damages. For when a change of behaviour, or of a message, is
meant. Called by ./run golden."""

import lzma
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "system"))

import recorded_runs  # noqa: E402  (it is not installed anywhere)

RUNS = {
    "lockstep": recorded_runs.lockstep,
    "real-time": recorded_runs.real_time,
    "body": lambda out: recorded_runs.lockstep_without_eyes(out, samples=15),
}
MOST_BYTES = 300_000
CORPUS = HERE.parent / "fuzz/corpus/replay/beginning.lcmlog"


def record(run) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        run(Path(folder))
        return (Path(folder) / "run.lcmlog").read_bytes()


def main() -> None:
    for name, run in RUNS.items():
        packed = lzma.compress(record(run), preset=9)
        path = HERE / f"{name}.lcmlog.xz"
        if len(packed) > MOST_BYTES:
            sys.exit(
                f"{path}: {len(packed)} bytes are more than {MOST_BYTES}; make the run shorter"
            )
        path.write_bytes(packed)
        print(f"{path}: {len(packed)} bytes")
    CORPUS.parent.mkdir(exist_ok=True)
    CORPUS.write_bytes(record(recorded_runs.with_a_small_learner))
    print(f"{CORPUS}: {CORPUS.stat().st_size} bytes")


if __name__ == "__main__":
    main()
