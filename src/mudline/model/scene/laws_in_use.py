"""Use of the laws of a deck: elements that need a law and have none, and curves that no element follows."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.basics.short_repr import counted, cut
from mudline.basics.spelling import Effort
from mudline.language.codes.contact import REF003, REF004, SBD006, SBD017, SBD025
from mudline.language.codes.lines import SYN009
from mudline.language.deck.model import Opaque
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Problem, Where
from mudline.language.keywords.catalogue import (
    hold_in_soil,
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
    from mudline.language.keywords.library.seabed_properties import SeabedProperties
    from mudline.model.scene.curves import SceneCurve


_TOUCHING = "is in contact", "are in contact"
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
        verbs = "is in contact and gets", "are in contact and get"
        yield _doubt(block_without_stiffness(scene, block, elements, *verbs), elements)
    bare = free[covered < 0]
    for where, keyword, near in unknown:
        meant = f" (did you mean *{near}?)" if near else ""
        lack = f"{scene.describe(bare, *_TOUCHING)} without a seabed law" if bare.size else "its lines have no effect"
        message = f"keyword *{keyword} is not known{meant}, and {lack}: correct the name"
        yield Doubt(SYN009, message, where, bare, _brief(bare) if bare.size else f"*{cut(keyword, 40)} is not known")
    keywords = scene.deck.keywords()
    inside = some and not keywords.isdisjoint(_PIPE_IN_PIPE)
    if bare.size and not unknown and not inside and not hold_in_soil(keywords):
        yield _doubt(_bare(scene, bare), bare)


def _bare(scene: ResolvedDeck, elements: Indices) -> Problem:
    """Return the reason for elements that no block covers, or an elastic surface without a stiffness."""
    surfaces = [where for where, _ in scene.deck.blocks("ELASTIC SURFACE")]
    if not surfaces:
        return without_law(scene, elements, *_TOUCHING)
    message = (
        f"{scene.describe(elements, *_TOUCHING)} without a curve of *EMBEDMENT, and this surface has no stiffness: "
        "give one in the first field"
    )
    return Problem(SBD006, message, where=surfaces[-1])


def _doubt(problem: Problem, elements: Indices) -> Doubt:
    return Doubt(problem.code, problem.message, problem.where, elements, _brief(elements))


def _brief(elements: Indices) -> str:
    return f"{counted(len(elements), 'element')} in contact without a seabed law"


def block_without_stiffness(scene: ResolvedDeck, block: int, elements: Indices, one: str, many: str) -> Problem:
    """Return the problem of elements to which a block without stiffness applies, given by its index in `set_laws`."""
    message = (
        f"{scene.describe(elements, one, many)} no stiffness from this block, which overrides earlier ones as a whole: "
        "give STIFFNESS= here too"
    )
    return Problem(SBD006, message, where=scene.laws.set_laws[block].where)


def without_law(scene: ResolvedDeck, elements: Indices, one: str, many: str) -> Problem:
    """Return the problem of elements to which no block applies; its place is that of the laws if a set has none."""
    message = f"{scene.describe(elements, one, many)} and no seabed law applies: give STIFFNESS= to a set of them"
    sets = (set_ for set_ in scene.set_table.named.values() if set_.where and elements[0] in set_.elements)
    bare = any((scene.law[set_.elements] == LawKind.NONE).all() for set_ in sets)
    properties = scene.context.blocks("SEABED PROPERTIES")
    place = properties[0][0] if bare and properties else scene.table.numbered.where(int(elements[0]))
    return Problem(SBD006, message, where=place)


# ------------------------------------------------------------------------------------------------ curves without effect


def idle_curves(scene: ResolvedDeck) -> dict[str, list[SceneCurve]]:
    """Return the curves that no STIFFNESS= names, by folded name; none if something that may use them is not known.

    A curve whose name reads as a number, or nearly as an undefined name, is left out.
    """
    if _chosen_elsewhere(scene):
        return {}
    curves = [curve for curve in scene.laws.curves if not curve.embedment]
    unknown = scene.referenced - {folded(curve.name) for curve in curves}
    idle: dict[str, list[SceneCurve]] = {}
    for curve in curves:
        name = folded(curve.name)
        if not name or name in scene.referenced or read_number(name) is not None:
            continue
        if name in idle:
            idle[name].append(curve)
        elif not scene.context.near(name, unknown):  # else it is misspelt where it is used, which is reported there
            idle[name] = [curve]
    return {} if len(idle) == 1 and len(unknown) == 1 else idle


def _chosen_elsewhere(scene: ResolvedDeck) -> bool:
    """Return True if something that is not read, or not fixed, may use curves."""
    context, laws = scene.context, scene.laws
    for where, block in context.blocks("SEABED PROPERTIES"):
        if where.section < len(context.deck.own_sections):
            written = cast("SeabedProperties", context.written.at(where))
            pairs = zip(written.sets, block.sets, strict=True)
            if any(before.stiffness is not after.stiffness for before, after in pairs):
                return True  # an equation, whose parameters may be varied
    if any(grant.kind is LawKind.NONE and grant.unknown for grant in laws.set_laws):
        return True  # a set whose STIFFNESS= is not known
    if any(gap.block >= 0 and not gap.path for gap in laws.gaps):
        return True  # a block of which no set is known
    if "SEABED PROPERTIES" in context.misplaced or (context.restart and not scene.referenced):
        return True
    return any(
        folded(" ".join(varied.keyword or [])) == "seabed properties"  # None in a line that could not be read
        for _, block in context.blocks("VARIATION", "PREPROCESSOR")
        for variation in block.variations
        for varied in variation.blocks
        if varied.action == "ADD"
    )


def named_as_numbers(scene: ResolvedDeck) -> Iterator[Problem]:
    """Yield the curves whose names read as numbers."""
    for curve in scene.laws.curves:
        if not curve.embedment and curve.name and read_number(curve.name) is not None:
            message = "the name of this curve reads as a number, and STIFFNESS= takes the number: choose another name"
            yield Problem(SBD017, message, where=curve.title)


def repeated_curves(scene: ResolvedDeck) -> Iterator[Problem]:
    """Yield the curves that have the name, or in `*EMBEDMENT` the set, of an earlier one, which they override."""
    known: set[tuple[bool, str]] = set()
    for curve in scene.laws.curves:
        key = (curve.embedment, folded(curve.name))
        if key in known and curve.name:
            what = "set {} already has a curve" if curve.embedment else "curve {} is already defined"
            what = what.format(shown(curve.name))
            message = f"{what}: the later one is used (inferred); keep one of them"
            yield Problem(REF004, message, where=curve.title)
        known.add(key)


def unused_curves(scene: ResolvedDeck) -> Iterator[Problem]:
    """Yield a problem for each curve that no element follows, with the reason.

    The curves that no STIFFNESS= names share one problem. A curve whose elements are unknown, or that a parameter or a
    variation may choose, is left out.
    """
    laws = scene.laws
    used = distinct(laws.of_element[scene.law == LawKind.CURVE]).tolist()
    by_curve: dict[int, list[SetLaw]] = {}
    for grant in laws.set_laws:
        by_curve.setdefault(grant.curve, []).append(grant)
    followed = {laws.set_laws[index].curve for index in used}
    last = {(curve.embedment, folded(curve.name)): number for number, curve in enumerate(laws.curves)}
    for number, curve in enumerate(laws.curves):
        grants = by_curve.get(number, [])
        if not grants or not curve.name or last[curve.embedment, folded(curve.name)] != number:
            continue  # an earlier curve of the same name is reported with the later one
        if number not in followed and not any(grant.set_.open for grant in grants):
            message = f"{_called(curve)} has no effect: {_reason(scene, grants[-1])}"
            yield Problem(SBD025, message, where=curve.title)
    yield from repeated_curves(scene)
    yield from named_as_numbers(scene)
    unnamed = [curve for curve, *_ in idle_curves(scene).values()]
    if unnamed:
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
