"""Elements without vertical support: no seabed law applies to them, or a law without stiffness."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.seabed_position import depths, first_of
from mudline.language.codes.contact import SBD006
from mudline.language.codes.lines import SYN014
from mudline.language.deck.model import Opaque
from mudline.language.diagnostics import Problem, Repair, Span, Where
from mudline.language.keywords.catalogue import is_superseded, sections_of
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask, blocks_of
from mudline.model.scene.rules.laws import SBD004
from mudline.model.scene.seabed import SeabedKind

if TYPE_CHECKING:
    from mudline.language.keywords.library.pipe_in_pipe import PipSections


@rule(SBD006)
def no_vertical_restraint(context: LintContext) -> Iterator[Problem]:
    """Nothing supports elements of the model vertically.

    Either the block of *SEABED PROPERTIES that applies to the elements gives no stiffness: a block overrides an earlier
    one as a whole, and does not inherit its STIFFNESS=. Or the elements lie at or below the seabed in the deck's
    coordinates, and no law, or a stiffness of 0, applies to them. Inner pipes of *PIP SECTION need no law. A static run
    may then have no unique solution. Give STIFFNESS=, or put the elements into a set that has it.

    Example on sets:
          GEN=3, 4
        |*SEABED PROPERTIES
        | TYPE=ELASTIC
        | SET=ALL
        | STIFFNESS=50000.0
        | SET=Flowline
        + STIFFNESS=50000.0
        | FRICTION=0.8, 0.9

    Finds: 18:2
    """
    scene = context.scene
    reading = scene.context
    if stray := list(_stray_laws(context)):
        yield from stray
        return
    if reading.restart or any(map(is_superseded, reading.misplaced)) or "SEABED PROPERTIES" in reading.misplaced:
        return
    if "SEABED CONTACT" in context.keywords:
        return  # it may hold the pipe
    if context.problems_of(SBD004):
        return  # it reports that there is no stiffness
    yield from _zeros(context)
    free = scene.law == LawKind.NONE
    if not np.count_nonzero(free):
        return
    if "PIP SECTION" in context.keywords or "PIP CONNECTION" in context.keywords:
        free &= ~_inner_pipes(scene, free)
    if np.count_nonzero(free):
        yield from _blocks(scene, np.flatnonzero(free & (scene.laws.covered >= 0)))
        if not context.problems_of(SYN014):  # else the law may be in the part that was cut off
            yield from _lying(context, np.flatnonzero(free & (scene.laws.covered < 0)))


_LAW = re.compile(r"^[ \t]*TYPE[ \t]*=[ \t]*(?:ELASTIC|RIGID)[ \t]*$", re.IGNORECASE | re.MULTILINE)


def _stray_laws(context: LintContext) -> Iterator[Problem]:
    """Yield lines of *SEABED PROPERTIES in blocks that are passed through: their keyword line is missing."""
    for number, section in enumerate(context.deck.sections):
        for index, block in enumerate(section.blocks):
            if type(block) is not Opaque or section.name not in (sections_of(block.keyword) or ()):
                continue
            if not any(map(_LAW.match, block.lines)) or not context.text:
                continue
            where = Where(number, index)
            head = context.text.head(where)
            match = _LAW.search(context.text.source.text, head.end if head else 0)
            message = (
                f"*{block.keyword} has no such line: begin *SEABED PROPERTIES above it, else no seabed law applies"
            )
            place = Span(*match.span()) if match else head or Span(0, 0)
            line = (Span(place.start, place.start), "*SEABED PROPERTIES\n")
            repair = Repair("unsafe", "begin *SEABED PROPERTIES above this line", (line,)) if match else None
            yield Problem(SBD006, message, place, repair=repair)


def _zeros(context: LintContext) -> Iterator[Problem]:
    """Yield stiffnesses of 0 of elements that lie at or below the seabed."""
    scene = context.scene
    grants = scene.laws.set_laws
    zero = [
        i
        for i, grant in enumerate(grants)
        if grant.kind is LawKind.LINEAR and grant.stiffness == 0.0 and not grant.unknown
    ]
    for index in zero:
        elements = np.flatnonzero(scene.laws.of_element == index)
        lying = elements[_depths(context, elements) >= 0.0]
        if lying.size and "SEABED CONTACT" not in scene.extensions:
            which = f"{first_of('element', scene.element_ids[lying[0]], lying.size)} lie{'s' * (lying.size == 1)}"
            message = f"{which} at or below the seabed{_level(scene)} and this stiffness is 0: give another one"
            yield Problem(SBD006, message, where=grants[index].where)


_SAME_PLACE = 3
"""Number of decimals to which the coordinates of the pipes of a pipe in a pipe agree."""


def _inner_pipes(scene: Scene, free: Mask) -> Mask:
    """Return a mask (m,) of the elements without a law that lie in another pipe, out of reach of the seabed.

    They are named by *PIP SECTION, or their middles coincide with those of elements with a law.
    """
    inside = in_another_pipe(scene)
    placed = (scene.element_nodes >= 0).all(axis=1)
    outer = set(_middles(scene, np.flatnonzero(placed & (scene.law != LawKind.NONE))))
    alone = np.flatnonzero(placed & free & ~inside)
    inside[alone] = [middle in outer for middle in _middles(scene, alone)]
    return inside & free


def in_another_pipe(scene: Scene) -> Mask:
    """Return a mask (m,) of the elements of the inner pipes that `*PIP SECTION` names."""
    inside = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for _, block in scene.deck.blocks("PIP SECTION"):
        for pipe in cast("PipSections", block).pipes:
            if set_ := scene.set_table.find(pipe.inner or ""):
                inside[set_.elements] = True
    return inside


def _middles(scene: Scene, elements: Indices) -> list[tuple[float, ...]]:
    """Return the rounded middles of some elements whose nodes are known."""
    return list(map(tuple, scene.coordinates[scene.element_nodes[elements]].mean(axis=1).round(_SAME_PLACE).tolist()))


def _blocks(scene: Scene, elements: Indices) -> Iterator[Problem]:
    """Yield blocks without stiffness that apply to elements, unless a later block of unknown elements may apply."""
    if not elements.size:
        return
    grants = scene.laws.set_laws
    last_open = max((index for index, grant in enumerate(grants) if grant.set_.open), default=-1)
    legacy_open = any(grant.set_.open for grant in grants if grant.family == "legacy")
    groups = np.unique(scene.laws.covered[elements], return_index=True, return_counts=True)
    for index, first, count in zip(*(part.tolist() for part in groups), strict=True):
        where = grants[index].where
        if legacy_open or last_open > index or grants[index].unknown or max(scene.laws.gaps, default=Where()) >= where:
            continue
        which = f"{first_of('element', scene.element_ids[elements[first]], count)} get{'s' * (count == 1)}"
        message = (
            f"{which} no stiffness from this block, which overrides earlier ones as a whole: give STIFFNESS= here too"
        )
        yield Problem(SBD006, message, where=where)


def _lying(context: LintContext, elements: Indices) -> Iterator[Problem]:
    """Yield elements at or below the seabed without any law; if the deck has no seabed, only those below it."""
    if not elements.size:
        return
    scene = context.scene
    if scene.laws.uncertain or scene.may_have_more_laws or context.in_soil:
        return
    seabed = bool(scene.laws.types or scene.laws.set_laws)
    lies = np.greater_equal if seabed else np.greater
    parts = (elements[block] for block in blocks_of(len(elements)))
    lying = np.concatenate([part[lies(_depths(context, part), 0.0)] for part in parts])
    if lying.size:
        where = f"{'at or below' if seabed else 'below'} the seabed{_level(scene)}"
        which = f"{first_of('element', scene.element_ids[lying[0]], lying.size)} lie{'s' * (lying.size == 1)}"
        message = f"{which} {where} and no seabed law applies: give STIFFNESS= to a set of them"
        sets = (set_ for set_ in scene.set_table.named.values() if set_.where and lying[0] in set_.elements)
        bare = [set_ for set_ in sets if (scene.law[set_.elements] == LawKind.NONE).all()]
        properties = context.written("SEABED PROPERTIES")
        place = properties[0][0] if bare and properties else scene.table.numbered.where(int(lying[0]))
        yield Problem(SBD006, message, where=place)


def _level(scene: Scene) -> str:
    """Return the level of a flat seabed for a message, or ""."""
    return " (X = 0)" if scene.seabed.kind is SeabedKind.FLAT else ""


def _depths(context: LintContext, elements: Indices) -> Floats:
    """Return lower bounds of the mean depth of each element's two nodes below the seabed; NaN if one is not known."""
    scene = context.scene
    mean_depths = np.full(len(elements), np.nan)
    ends = scene.element_nodes[elements]
    known = (ends >= 0).all(axis=1)
    if scene.seabed.kind is SeabedKind.FLAT:
        below = 0.0 - scene.coordinates[ends[known], 0]
    else:
        below = context.once(depths)[ends[known]]
    mean_depths[known] = 0.5 * below[:, 0] + 0.5 * below[:, 1]
    return mean_depths
