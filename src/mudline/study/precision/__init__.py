"""Error against run time: curve evaluation, time integration of contact, smoothing."""

from __future__ import annotations

import numpy as np

from mudline.scene.model import Scene
from mudline.study.precision.backbones import study_backbones
from mudline.study.precision.cases import all_cases, contacts_of
from mudline.study.precision.curves import study_curves
from mudline.study.precision.integration import study_motions
from mudline.study.precision.smoothing import study_smoothing
from mudline.study.report import Omission, Section, StudyOptions, StudyReport, paragraphs

__all__ = ["run"]

_NOTES = """
Errors of curves: the largest of 1500 random ratios and the points themselves, against exact rational arithmetic on the
same points, over the largest force. Times: best of repeated evaluations of 100 000 random ratios.

Errors of motions: the largest of eight runs that reach the seabed at different phases of a step; they are stepped side
by side, and their run time is that of all eight.

Newton's method has converged where |residual| < 1e-8 in the unit of force, or is no more than 16 times the round-off
of its largest term; a step has failed after 50 iterations.
"""


@np.errstate(all="ignore")  # what overflows is not finite, and that is a failure with its reason
def run(scene: Scene, options: StudyOptions) -> StudyReport:
    """Study the curves and the stiffest laws of a scene.

    Raises DeckError where the scene cannot be evaluated, and ImportError without scipy.
    """
    studied = contacts_of(scene)
    curves, backbones = study_curves(scene, options), study_backbones(options)
    omissions: list[Omission] = []
    cases = all_cases(studied, omissions)
    sections = (
        curves,
        backbones,
        Section(notes=[*paragraphs(_NOTES), *studied.notes], omissions=omissions),
        study_motions(cases, options),
        study_smoothing(scene, studied.contacts, options),
    )
    return StudyReport.of("precision", f"Precision: {scene.deck.file}", sections)
