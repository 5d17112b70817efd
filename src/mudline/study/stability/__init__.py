"""How stable a deck's contacts are under time steps, Newton's method, the release of suction, and extreme numbers."""

from __future__ import annotations

from mudline.study.running import Part, Study
from mudline.study.stability.critical import study_steps
from mudline.study.stability.ladder import study_ladder
from mudline.study.stability.landings import study_landings
from mudline.study.stability.statics import study_cycles, study_release

STUDY = Study(
    "stability",
    "Stability of the contacts of {deck}",
    (
        Part("steps", study_steps, 10.0),
        Part("landings", study_landings, 5.0),
        Part("newton", study_cycles),
        Part("release", study_release, 3.0),
        Part("ladder", study_ladder, 10.0),
    ),
)
run = STUDY.run
