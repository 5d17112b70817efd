"""Curves that laws name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from mudline.contact.input import LawKind
from mudline.deck.parameters import folded
from mudline.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.keywords.kept import Names
from mudline.keywords.remarks import advice_on
from mudline.keywords.text import shown
from mudline.scene.checks.declaring import check
from mudline.scene.laws import NOTHING
from mudline.scene.references import given_names

if TYPE_CHECKING:
    from mudline.scene.model import Scene

REF002 = Code("REF002", "undefined-curve", Severity.ERROR)


@check(REF002)
def undefined_curve(scene: Scene) -> Iterator[Problem]:
    """A STIFFNESS= names a curve that the deck does not define.

    The elements of the set have no seabed then. A STIFFNESS= that is no number is taken for the name of a curve, so a
    slip in a number is reported here too. Define the curve in *SEABED STIFFNESS, or correct the name.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Soft Clay
          0.0, 0.0
          0.1, 1200.0
          0.5, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
        - STIFFNESS=Softclay
        + STIFFNESS=Soft Clay

    Finds: 10:12
    """
    names = {folded(curve.name): curve.name for curve in scene.laws.curves if curve.named and not curve.embedment}
    followed: set[Where] | None = None
    for _, where, name in given_names(scene.deck, Names.CURVE):
        if folded(name) in names:
            continue
        near = scene.context.near(name, names)
        hint = f" (did you mean {names[near]}?)" if near else ""
        advice = advice_on(name) or "*SEABED STIFFNESS has no such curve"
        problem = scene.context.missing(
            REF002, f"curve {shown(name)} is not defined{hint}: {advice}", where, "SEABED STIFFNESS"
        )
        followed = _followed(scene) if followed is None else followed
        yield replace(problem, blocks=Blocks.ALWAYS) if where in followed else problem


def _followed(scene: Scene) -> set[Where]:
    """Where the names of missing curves stand that elements follow."""
    lost = (i for i, grant in enumerate(scene.laws.grants) if grant.kind is LawKind.CURVE and grant.curve == NOTHING)
    return {scene.laws.grants[index].where for index in lost if (scene.laws.of_element == index).any()}
