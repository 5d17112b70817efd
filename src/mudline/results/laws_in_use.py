"""Elements in contact without a seabed law, and what in the deck is the reason."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mudline.codes.contact import SBD006
from mudline.codes.lines import SYN009
from mudline.deck.model import Opaque
from mudline.diagnostics import Code, Where
from mudline.keywords.catalogue import (
    holds_in_soil,
    is_extension,
    is_superseded,
    sections_of,
    suggest_keyword,
    supersedes,
)
from mudline.scene.numbering import Indices
from mudline.scene.resolved import ResolvedDeck
from mudline.short_repr import counted, cut
from mudline.spelling import Effort

_PIPE_IN_PIPE = ("PIP SECTION", "PIP CONNECTION")


class Missing(NamedTuple):
    """What keeps elements (indices) without a law: code, message and place, and a few words for a caption."""

    code: Code
    message: str
    where: Where
    elements: Indices
    brief: str


class UnknownKeyword(NamedTuple):
    """A keyword that is not known and looks like one of a seabed: where it stands first, and the one meant, or ""."""

    where: Where
    keyword: str
    near: str


def unknown_keywords(scene: ResolvedDeck) -> list[UnknownKeyword]:
    """The unknown keywords of the model that look like one of a seabed, each once."""
    places: dict[str, Where] = {}
    for i, section in enumerate(scene.deck.sections):
        for j, block in enumerate(section.blocks if section.name == "MODEL" else ()):
            if type(block) is Opaque:
                places.setdefault(block.keyword, Where(i, j))
    found, effort = [], Effort()
    for keyword, where in places.items():
        if sections_of(keyword) is not None:
            continue
        near = suggest_keyword(keyword, "MODEL", effort)
        of_seabed = bool(near) and (supersedes(near) or is_superseded(near) or is_extension(near))
        if of_seabed or (not near and keyword.split()[:1] == ["SEABED"]):
            found.append(UnknownKeyword(where, keyword, near))
    return found


def missing_laws(scene: ResolvedDeck, free: Indices, unknown: list[UnknownKeyword], *, some: bool) -> Iterator[Missing]:
    """What keeps the elements `free`, which are in contact, without a law; every unknown keyword is named.

    `some` says that other elements of the line are not among them, and may carry those inside of them.
    """
    covered = scene.laws.covered[free]
    for block in np.unique(covered[covered >= 0]).tolist():
        elements = free[covered == block]
        message = (
            f"{_touching(scene, elements)} stiffness: this block gives none, and overrides earlier ones as a whole; "
            "give STIFFNESS= here too"
        )
        yield Missing(SBD006, message, scene.laws.set_laws[block].where, elements, _brief(elements))
    bare = free[covered < 0]
    for where, keyword, near in unknown:
        meant = f" (did you mean *{near}?)" if near else ""
        lack = f"{_touching(scene, bare)} a seabed law" if bare.size else "its lines have no effect"
        message = f"keyword *{keyword} is not known{meant}, and {lack}: correct the name"
        yield Missing(SYN009, message, where, bare, _brief(bare) if bare.size else f"*{cut(keyword, 40)} is not known")
    keywords = scene.deck.keywords()
    inside = some and not keywords.isdisjoint(_PIPE_IN_PIPE)
    if bare.size and not unknown and not inside and not any(map(holds_in_soil, keywords)):
        yield _bare(scene, bare)


def _bare(scene: ResolvedDeck, elements: Indices) -> Missing:
    """Elements that no block holds, or an elastic surface without a stiffness."""
    surfaces = [where for where, _ in scene.deck.blocks("ELASTIC SURFACE")]
    if surfaces:
        message = (
            f"{_touching(scene, elements)} a curve of *EMBEDMENT, and this surface has no stiffness: give one in the "
            "first field"
        )
        return Missing(SBD006, message, surfaces[-1], elements, _brief(elements))
    message = f"{_touching(scene, elements)} a seabed law: give STIFFNESS= to a set of them"
    where = scene.table.numbered.where(int(elements[0]))
    return Missing(SBD006, message, where, elements, _brief(elements))


def _touching(scene: ResolvedDeck, elements: Indices) -> str:
    return scene.describe(elements, "is in contact without", "are in contact without")


def _brief(elements: Indices) -> str:
    return f"{counted(len(elements), 'element')} in contact without a seabed law"
