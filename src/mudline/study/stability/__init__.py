"""How stable a deck's contacts are under time steps, Newton's method, suction that lets go, and extreme numbers."""

from __future__ import annotations

from mudline.scene.model import Scene
from mudline.study.report import StudyOptions, StudyReport
from mudline.study.sample import sample_scene
from mudline.study.stability.whole import study_scene

__all__ = ["run"]


def run(scene: Scene | None, options: StudyOptions) -> StudyReport:
    """Study the contacts of a scene, of the built-in sample where there is none; raises DeckError."""
    return study_scene(sample_scene() if scene is None else scene, options)
