"""The table of all arms, in Markdown."""

from .measure import Row

_HEAD = (
    "| arm | joints | loads | kinematics off by, m | gravity off by, N m | moving off by, m"
    " | energy drift | fastest | body from | reached, body | reached, polynomial"
    " | times real time |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|\n"
)


def of(rows: list[Row], targets: int) -> str:
    return _HEAD + "".join(_line(row) for row in rows) + "\n" + _sums(rows, targets) + _notes(rows)


def _line(row: Row) -> str:
    loads = "refused" if row.refused else f"{row.repaired} repaired" if row.repaired else "yes"
    reached = row.reached or {}
    cells = [
        row.name, row.joints, loads, _small(row.kinematics), _small(row.gravity),
        _small(row.off_chain), None if row.drift is None else f"{100 * row.drift:.1f} %",
        _speed(row), row.body or None, reached.get("body"), reached.get("polynomial"),
        None if row.real_time_factor is None else f"{row.real_time_factor:.0f}",
    ]  # fmt: skip
    return "| " + " | ".join("" if cell is None else str(cell) for cell in cells) + " |\n"


def _speed(row: Row) -> str | None:
    if row.fastest is None:
        return None
    strong = "" if row.fastest_strong is None else f" ({row.fastest_strong:.2f})"
    return f"{row.fastest:.2f}{strong}"


def _small(value: float | None) -> str | None:
    return None if value is None else f"{value:.1e}"


def _sums(rows: list[Row], targets: int) -> str:
    loaded = [row for row in rows if not row.refused]
    whole = [sum((row.reached or {}).get(kind) == targets for row in loaded)
             for kind in ("body", "polynomial")]  # fmt: skip
    return (
        f"{len(loaded)} of {len(rows)} load, {sum(row.repaired > 0 for row in loaded)} of them with"
        f" repaired masses. {targets} of {targets} targets within 1 cm: {whole[0]} with a body,"
        f" {whole[1]} with polynomials.\n"
    )


def _notes(rows: list[Row]) -> str:
    """What the table has no room for."""
    lines = [f"- {row.name} is refused: {row.refused}" for row in rows if row.refused]
    lines += [f"- {row.name}: motors too weak for the arm's weight: {row.weak}"
              for row in rows if row.weak]  # fmt: skip
    lines += [f"- {row.name}, {what}: {why}"
              for row in rows for what, why in (row.trouble or {}).items()]  # fmt: skip
    return "".join(f"\n{line}" for line in lines) + ("\n" if lines else "")
