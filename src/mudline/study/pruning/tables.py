"""The rows of the study as tables."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.study.pruning.cost import CostRow, CurveRow
from mudline.study.pruning.growth import Fit, GrowthRow
from mudline.study.pruning.imports import ImportRow
from mudline.study.pruning.variants import CURVE
from mudline.study.report import Cell, Column, StudyTable


def curve_table(rows: Sequence[CurveRow]) -> StudyTable:
    """What a scene with a curve pays beyond the curve."""
    columns = (
        Column("nodes"),
        Column("curve alone", "ns/node"),
        Column("plain numpy", "ns/node"),
        Column("scene", "ns/node"),
        Column("scene / curve alone"),
        Column("scene / plain numpy"),
    )
    cells = [(*row, row.over_curve, row.over_bare) for row in rows]
    return StudyTable("curve", "A scene with nothing but a curve, one step, every element in contact", columns, cells)


def stage_table(rows: Sequence[CostRow]) -> StudyTable:
    """Every scene at the largest number of nodes."""
    most = max(row.nodes for row in rows)
    largest = [row for row in rows if row.nodes == most]
    plain = next(row.nanoseconds for row in largest if row.scene == CURVE)
    columns = (
        Column("scene"),
        Column("steps"),
        Column("in contact", "%"),
        Column("time", "ns/node/step"),
        Column("times the curve's"),
        Column("memory", "bytes/node"),
        Column("to prepare", "ns/node"),
    )
    cells: list[tuple[Cell, ...]] = [
        (
            row.scene,
            "one by one" if row.history else "together",
            100.0 * row.touching,
            row.nanoseconds,
            row.nanoseconds / plain,
            row.peak,
            row.prepare,
        )
        for row in largest
    ]
    return StudyTable("stages", f"Scenes of {most} nodes", columns, cells)


def cost_table(rows: Sequence[CostRow]) -> StudyTable:
    """Every scene at every number of nodes."""
    columns = (
        Column("scene"),
        Column("nodes"),
        Column("best time", "ns/node/step"),
        Column("median time", "ns/node/step"),
        Column("share in contact"),
        Column("memory", "bytes/node"),
        Column("to prepare", "ns/node"),
        Column("history"),
    )
    return StudyTable("nodes", "Time and memory against the number of nodes", columns, rows, brief=False)


def import_table(rows: Sequence[ImportRow]) -> StudyTable:
    """What scenes load."""
    columns = (
        Column("scene"),
        Column("time", "ms"),
        Column("modules of mudline"),
        Column("other modules"),
        Column("beyond those of the curve"),
    )
    cells = [
        (row.scene, 1e3 * row.seconds, row.modules, row.others, ", ".join(dict.fromkeys(map(_room, row.beyond))))
        for row in rows
    ]
    return StudyTable("imports", "What a scene loads, in a fresh interpreter", columns, cells)


def fit_table(fits: Sequence[Fit]) -> StudyTable:
    """Exponents."""
    columns = (
        Column("number of"),
        Column("from"),
        Column("to"),
        Column("exponent"),
        Column("exponent, upper half"),
        Column("time, largest / smallest"),
        Column("time of one more", "us"),
    )
    cells = [(*fit[:-1], 1e6 * fit.unit) for fit in fits]
    return StudyTable("growth", "How time grows", columns, cells)


def growth_table(rows: Sequence[GrowthRow]) -> StudyTable:
    """The measured points."""
    columns = (Column("number of"), Column("size"), Column("best time", "s"))
    return StudyTable("sizes", "Time against size", columns, rows, brief=False)


def module_table(rows: Sequence[ImportRow]) -> StudyTable:
    """The names of what scenes load."""
    columns = (Column("scene"), Column("module beyond those of the curve"))
    cells = [(row.scene, module) for row in rows for module in row.beyond]
    return StudyTable("modules", "Modules that a scene loads beyond those of a curve", columns, cells, brief=False)


def _room(module: str) -> str:
    """The name of a law, else of the package that a module is of."""
    return module.removeprefix("laws.").partition(".")[0]
