"""The tables of docs/studies/benchmark.md, from the CSV files beside it; the text of the page is written by hand."""

from __future__ import annotations

from collections.abc import Iterable
from math import log2

from tests.benchmarks.dynamics.peers import CORRECTED, HELD, LOWERED, PULLED, REST
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import Row, load, table

CLOSE = 0.01
"""What a run may be off to be called good enough: of the peak force, of the force (root mean square), of the work."""
CLOSE_TOUCHDOWN = 0.02
"""The same for the touchdown point, root mean square, m."""


def short(value: float) -> str:
    """Two digits, or all in front of the point."""
    return f"{value:.0f}" if abs(value) >= 10.0 else f"{value:.2g}"


def power(value: str | float) -> str:
    """A small number, with one digit."""
    number = float(value)
    return f"{number:.0e}".replace("e-0", "e-").replace("e+0", "e") if number else "0"


# -------------------------------------------------------------------------------------------------------------- schemes


def _step(row: Row) -> float:
    return float(row["step [s]"])


def _matrix(heading: str, title: str, factor: float) -> str:
    """Errors of all schemes over the steps, and the order of the last halving."""
    runs = load("benchmark-schemes")
    steps = sorted({_step(row) for row in runs}, reverse=True)
    rows = []
    for name in dict.fromkeys(row["scheme"] for row in runs):
        own = {_step(row): row for row in runs if row["scheme"] == name}
        cells = [_cell(own.get(step), heading, factor) for step in steps]
        rows.append([SCHEMES[name].title, *cells, _order(own, heading)])
    return table([title, *(f"{1000 * step:g} ms" for step in steps), "order"], rows)


def _cell(row: Row | None, heading: str, factor: float) -> str:
    if row is None:
        return ""
    if row["failure"]:
        return "fails"
    value = factor * float(row[heading])
    return power(value) if abs(value) < 1e-3 else f"{value:.3g}"


def _order(own: dict[float, Row], heading: str) -> str:
    last = [own[step] for step in sorted(own)[:2]]
    if any(row["failure"] for row in last):
        return ""
    fine, coarse = (float(row[heading]) for row in last)
    if fine * coarse < 0.0:  # the error passes zero
        return ""
    fine, coarse = abs(fine), abs(coarse)
    return f"{log2(coarse / fine) + 0.0:.1f}".replace("-0.0", "0.0") if fine > 1e-9 and coarse > 0.0 else ""


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


def _chains(when: str, sources: tuple[str, ...]) -> str:
    """Tensions of both ends in each depth, by source; `no: mudline` is that without friction."""
    chains = load("benchmark-chains")

    def tension(depth: str, source: str, end: str) -> str:
        kind, _, name = source.rpartition(": ")
        # MoorDyn moves while it is pulled: what is at rest is compared with what it has after the hold
        at = HELD if when == PULLED and name == "MoorDyn" else when
        row = next(
            one
            for one in chains
            if (one["depth [m]"], one["when"]) == (depth, at)
            and one["source"].startswith(name)
            and (not kind or one["friction"] == kind)
        )
        return f"{float(row[end]):.1f}"

    heads = [
        source.replace("no: ", "no friction, ").replace("yes: ", "friction, ").replace(": ", ", ") for source in sources
    ]
    rows = [
        [f"{depth} m, {end.removesuffix(' [kN]')}", *(tension(depth, source, end) for source in sources)]
        for depth in dict.fromkeys(row["depth [m]"] for row in chains)
        for end in ("fairlead [kN]", "anchor [kN]")
    ]
    return table(["", *heads], rows)


def _bounces() -> str:
    heads = ("to 0.5 s [m]", "to 1 s [m]", "to 2 s [m]")
    return table(
        ["step [ms]", *(head.replace("[m]", "[mm]") for head in heads)],
        [
            [f"{1000 * _step(row):.3g}", *(short(1000 * float(row[head])) for head in heads)]
            for row in load("benchmark-bouncing")
        ],
    )


TABLES = {
    "touchdown": lambda: _matrix("touchdown rms [m]", "Touchdown, mm", 1000.0),
    "enough": _enough,
    "chains-at-rest": lambda: _chains(REST, ("published", LOWERED, "catenary", CORRECTED, "mudline", "MoorDyn")),
    "chains-pulled": lambda: _chains(
        PULLED, ("no: catenary", "no: mudline", "FricDamp 200: MoorDyn", "yes: catenary", "yes: mudline")
    ),
    "bounces": _bounces,
}
