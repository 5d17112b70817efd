"""docs/studies/benchmark.md: its numbers come from the tables beside it, and from the decks; pictures as well."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import log2
from pathlib import Path

from mudline.study.schemes import SCHEMES
from tests.benchmarks.dynamics.beam import read_beam
from tests.benchmarks.dynamics.lifting import DAMPING
from tests.benchmarks.dynamics.page_limits import deck_line, limit_of, limit_parts, stiffer
from tests.benchmarks.dynamics.page_peers import peer_bullets, peer_parts
from tests.benchmarks.dynamics.reference import RESOLUTION
from tests.benchmarks.dynamics.schemes import DECK, HOIST
from tests.benchmarks.dynamics.tables import FOLDER, Row, column, load
from tests.benchmarks.dynamics.words import listed, mm, percent, power, rewrapped, table, wrapped

CLOSE = 0.01
"""What a run may be off to be called good enough: of the peak force, of the force (root mean square), of the work."""
CLOSE_TOUCHDOWN = 0.02
"""The same for the touchdown point, root mean square, m."""

_HEAD = """\
# Benchmark: a line laid on the seabed and lifted off again

```console
make install
make dynamics
```

The second command (`python -m tests.benchmarks.dynamics`) computes all tables, pictures and this page again. It took
{minutes:.0f} minutes of processor time, {elapsed:.0f} minutes on a machine that did other things too, and installs
MoorDyn and Exudyn in environments of their own below `.bench`; with `ARGS=--no-peers` it does without them and keeps
what the tables have of them. Every number of this page is taken from the tables `benchmark-*.csv`; the decks are in
[`benchmark/`](benchmark).

The [precision](precision.md) and [stability](stability.md) studies step one mass. Here a whole line moves, with
suction, friction and a touchdown point that travels, and the question is the one of a real analysis: **which time
integration, which step, and what is the error?** Two programs that share no code with mudline compute the parts of it
that they can.
"""

_LINE = """\
## The line

[`lay-and-lift.keyxm`](benchmark/lay-and-lift.keyxm) is a flexible hose of {length:g} m in {elements} elements on soft
clay: a linear seabed, suction (`*SEABED SUCTION`) and friction along the line (`*SEABED FRICTION`). A hoist holds its
end by a spring of {hoist.stiffness:,.0f} N/m in each direction, lifts it by {hoist.height:g} m and lays it down
again, every {hoist.lift_period:g} s for {end:g} s, and pulls it {hoist.pull:g} m along the line and back. The
seabed's force comes from mudline's evaluator (`ContactModel.step`), with all its history. The line itself is kept
simple so that anyone can repeat it: masses at the nodes, axial springs EA / L, bending by second differences, EI /
L^3, damping of {damping:g} s times the stiffness; small displacements, no water. What remains difficult is the
contact.

![The reference: touchdown, force of the hoist and works over time](benchmark-path.png)

What an explicit step must resolve, by `ContactModel.stiffest()` and the line's own fastest mode:
"""

_REFERENCE = """\
## The reference

The reference integrates the same equations with an explicit pair of order 8 (DOP853) under error control, and
**begins again at every event of the contact**: touchdown or lift-off of an element or node, the corners of the
suction, its change to rest, a new largest velocity, slip and stick. Between two events all forces are smooth, so high
order holds.

History enters it exactly. The evaluator starts each step from the history at the step's begin; that is right as long
as the stick point of a slipping node moves one way and the velocity of a lifting element grows or stays below its
largest. Where either turns there is an event, found by bisection to {resolution:g} s, and the history is taken there.
Nothing had to be split: normal force, suction and friction are integrated together.

With tolerances ten times tighter and half the longest step from row to row, against the tightest:
"""

_SCHEMES = """\
## What the schemes make of it

Every scheme of `mudline study` steps the same line with the same evaluator. An implicit step is one system of
equations, solved by Newton's method with the consistent tangent and corrections that are halved until the residual
falls. Runs are compared at {moments} moments. Work is counted in evaluations of the contact, a tangent as one more:
that does not depend on the machine.

* *Touchdown*: the arc length at which the line leaves the seabed, root mean square of the error.
* *Peak force*: of the hoist, upwards.
* *Work of the seabed*: largest error over time, as a share of the {work:.0f} J that the hoist does at most.
* *Energy balance*: what the works of hoist, seabed and damping leave of the line's energy, forces averaged over each
  step.

![Errors over work, by scheme](benchmark-schemes.png)
"""


def write(folder: Path = FOLDER) -> None:
    """Write page and pictures."""
    from tests.benchmarks.dynamics.pictures import draw  # noqa: PLC0415 - large, and not for who reads the page

    (folder / "benchmark.md").write_text(page(folder), encoding="utf-8", newline="\n")
    draw(folder)


def _head(folder: Path) -> str:
    cost = load("cost", folder)
    minutes, elapsed = (sum(column(cost, heading)) / 60.0 for heading in ("processor time [s]", "elapsed time [s]"))
    return _HEAD.format(minutes=minutes, elapsed=elapsed)


def page(folder: Path = FOLDER) -> str:
    """The text of the page."""
    runs, path, beam = load("schemes", folder), load("path", folder), read_beam(DECK)
    work, end = max(map(abs, column(path, "hoist work [J]"))), column(path, "time [s]")[-1]
    size = {"length": beam.start[-1, 1], "elements": beam.nodes - 1}
    parts = [
        _head(folder),
        *_short(runs, folder),
        _LINE.format(**size, end=end, hoist=HOIST, damping=DAMPING),
        *limit_parts(folder),
        _REFERENCE.format(resolution=RESOLUTION),
        *_reference(folder),
        _SCHEMES.format(moments=len(path), work=work),
        *_matrices(runs),
        *_failures(runs, folder),
        *_enough(runs),
        *peer_parts(folder),
    ]
    return rewrapped("\n".join(parts))


# -------------------------------------------------------------------------------------------------------- in short


def cheapest(runs: Iterable[Row]) -> dict[str, Row]:
    """By scheme, the run with the least work that is good enough, with all that have smaller steps."""
    found: dict[str, Row] = {}
    for row in sorted(runs, key=lambda row: float(row["step [s]"])):
        name = row["scheme"]
        smaller = [other for other in runs if other["scheme"] == name and _step(other) < _step(row)]
        if _good(row) and all(map(_good, smaller)):
            found[name] = row
    return found


def _ms(row: Row) -> str:
    return f"{1000 * _step(row):g} ms"


def _step(row: Row) -> float:
    return float(row["step [s]"])


def _good(row: Row) -> bool:
    if row["failure"]:
        return False
    shares = (abs(float(row[name])) for name in ("peak force", "force rms", "seabed work"))
    return max(shares) <= CLOSE and float(row["touchdown rms [m]"]) <= CLOSE_TOUCHDOWN


def _cost(row: Row) -> int:
    return int(row["evaluations"]) + int(row["tangents"])


def _judged(row: Row) -> tuple[int, float]:
    """By work, then by error."""
    return _cost(row), float(row["touchdown rms [m]"])


def _short(runs: list[Row], folder: Path) -> Iterator[str]:
    best = cheapest(runs)
    explicit, implicit = (
        min((row for row in best.values() if row["explicit"] == kind), key=_judged) for kind in ("true", "false")
    )
    limits = load("limits", folder)
    ea = limits[0]
    tight = load("reference", folder)
    yield "**In short**\n"
    yield wrapped(
        f"* For this line **{explicit['title']} with a step of {_ms(explicit)}** is the cheapest that is good",
        "enough: forces and",
        f"work within {100 * CLOSE:g} %, touchdown within {1000 * CLOSE_TOUCHDOWN:g} mm, for {_cost(explicit):,}",
        "evaluations of the",
        f"contact. Its limit is just above ({limit_of(ea, explicit['scheme'])} ms; central difference",
        f"{limit_of(ea, 'central-difference')} ms, RK4 {limit_of(ea, 'rk4')} ms; {ea['what']}, deck line",
        f"{deck_line(ea['what'])}): below it explicit schemes are already accurate.",
    )
    yield wrapped(
        f"* Of the implicit schemes the cheapest is **{implicit['title']} with {_ms(implicit)}**, for",
        f"{_cost(implicit):,} evaluations",
        "(generalised-alpha with rho = 1 is Newmark's scheme in other averages). No limit stops a larger",
        "step: it runs, looks smooth and is wrong. With the same step in both,",
        f"the implicit scheme costs {_cost(implicit) / _cost(_at(runs, 'velocity-verlet', _step(implicit))):.1f}",
        "times as much.",
    )
    equal = _step(explicit) * _cost(explicit) / _cost(implicit)
    yield wrapped(
        "* Explicit schemes win here because a hose is soft along its axis. Their limit falls with EA: from",
        f"{stiffer(ea, equal, DAMPING):.0f} times this EA on ({stiffer(ea, equal, 0.0):.0f} times without the line's",
        "own damping), as in any steel pipe, the implicit scheme is the cheaper one. Its step stays what the",
        "motion and the contact ask for.",
    )
    newmark, euler, calm = (_at(runs, name, 0.01) for name in ("newmark", "backward-euler", "generalised-alpha-0"))
    yield wrapped(
        "* A closed energy balance proves nothing: at 10 ms Newmark closes it to",
        f"{power(newmark['energy balance'])} of the hoist's work and is off by",
        f"{mm(newmark['touchdown max [m]'])} in the touchdown point at worst. Damping makes it worse:",
        "generalised-alpha with rho = 0",
        f"is off by {mm(calm['touchdown max [m]'])}, backward Euler by {mm(euler['touchdown max [m]'])} and by",
        f"{percent(abs(float(euler['peak force'])))} of the peak force.",
        "**What damps unresolved landings damps the line too.**",
    )
    yield wrapped(
        f"* The reference locates {tight[-1]['events']} events. Tolerances ten times wider, with steps twice as long,",
        "move it by",
        f"{power(tight[-2]['to the tightest: displacement [m]'])} m: every error below is that of its scheme.",
    )
    yield from peer_bullets(folder)
    yield ""


def _at(runs: list[Row], scheme: str, step: float) -> Row:
    return next(row for row in runs if row["scheme"] == scheme and abs(_step(row) - step) < 1e-9)


# ---------------------------------------------------------------------------------------------------------- tables


def _reference(folder: Path) -> Iterator[str]:
    rows = load("reference", folder)
    names = ("displacement [m]", "force [N]", "seabed work [J]", "touchdown [m]")
    keys = [f"to the tightest: {names[0]}", *names[1:]]
    cells = [
        [
            power(row["relative tolerance"]),
            row["events"],
            f"{int(row['evaluations']):,}",
            power(row["energy balance [J]"]),
            *(power(row[key]) if row[key] else "" for key in keys),
        ]
        for row in rows
    ]
    yield table(["tolerance", "events", "evaluations", "energy balance [J]", *names], cells)


def _matrices(runs: list[Row]) -> Iterator[str]:
    steps = sorted({_step(row) for row in runs}, reverse=True)
    names = dict.fromkeys(row["scheme"] for row in runs)
    wanted = (
        ("touchdown rms [m]", "Touchdown, mm", 1000.0),
        ("peak force", "Peak force, %", 100.0),
        ("seabed work", "Work of the seabed, %", 100.0),
        ("energy balance", "Energy balance, %", 100.0),
    )
    for heading, title, factor in wanted:
        rows = []
        for name in names:
            own = {_step(row): row for row in runs if row["scheme"] == name}
            cells = [_cell(own.get(step), heading, factor) for step in steps]
            rows.append([next(iter(own.values()))["title"], *cells, _order(own, heading)])
        yield table([title, *(f"{1000 * step:g} ms" for step in steps), "order"], rows)
    yield from _orders(runs)


def _orders(runs: list[Row]) -> Iterator[str]:
    """What the columns "order" say, and how schemes compare at equal work."""
    heading = "touchdown rms [m]"

    def order(name: str) -> str:
        return _order({_step(row): row for row in runs if row["scheme"] == name}, heading)

    verlet, rk4 = _at(runs, "velocity-verlet", 0.0025), _at(runs, "rk4", 0.01)
    yield wrapped(
        "The order is that of the last halving of the step. For the touchdown Newmark keeps its second",
        f"({order('newmark')}) and",
        f"velocity Verlet nearly ({order('velocity-verlet')}); central difference, whose suction sees the",
        "velocity of half a step",
        f"before, has {order('central-difference')}. RK4 falls from its fourth to {order('rk4')}: its stages step",
        "over kinks with",
        f"the history of the step's begin. At {_cost(rk4):,} evaluations it is off by {mm(rk4[heading])},",
        "velocity Verlet with",
        f"{_cost(verlet):,} by {mm(verlet[heading])}: nothing is gained by high order. That Newmark closes the",
        "balance of energy is no",
        "merit: for a linear line the scheme averages forces as the balance does, so it closes at any step,",
        "right or wrong.",
    )
    yield ""


def _cell(row: Row | None, heading: str, factor: float) -> str:
    if row is None:
        return ""
    if row["failure"]:
        return "fails"
    value = factor * float(row[heading])
    return power(str(value)) if abs(value) < 1e-3 else f"{value:.3g}"


def _order(own: dict[float, Row], heading: str) -> str:
    last = [own[step] for step in sorted(own)[:2]]
    if any(row["failure"] for row in last):
        return ""
    fine, coarse = (float(row[heading]) for row in last)
    if fine * coarse < 0.0:  # the error passes zero
        return ""
    fine, coarse = abs(fine), abs(coarse)
    return f"{log2(coarse / fine) + 0.0:.1f}".replace("-0.0", "0.0") if fine > 1e-9 and coarse > 0.0 else ""


def _failures(runs: list[Row], folder: Path) -> Iterator[str]:
    failed = [row for row in runs if row["failure"]]
    if failed:
        yield f"{len(failed)} of {len(runs)} runs failed:\n"
        yield table(["scheme", "step [ms]", "at"], [[row["title"], _ms(row), row["failure"]] for row in failed])
    axial = load("limits", folder)[0]
    explicit = dict.fromkeys(row["scheme"] for row in runs if row["explicit"] == "true")
    limits = listed(f"{SCHEMES[name].title} {limit_of(axial, name)} ms" for name in explicit)
    yield wrapped(
        f"They are all runs of explicit schemes with a step above what EA of the line allows: {limits}.",
        "RK2 and forward Euler have a limit only because the line is damped; on springs without damping, as those of",
        "the seabed, they grow at any step.",
    )
    yield ""


def _enough(runs: list[Row]) -> Iterator[str]:
    best = cheapest(runs)
    yield f"### The largest step within {100 * CLOSE:g} %\n"
    yield wrapped(
        f"Peak force, force (root mean square, of the peak) and work of the seabed within {100 * CLOSE:g} %,",
        "touchdown (root mean",
        f"square) within {1000 * CLOSE_TOUCHDOWN:g} mm, at this step and at all smaller ones that were run:",
    )
    yield ""
    rows = [
        [row["title"], _ms(row), f"{int(row['evaluations']):,}", f"{int(row['tangents']):,}", row["most iterations"]]
        for row in sorted(best.values(), key=_judged)
    ]
    rows += [
        [title, "none", "", "", ""] for title in dict.fromkeys(r["title"] for r in runs if r["scheme"] not in best)
    ]
    yield table(["scheme", "step", "evaluations", "tangents", "most Newton iterations"], rows)
