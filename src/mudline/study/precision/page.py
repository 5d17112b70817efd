"""The page of the precision study, and its one sentence about the deck: all numbers are those of the tables."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from pathlib import Path

from mudline.study.pages import (
    DOWN,
    UP,
    Columns,
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
    span,
    table_of,
    time,
)
from mudline.study.precision.curves import BEYOND_ERROR, FORCE_ERROR, LINE_ERROR, PCHIP_ERROR
from mudline.study.precision.goals import ACCURACY, ORDER_STEPS, QUARTILE, STEP, TIME, WORK
from mudline.study.precision.integration import ADVISED_GOALS, COMPARED, LADDER, PARTS
from mudline.study.precision.smoothing import PUBLISHED, WIDTHS
from mudline.study.report import grouped
from mudline.study.running import RUN_TIME
from mudline.study.schemes import SCHEMES

_EXPLICIT = {scheme.title for scheme in SCHEMES.values() if scheme.explicit}
_DEPTH_ERROR, _DEEPEST = "error of penetration [relative]", "h / deepest penetration"
_ITERATIONS = "Newton iterations per step"
_LIES = 1e-6
"""Below this error the penetration is that without smoothing."""
_FLOATING = WIDTHS[3]
_GOALS = tuple(f"{goal:g}" for goal in ADVISED_GOALS)
"""As the headings of the table of goals have them."""
_ERRORS = (
    "error of penetration, suction or way [relative]",
    "error of speed [relative]",
    "error of energy or work [relative]",
)
_BRACKETED = "steps that needed the bracket"
_VERLET, _NEWMARK, _RK4 = (SCHEMES[name].title for name in COMPARED)
_COMPARED = ("newmark", "hht-0.3", "generalised-alpha-0.5", "generalised-alpha-0", "backward-euler")
_COMPARED_STEP = 0.1
_RESOLUTION = max(b / a for a, b in pairwise(LADDER)) ** (1.0 / PARTS) - 1.0
"""How much larger than the largest step for a goal the next one tried may be."""
_DECK_STEPS = (
    "On all laws of this deck together, the least work first; the step of an explicit scheme is also below the "
    "critical step of every contact, which [stability](stability.md) lists:"
)
_WRONG = 0.1
"""Results with larger errors are useless."""
_KINDS = {
    "grew without bound": "the motion grows without bound",
    "left a residual": "Newton's method does not converge",
    "it would take": "it would take too many steps",
}


def advice(tables: Tables) -> str:
    """Return which scheme and which step the deck needs, because of which line; "" where it has nothing to step on."""
    parts: list[str] = []
    causes: list[str] = []
    others: dict[tuple[str, str, str], list[str]] = {}
    for goal, tried in grouped(tables.rows("advice"), lambda row: row.text("goal [relative]")).items():
        reached = [row for row in tried if row.text("step [s]")]
        causes.append(_cause(tables, (reached or tried)[0]))
        because = f", because of {causes[-1]}" if causes[-1] not in causes[:-1] else ""
        if not reached:
            parts.append(f"for errors of {percent(float(goal))} no step of the ladder is small enough{because}")
            continue
        explicit = reached[0].text("scheme") in _EXPLICIT
        for row in [row for row in reached if (row.text("scheme") in _EXPLICIT) != explicit][:1]:
            key = "implicit" if explicit else "explicit", _use(row), _cause(tables, row)
            others.setdefault(key, []).append(percent(float(goal)))
        parts.append(f"for errors of {percent(float(goal))} use {_use(reached[0])}{because}")
    if not parts:
        return ""
    sentences = [f"On this deck, {'; '.join(parts)}."]
    for (kind, use, cause), goals in others.items():
        own = "" if cause in causes else f", because of {cause}"
        sentences.append(f"The best {kind} scheme for {' and '.join(goals)} is {use}{own}.")
    return " ".join(sentences)


def _use(row: Record) -> str:
    return f"{row.text('scheme')} with a step of {_step(row)}"


def _step(row: Record) -> str:
    """A step with three digits that are not above it."""
    return time(row.number("step [s]"), 3, DOWN)


def _cause(tables: Tables, row: Record) -> str:
    """The motion or the contact that sets a step, with its line."""
    name = row.text("set by")
    if row.text("limited by") == ACCURACY:
        name = f"the mass {tables.row('cases', case=name).text('what')}"
    return f"{name} ({row.place()})"


def page(tables: Tables) -> str:
    """The page in Markdown; raises MissingTableError where a part was not run."""
    machine = {row.text("what"): row.text("value") for row in tables.rows("machine")}
    fields = {
        "command": command_of("precision", machine["deck"]),
        "advice": advice(tables) or "The deck has no normal law with a stiffness: only the published case was run.",
        "deck": f"`{machine['deck']}`",
        "run_time": time(float(machine[RUN_TIME])),
        "processor": machine["processor"],
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
        entries, worse = grouped_digits(_entries(table)), rounded(table.number(FORCE_ERROR))
        slower = table.number("best time [ns/point]") / own.number("best time [ns/point]")
        found.append(
            f"Curves are evaluated exactly to {rounded(own.number(FORCE_ERROR), rounding=UP)} of the largest force. "
            f"An even table of {entries} entries is off by {worse} and takes {rounded(slower)} times as long."
        )
    ten = tables.rows("backbones", points="10")
    if ten:
        off = {
            kind: [_linear(row) for row in ten if row.text("points at distances") == kind]
            for kind in ("even", "graded")
        }
        found.append(
            f"Sample a published curve with points that crowd towards the mudline: ten graded points are within "
            f"{percent(max(off['graded']), rounding=UP)}, ten even ones are off by {_percents(off['even'])}."
        )
    for goal in _GOALS:
        steps = [row for row in tables.rows("goals", scheme="velocity Verlet") if row.text(STEP.format(goal))]
        if steps:
            found.append(
                f"For {percent(float(goal))} velocity Verlet needs omega dt = "
                f"{span((row.number(STEP.format(goal)) for row in steps), rounding=DOWN)}, "
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
    return row.number(LINE_ERROR)


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
        "smooth": _percents(row.number(PCHIP_ERROR) for row in most),
    }


def _curves(tables: Tables) -> str:
    curves = _of_first_curve(tables)
    if not curves:
        return "The deck has no curve."
    columns: Columns = {
        "method": "method",
        "largest error": lambda row: rounded(row.number(FORCE_ERROR)),
        "beyond the last point": lambda row: rounded(row.number(BEYOND_ERROR)),
        "time per point": lambda row: f"{rounded(row.number('best time [ns/point]'))} ns",
    }
    held, smooth, last = curves["np.interp"], curves["scipy PCHIP"], _largest_table(curves)
    name = next(iter(curves.values())).text("curve")
    return "\n\n".join(
        [
            "![Error of curve evaluation against time per point](precision-curves.png)",
            f"{name}:",
            table_of(curves.values(), columns),
            "What follows from it:",
            bullets(
                [
                    (
                        "`np.interp` keeps the last force beyond the points: within a tenth of their range it is up to "
                        f"{percent(held.number(BEYOND_ERROR), rounding=UP)} off. A curve of a deck continues its last "
                        "segment."
                    ),
                    (
                        f"PCHIP is another curve: it rounds the corners that the deck gives, and is off by "
                        f"{percent(smooth.number(FORCE_ERROR))} here."
                    ),
                    (
                        "An even table misses the corners of the curve between its entries; with "
                        f"{grouped_digits(_entries(last))} of them it is off by {rounded(last.number(FORCE_ERROR))}."
                    ),
                    "mudline's times include the slope and the checks; those of the others are for the force alone.",
                ]
            ),
        ]
    )


# -------------------------------------------------------------------------------------------------------------- motions


def motion_fields(tables: Tables) -> dict[str, str]:
    """Return the fields of the page about the motions."""
    cases = tables.rows("cases")
    names = [case.text("case") for case in cases]
    has_pull = any(not name.startswith("drop") for name in names)
    return {
        "cases": _cases(cases),
        "runs": cases[0].text("runs side by side"),
        "bracket": _bracket(tables, int(cases[0].text("runs side by side"))),
        "pull_drag_picture": "![Which step a scheme needs in pull and drag](precision-pull-drag.png)"
        if has_pull
        else "",
        "goals": _by_scheme(tables, names, _needed),
        "findings": "\n\n".join([*_advice_table(tables), "What follows from it:", bullets(_findings(tables))]),
        "goal_names": ", then for ".join(percent(goal) for goal in ADVISED_GOALS),
        "compared": listed((_VERLET, _NEWMARK, _RK4)),
        "closer": str(PARTS),
        "resolution": percent(_RESOLUTION, rounding=UP),
        "order_steps": f"{ORDER_STEPS:g} and below",
        "orders": _by_scheme(tables, names, lambda row: rounded(row.number("order"))),
        "failures": _failures(tables),
        "repeats": str(max(int(row.text("repeats")) for row in tables.rows("steps"))),
        "run_time_ratio": _run_time_ratio(tables),
    }


def _cases(cases: Sequence[Record]) -> str:
    return table_of(
        cases,
        {
            "motion": "case",
            "what": "what",
            "deck line": line_cell,
            "omega": lambda case: f"{rounded(case.number('omega [1/s]'), 3)}/s",
            "duration": lambda case: time(case.number("duration [s]"), 3),
            "exact outcome": "reference",
        },
    )


def _by_scheme(tables: Tables, cases: Sequence[str], cell: Callable[[Record], str]) -> str:
    """A line for each scheme, a column for each motion; schemes with the same cells share a line."""
    by_scheme = grouped(tables.rows("goals"), lambda row: row.text("scheme"))
    lines = {scheme: tuple(cell(row) for row in rows) for scheme, rows in by_scheme.items()}
    alike = grouped(lines, lambda scheme: lines[scheme])
    return markdown_table(("scheme", *cases), [(", ".join(schemes), *cells) for cells, schemes in alike.items()])


def _needed(row: Record) -> str:
    found = []
    for goal in _GOALS:
        step, work = row.number(STEP.format(goal)), row.number(WORK.format(goal))
        found.append(f"{rounded(step, 2, DOWN)} ({rounded(work, 3)})" if step > 0.0 else "none")
    return "; ".join(found)


def _advice_table(tables: Tables) -> list[str]:
    rows = [row for row in tables.rows("advice") if row.text("step [s]")]
    columns: Columns = {
        "all errors up to": lambda row: percent(row.number("goal [relative]")),
        "scheme": "scheme",
        "step": _step,
        "set by": "set by",
        "deck line": line_cell,
        "force evaluations per simulated second": lambda row: rounded(row.number("force evaluations [1/s]"), 3),
    }
    return [_DECK_STEPS, table_of(rows, columns)] if rows else []


def _findings(tables: Tables) -> list[str]:
    found = [
        f"For {percent(float(goal))}, {words} the force evaluations of {_VERLET}, each at its largest step."
        for goal in _GOALS
        if (words := _times(tables, WORK.format(goal)))
    ]
    near = [row for row in tables.rows("steps") if abs(row.number("omega dt") / _COMPARED_STEP - 1.0) < 1e-2]
    drops = grouped((row for row in near if row.text("case").startswith("drop")), lambda row: row.text("scheme"))
    speeds = {name: [row.number(_ERRORS[1]) for row in drops.get(name, ())] for name in _COMPARED}
    if all(speeds.values()):
        damped = [max(errors) for name, errors in speeds.items() if name != "newmark"]
        words = "**Damping does not help an impact.** " if max(speeds["newmark"]) <= min(damped) else ""
        each = listed(f"{SCHEMES[name].title} {_percents(errors)}" for name, errors in speeds.items())
        found.append(f"{words}Error of the rebound speed at omega dt = {_COMPARED_STEP:g}: {each}.")
    pulls = {row.text("scheme"): row.number(_ERRORS[1]) for row in near if row.text("case") == "pull"}
    if pulls:
        behind, ahead = (percent(pulls[name]) for name in ("central-difference", "velocity-verlet"))
        found.append(
            f"In the pull, at omega dt = {_COMPARED_STEP:g}, the central difference is off by {behind} in the speed, "
            f"velocity Verlet by {ahead}. The force of the central difference sees the velocity half a step ago."
        )
        found.append(_stable(tables))
    return found


def _times(tables: Tables, heading: str, needs: str = "") -> str:
    """What other schemes take over what velocity Verlet takes; "" where no motion tells."""
    ratios = {name: _ratios(tables, name, heading, needs) for name in (_NEWMARK, _RK4)}
    first, *others = [f"{name} {{}}{span(values)} times" for name, values in ratios.items() if values] or [""]
    return listed([first.format("takes "), *(other.format("") for other in others)]) if first else ""


def _ratios(tables: Tables, scheme: str, heading: str, needs: str = "") -> list[float]:
    """What a scheme takes over what velocity Verlet takes, on the motions on which both reach the goal."""
    found = []
    for row in tables.rows("goals", scheme=scheme):
        other = tables.row("goals", scheme=_VERLET, case=row.text("case"))
        if all(one.text(heading) and (not needs or one.text(needs)) for one in (row, other)):
            found.append(row.number(heading) / other.number(heading))
    return found


def _stable(tables: Tables) -> str:
    pulls = tables.rows("steps", case="pull")
    largest = max(row.number("omega dt") for row in pulls)
    tried = [row for row in pulls if row.number("omega dt") == largest]
    errors = [row.number(_ERRORS[0]) for row in tried if row.text("failed runs") == "0"]
    words = "**Stable is not right.** " if errors and min(errors) > _WRONG else ""
    return (
        f"{words}At omega dt = {largest:g}, {len(errors)} of {len(tried)} schemes finish the pull; their errors of the "
        f"largest suction: {_percents(errors)}."
    )


def _bracket(tables: Tables, runs: int) -> str:
    rows = [row for row in tables.rows("steps") if row.number("Newton iterations per step") > 0.0]
    needed = [row for row in rows if row.number(_BRACKETED) > 0.0]
    if not needed:
        return "No step needed that here."
    share = sum(row.number(_BRACKETED) for row in needed) / sum(runs * row.number("steps") for row in rows)
    least = min(row.number("omega dt") for row in needed)
    where = listed(dict.fromkeys(row.text("case") for row in needed))
    return f"That happened in {percent(share)} of the implicit steps, from omega dt = {least:g} on, in {where}."


def _failures(tables: Tables) -> str:
    failed = grouped(
        (row for row in tables.rows("steps") if row.text("reason")), lambda row: (_kind(row), row.text("case"))
    )
    if not failed:
        return "Nothing failed."
    rows = []
    for (kind, case), found in failed.items():
        by_scheme = grouped(found, lambda row: row.text("scheme"))
        least = {SCHEMES[name].title: min(row.number("omega dt") for row in some) for name, some in by_scheme.items()}
        alike = grouped(least, least.__getitem__)
        words = "; ".join(f"{step:g}: {', '.join(titles)}" for step, titles in sorted(alike.items()))
        rows.append((case, words, kind))
    return markdown_table(("motion", "smallest omega dt that failed", "why"), sorted(rows))


def _kind(row: Record) -> str:
    words = row.text("reason")
    return next((kind for part, kind in _KINDS.items() if part in words), words.partition("runs: ")[2] or words)


def _run_time_ratio(tables: Tables) -> str:
    goal = _GOALS[0]
    words = _times(tables, TIME.format(goal), QUARTILE.format(goal))
    return f"For {percent(float(goal))}, {words} the run time of {_VERLET}." if words else ""


# ----------------------------------------------------------------------------------------------------------- smoothing


def _smoothing_fields(tables: Tables) -> dict[str, str]:
    rest = sorted(tables.rows("smoothing", case=PUBLISHED.name), key=_share)
    width, depth = (_heading(rest[0], words) for words in ("half width h", "penetration"))
    unit = width.partition("[")[2].removesuffix("]")
    shown = [row for row in rest if any(math.isclose(_share(row), h / PUBLISHED.kinked) for h in WIDTHS)]
    rows = [(rounded(row.number(width)), _tries(row), rounded(row.number(depth), 5)) for row in shown]
    exact = [row for row in rest if row.number(_DEPTH_ERROR) < _LIES]
    floating = next(row for row in rest if math.isclose(_share(row), _FLOATING / PUBLISHED.kinked))
    hits = tables.rows("impacts", scheme="newmark", **{"omega dt": "0.5"})
    hits = [min(hits, key=lambda row: abs(row.number(_DEEPEST) - share)) for share in (0.0, 0.1, 0.316)]
    more = [percent(row.number(_ITERATIONS) / hits[0].number(_ITERATIONS) - 1.0) for row in hits]
    off = [percent(row.number("error of rebound speed [relative]")) for row in hits]
    return {
        "smoothing": markdown_table((f"h [{unit}]", "iterations from above / below", f"penetration [{unit}]"), rows),
        "kinked": _tries(rest[0]),
        "widest": _tries(rest[-1]),
        "safe": percent(_share(exact[-1]), rounding=DOWN),
        "safe_error": rounded(max(row.number(_DEPTH_ERROR) for row in exact), rounding=UP),
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


def _tries(row: Record) -> str:
    return f"{row.text('iterations from above')} / {row.text('iterations from below')}"
