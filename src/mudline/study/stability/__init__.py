"""How stable a deck's contacts are under time steps, Newton's method, the release of suction, and extreme numbers."""

from __future__ import annotations

from mudline.scene.model import Scene
from mudline.study.report import StudyOptions, StudyReport
from mudline.study.stability.critical import study_steps
from mudline.study.stability.ladder import study_ladder
from mudline.study.stability.landings import study_landings
from mudline.study.stability.statics import study_cycles, study_release


def run(scene: Scene, options: StudyOptions) -> StudyReport:
    """Study the contacts of a scene; raises DeckError."""
    sections = (
        study_steps(scene, options),
        study_landings(options),
        study_cycles(),
        study_release(scene, options),
        study_ladder(options),
    )
    return StudyReport.of("stability", f"Stability of the contacts of {scene.deck.file}", sections)
