"""Error against work and run time: curve evaluation, time integration of contact, smoothing."""

from __future__ import annotations

from mudline.scene.model import Scene
from mudline.study.pages import listed
from mudline.study.precision.contacts import all_cases, contacts_of
from mudline.study.precision.curves import study_backbones, study_curves
from mudline.study.precision.goals import motion_pictures, study_goals
from mudline.study.precision.integration import ADVISED_GOALS, COMPARED, PARTS, REPEATS, RUNS, study_motions
from mudline.study.precision.page import advice, page
from mudline.study.precision.smoothing import study_smoothing
from mudline.study.report import Omission, Section, StudyOptions, paragraphs
from mudline.study.running import Part, Study
from mudline.study.schemes import BRACKETED, SCHEMES

_COMPARED = listed([SCHEMES[name].title for name in COMPARED])
_SOUGHT = " and ".join(f"{100.0 * goal:g} %" for goal in ADVISED_GOALS)
_NOTES = f"""
Errors of curves: the largest of 1500 random ratios and the points themselves, against exact rational arithmetic on the
same points, over the largest force. Times: best of repeated evaluations of 100 000 random ratios.

Errors of motions: the largest of {RUNS} runs that reach the seabed at different phases of a step. The runs are stepped
side by side: force evaluations are those of one run, Newton's iterations included; a run time is the CPU time of all
runs together. Run times are medians of {REPEATS} repeats, in which all schemes take turns; long runs are timed once.

The largest step for an error of {_SOUGHT} is the last before the first that is too large, of {PARTS} between
two steps of the ladder. For {_COMPARED} the next {PARTS} below it, closer together, meet the goal too: errors do
not always grow with the step.

An advised step is also below the critical step of the scheme on every contact of the deck, damping included.

Newton's method is kept in a bracket, so that iterates that alternate do not count as a failure of the scheme. It has
converged where |residual| < 1e-8 in the unit of force, or is no more than 16 times the round-off of its largest term;
where the force jumps and no position is in equilibrium, the step ends at the jump. A step has failed after
{BRACKETED.most} iterations.
"""


def _motions(scene: Scene, options: StudyOptions) -> Section:
    """Every scheme on the drops, the pull and the drag on the laws of the deck."""
    studied = contacts_of(scene)
    omissions: list[Omission] = []
    cases = all_cases(studied, omissions)
    ladders, measured = study_motions(cases, options)
    return Section(
        [*study_goals(ladders, cases, scene), *measured.tables],
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
        Part("motions", _motions, 45.0),
        Part("smoothing", study_smoothing, 1.0),
    ),
    page,
    advice,
    order=("curves", "backbones", "cases", "advice", "goals", "orders", "steps"),
)
run = STUDY.run
