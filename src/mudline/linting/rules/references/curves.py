"""Curves and the places that name them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.contact.input import LawKind
from mudline.deck.parameters import folded
from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.references.removal import removals
from mudline.syntax.rows import read_number

if TYPE_CHECKING:
    from mudline.deck.model import Deck
    from mudline.keywords.library.seabed_properties import SeabedProperties
    from mudline.keywords.library.variation import Variation
    from mudline.scene.force_curves import SceneCurve

REF003 = Code("REF003", "unused-curve", Severity.WARNING)
REF004 = Code("REF004", "duplicate-curve", Severity.WARNING)


@rule(REF003)
def unused_curve(context: LintContext) -> Iterator[Problem]:
    """No STIFFNESS= uses the curve.

    It was measured or calculated for something, so perhaps the elements that it was meant for follow another law. Name
    it in a STIFFNESS= of *SEABED PROPERTIES, or remove it. Nothing is said of a deck whose STIFFNESS= is an equation:
    its parameters choose the curve; nor of a curve whose name reads as a number, which SBD017 tells.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Soft Clay
          0.0, 0.0
          0.1, 1200.0
        - CURVE=Backfill
        - 0.0, 0.0
        - 0.1, 300.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Soft Clay

    Finds: 6:8
    """
    if _chosen_elsewhere(context):
        return
    scene = context.scene
    names = {folded(curve.name) for curve in scene.laws.curves if not curve.embedment}
    unknown = scene.laws.referenced - names
    unused: dict[str, list[SceneCurve]] = {}
    for curve in scene.laws.curves:
        name = folded(curve.name)
        if curve.embedment or not curve.named or name in scene.laws.referenced:
            continue
        if read_number(name) is not None:  # a STIFFNESS= may mean it, which SBD017 tells
            continue
        if name in unused:
            unused[name].append(curve)
        elif not scene.context.near(name, unknown):  # else it is misspelt where it is used, which has been told
            unused[name] = [curve]
    places = [curve.where for curves in unused.values() for curve in curves]
    repairs = removals(context.text, places) if context.text else {}
    for curve, *_ in unused.values():
        message = f"curve {shown(curve.name)} is not used: name it in a STIFFNESS=, or remove it"
        yield Problem(REF003, message, where=curve.title, repair=repairs.get(curve.where))


def _chosen_elsewhere(context: LintContext) -> bool:
    """Whether something that is not read, or not fixed, may use curves."""
    scene = context.scene
    own = zip(
        _stiffnesses(context.deck), _stiffnesses(scene.deck), strict=False
    )  # a continued deck has more behind them
    if any(written is not value for written, value in own):
        return True  # an equation, whose parameters may be varied
    if any(grant.kind is LawKind.NONE and grant.unknown for grant in scene.laws.set_laws):
        return True  # a set whose STIFFNESS= could not be read
    if scene.context.misplaced("SEABED PROPERTIES") or (scene.context.restart and not scene.laws.referenced):
        return True
    return any(
        folded(" ".join(varied.keyword or [])) == "seabed properties"  # None in a line that could not be read
        for _, block in scene.deck.blocks("VARIATION", "PREPROCESSOR")
        for variation in cast("Variation", block).variations
        for varied in variation.blocks
        if varied.action == "ADD"
    )


def _stiffnesses(deck: Deck) -> Iterator[object]:
    for _, block in deck.blocks("SEABED PROPERTIES"):
        for entry in cast("SeabedProperties", block).sets:
            yield entry.stiffness


@rule(REF004)
def duplicate_curve(context: LintContext) -> Iterator[Problem]:
    """Two curves have one name, or one set has two curves in *EMBEDMENT.

    The later one is taken (inferred: the language does not say what happens), so the points of the earlier one count
    for nothing. Case does not count in names. Choose another name, or remove one of the curves.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
          0.1, 1200.0
        - CURVE=CLAY
        - 0.0, 0.0
        - 0.1, 2500.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 6:8
    """
    known: set[tuple[bool, str]] = set()
    for curve in context.scene.laws.curves:
        key = (curve.embedment, folded(curve.name))
        if key in known and curve.named:
            what = "set {} has a curve already" if curve.embedment else "there is a curve {} already"
            what = what.format(shown(curve.name))
            message = f"{what}: the later one is taken (inferred); keep one of them"
            yield Problem(REF004, message, where=curve.title)
        known.add(key)
