"""The page of the study of stability, from its tables."""

from __future__ import annotations

import math
from pathlib import Path

from mudline.contact.stiffest import ADVISED_OMEGA_DT
from mudline.study.pages import (
    MissingTableError,
    Record,
    Tables,
    filled,
    grouped_digits,
    listed,
    markdown_table,
    percent,
    rounded,
    time,
)
from mudline.study.schemes import SCHEMES
from mudline.study.stability.critical import FAR, GROWTH, STEPS, STEPS_DAMPED
from mudline.study.stability.deck_steps import FARTHEST, advice
from mudline.study.stability.ladder import ladder_part
from mudline.study.stability.landings import FEW_PHASES, NEVER, PHASES, TRIED

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
        return "No contact of this deck has a frequency: laws with a stiffness and sections with a mass are needed."
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
    most = max(one.number("largest at any step [-]") for one in limits.values())
    gentle = _gentle(tables)
    left = listed(f"{share} of the speed with {name}" for name, share in _left(landed, gentle))
    halvings = max(one.number("halvings needed") for one in tables.rows("newton-halvings"))
    stiffest = max(one.number("spring / structure [-]") for one in tables.rows("newton-halvings"))
    gain = percent(landed[newmark].number("largest [-]") - 1.0)
    within = rounded(limits[newmark].number("landings within 1 % [-]"))
    never = listed(f"{name} (at most {value})" for name, value in gentle.items())
    points = (
        """
        The smallest of the steps below counts, with whatever it comes from: rule `STB002` reads the same numbers and
        reports a deck whose step is larger.
        """,
        f"""
        At `omega dt` = {ADVISED_OMEGA_DT:g} a landing with {newmark}'s scheme gains up to {gain} of its speed; one
        percent needs `omega dt` = {within} on a linear seabed, and what the table below says on this deck.
        """,
        """
        Central difference fails above `omega dt` = 2 on springs, RK4 above 2.83; on dampers they fail above `2 m / c`
        and `2.785 m / c`, velocity Verlet above `m / c`. Forward Euler and RK2 grow on every spring without damping.
        """,
        f"""
        "Unconditionally stable" is a property of linear systems. With contact that opens and closes, a pipe rebounds
        up to {rounded(most)} times as fast as it landed.
        """,
        f"""
        Of the implicit schemes tried only {never} never land with more than {NEVER:g} of their speed gained.
        They pay for it with damping: at `omega dt` = {ADVISED_OMEGA_DT:g} a landing leaves {left}.
        """,
        f"""
        Let a solver keep a bracket around the root where friction or suction has a limit. Plain Newton cycles where
        `kt / kb > 1 / (1 - F / (mu N))`; halved corrections need `log2(kt / kb) - 1` halvings, {halvings:.0f} for
        `kt / kb` = {grouped_digits(stiffest)}.
        """,
        _ladder_in_short(tables),
    )
    return "\n".join(f"* {' '.join(point.split())}" for point in points)


def _left(landed: dict[str, Record], gentle: dict[str, str]) -> list[tuple[str, str]]:
    return [(name, percent(landed[name].number("mean [-]"))) for name in gentle if name in landed]


def _gentle(tables: Tables) -> dict[str, str]:
    """Implicit schemes that gain no more than `NEVER` in any landing, and their largest speed after over before."""
    found = {}
    for one in tables.rows("landing-limits"):
        name = one.text("scheme")
        values = [row.number("largest [-]") for row in tables.rows("landings", scheme=name)]
        most = max([one.number("largest at any step [-]"), *(value for value in values if not math.isnan(value))])
        if math.isnan(one.number("critical omega dt [-]")) and most <= 1.0 + NEVER:
            found[name] = f"{most:.5f}"
    return found


def _contacts(tables: Tables) -> str:
    rows = tables.rows("contacts")
    if not rows:
        return "No contact of this deck has a frequency."
    stiffness, mass, damping = (_heading(rows[0], start) for start in ("largest stiffness", "mass", "damping ["))
    headings = (
        "contact",
        "deck line",
        "node",
        f"k {_unit(stiffness)}",
        f"c {_unit(damping)}",
        f"m {_unit(mass)}",
        "omega [rad/s]",
        f"omega dt = {ADVISED_OMEGA_DT:g} at [s]",
        "central difference below [s]",
        "Verlet below [s]",
        "RK4 below [s]",
    )
    cells = [
        (
            one.text("contact"),
            one.text("deck line"),
            one.text("node"),
            _number(one, stiffness),
            _number(one, damping),
            rounded(one.number(mass), 4),
            _number(one, "omega [rad/s]"),
            _number(one, "advised step, implicit [s]"),
            *(_number(one, f"critical step, {name} [s]") for name in ("central-difference", "velocity-verlet", "rk4")),
        )
        for one in rows[:_MOST_ROWS]
    ]
    more = len(rows) - len(cells)
    return markdown_table(headings, cells) + (f"\n\n{more} more are in the CSV file." if more > 0 else "")


def _heading(row: Record, start: str) -> str:
    return next(heading for heading in row.cells if heading.startswith(start))


def _unit(heading: str) -> str:
    return heading[heading.index("[") :]


def _number(row: Record, heading: str, digits: int = 3) -> str:
    value = row.number(heading)
    return "-" if math.isnan(value) or value == 0.0 else rounded(value, digits)


def _measured(tables: Tables) -> str:
    rows = tables.rows("critical-steps")
    good = sum(one.text("as predicted") == "yes" for one in rows)
    ratios = [
        one.number("measured [s]") / one.number("predicted [s]") for one in rows if one.number("predicted [s]") > 0.0
    ]
    off = max((abs(ratio - 1.0) for ratio in ratios if not math.isnan(ratio)), default=math.nan)
    return (
        f"{good} of {len(rows)} runs did as predicted: bounded at 0.99 of the critical step, growing at 1.01; the step "
        f"at which growth begins is within {percent(max(off, 0.0025))} of the predicted one. Implicit schemes stayed "
        f"bounded at `omega dt` = {FAR:g}, the linear half of the truth."
    )


def _deck_steps(tables: Tables) -> str:
    rows = tables.rows("deck-steps")
    headings = (
        "scheme",
        "critical step [s]",
        "set by",
        "deck line",
        "landings below 1.01 up to [s]",
        "landings within 1 % up to [s]",
        "landing on",
    )
    cells = [
        (
            one.text("scheme"),
            _critical(one),
            one.text("set by"),
            one.text("deck line"),
            _number(one, "landings below 1.01 [s]"),
            _number(one, "landings within 1 % [s]"),
            one.text("landing on"),
        )
        for one in rows
    ]
    return markdown_table(headings, cells) if cells else "No step follows from this deck."


def _critical(row: Record) -> str:
    step = row.number("critical step [s]")
    return "no limit" if math.isnan(step) else "grows at any" if step == 0.0 else rounded(step, 3)


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
        f"{rounded(row.number('from ratio [-]'))} to {rounded(row.number('to ratio [-]'))} (deck line "
        f"{row.text('deck line')}), {grouped_digits(row.number(stiffness))} {_unit(stiffness)[1:-1]}. The secant "
        f"without the point in line {row.text('point to remove, deck line')} has "
        f"{grouped_digits(row.number(without))}, and with it "
        f"`omega dt` = {ADVISED_OMEGA_DT:g} is at {rounded(row.number('advised step without it [s]'), 3)} s instead of "
        f"{rounded(row.number('advised step [s]'), 3)} s; the force changes by {rounded(row.number(change), 3)} "
        f"{_unit(change)[1:-1]} at most. Look at whether that segment is what you mean."
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
    columns = ("critical omega dt [-]", "landings below 1.01 [-]", "landings within 1 % [-]")
    cells = [
        (
            one.text("scheme"),
            *(_number(one, column) for column in columns),
            f"{one.number('least at any step [-]'):.4f}",
            f"{one.number('largest at any step [-]'):.5f}",
        )
        for one in tables.rows("landing-limits")
    ]
    headings = (
        "scheme",
        "critical",
        "below 1.01 up to",
        "within 1 % up to",
        "least at any step",
        "largest at any step",
    )
    return markdown_table(headings, cells)


def _never(tables: Tables) -> str:
    gentle = _gentle(tables)
    return (
        f"{listed(gentle)} never gain more than {NEVER:g} of the speed of a landing at any step tried, from "
        f"`omega dt` = {TRIED[0]:g} to {TRIED[-1]:g}."
    )


def _newton(tables: Tables) -> dict[str, str]:
    """What is said about Newton's method."""
    ratio, share = "spring / structure [-]", "force / limit [-]"
    rows = [one for one in tables.rows("newton-cycles") if one.number(share) < 1.0]
    headings = (
        "kt / kb",
        "F / mu N",
        "cycles above kt / kb",
        "lost, plain",
        "lost, halved at most ten times",
        "lost, bracketed",
        "most iterations, bracketed",
    )
    cycles = [
        (
            grouped_digits(one.number(ratio)),
            one.text(share),
            rounded(one.number("cycles above spring / structure [-]"), 3),
            one.text("lost: plain"),
            one.text("lost: halved corrections"),
            one.text("lost: bracketed"),
            one.text("most iterations, bracketed"),
        )
        for one in rows
    ]
    halved = tables.rows("newton-halvings")
    caps = [heading for heading in halved[0].cells if heading.startswith("lost:")]
    halvings = [
        (
            grouped_digits(one.number(ratio)),
            one.text(share),
            *(one.text(cap) for cap in caps),
            one.text("halvings needed"),
            one.text("none lost from a cap of"),
        )
        for one in halved
    ]
    names = [cap.removeprefix("lost: ") for cap in caps]
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
        f"With {numbers} the guesses are {plain} and so on; with corrections that are halved until the residual falls "
        f"they are {cured}: the root."
    )
    return {
        "starts": rows[0].text("starts"),
        "example": example,
        "cycles": markdown_table(headings, cycles),
        "halvings": markdown_table(("kt / kb", "F / mu N", *names, "suffice", "none lost from"), halvings),
    }


def _release(tables: Tables) -> str:
    rows = tables.rows("release")
    if not rows:
        return "No element of this deck has `*SEABED SUCTION`."
    velocity, force, depth, needed = (
        _heading(rows[0], start) for start in ("velocity", "largest suction", "breakout", "needed stiffness")
    )
    counts = [heading for heading in rows[0].cells if heading.startswith("equilibria")]
    cells = [
        (
            one.text("element"),
            *(rounded(one.number(heading), 3) for heading in (velocity, force, depth, needed)),
            *(one.text(heading) for heading in counts),
        )
        for one in rows[:_MOST_ROWS]
    ]
    table = markdown_table(("element", velocity, force, depth, needed, *counts), cells)
    return f"On the laws of this deck:\n\n{table}"


def _ladder_in_short(tables: Tables) -> str:
    rows = tables.rows("ladder")
    cells, wrong = (int(sum(one.number(heading) for one in rows)) for heading in ("cells", "anything else"))
    if wrong:
        return f"Extreme numbers: {wrong} of {cells} decks give results that are neither right nor refused."
    return (
        "Extreme numbers give right results, to the bounds below, or are refused with the line of the deck: "
        f"{cells} of {cells} decks."
    )
