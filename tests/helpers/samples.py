"""The sample decks, and the little arithmetic that their tests hold them against."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple, cast

from mudline.language.deck.loading import load_path
from mudline.language.deck.model import Deck
from mudline.language.keywords.library.geometric_sets import FlexibleSection, GeometricSets, RigidSection
from mudline.language.keywords.library.ocean import Ocean
from mudline.model.contact import ContactResult
from mudline.model.scene.model import Scene, resolve

SAMPLES = Path(__file__).parents[2] / "samples"
FAULTY = ("broken.keyxm", "scr-vessel-bad.keyxm")
"""The samples that are illegal."""


class Evaluated(NamedTuple):
    """A sample's scene and its contact."""

    scene: Scene
    result: ContactResult


def sample(name: str) -> Deck:
    return load_path(SAMPLES / name, name)


def evaluated(deck: Deck) -> Evaluated:
    scene = resolve(deck).require()
    return Evaluated(scene, scene.contact().evaluate())


def submerged_weight(scene: Scene) -> float:
    """Weight per unit length in water of the first section, from the deck's own numbers."""
    _, ocean = next(scene.deck.blocks("OCEAN"))
    _, sections = next(scene.deck.blocks("GEOMETRIC SETS"))
    water = cast("Ocean", ocean)
    section = cast("GeometricSets", sections).sets[0].section
    density, gravity = cast("float", water.density), cast("float", water.gravity)
    if isinstance(section, FlexibleSection):
        mass, outer = cast("float", section.mass), cast("float", section.db)
    else:
        assert isinstance(section, RigidSection)
        outer, inner = cast("float", section.do), cast("float", section.di)
        mass = cast("float", section.density) * math.pi / 4 * (outer**2 - inner**2)
    return (mass - density * math.pi / 4 * outer**2) * gravity


def penetration(ratio: float, diameter: float, strength: float, gradient: float) -> float:
    """Force per unit length of undrained penetration (DNV-RP-F114, model 2, without its buoyancy term)."""
    factor: float = min(6 * ratio**0.25, 3.4 * math.sqrt(10 * ratio))
    return factor * (strength + gradient * ratio * diameter) * diameter
