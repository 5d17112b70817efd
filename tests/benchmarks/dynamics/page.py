"""The tables of docs/studies/benchmark.md, from the CSV files beside it; the text of the page is written by hand."""

from __future__ import annotations

from collections.abc import Iterable

from tests.benchmarks.dynamics.peers import CORRECTED, LOWERED
from tests.benchmarks.tables import Row, load, table

CLOSE = 0.01
"""What a run may be off to be called good enough: of the peak force, of the force (root mean square), of the work."""
CLOSE_TOUCHDOWN = 0.02
"""The same for the touchdown point, root mean square, m."""


# -------------------------------------------------------------------------------------------------------------- schemes


def _step(row: Row) -> float:
    return float(row["step [s]"])


def cheapest(runs: Iterable[Row]) -> dict[str, Row]:
    """By scheme, the run with the least work that is good enough, with all that have smaller steps."""
    found: dict[str, Row] = {}
    lost: set[str] = set()
    for row in sorted(runs, key=_step):
        if not _good(row):
            lost.add(row["scheme"])
        elif row["scheme"] not in lost:
            found[row["scheme"]] = row
    return found


def _good(row: Row) -> bool:
    if row["failure"]:
        return False
    shares = (abs(float(row[name])) for name in ("peak force", "force rms", "seabed work"))
    return max(shares) <= CLOSE and float(row["touchdown rms [m]"]) <= CLOSE_TOUCHDOWN


def _judged(row: Row) -> tuple[int, float]:
    """By work, then by error."""
    return int(row["evaluations"]) + int(row["tangents"]), float(row["touchdown rms [m]"])


def _enough() -> str:
    runs = load("benchmark-schemes")
    best = cheapest(runs)
    rows = [
        [row["title"], f"{1000 * _step(row):g} ms", f"{int(row['evaluations']):,}", f"{int(row['tangents']):,}",
         row["most iterations"]]
        for row in sorted(best.values(), key=_judged)
    ]  # fmt: skip
    rows += [
        [title, "none", "", "", ""] for title in dict.fromkeys(r["title"] for r in runs if r["scheme"] not in best)
    ]
    return table(["scheme", "step", "evaluations", "tangents", "most Newton iterations"], rows)


# ------------------------------------------------------------------------------------------------------- other programs


def _chains_at_rest() -> str:
    """Tensions of both ends in each depth, by source."""
    sources = ("published", LOWERED, "catenary", CORRECTED, "mudline", "MoorDyn")
    chains = load("benchmark-chains")

    def tension(depth: str, source: str, end: str) -> str:
        row = next(one for one in chains if one["depth [m]"] == depth and one["source"].startswith(source))
        return f"{float(row[end]):.1f}"

    rows = [
        [f"{depth} m, {end.removesuffix(' [kN]')}", *(tension(depth, source, end) for source in sources)]
        for depth in dict.fromkeys(row["depth [m]"] for row in chains)
        for end in ("fairlead [kN]", "anchor [kN]")
    ]
    return table(["", *sources], rows)


TABLES = {"enough": _enough, "chains-at-rest": _chains_at_rest}
