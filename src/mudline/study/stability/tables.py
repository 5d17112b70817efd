"""The tables of the stability study."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.contact.stiffest import ADVISED_OMEGA_DT, CRITICAL_OMEGA_DT
from mudline.study.report import Cell, Column, StudyTable
from mudline.study.stability.bounded import ALWAYS, FAR, Measured
from mudline.study.stability.contacts import Contact
from mudline.study.stability.cycles import Cycling
from mudline.study.stability.ladder.verdict import Judgement, Verdict
from mudline.study.stability.landings import Landing
from mudline.study.stability.release import SHARES, Release

_UNITS = {"metric": ("N", "m", "kg"), "imperial": ("lbf", "ft", "slug")}


def contacts_table(contacts: Sequence[Contact], units: str) -> StudyTable:
    """Frequencies, and the steps that go with them."""
    force, length, mass = _UNITS.get(units, ("force", "length", "mass"))
    explicit = ("central-difference", "rk4")
    columns = (
        Column("contact"),
        Column("elements"),
        Column("largest stiffness", f"{force}/{length}2"),
        Column("mass", f"{mass}/{length}"),
        Column("omega", "rad/s"),
        Column("advised step, implicit", "s"),
        *(Column(f"critical step, {name}", "s") for name in explicit),
    )
    rows: list[tuple[Cell, ...]] = [
        (
            *(one.name, one.elements, one.stiffness, one.mass, one.omega, ADVISED_OMEGA_DT / one.omega),
            *(CRITICAL_OMEGA_DT[name] / one.omega for name in explicit),
        )
        for one in contacts
    ]
    return StudyTable("contacts", "Frequencies of the contacts, the fastest first", columns, rows)


def critical_table(measured: Sequence[Measured]) -> StudyTable:
    """Predicted and measured critical steps."""
    columns = (
        Column("contact"),
        Column("scheme"),
        Column("predicted", "s"),
        Column("measured", "s"),
        Column("at 0.99"),
        Column("at 1.01"),
        Column("as predicted"),
    )
    rows: list[tuple[Cell, ...]] = [
        (
            *(one.contact.name, one.scheme.title, one.predicted, one.measured, one.below, one.above),
            "yes" if one.as_predicted else "NO",
        )
        for one in measured
    ]
    title = f"Critical steps (none: tried at omega dt = {FAR:g}; 0: tried at {ALWAYS:g})"
    return StudyTable("critical-steps", title, columns, rows)


def landings_table(landings: Sequence[Landing]) -> StudyTable:
    """Restitution, with the figures to compare with."""
    columns = (
        Column("scheme"),
        Column("omega dt", "-"),
        *(Column(name, "-") for name in ("least", "mean", "largest")),
        Column("compared with"),
        Column("agrees"),
    )
    words = {None: "", True: "yes", False: "NO"}
    rows = [
        (
            *(one.scheme.title, one.omega_dt, one.least, one.mean, one.largest),
            "/".join(one.compared or ()),
            words[one.agrees],
        )
        for one in landings
    ]
    return StudyTable("landings", "Speed after landing over speed before, 400 landing phases", columns, rows)


def cycles_table(cyclings: Sequence[Cycling]) -> StudyTable:
    """Newton's method on friction, plain and with a line search."""
    columns = (
        Column("spring / structure", "-"),
        Column("force / limit", "-"),
        Column("starts"),
        Column("lost: plain"),
        Column("lost: halved corrections"),
        Column("lost: bracketed"),
        Column("most iterations, bracketed"),
    )
    return StudyTable(
        "newton-cycles", "Newton's method on friction that slips", columns, [tuple(one) for one in cyclings]
    )


def release_table(releases: Sequence[Release], units: str) -> StudyTable:
    """What suction asks of a structure when it lets go."""
    force, length, _ = _UNITS.get(units, ("force", "length", "mass"))
    columns = (
        Column("element"),
        Column("velocity", f"{length}/s"),
        Column("largest suction", f"{force}/{length}"),
        Column("breakout", length),
        Column("needed stiffness", f"{force}/{length}2"),
        *(Column(f"equilibria at {share:g} of it") for share in SHARES),
    )
    rows = [(*one[:5], *one.equilibria) for one in releases]
    return StudyTable("release", "Structural stiffness for one equilibrium while suction lets go", columns, rows)


def summary_table(judgements: Sequence[Judgement]) -> StudyTable:
    """The ladder, family by family."""
    columns = (
        Column("family"),
        Column("cells"),
        Column("right"),
        Column("refused beyond"),
        Column("refused"),
        Column("anything else"),
        Column("numbers compared"),
        Column("largest error", "2^-53"),
        Column("bound", "2^-53"),
    )
    return StudyTable(
        "ladder", "Ladder of extremes, by family", columns, [_summed(part) for part in _families(judgements)]
    )


def cells_table(judgements: Sequence[Judgement]) -> StudyTable:
    """The ladder, cell by cell."""
    columns = (
        *(Column(name) for name in ("family", "value", "verdict", "numbers compared")),
        Column("largest error", "2^-53"),
        Column("bound", "2^-53"),
        Column("told"),
    )
    rows = [
        (one.family, one.value, one.verdict.value, one.results, one.error, one.bound, one.told) for one in judgements
    ]
    return StudyTable("ladder-cells", "Ladder of extremes, cell by cell", columns, rows, brief=False)


def _families(judgements: Sequence[Judgement]) -> list[list[Judgement]]:
    families: dict[str, list[Judgement]] = {}
    for one in judgements:
        families.setdefault(one.family, []).append(one)
    return list(families.values())


def _summed(part: Sequence[Judgement]) -> tuple[str | int | float, ...]:
    counts = [
        sum(one.verdict is verdict for one in part) for verdict in (Verdict.RIGHT, Verdict.UP_TO, Verdict.REFUSED)
    ]
    other = len(part) - sum(counts)
    results, error = sum(one.results for one in part), max(one.error for one in part)
    return part[0].family, len(part), *counts, other, results, error, max(one.bound for one in part)
