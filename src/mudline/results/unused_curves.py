"""Force-embedment curves that no element of a deck follows, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes.contact import REF003, SBD017, SBD025
from mudline.contact import LawKind
from mudline.deck.model import Deck
from mudline.deck.parameters import folded
from mudline.diagnostics import Problem, Where
from mudline.keywords.text import shown
from mudline.scene.resolved import ResolvedDeck
from mudline.syntax.rows import read_number

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_properties import SeabedProperties
    from mudline.scene.force_curves import SceneCurve
    from mudline.scene.laws import SetLaw


def unused_curves(scene: ResolvedDeck) -> Iterator[Problem]:
    """The curves that no element follows, each with the reason; those that no STIFFNESS= names are one problem.

    A curve whose elements are not known, or which a parameter or a variation may choose, is left out.
    """
    laws = scene.laws
    used = set(np.unique(laws.of_element[scene.law == LawKind.CURVE]).tolist())
    by_curve: dict[int, list[SetLaw]] = {}
    followed: set[int] = set()
    for index, grant in enumerate(laws.set_laws):
        by_curve.setdefault(grant.curve, []).append(grant)
        if index in used:
            followed.add(grant.curve)
    unnamed: list[SceneCurve] = []
    for number, curve in enumerate(laws.curves):
        if number in followed or not curve.named:
            continue
        if grants := by_curve.get(number):
            if not any(grant.set_.open for grant in grants):
                yield Problem(
                    SBD025, f"{_called(curve)} has no effect: {_reason(scene, grants[-1])}", where=curve.title
                )
        elif later := _namesake(scene, number):
            message = f"{_called(curve)} has no effect: line {later} has one of the same name; rename it"
            yield Problem(SBD025, message, where=curve.title)
        elif reader := _read_as_number(scene, curve):
            message = f"{_called(curve)} has no effect: STIFFNESS= in line {reader} is a number; rename the curve"
            yield Problem(SBD017, message, where=curve.title)
        else:
            unnamed.append(curve)
    if unnamed and not _chosen_by_values(scene):
        names = ", ".join(shown(curve.name) for curve in unnamed)
        message = (
            f"{len(unnamed)} curves have no effect, as no STIFFNESS= names them: {names}"
            if len(unnamed) > 1
            else f"{_called(unnamed[0])} has no effect: no STIFFNESS= names it"
        )
        yield Problem(REF003, message, where=unnamed[0].title)


def _called(curve: SceneCurve) -> str:
    return f"the curve of *EMBEDMENT for SET={shown(curve.name)}" if curve.embedment else f"curve {shown(curve.name)}"


def _reason(scene: ResolvedDeck, grant: SetLaw) -> str:
    """Why the elements of a set do not follow the curve that a place of the deck gives them."""
    name, elements = f"SET={shown(grant.set_.name)}", grant.set_.elements
    if not elements.size:
        return f"{name} has no element"
    if scene.nodal[elements].all():
        return f"*SEABED CONTACT gives the nodes of {name} a stiffness of their own"
    winners = np.unique(scene.laws.of_element[elements]).tolist()
    lines = sorted({line_of(scene, scene.laws.set_laws[index].where) for index in winners})
    if len(winners) > 1:
        return f"lines {', '.join(map(str, lines))} override it for all elements of {name}"
    winner = scene.laws.set_laws[winners[0]]
    return f"line {lines[0]} gives all elements of {name} {_law(scene, winner)}"


def _law(scene: ResolvedDeck, winner: SetLaw) -> str:
    if winner.kind is LawKind.LINEAR:
        return f"a number, {winner.stiffness:.6g}"
    if winner.kind is LawKind.CURVE:
        return _called(scene.laws.curves[winner.curve])
    return "a rigid seabed" if winner.kind is LawKind.RIGID else "no stiffness"


def _namesake(scene: ResolvedDeck, number: int) -> int:
    """The line of a later curve with the name of this one, which holds in its place; 0 without one."""
    curve, later = scene.laws.curves[number], scene.laws.curves[number + 1 :]
    same = [other for other in later if other.embedment is curve.embedment and folded(other.name) == folded(curve.name)]
    return line_of(scene, same[-1].title) if same else 0


def _read_as_number(scene: ResolvedDeck, curve: SceneCurve) -> int:
    """The line of a STIFFNESS= whose number is the name of a curve; 0 without one."""
    value = read_number(curve.name)
    places = (grant.where for grant in scene.laws.set_laws if grant.family == "new" and grant.stiffness == value)
    return next((line_of(scene, where) for where in places), 0)


def _chosen_by_values(scene: ResolvedDeck) -> bool:
    """Whether equations or variations choose the curves, so that other values of theirs use the others."""
    if "VARIATION" in scene.deck.keywords("PREPROCESSOR"):
        return True
    written, evaluated = (_stiffnesses(deck) for deck in (scene.context.written, scene.deck))
    return any(before is not after for before, after in zip(written, evaluated, strict=False))


def _stiffnesses(deck: Deck) -> Iterator[object]:
    blocks = (cast("SeabedProperties", block) for _, block in deck.blocks("SEABED PROPERTIES"))
    return (entry.stiffness for block in blocks for entry in block.sets)


def line_of(scene: ResolvedDeck, where: Where) -> int:
    """The line of a place in its file."""
    return scene.deck.place(Problem(SBD025, "", where=where)).line
