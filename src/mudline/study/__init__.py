"""Studies of the numbers: how exact, how stable and how costly they are, on a deck of the user's or a built-in one.

Each study is a package with `run(scene, options)`, which returns a `StudyReport`; scipy, mpmath and matplotlib are
needed by some of them and come with the extra `mudline[study]`. The built-in deck is here: a short riser end on a clay
with suction and friction, all values made up for this purpose.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mudline.contact.input import LawKind
from mudline.deck.loading import load_bytes
from mudline.diagnostics import Where
from mudline.scene.model import Scene, resolve

SAMPLE_NAME = "built-in-sample.keyxm"

SAMPLE_TEXT = """\
C A pipe of 0.3 m on soft clay, part of it on a linear seabed. Synthetic values. Metre, kilogram, second, newton.
$MODEL
*OCEAN
 1000.0, 1025.0, 9.81
*NODE
  1, -0.010,   0.0, 0.0
 11, -0.010,  20.0, 0.0
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
*ELEMENT SETS
 SET=Clay
 GEN=1, 7
 SET=Sand
 GEN=8, 10
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3, 0.25, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Clay
 STIFFNESS=Soft Clay
 FRICTION=0.35, 0.60, 0.003, 0.150
 SET=Sand
 STIFFNESS=50.0E3
 FRICTION=0.50, 0.70, 0.003, 0.150
*SEABED STIFFNESS
 CURVE=Soft Clay
 0.00,    0.0
 0.01,  450.0
 0.02,  640.0
 0.05, 1030.0
 0.10, 1480.0
 0.20, 1800.0
 0.50, 2450.0
*SEABED CONTACT
 SET=Sand
 SMOOTHING=AUTO
*SEABED SUCTION
 SET=Clay
 COHESION=5.0E3
$LOAD CASE
*ANALYSIS TYPE
 TYPE=STATIC
"""


def scene_of(text: str, name: str) -> Scene:
    """The scene of a deck; raises DeckError."""
    return resolve(load_bytes(text.encode(), name)).require()


def file_of(scene: Scene, where: Where | None) -> str:
    """Name of the file of a place that a deck continues (*RESTART); "" for a place in the deck itself."""
    base = scene.deck.base_of(where)
    return Path(base[0].file).name if base else ""


def without_springs(scene: Scene) -> str:
    """Why no contact of a scene has a spring and a mass, as a clause."""
    if not np.isin(scene.law, (LawKind.NONE, LawKind.RIGID)).all():
        return "no law has a stiffness" if (scene.mass_per_length > 0.0).any() else "no section has a mass"
    return "the seabed is rigid" if (scene.law == LawKind.RIGID).any() else "no element has a seabed law"


def sample_scene() -> Scene:
    """The scene of the built-in deck."""
    return scene_of(SAMPLE_TEXT, SAMPLE_NAME)
