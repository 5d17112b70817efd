"""The page of the study of stability, from its tables."""

from __future__ import annotations

import math
from decimal import ROUND_HALF_EVEN
from functools import partial
from pathlib import Path

from mudline.contact.stiffest import ADVISED_OMEGA_DT
from mudline.study.pages import (
    DOWN,
    UP,
    Columns,
    MissingTableError,
    Record,
    Tables,
    bullets,
    command_of,
    filled,
    grouped_digits,
    line_cell,
    listed,
    markdown_table,
    percent,
    rounded,
    table_of,
    time,
)
from mudline.study.schemes import SCHEMES
from mudline.study.stability.critical import ALWAYS, FAR, GROWTH, STEPS, STEPS_DAMPED
from mudline.study.stability.deck_steps import FARTHEST, NO_FREQUENCY, advice
from mudline.study.stability.ladder import ladder_part
from mudline.study.stability.landings import FEW_PHASES, NEVER, PHASES, TRIED
from mudline.study.stability.statics import FORCE_OVER_LIMIT, SPRING_OVER_STRUCTURE

_OF_TABLE = ("0.1", "0.5", "1", "10")
_BETWEEN = ("1.1", "1.5", "1.9", "1.99")
_WORTH_SHOWING = (
    "velocity-verlet",
    "rk4",
    "newmark",
    "hht-0.3",
    "generalised-alpha-0.5",
    "generalised-alpha-0",
    "backward-euler",
)
_EXPLICIT = ("velocity-verlet", "rk4")
_MOST_ROWS = 12


def page(tables: Tables) -> str:
    """The page in Markdown; raises MissingTableError."""
    fields = {
        "command": command_of("stability", _machine(tables, "deck")),
        "deck": _machine(tables, "deck"),
        "processor": _machine(tables, "processor"),
        "run_time": time(float(_machine(tables, "run time [s]") or math.nan)),
        "advice": sentence(tables),
        "short": _short(tables),
        "contacts": _contacts(tables),
        "steps": str(STEPS),
        "steps_damped": str(STEPS_DAMPED),
        "growth": f"{GROWTH:g}",
        "measured": _measured(tables),
        "deck_steps": _deck_steps(tables),
        "segments": _segments(tables),
        "farthest": f"{FARTHEST:g}",
        "few_phases": str(len(FEW_PHASES)),
        "phases": str(len(PHASES)),
        "landings": _landings(tables, _WORTH_SHOWING, _OF_TABLE),
        "explicit_landings": _landings(tables, _EXPLICIT, _BETWEEN),
        "agreement": _agreement(tables),
        "limits": _limits(tables),
        "never": _never(tables),
        **_newton(tables),
        "release": _release(tables),
        "ladder": ladder_part(tables),
    }
    return filled(Path(__file__).with_name("page.md"), fields)


def sentence(tables: Tables) -> str:
    """The advice, or why there is none."""
    if not tables.rows("advice"):
        return NO_FREQUENCY
    return advice(tables)


def _machine(tables: Tables, what: str) -> str:
    try:
        return tables.row("machine", what=what).text("value")
    except MissingTableError:
        return ""


def _short(tables: Tables) -> str:
    """The points of the summary."""
    landed = {one.text("scheme"): one for one in tables.rows("landings", **{"omega dt [-]": f"{ADVISED_OMEGA_DT:g}"})}
    newmark = SCHEMES["newmark"].title
    limits = {one.text("scheme"): one for one in tables.rows("landing-limits")}
    most = max(_extreme(tables, name, "largest") for name in limits)
    gentle = _gentle(tables)
    left = listed(f"{share} of the speed with {name}" for name, share in _left(landed, gentle))
    halvings = max(one.number("halvings needed") for one in tables.rows("newton-halvings"))
    stiffest = max(one.number(SPRING_OVER_STRUCTURE) for one in tables.rows("newton-halvings"))
    gain = percent(landed[newmark].number("largest [-]") - 1.0, rounding=UP)
    within = rounded(limits[newmark].number("landings within 1 % [-]"), 3, DOWN)
    never = listed(f"{name} (at most {value})" for name, value in gentle.items())
    points = (
        """
        The contact that asks for the smallest step sets the step of the model. Rule `STB002` uses the same numbers and
        reports a deck whose step is larger.
        """,
        f"""
        At `omega dt` = {ADVISED_OMEGA_DT:g} a landing with {newmark}'s scheme gains up to {gain} of its speed; one
        percent needs `omega dt` = {within} on a linear seabed; the table of steps below has the limits of this deck.
        """,
        """
        Central difference is unstable above `omega dt` = 2 on springs, RK4 above 2.83; on dampers they are unstable
        above `2 m / c` and `2.785 m / c`, and velocity Verlet, whose force sees the velocity predicted to the whole
        step, above `m / c`. Forward Euler and RK2 grow on every spring without damping.
        """,
        f"""
        "Unconditionally stable" is a property of linear systems. With contact that opens and closes, a pipe rebounds
        up to {rounded(most, rounding=UP)} times as fast as it landed.
        """,
        f"""
        Of the implicit schemes tried only {never} never gain more than {NEVER:g} of the speed of a landing.
        They pay for it with damping: at `omega dt` = {ADVISED_OMEGA_DT:g} a landing leaves {left}.
        """,
        f"""
        Keep a bracket around the root where friction or suction has a limit. Newton's method alone cycles where
        `kt / kb > 1 / (1 - F / (mu N))`; halved corrections need about `log2(kt / kb) - 1` halvings, {halvings:.0f} for
        `kt / kb` = {grouped_digits(stiffest)}.
        """,
        _ladder_in_short(tables),
    )
    return bullets(points)


def _left(landed: dict[str, Record], gentle: dict[str, str]) -> list[tuple[str, str]]:
    return [(name, percent(landed[name].number("mean [-]"))) for name in gentle if name in landed]


def _gentle(tables: Tables) -> dict[str, str]:
    """Implicit schemes that gain no more than `NEVER` in any landing, and their largest speed after over before."""
    found = {}
    for one in tables.rows("landing-limits"):
        most = _extreme(tables, one.text("scheme"), "largest")
        if math.isnan(one.number("critical omega dt [-]")) and most <= 1.0 + NEVER:
            found[one.text("scheme")] = rounded(most, 6, UP)
    return found


def _extreme(tables: Tables, scheme: str, which: str) -> float:
    """The "largest" or "least" speed after landing over speed before, of all steps and landing phases tried."""
    values = [row.number(f"{which} [-]") for row in tables.rows("landings", scheme=scheme)]
    values += [row.number(f"{which} at any step [-]") for row in tables.rows("landing-limits", scheme=scheme)]
    return (max if which == "largest" else min)(value for value in values if not math.isnan(value))


def _contacts(tables: Tables) -> str:
    rows = tables.rows("contacts")
    if not rows:
        return "No contact of this deck has a frequency."
    stiffness, mass, damping = (_heading(rows[0], start) for start in ("largest stiffness", "mass", "damping ["))
    table = table_of(
        rows[:_MOST_ROWS],
        {
            "contact": "contact",
            "deck line": line_cell,
            "node": "node",
            f"k {_unit(stiffness)}": lambda one: _number(one, stiffness),
            f"c {_unit(damping)}": lambda one: _number(one, damping),
            f"m {_unit(mass)}": lambda one: rounded(one.number(mass), 4),
            "omega [rad/s]": lambda one: _number(one, "omega [rad/s]"),
            f"omega dt = {ADVISED_OMEGA_DT:g} at [s]": lambda one: _limit(one, "advised step, implicit [s]"),
            "central difference below [s]": lambda one: _limit(one, "critical step, central-difference [s]"),
            "Verlet below [s]": lambda one: _limit(one, "critical step, velocity-verlet [s]"),
            "RK4 below [s]": lambda one: _limit(one, "critical step, rk4 [s]"),
        },
    )
    more = len(rows) - _MOST_ROWS
    return table + (f"\n\n{more} more are in the CSV file." if more > 0 else "")


def _heading(row: Record, start: str) -> str:
    return next(heading for heading in row.cells if heading.startswith(start))


def _unit(heading: str) -> str:
    return heading[heading.index("[") :]


def _number(row: Record, heading: str, rounding: str = ROUND_HALF_EVEN) -> str:
    value = row.number(heading)
    return "-" if math.isnan(value) or value == 0.0 else rounded(value, 3, rounding)


def _limit(row: Record, heading: str) -> str:
    """A number that something has to stay below, with three digits that are not above it."""
    return _number(row, heading, DOWN)


def _measured(tables: Tables) -> str:
    rows = tables.rows("critical-steps")
    wrong = sum(one.text("as predicted") != "yes" for one in rows)
    limited, growing = (
        sum(bool(one.text("predicted [s]")) and (one.number("predicted [s]") > 0.0) is own for one in rows)
        for own in (True, False)
    )
    ratios = [
        one.number("measured [s]") / one.number("predicted [s]") for one in rows if one.number("predicted [s]") > 0.0
    ]
    off = max((abs(ratio - 1.0) for ratio in ratios if not math.isnan(ratio)), default=math.nan)
    within = percent(max(off, 0.0025), rounding=UP)
    behaved = f"{len(rows) - wrong} of {len(rows)} runs behaved" if wrong else f"All {len(rows)} runs behaved"
    return (
        f"{behaved} as predicted: {limited} of a scheme with a critical step are bounded at 0.99 of it and grow at "
        f"1.01, {growing} of schemes that grow at any step grow at `omega dt` = {ALWAYS:g}, and "
        f"{len(rows) - limited - growing} of implicit schemes stay bounded at `omega dt` = {FAR:g}, which says nothing "
        f"about contact that opens and closes. Growth begins within {within} of the predicted step."
    )


def _deck_steps(tables: Tables) -> str:
    rows = tables.rows("deck-steps")
    columns: Columns = {
        "scheme": "scheme",
        "critical step [s]": _critical,
        "set by": "set by",
        "deck line": line_cell,
        "landings below 1.01 up to [s]": partial(_landing_step, tables, "below 1.01"),
        "landings within 1 % up to [s]": partial(_landing_step, tables, "within 1 %"),
        "landing on": "landing on",
    }
    return table_of(rows, columns) if rows else "No step follows from this deck."


def _critical(row: Record) -> str:
    step = row.number("critical step [s]")
    return "no limit" if math.isnan(step) else "grows at any" if step == 0.0 else rounded(step, 3, DOWN)


def _landing_step(tables: Tables, which: str, row: Record) -> str:
    """The step of a landing limit, or that every step tried keeps to it: the search ends at `FARTHEST`."""
    heading = f"landings {which} [s]"
    if row.text(heading):
        for one in tables.rows("deck-landings", **{heading: row.text(heading)}):
            if one.number(f"omega dt {which} [-]") > 0.999 * TRIED[TRIED <= FARTHEST][-1]:
                return f"all tried ({_limit(row, heading)})"
    return _limit(row, heading)


def _segments(tables: Tables) -> str:
    rows = tables.rows("steep-segments")
    if not rows:
        return "No curve of this deck owes its largest stiffness to a narrow segment."
    return "\n\n".join(map(_segment, rows))


def _segment(row: Record) -> str:
    stiffness, without = _heading(row, "stiffness ["), _heading(row, "stiffness without it")
    change = _heading(row, "largest change")
    return (
        f"The step of {row.text('contact')} is set by one narrow segment of its curve, from ratio "
        f"{rounded(row.number('from ratio [-]'))} to {rounded(row.number('to ratio [-]'))} ({row.place()}), "
        f"{grouped_digits(row.number(stiffness))} {_unit(stiffness)[1:-1]}. The secant without the point in line "
        f"{row.text('point to remove, deck line')} has {grouped_digits(row.number(without))}, and with it "
        f"`omega dt` = {ADVISED_OMEGA_DT:g} is at {_limit(row, 'advised step without it [s]')} s instead of "
        f"{_limit(row, 'advised step [s]')} s; the force changes by {_number(row, change, UP)} "
        f"{_unit(change)[1:-1]} at most. Check that segment."
    )


def _landings(tables: Tables, schemes: tuple[str, ...], columns: tuple[str, ...]) -> str:
    cells = []
    for name in schemes:
        title = SCHEMES[name].title
        rows = {one.text("omega dt [-]").removesuffix(".0"): one for one in tables.rows("landings", scheme=title)}
        cells.append((title, *(_three(rows[column]) for column in columns)))
    return markdown_table(("scheme", *(f"omega dt = {column}" for column in columns)), cells)


def _three(row: Record) -> str:
    values = [row.number(f"{which} [-]") for which in ("least", "mean", "largest")]
    return "unstable" if any(map(math.isnan, values)) else " / ".join(f"{value:.4f}" for value in values)


def _agreement(tables: Tables) -> str:
    compared = [one for one in tables.rows("landings") if one.text("agrees")]
    good = sum(one.text("agrees") == "yes" for one in compared)
    return (
        f"{good} of the {len(compared)} sets of figures that had been computed independently of this program agree to "
        "the last digit given."
    )


def _limits(tables: Tables) -> str:
    return table_of(
        tables.rows("landing-limits"),
        {
            "scheme": "scheme",
            "critical": lambda one: _limit(one, "critical omega dt [-]"),
            "below 1.01 up to": lambda one: _tried(one, "landings below 1.01 [-]"),
            "within 1 % up to": lambda one: _tried(one, "landings within 1 % [-]"),
            "least of those tried": lambda one: f"{_extreme(tables, one.text('scheme'), 'least'):.4f}",
            "largest of those tried": lambda one: rounded(_extreme(tables, one.text("scheme"), "largest"), 6, UP),
        },
    )


def _tried(row: Record, heading: str) -> str:
    """A limit of landings, or that every omega dt tried keeps to it."""
    return "all tried" if row.number(heading) >= TRIED[-1] else _limit(row, heading)


def _never(tables: Tables) -> str:
    gentle = _gentle(tables)
    return (
        f"{listed(gentle)} never gain more than {NEVER:g} of the speed of a landing at any step tried, from "
        f"`omega dt` = {TRIED[0]:g} to {TRIED[-1]:g}."
    )


def _newton(tables: Tables) -> dict[str, str]:
    """What is said about Newton's method."""
    rows = [one for one in tables.rows("newton-cycles") if one.number(FORCE_OVER_LIMIT) < 1.0]
    springs: Columns = {
        "kt / kb": lambda one: grouped_digits(one.number(SPRING_OVER_STRUCTURE)),
        "F / mu N": FORCE_OVER_LIMIT,
    }
    cycles: Columns = {
        **springs,
        "cycles above kt / kb": lambda one: rounded(one.number("cycles above spring / structure [-]"), 3),
        "lost, plain": "lost: plain",
        "lost, halved at most ten times": "lost: halved corrections",
        "lost, bracketed": "lost: bracketed",
        "most iterations, bracketed": "most iterations, bracketed",
    }
    halved = tables.rows("newton-halvings")
    caps = {cap.removeprefix("lost: "): cap for cap in halved[0].cells if cap.startswith("lost:")}
    halvings: Columns = {**springs, **caps, "suffice": "halvings needed", "none lost from": "none lost from a cap of"}
    path = tables.rows("newton-path")
    plain, cured = (
        ", ".join(rounded(one.number("iterate [-]"), 3) for one in path if one.text("method") == method)
        for method in ("plain", "halved")
    )
    case = path[0]
    numbers = ", ".join(
        f"`{name}` = {rounded(case.number(heading))}"
        for name, heading in (("kb", "kb"), ("kt", "kt"), ("mu N", "mu N"), ("F", "F"))
    )
    example = (
        f"With {numbers} the iterates are {plain} and so on; with corrections that are halved until the residual falls "
        f"they are {cured}: the root."
    )
    return {
        "starts": rows[0].text("starts"),
        "example": example,
        "cycles": table_of(rows, cycles),
        "halvings": table_of(halved, halvings),
    }


def _release(tables: Tables) -> str:
    rows = tables.rows("release")
    if not rows:
        return "No element of this deck has `*SEABED SUCTION`."
    velocity, force, depth, needed = (
        _heading(rows[0], start) for start in ("velocity", "largest suction", "breakout", "needed stiffness")
    )
    columns: Columns = {
        "element": "element",
        **{name: partial(_number, heading=name) for name in (velocity, force, depth)},
        needed: lambda one: _number(one, needed, UP),
        **{name: name for name in rows[0].cells if name.startswith("equilibria")},
    }
    return f"On the laws of this deck:\n\n{table_of(rows[:_MOST_ROWS], columns)}"


def _ladder_in_short(tables: Tables) -> str:
    rows = tables.rows("ladder")
    cells, wrong = (int(sum(one.number(heading) for one in rows)) for heading in ("cells", "anything else"))
    if wrong:
        return f"Extreme numbers: {wrong} of {cells} decks give results that are neither right nor refused."
    return (
        "Extreme numbers give right results, to the bounds below, or are refused with the line of the deck: "
        f"{cells} of {cells} decks."
    )
