"""Extension keywords: unloading against the loading law, and decks for Flexcom."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.contact.input import LawKind
from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.keywords.catalogue import is_extension
from mudline.linting.rule import LintContext, rule
from mudline.scene.deck_values import number
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats

EXT008 = Code("EXT008", "soft-unloading", Severity.WARNING)
SBD018 = Code("SBD018", "extension-keyword", Severity.ERROR)
_KEYWORD = "SEABED UNLOADING"


@rule(EXT008)
def soft_unloading(context: LintContext) -> Iterator[Problem]:
    """The unloading stiffness is below the steepest slope of the loading law.

    Soil unloads at least as stiffly as it was loaded: with a softer return path a cycle would give energy back, and the
    trench would lie above the seabed. The stiffness is raised to the slope reached. Give a higher one.

    Example:
         $MODEL
         *NODE
          1, -0.05, 0.0
          5, -0.05, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
         *SEABED UNLOADING
          SET=ALL
        - STIFFNESS=20000.0
        + STIFFNESS=500000.0

    Finds: 15:12
    """
    scene = context.scene
    extension = scene.extensions.get(_KEYWORD)
    if extension is None:
        return
    steepest = np.where(scene.nodal, np.nan, _steepest(scene))
    for index, (entry, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
        stiffness = number(entry, "stiffness")
        softer = np.flatnonzero((extension.of_element == index) & (steepest > stiffness))
        if stiffness > 0.0 and softer.size:
            message = (
                f"unloading stiffness {stiffness!r} is below the steepest slope of the loading law of "
                f"{softer.size} elements (first: {scene.element_ids[softer[0]]}), "
                f"{float(steepest[softer].max()):.6g}: it is raised to that; give at least as much"
            )
            yield Problem(EXT008, message, where=where._replace(path=(*where.path, "stiffness")))


def _steepest(scene: Scene) -> Floats:
    """Steepest slope of each element's law below the mudline, per unit of penetration; NaN where it is not known."""
    linear = np.array([*(np.nan if grant.unknown else grant.stiffness for grant in scene.laws.set_laws), np.nan])
    slopes = np.array([*(_curve_slope(scene, grant.curve) for grant in scene.laws.set_laws), np.nan])
    found = scene.laws.of_element
    with np.errstate(over="ignore"):
        steep: Floats = np.where(scene.law == LawKind.LINEAR, linear[found], slopes[found] / scene.diameter)
    return steep


def _curve_slope(scene: Scene, index: int) -> float:
    curve = scene.laws.curves[index].curve if index >= 0 else None
    if curve is None:
        return float("nan")
    ratios = scene.laws.curves[index].points[:, 0]
    return float(curve.evaluate(np.append(ratios[ratios > 0.0], 0.0))[1].max())


@rule(SBD018)
def extension_keyword(context: LintContext) -> Iterator[Problem]:
    """An extension keyword is used in a deck for Flexcom.

    The keyword belongs to mudline alone: Flexcom does not know it and will not run the deck. It is reported only where
    the deck is checked for that dialect. Remove it, or keep a copy of the deck for Flexcom.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        -*SEABED SUCTION
        - SET=ALL
        - COHESION=5000.0
        + SUCTION=8000.0, 0.15

    Finds: 6:1
    Dialect: flexcom
    """
    if context.dialect != "flexcom":
        return
    for i, section in enumerate(context.deck.sections):
        for j, block in enumerate(section.blocks):
            if is_extension(block.keyword):
                message = f"*{block.keyword} is an extension that Flexcom does not know: remove it for that program"
                yield Problem(SBD018, message, where=Where(i, j))
