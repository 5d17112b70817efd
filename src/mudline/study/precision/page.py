"""The page of the precision study, and its one sentence about the deck: all numbers are those of the tables."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path

from mudline.contact.stiffest import rounded_down
from mudline.study.pages import (
    Record,
    Tables,
    filled,
    grouped_digits,
    markdown_table,
    percent,
    rounded,
    span,
    time,
)
from mudline.study.precision.page_motions import GOALS, STEP, WORK, bullets, motion_fields
from mudline.study.precision.smoothing import PUBLISHED, WIDTHS
from mudline.study.report import grouped
from mudline.study.running import RUN_TIME
from mudline.study.schemes import SCHEMES

_EXPLICIT = {scheme.title for scheme in SCHEMES.values() if scheme.explicit}
_FORCE_ERROR = "error [of largest force]"
_BEYOND = "error beyond the points [of largest force]"
_DEPTH_ERROR, _DEEPEST = "error of penetration [relative]", "h / deepest penetration"
_ITERATIONS = "Newton iterations per step"
_LIES = 1e-6
"""Below this error a pipe lies where it lay."""
_FLOATING = WIDTHS[3]


_STABILITY = (
    "Explicit schemes also have to keep below the critical step of every contact, suction damping included, "
    "which can be much smaller: `mudline study stability`."
)


def advice(tables: Tables) -> str:
    """Return which scheme and which step the deck needs, because of which line; "" where it has nothing to step on."""
    parts: list[str] = []
    causes: list[str] = []
    for goal, tried in grouped(tables.rows("advice"), lambda row: row.text("goal [relative]")).items():
        reached = [row for row in tried if row.text("step [s]")]
        causes.append(_cause(tables, (reached or tried)[0]))
        because = f", because of {causes[-1]}" if causes[-1] not in causes[:-1] else ""
        if not reached:
            parts.append(f"for errors of {percent(float(goal))} no step of the ladder is small enough{because}")
            continue
        explicit = reached[0].text("scheme") in _EXPLICIT
        other = [_use(row) for row in reached if (row.text("scheme") in _EXPLICIT) != explicit][:1]
        besides = f" ({'implicit' if explicit else 'explicit'}: {other[0]})" if other else ""
        parts.append(f"for errors of {percent(float(goal))} use {_use(reached[0])}{besides}{because}")
    return f"On this deck, {'; '.join(parts)}. {_STABILITY}" if parts else ""


def _use(row: Record) -> str:
    return f"{row.text('scheme')} with a step of {_step(row.number('step [s]'))}"


def _step(seconds: float) -> str:
    """A step with three digits that are not above it."""
    return time(rounded_down(seconds), 3)


def _cause(tables: Tables, row: Record) -> str:
    case = tables.row("cases", case=row.text("set by"))
    return f"the mass {case.text('what')} (deck line {row.text('deck line')})"


def page(tables: Tables) -> str:
    """Fill the page."""
    fields = {
        "advice": advice(tables) or "The deck has no law to fall on: only the published case was run.",
        "deck": f"`{tables.row('machine', what='deck').text('value')}`",
        "run_time": time(tables.row("machine", what=RUN_TIME).number("value")),
        "processor": tables.row("machine", what="processor").text("value"),
        "in_short": bullets(_in_short(tables)),
        **_curve_fields(tables),
        **motion_fields(tables),
        **_smoothing_fields(tables),
    }
    return filled(Path(__file__).with_name("page.md"), fields)


def _in_short(tables: Tables) -> list[str]:
    found = []
    curves = _of_first_curve(tables)
    if curves:
        own, table = curves["mudline, numpy"], _largest_table(curves)
        entries, worse = grouped_digits(_entries(table)), rounded(table.number(_FORCE_ERROR))
        slower = table.number("best time [ns/point]") / own.number("best time [ns/point]")
        found.append(
            f"The evaluator of curves is exact to {rounded(own.number(_FORCE_ERROR))} of the largest force. An even "
            f"table of {entries} entries is off by {worse} and takes {rounded(slower)} times as long."
        )
    ten = tables.rows("backbones", points="10")
    if ten:
        off = {
            kind: [_linear(row) for row in ten if row.text("points at distances") == kind]
            for kind in ("even", "graded")
        }
        found.append(
            f"Sample a published curve with points that crowd towards the mudline: ten graded points are within "
            f"{percent(max(off['graded']))}, ten even ones are off by {_percents(off['even'])}."
        )
    for goal in GOALS:
        steps = [row for row in tables.rows("goals", scheme="velocity Verlet") if row.text(STEP.format(goal))]
        if steps:
            found.append(
                f"For {percent(float(goal))} velocity Verlet needs omega dt = "
                f"{span(row.number(STEP.format(goal)) for row in steps)}, "
                f"{span((row.number(WORK.format(goal)) for row in steps), 3)} force evaluations per period."
            )
    found.append("Leave SMOOTHING=AUTO: it moves nothing at rest. A wide zone lifts the pipe off the seabed.")
    return found


# -------------------------------------------------------------------------------------------------------------- curves


def _of_first_curve(tables: Tables) -> dict[str, Record]:
    rows = tables.rows("curves")
    return {row.text("method"): row for row in rows if row.text("curve") == rows[0].text("curve")}


def _largest_table(curves: dict[str, Record]) -> Record:
    return max((row for name, row in curves.items() if name.startswith("table of ")), key=_entries)


def _entries(row: Record) -> int:
    return int(row.text("method").removeprefix("table of "))


def _linear(row: Record) -> float:
    return row.number("error of straight lines [of largest force]")


def _percents(shares: Iterable[float]) -> str:
    return span((100.0 * share for share in shares), unit="%")


def _curve_fields(tables: Tables) -> dict[str, str]:
    even, graded = (tables.rows("backbones", **{"points at distances": kind}) for kind in ("even", "graded"))
    shown = ("5", "10", "100", even[-1].text("points"))
    rows = [
        (one.text("backbone"), one.text("points"), percent(_linear(one)), percent(_linear(other)))
        for one, other in zip(even, graded, strict=True)
        if one.text("points") in shown
    ]
    most = [row for row in graded if row.text("points") == even[-1].text("points")]
    return {
        "curves": _curves(tables),
        "backbones": "\n".join(f"| {' | '.join(row)} |" for row in rows),
        "most_points": most[0].text("points"),
        "smooth": _percents(row.number("error of PCHIP [of largest force]") for row in most),
    }


def _curves(tables: Tables) -> str:
    curves = _of_first_curve(tables)
    if not curves:
        return "The deck has no curve."
    headings = ("method", "largest error", "beyond the last point", "time per point")
    cells = [
        (
            name,
            rounded(row.number(_FORCE_ERROR)),
            rounded(row.number(_BEYOND)),
            f"{rounded(row.number('best time [ns/point]'))} ns",
        )
        for name, row in curves.items()
    ]
    held, smooth, last = curves["np.interp"], curves["scipy PCHIP"], _largest_table(curves)
    name = next(iter(curves.values())).text("curve")
    return "\n\n".join(
        [
            "![Error of curve evaluation against time per point](precision-curves.png)",
            f"{name}:",
            markdown_table(headings, cells),
            "What follows from it:",
            bullets(
                [
                    (
                        "`np.interp` holds the last force beyond the points: within a tenth of their range it is up to "
                        f"{percent(held.number(_BEYOND))} off. The deck's language continues the last segment."
                    ),
                    (
                        f"PCHIP is another curve: it rounds the corners that the deck gives, and is off by "
                        f"{percent(smooth.number(_FORCE_ERROR))} here."
                    ),
                    (
                        "An even table misses the corners of the curve between its entries; with "
                        f"{grouped_digits(_entries(last))} of them it is off by {rounded(last.number(_FORCE_ERROR))}."
                    ),
                    "mudline's times include the slope and the checks; those of the others are for the force alone.",
                ]
            ),
        ]
    )


# ----------------------------------------------------------------------------------------------------------- smoothing


def _smoothing_fields(tables: Tables) -> dict[str, str]:
    rest = sorted(tables.rows("smoothing", case=PUBLISHED.name), key=_share)
    width, depth = (_heading(rest[0], words) for words in ("half width h", "penetration"))
    unit = width.partition("[")[2].removesuffix("]")
    shown = [row for row in rest if any(_alike(_share(row), h / PUBLISHED.kinked) for h in WIDTHS)]
    rows = [(rounded(row.number(width)), _tries(row), rounded(row.number(depth), 5)) for row in shown]
    exact = [row for row in rest if row.number(_DEPTH_ERROR) < _LIES]
    floating = next(row for row in rest if _alike(_share(row), _FLOATING / PUBLISHED.kinked))
    hits = tables.rows("impacts", scheme="newmark", **{"omega dt": "0.5"})
    hits = [min(hits, key=lambda row: abs(row.number(_DEEPEST) - share)) for share in (0.0, 0.1, 0.316)]
    more = [percent(row.number(_ITERATIONS) / hits[0].number(_ITERATIONS) - 1.0) for row in hits]
    off = [percent(row.number("error of rebound speed [relative]")) for row in hits]
    return {
        "smoothing": markdown_table((f"h [{unit}]", "iterations from above / below", f"penetration [{unit}]"), rows),
        "kinked": _tries(rest[0]),
        "widest": _tries(rest[-1]),
        "safe": percent(_share(exact[-1])),
        "safe_error": rounded(max(row.number(_DEPTH_ERROR) for row in exact)),
        "floating": f"{rounded(floating.number(width))} {unit}",
        "height": f"{rounded(-floating.number(depth))} {unit}",
        "impact_step": hits[0].text("omega dt"),
        "kinked_rebound": off[0],
        "tenth_rebound": off[1],
        "third_rebound": off[2],
        "tenth": rounded(hits[1].number(_DEEPEST)),
        "third": rounded(hits[2].number(_DEEPEST)),
        "tenth_more": more[1],
        "third_more": more[2],
    }


def _heading(row: Record, words: str) -> str:
    return next(heading for heading in row.cells if heading.startswith(f"{words} ["))


def _share(row: Record) -> float:
    return row.number("h / static penetration")


def _alike(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=1e-6)


def _tries(row: Record) -> str:
    return f"{row.text('iterations from above')} / {row.text('iterations from below')}"
