"""Error against work and run time: curve evaluation, time integration of contact, smoothing."""

from __future__ import annotations

import numpy as np

from mudline.scene.model import Scene
from mudline.study.precision.contacts import all_cases, contacts_of
from mudline.study.precision.curves import study_backbones, study_curves
from mudline.study.precision.goals import study_goals
from mudline.study.precision.integration import study_motions
from mudline.study.precision.smoothing import study_smoothing
from mudline.study.report import Omission, Section, StudyOptions, StudyReport, paragraphs

_NOTES = """
Errors of curves: the largest of 1500 random ratios and the points themselves, against exact rational arithmetic on the
same points, over the largest force. Times: best of repeated evaluations of 100 000 random ratios.

Errors of motions: the largest of 64 runs that reach the seabed at different phases of a step. They are stepped side by
side: a force evaluation is one of one run, Newton's iterations included; a run time is that of all 64. Run times are
medians of five runs, in which all schemes take turns; runs of more than 250 steps (2500 with --full) are timed once.

Newton's method is kept in a bracket, so that a solver that alternates does not look like a scheme that fails. It has
converged where |residual| < 1e-8 in the unit of force, or is no more than 16 times the round-off of its largest term;
where the force jumps and no position balances, the step ends at the jump. A step has failed after 100 iterations.
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
    ladders, motions = study_motions(cases, options)
    sections = (
        curves,
        backbones,
        Section(notes=[*paragraphs(_NOTES), *studied.notes], omissions=omissions),
        motions,
        study_goals(ladders, cases),
        study_smoothing(scene, studied.contacts, options),
    )
    return StudyReport.of("precision", f"Precision: {scene.deck.file}", sections)
