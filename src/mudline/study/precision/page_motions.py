"""What the page of the precision study says about the motions: steps, orders, failures, work."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from mudline.study.pages import Record, Tables, listed, markdown_table, percent, rounded, span, time
from mudline.study.precision.goals import ADVISED_GOALS, ORDER_STEPS
from mudline.study.report import grouped
from mudline.study.schemes import SCHEMES

GOALS = tuple(f"{goal:g}" for goal in ADVISED_GOALS)
"""As the headings of the table of goals have them."""
STEP, WORK = "omega dt for {}", "force evaluations per period for {} [-]"
_TIME = "run time for {} [s/s]"
_QUARTILE = "lower quartile of run time for {} [s/s]"
_ERRORS = (
    "error of penetration, suction or way [relative]",
    "error of speed [relative]",
    "error of energy or work [relative]",
)
_BRACKETED = "steps that needed the bracket"
_VERLET, _NEWMARK, _RK4 = (SCHEMES[name].title for name in ("velocity-verlet", "newmark", "rk4"))
_COMPARED = ("newmark", "hht-0.3", "generalised-alpha-0.5", "generalised-alpha-0", "backward-euler")
_COMPARED_STEP = 0.1
_WRONG = 0.1
"""An error from which on a result is of no use."""
_KINDS = {
    "grew without bound": "the motion grows without bound",
    "left a residual": "Newton's method does not converge",
    "it would take": "it would take too many steps",
}


def bullets(sentences: Iterable[str]) -> str:
    """A list."""
    return "\n".join(f"* {sentence}" for sentence in sentences)


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
        "order_steps": f"{ORDER_STEPS:g} and below",
        "orders": _by_scheme(tables, names, lambda row: rounded(row.number("order"))),
        "failures": _failures(tables),
        "repeats": str(max(int(row.text("repeats")) for row in tables.rows("steps"))),
        "run_time_ratio": _run_time_ratio(tables),
    }


def _cases(cases: Sequence[Record]) -> str:
    headings = ("motion", "what", "deck line", "omega", "duration", "exact outcome")
    return markdown_table(
        headings,
        [
            (
                case.text("case"),
                case.text("what"),
                case.text("deck line"),
                f"{rounded(case.number('omega [1/s]'), 3)}/s",
                time(case.number("duration [s]"), 3),
                case.text("reference"),
            )
            for case in cases
        ],
    )


def _by_scheme(tables: Tables, cases: Sequence[str], cell: Callable[[Record], str]) -> str:
    """A line for each scheme, a column for each motion; schemes that are alike in all of them share a line."""
    by_scheme = grouped(tables.rows("goals"), lambda row: row.text("scheme"))
    lines = {scheme: tuple(cell(row) for row in rows) for scheme, rows in by_scheme.items()}
    alike = grouped(lines, lambda scheme: lines[scheme])
    return markdown_table(("scheme", *cases), [(", ".join(schemes), *cells) for cells, schemes in alike.items()])


def _needed(row: Record) -> str:
    found = []
    for goal in GOALS:
        step, work = row.number(STEP.format(goal)), row.number(WORK.format(goal))
        found.append(f"{rounded(step)} ({rounded(work, 3)})" if step > 0.0 else "none")
    return "; ".join(found)


def _advice_table(tables: Tables) -> list[str]:
    rows = [row for row in tables.rows("advice") if row.text("step [s]")]
    if not rows:
        return []
    headings = ("all errors up to", "scheme", "step", "set by", "deck line", "force evaluations per simulated second")
    cells = [
        (
            percent(row.number("goal [relative]")),
            row.text("scheme"),
            time(row.number("step [s]"), 3),
            row.text("set by"),
            row.text("deck line"),
            rounded(row.number("force evaluations [1/s]"), 3),
        )
        for row in rows
    ]
    return ["On all laws of this deck together, the least work first:", markdown_table(headings, cells)]


def _findings(tables: Tables) -> list[str]:
    found = [
        f"For {percent(float(goal))}, {words} the force evaluations of {_VERLET}, each at its step of the ladder."
        for goal in GOALS
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


def _percents(shares: Iterable[float]) -> str:
    return span((100.0 * share for share in shares), unit="%")


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
    goal = GOALS[0]
    words = _times(tables, _TIME.format(goal), _QUARTILE.format(goal))
    return f"For {percent(float(goal))}, {words} the run time of {_VERLET}." if words else ""
