"""The study from the scene to its report."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mudline.results.units import unit_names
from mudline.scene.model import Scene
from mudline.study.precision.cases import all_cases, reference_drop
from mudline.study.precision.curves import CurveRow, evaluate_methods, sampled_backbones
from mudline.study.precision.integration import FINE_LADDER, LADDER, StepRow, integrate
from mudline.study.precision.pictures import backbone_picture, curve_picture, step_pictures
from mudline.study.precision.seabed import Seabed, seabed_of
from mudline.study.precision.smoothing import PUBLISHED, SHARES, WIDTHS, Rest, RestRow, at_rest, impacts, weightless
from mudline.study.precision.smoothing_picture import smoothing_picture
from mudline.study.precision.tables import (
    backbone_table,
    case_table,
    curve_table,
    goal_table,
    impact_table,
    rest_table,
    step_table,
)
from mudline.study.report import Omission, StudyOptions, StudyReport

_MOST_CURVES = 2
_NOTES = (
    """Errors of curves: the largest of 1500 random ratios and the points themselves, against exact rational arithmetic
    on the same points, over the largest force. Times: best of repeated evaluations of 100 000 random ratios.""",
    """Errors of motions: the largest of eight runs that meet the bed at different phases of a step; they are stepped
    side by side, and their run time is that of all eight.""",
    """Newton's method has converged where |residual| < 1e-8 in the unit of force, or is no more than 16 times the
    round-off of its largest term; a step has failed after 50 iterations.""",
)


def run(scene: Scene, options: StudyOptions) -> StudyReport:
    """Study the curves and the stiffest laws of a scene.

    Raises DeckError where the scene cannot be evaluated, and ImportError without scipy.
    """
    with np.errstate(all="ignore"):  # what overflows is not finite, and that is a failure with its reason
        return _studied(scene, options)


def _studied(scene: Scene, options: StudyOptions) -> StudyReport:
    omissions: list[Omission] = []
    seabed = seabed_of(scene)
    notes = [*(" ".join(note.split()) for note in _NOTES), *seabed.notes]
    curves = _curves(scene, options, omissions)
    options.progress("closed-form curves")
    backbones = list(sampled_backbones())
    cases = all_cases(scene, seabed, omissions, notes)
    steps: list[StepRow] = []
    for case in cases:
        options.progress(f"time integration: {case.title}")
        steps += integrate([case], FINE_LADDER if options.full else LADDER)
    omissions += _failures(steps)
    options.progress("smoothing")
    rest = _rest(seabed)
    hits = list(impacts(weightless(reference_drop())))
    length = unit_names(scene.units).length
    pictures = [
        *([curve_picture(curves)] if curves else []),
        backbone_picture(backbones),
        *step_pictures(steps, cases),
        smoothing_picture(rest, hits),
    ]
    tables = (
        curve_table(curves),
        backbone_table(backbones),
        case_table(cases),
        goal_table(steps),
        step_table(steps),
        rest_table(rest, length),
        impact_table(hits, "m"),
    )
    title = f"Precision: {scene.deck.file}"
    return StudyReport("precision", title, tables, tuple(pictures), tuple(dict.fromkeys(notes)), tuple(omissions))


def _curves(scene: Scene, options: StudyOptions, omissions: list[Omission]) -> list[CurveRow]:
    named = list(scene.curves.items())
    most = len(named) if options.full else _MOST_CURVES
    omissions += [Omission(f"curve {name}", f"only {most} curves are shown without --full") for name, _ in named[most:]]
    rows: list[CurveRow] = []
    for name, curve in named[:most]:
        options.progress(f"curve {name}")
        rows += evaluate_methods(name, curve, options, omissions)
    return rows


def _failures(rows: Iterable[StepRow]) -> list[Omission]:
    """One for each scheme on each case, with the steps at which it failed."""
    found: dict[tuple[str, str], list[StepRow]] = {}
    for row in rows:
        if row.reason:
            found.setdefault((row.case, row.scheme), []).append(row)
    return [
        Omission(f"{scheme}, {case}, omega dt {', '.join(f'{row.omega_dt:.3g}' for row in failed)}", failed[0].reason)
        for (case, scheme), failed in found.items()
    ]


def _rest(seabed: Seabed) -> list[RestRow]:
    """The published case, and the scene's stiffest law as if it were linear."""
    widths = np.unique([float(f"{width:.4g}") for width in (*WIDTHS, *(share * 1e-5 for share in SHARES))])
    rows = list(at_rest(PUBLISHED, widths))
    for bed in seabed.beds[:1]:
        start = 0.7 * bed.diameter
        rest = Rest(bed.law.name, bed.stiffness, 2e-5 * bed.stiffness, bed.weight, start)
        rows += at_rest(rest, np.array(SHARES) * rest.kinked)
    return rows
