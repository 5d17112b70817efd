"""Which section or keyword a name that is not known was to be."""

from __future__ import annotations

from collections.abc import Collection
from itertools import takewhile

from mudline.keywords import catalogue
from mudline.spelling import Effort, nearest

_SAME_BEGINNING = 0.8
"""Share of the longer of two names that has to be the same from its first letter on."""


def meant_section(name: str) -> str:
    """The section that an unknown one was to be, or ""."""
    return nearest(name, catalogue.SECTIONS) or _begun(name, catalogue.SECTIONS) or _before(name, catalogue.SECTIONS)


def meant_keyword(keyword: str, effort: Effort | None = None) -> str:
    """The keyword that an unknown one was to be, or ""."""
    known = catalogue.keywords()
    return nearest(keyword, known, effort) or _begun(keyword, known) or _before(keyword, catalogue.read_keywords())


def meant_in(keyword: str, section: str) -> str:
    """The keyword of a section that is spelt nearly as one that does not belong in it, or ""."""
    near = [name for name in catalogue.keywords() if nearest(keyword, [name])]
    return nearest(keyword, [name for name in near if section in (catalogue.sections_of(name) or ())])


def words_behind(name: str, near: str) -> bool:
    """Whether a name is a known one with words behind it."""
    return name.startswith(near) and name[len(near) : len(near) + 1] in (" ", ",")


def _begun(name: str, known: Collection[str]) -> str:
    """The known name with the longest beginning in common, when that is nearly all of both."""
    head = name[: int(_SAME_BEGINNING * len(name))]
    common, near = max(((_common(name, other), other) for other in known if other.startswith(head)), default=(0, ""))
    return near if common >= _SAME_BEGINNING * max(len(name), len(near)) else ""


def _common(one: str, other: str) -> int:
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _before(name: str, known: Collection[str]) -> str:
    """The longest known name behind which other words stand."""
    return max((other for other in known if words_behind(name, other)), key=len, default="")
