"""The part of the page about the limits of explicit schemes, and why a step above one of them stays bounded."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from mudline.study.schemes import SCHEMES
from tests.benchmarks.dynamics.beam import DECKS
from tests.benchmarks.dynamics.lifting import DAMPING
from tests.benchmarks.dynamics.schemes import DECK
from tests.benchmarks.dynamics.tables import Row, load
from tests.benchmarks.dynamics.words import percent, table, wrapped

TRIED = 0.01
"""Of the limit: how far below and above it the tests step a line that is raised as a whole."""

_VARIANTS = """\
The limits are those of `x'' = -omega^2 x - gamma x'`, gamma = c / m, with the velocity that the forces of a scheme see,
as in [the stability study](stability.md). *Central difference* sees that of the half step before:
`(omega dt)^2 + 2 gamma dt < 4`, for damping alone 2 m / c. *Velocity Verlet* sees `v(n) + dt a(n)`, predicted to the
end of the step with the acceleration at its beginning, which is `(3 x(n+1) - 4 x(n) + x(n-1)) / (2 dt)`:
`(omega dt)^2 + 4 gamma dt < 4`, for damping alone m / c. Its factors in a step are the roots of
`z^3 - (2 - w - 3 h / 2) z^2 + (1 - 2 h) z + h / 2`, with w = `(omega dt)^2` and h = `gamma dt`; the first to leave the
unit circle passes -1, where w + 4 h = 4. RK4 has {rk4:.4g} m / c. The line has its own damping as well: EA alone would
allow {undamped:.1f} ms; with {damping:g} s of damping it allows velocity Verlet {ea} ms.

Suction is a damper: its force grows with the velocity, most steeply below `REGULARISATION=`. Its limit is that of a
line which rises **as a whole**: all elements at once, hardly moving, with suction fully mobilised. Here the line leaves
the seabed element by element, so the limit does not apply, and velocity Verlet stays bounded with a step above it:
"""

_AS_A_WHOLE = """\
A line that is raised as a whole has no such help: on the same deck a small motion beside a steady rise dies out below
{whole} ms with velocity Verlet and {kicked} ms with central difference and grows above, tried at {share:g} % less and
more. Take the limit of the table unless a run with half the step shows the same.
"""

_KEYWORDS = {
    "EA": "*GEOMETRIC SETS",
    "EI": "*GEOMETRIC SETS",
    "linear": "*SEABED PROPERTIES",
    "suction": "*SEABED SUCTION",
    "friction": "*SEABED FRICTION",
}


def deck_line(what: str) -> int:
    """The line of the deck where the keyword stands that a limit comes from."""
    keyword = _KEYWORDS[what.replace(",", "").split()[0]]
    return (DECKS / DECK).read_text(encoding="utf-8").splitlines().index(keyword) + 1


def stiffer(axial: Row, step: float, damping: float) -> float:
    """How many times stiffer a line is that allows velocity Verlet just this step."""
    return 4.0 / (step * step + 4.0 * damping * step) / float(axial["omega [rad/s]"]) ** 2


def limit_parts(folder: Path) -> Iterator[str]:
    """The text, by paragraphs and tables."""
    rows = load("limits", folder)
    shown = ("central-difference", "velocity-verlet", "rk4")
    cells = [
        [
            row["what"],
            str(deck_line(row["what"])),
            f"{float(row['value']):,.0f} {row['unit']}" if row["value"] else "",
            *(f"{float(row[heading]):.1f}" if row[heading] else "" for heading in ("omega [rad/s]", "rate [1/s]")),
            *(limit_of(row, name) for name in shown),
        ]
        for row in rows
    ]
    heads = [f"{SCHEMES[name].title} below [ms]" for name in shown]
    yield table(["what", "deck line", "largest", "omega [rad/s]", "c / m [1/s]", *heads], cells)
    axial, damped = rows[0], next(row for row in rows if row["what"] == "suction, damping")
    yield _VARIANTS.format(
        undamped=2000.0 / float(axial["omega [rad/s]"]),
        ea=limit_of(axial, "velocity-verlet"),
        damping=DAMPING,
        rk4=float(damped["rk4 [s]"]) * float(damped["rate [1/s]"]),
    )
    yield from (_within(row, damped) for row in load("suction", folder))
    yield ""
    yield _AS_A_WHOLE.format(
        whole=limit_of(damped, "velocity-verlet"), kicked=limit_of(damped, "central-difference"), share=100.0 * TRIED
    )


def limit_of(row: Row, scheme: str) -> str:
    """The limit of a scheme in a row of the table, ms."""
    return f"{1000 * float(row[f'{scheme} [s]']):.1f}"


def _within(row: Row, damped: Row) -> str:
    """What suction did in a run above or beside its own limit."""
    step, slope = float(row["step [s]"]), float(row["slope [N s/m2]"])
    largest, own, line = (float(row[heading]) for heading in ("largest growth", "growth", "growth of the line"))
    return wrapped(
        f"* {row['title']}, {1000 * step:g} ms, {int(row['steps']):,} steps: never more than",
        f"{row['most elements damped']} elements are damped at once. The largest rate is at",
        f"{float(row['time [s]']):.3f} s, where {slope:,.0f} N s/m2 act on element {row['element']}, {_alone(row)}:",
        f"{percent(slope / float(damped['value']))} of what the law can reach. Its two nodes share it, so that",
        f"gamma is c / 2 m = {float(row['rate [1/s]']):.0f} 1/s and the limit {1000 * float(row['limit [s]']):.1f} ms.",
        f"In no step does any motion grow by more than {percent(largest - 1.0)}, and that is suction that softens:",
        f"beyond the equation itself a step adds {percent(own - max(line, 1.0))} at most.",
    )


def _alone(row: Row) -> str:
    others = int(row["damped at the time"]) - 1
    return f"with {others} others" if others else "and on no other"
