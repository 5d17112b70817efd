"""Use of the laws of a deck: elements in contact without a law, and curves that no element follows, with the reason."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mudline.basics.short_repr import counted, cut
from mudline.basics.spelling import Effort
from mudline.language.codes.contact import REF003, SBD006, SBD017, SBD025
from mudline.language.codes.lines import SYN009
from mudline.language.deck.model import Opaque
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Problem, Where
from mudline.language.keywords.catalogue import (
    holds_in_soil,
    is_extension,
    is_superseded,
    sections_of,
    suggest_keyword,
    supersedes,
)
from mudline.language.keywords.text import shown
from mudline.language.syntax.rows import read_number
from mudline.model.contact import LawKind
from mudline.model.scene.given_positions import Doubt
from mudline.model.scene.laws import SetLaw, present
from mudline.model.scene.numbering import Indices, distinct
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.model.scene.curves import SceneCurve


_PIPE_IN_PIPE = ("PIP SECTION", "PIP CONNECTION")


UnknownKeyword = tuple[Where, str, str]
"""An unknown keyword that looks like a seabed keyword: its first place, its name, and the keyword suggested, or ""."""


def unknown_keywords(scene: ResolvedDeck) -> list[UnknownKeyword]:
    """Return the unknown keywords of the model that look like a seabed keyword, each once."""
    places: dict[str, Where] = {}
    for where, section, block in scene.deck.every_block():
        if section == "MODEL" and type(block) is Opaque:
            places.setdefault(block.keyword, where)
    unknown, effort = [], Effort()
    for keyword, where in places.items():
        if sections_of(keyword) is not None:
            continue
        near = suggest_keyword(keyword, "MODEL", effort)
        of_seabed = bool(near) and (supersedes(near) or is_superseded(near) or is_extension(near))
        if of_seabed or (not near and keyword.split()[:1] == ["SEABED"]):
            unknown.append((where, keyword, near))
    return unknown


def missing_laws(scene: ResolvedDeck, free: Indices, unknown: list[UnknownKeyword], *, some: bool) -> Iterator[Doubt]:
    """Yield the reasons why the elements `free`, which are in contact, have no law; name every unknown keyword.

    `some` is True if other elements of the line are not in `free`, and may carry a pipe inside of them.
    """
    covered = scene.laws.covered[free]
    for block in present(covered):
        elements = free[covered == block]
        message = (
            f"{_touching(scene, elements)} stiffness: this block gives none, and overrides earlier ones as a whole; "
            "give STIFFNESS= here too"
        )
        yield Doubt(SBD006, message, scene.laws.set_laws[block].where, elements, _brief(elements))
    bare = free[covered < 0]
    for where, keyword, near in unknown:
        meant = f" (did you mean *{near}?)" if near else ""
        lack = f"{_touching(scene, bare)} a seabed law" if bare.size else "its lines have no effect"
        message = f"keyword *{keyword} is not known{meant}, and {lack}: correct the name"
        yield Doubt(SYN009, message, where, bare, _brief(bare) if bare.size else f"*{cut(keyword, 40)} is not known")
    keywords = scene.deck.keywords()
    inside = some and not keywords.isdisjoint(_PIPE_IN_PIPE)
    if bare.size and not unknown and not inside and not any(map(holds_in_soil, keywords)):
        yield _bare(scene, bare)


def _bare(scene: ResolvedDeck, elements: Indices) -> Doubt:
    """Return the reason for elements that no block covers, or an elastic surface without a stiffness."""
    surfaces = [where for where, _ in scene.deck.blocks("ELASTIC SURFACE")]
    if surfaces:
        message = (
            f"{_touching(scene, elements)} a curve of *EMBEDMENT, and this surface has no stiffness: give one in the "
            "first field"
        )
        return Doubt(SBD006, message, surfaces[-1], elements, _brief(elements))
    message = f"{_touching(scene, elements)} a seabed law: give STIFFNESS= to a set of them"
    where = scene.table.numbered.where(int(elements[0]))
    return Doubt(SBD006, message, where, elements, _brief(elements))


def _touching(scene: ResolvedDeck, elements: Indices) -> str:
    return scene.describe(elements, "is in contact without", "are in contact without")


def _brief(elements: Indices) -> str:
    return f"{counted(len(elements), 'element')} in contact without a seabed law"


# ------------------------------------------------------------------------------------------------ curves without effect


def unused_curves(scene: ResolvedDeck) -> Iterator[Problem]:
    """Yield a problem for each curve that no element follows, with the reason.

    The curves that no STIFFNESS= names share one problem. A curve whose elements are unknown, or that a parameter or a
    variation may choose, is left out.
    """
    laws = scene.laws
    used = set(distinct(laws.of_element[scene.law == LawKind.CURVE]).tolist())
    by_curve: dict[int, list[SetLaw]] = {}
    followed: set[int] = set()
    for index, grant in enumerate(laws.set_laws):
        by_curve.setdefault(grant.curve, []).append(grant)
        if index in used:
            followed.add(grant.curve)
    unnamed: list[SceneCurve] = []
    for number, curve in enumerate(laws.curves):
        if number in followed or not curve.name:
            continue
        if grants := by_curve.get(number):
            if not any(grant.set_.open for grant in grants):
                yield Problem(
                    SBD025, f"{_called(curve)} has no effect: {_reason(scene, grants[-1])}", where=curve.title
                )
        elif later := [
            other
            for other in laws.curves[number + 1 :]
            if (other.embedment, folded(other.name)) == (curve.embedment, folded(curve.name))
        ]:
            line = scene.line_of(later[-1].title)
            message = f"{_called(curve)} has no effect: line {line} has one of the same name; rename it"
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
    """Return why the elements of a set do not follow the curve that a place of the deck assigns to them."""
    name, elements = f"SET={shown(grant.set_.name)}", grant.set_.elements
    if not elements.size:
        return f"{name} has no element"
    if scene.nodal[elements].all():
        return f"*SEABED CONTACT gives the nodes of {name} a stiffness of their own"
    winners = distinct(scene.laws.of_element[elements]).tolist()
    lines = sorted({scene.line_of(scene.laws.set_laws[index].where) for index in winners})
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


def _read_as_number(scene: ResolvedDeck, curve: SceneCurve) -> int:
    """Return the line of a STIFFNESS= whose number is the name of a curve; 0 without one."""
    value = read_number(curve.name)
    places = (grant.where for grant in scene.laws.set_laws if grant.family == "new" and grant.stiffness == value)
    return next((scene.line_of(where) for where in places), 0)


def _chosen_by_values(scene: ResolvedDeck) -> bool:
    """Return True if equations or variations choose the curves: other values may then use the other curves."""
    if "VARIATION" in scene.deck.keywords("PREPROCESSOR"):
        return True
    written, evaluated = (
        [entry.stiffness for _, block in deck.blocks("SEABED PROPERTIES") for entry in block.sets]
        for deck in (scene.context.written, scene.deck)
    )
    return any(before is not after for before, after in zip(written, evaluated, strict=False))
