"""Error against work and run time: curve evaluation, time integration of contact, smoothing."""

from __future__ import annotations

from mudline.scene.model import Scene
from mudline.study.precision.contacts import all_cases, contacts_of
from mudline.study.precision.curves import study_backbones, study_curves
from mudline.study.precision.goals import motion_pictures, study_goals
from mudline.study.precision.integration import REPEATS, RUNS, study_motions
from mudline.study.precision.page import advice, page
from mudline.study.precision.smoothing import study_smoothing
from mudline.study.report import Omission, Section, StudyOptions, paragraphs
from mudline.study.running import Part, Study
from mudline.study.schemes import BRACKETED

_NOTES = f"""
Errors of curves: the largest of 1500 random ratios and the points themselves, against exact rational arithmetic on the
same points, over the largest force. Times: best of repeated evaluations of 100 000 random ratios.

Errors of motions: the largest of {RUNS} runs that reach the seabed at different phases of a step. They are stepped
side by side: a force evaluation is one of one run, Newton's iterations included; a run time is the processor time of
all of them. Run times are medians of {REPEATS} runs, in which all schemes take turns; long runs are timed once.

Newton's method is kept in a bracket, so that a solver that alternates does not look like a scheme that fails. It has
converged where |residual| < 1e-8 in the unit of force, or is no more than 16 times the round-off of its largest term;
where the force jumps and no position balances, the step ends at the jump. A step has failed after {BRACKETED.most}
iterations.
"""


def _motions(scene: Scene, options: StudyOptions) -> Section:
    """What the deck has to fall on, pull off and drag along, and every scheme on it."""
    studied = contacts_of(scene)
    omissions: list[Omission] = []
    cases = all_cases(studied, omissions)
    ladders, measured = study_motions(cases, options)
    return Section(
        [*study_goals(ladders, cases), *measured.tables],
        list(motion_pictures(ladders, cases)),
        [*paragraphs(_NOTES), *studied.notes],
        [*omissions, *measured.omissions],
    )


STUDY = Study(
    "precision",
    "Precision: {deck}",
    (
        Part("curves", study_curves, 2.0),
        Part("backbones", study_backbones, 0.5),
        Part("motions", _motions, 25.0),
        Part("smoothing", study_smoothing, 1.0),
    ),
    page,
    advice,
    order=("curves", "backbones", "cases", "advice", "goals", "orders", "steps"),
)
run = STUDY.run
