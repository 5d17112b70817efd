"""The rows of the study as tables."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.study.precision.case import Case
from mudline.study.precision.curves import BackboneRow, CurveRow
from mudline.study.precision.integration import StepRow
from mudline.study.precision.smoothing import ImpactRow, RestRow
from mudline.study.report import Cell, Column, StudyTable
from mudline.study.schemes import SCHEMES

GOALS = (1e-2, 1e-3, 1e-4)
"""Errors for which a step is looked up."""


def curve_table(rows: Sequence[CurveRow]) -> StudyTable:
    """Methods of evaluation."""
    columns = (
        Column("curve"),
        Column("method"),
        Column("error", "of largest force"),
        Column("error beyond the points", "of largest force"),
        Column("best time", "ns/point"),
        Column("median time", "ns/point"),
    )
    cells = [(row.curve, row.method, row.error, row.beyond, row.nanoseconds, row.median) for row in rows]
    return StudyTable("curves", "Curve evaluation against exact rational arithmetic", columns, cells)


def backbone_table(rows: Sequence[BackboneRow]) -> StudyTable:
    """Sampled closed forms."""
    columns = (
        Column("backbone"),
        Column("points at distances"),
        Column("points"),
        Column("error of straight lines", "of largest force"),
        Column("error of PCHIP", "of largest force"),
    )
    return StudyTable("backbones", "Closed forms sampled at points", columns, rows, brief=False)


def case_table(cases: Sequence[Case]) -> StudyTable:
    """What was integrated."""
    columns = (
        Column("case"),
        Column("what"),
        Column("omega", "1/s"),
        Column("duration", "s"),
        Column("reference"),
    )
    cells = [(case.name, case.title, case.omega, case.duration, case.reference) for case in cases]
    return StudyTable("cases", "Motions that are integrated", columns, cells)


def step_table(rows: Sequence[StepRow]) -> StudyTable:
    """Every scheme on every case at every step."""
    columns = (
        Column("case"),
        Column("scheme"),
        Column("omega dt"),
        Column("step", "s"),
        Column("steps"),
        Column("error of penetration, suction or way", "relative"),
        Column("error of speed", "relative"),
        Column("error of energy or work", "relative"),
        Column("run time", "s/s"),
        Column("force evaluations", "1/s"),
        Column("Newton iterations per step"),
        Column("failed runs"),
        Column("reason"),
    )
    cells = [(*row[:5], *row.errors, *row[6:]) for row in rows]
    return StudyTable("steps", "Time integration", columns, cells, brief=False)


def goal_table(rows: Sequence[StepRow]) -> StudyTable:
    """The largest step of the ladder up to which every error stays below a goal."""
    columns = (Column("case"), Column("scheme"), *(Column(f"omega dt for {goal:g}") for goal in GOALS))
    pairs = list(dict.fromkeys((row.case, row.scheme) for row in rows))
    cells: list[tuple[Cell, ...]] = []
    for case, scheme in pairs:
        ladder = sorted((row for row in rows if (row.case, row.scheme) == (case, scheme)), key=lambda row: row.omega_dt)
        cells.append((case, SCHEMES[scheme].title, *(_reached(ladder, goal) for goal in GOALS)))
    return StudyTable("goals", "Largest step with all three errors below a goal", columns, cells)


def _reached(ladder: Sequence[StepRow], goal: float) -> float | None:
    best = None
    for row in ladder:
        if any(error is None or not error <= goal for error in row.errors):
            break
        best = row.omega_dt
    return best


def rest_table(rows: Sequence[RestRow], length: str) -> StudyTable:
    """Smoothing at rest."""
    columns = (
        Column("case"),
        Column("half width h", length),
        Column("h / static penetration"),
        Column("penetration", length),
        Column("error of penetration", "relative"),
        Column("iterations from above"),
        Column("iterations from below"),
    )
    return StudyTable("smoothing", "Smoothing at rest: Newton iterations and error", columns, rows)


def impact_table(rows: Sequence[ImpactRow], length: str) -> StudyTable:
    """Smoothing in motion."""
    columns = (
        Column("scheme"),
        Column("omega dt"),
        Column("half width h", length),
        Column("h / deepest penetration"),
        Column("error of rebound speed", "relative"),
        Column("Newton iterations per step"),
        Column("reason"),
    )
    return StudyTable("impacts", "Smoothing at an impact", columns, rows, brief=False)
