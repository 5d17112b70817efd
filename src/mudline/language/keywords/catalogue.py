"""Every section and keyword that is known, which module declares it, and which of them an unknown name meant.

A keyword is declared for some sections; in others another module may declare what it means there. Which module that is
says the index, which is made of the declarations: one that a deck does not use is not imported.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from functools import cache, lru_cache
from importlib import import_module
from itertools import takewhile
from typing import cast

from mudline.basics.spelling import Effort, nearest
from mudline.language.keywords import index
from mudline.language.keywords.model import Block
from mudline.language.keywords.names_only import GIVES, NAMES, ZERO_LENGTH
from mudline.language.keywords.values import Entry, Facts, Gift, Names, OpaqueKeyword

SECTIONS = (
    "PREPROCESSOR",
    "MODEL",
    "LOAD CASE",
    "MODES",
    "MODES POSTPROCESSING",
    "DATABASE POSTPROCESSING",
    "TIMETRACE POSTPROCESSING",
    "SUMMARY POSTPROCESSING",
    "SUMMARY COLLATE",
    "SUMMARY WAVE SCATTER",
    "SPECTRAL POSTPROCESSING",
    "CODE CHECKING",
    "HISTOGRAM",
    "LIFETIME",
    "LIFETIME FATIGUE",
    "LIFEFREQUENCY",
    "CLEAR",
    "SHEAR7",
    "ANALYSIS",
    "POSTPROCESSING",
)

CERTAIN_SECTIONS = ("PREPROCESSOR", "MODEL", "LOAD CASE")
"""Sections of which it is certain which keywords belong there."""

_ASKED = 1024
"""Names of which is remembered what is known of them: decks may hold any."""
_LIBRARY = "mudline.language.keywords.library"


@cache
def _by_keyword() -> dict[str, list[Entry]]:
    """The entries of the index by keyword: one of a keyword for each of its declarations."""
    found: dict[str, list[Entry]] = {}
    for entry in index.ENTRIES:
        found.setdefault(entry.keyword, []).append(entry)
    return found


def entries(keyword: str) -> list[Entry]:
    """What the index says of a keyword, an entry for each of its declarations."""
    return _by_keyword().get(keyword, [])


def _read(keyword: str) -> list[Entry]:
    return [entry for entry in entries(keyword) if not entry.kept]


@lru_cache(_ASKED)
def block_class(section: str, keyword: str) -> type[Block] | None:
    """The declaration of a keyword in a section, or None when it is passed through."""
    return next((load(entry) for entry in _read(keyword) if section in entry.sections), None)


@lru_cache(_ASKED)
def declared(keyword: str, section: str = "") -> type[Block] | None:
    """The declaration of a keyword, or None when its lines are not read.

    That for a section goes before others, as the keyword may stand in a wrong one.
    """
    return block_class(section, keyword) or next(map(load, _read(keyword)), None)


def declarations(keyword: str) -> list[type[Block]]:
    """The declarations of a keyword: it may mean other things in other sections."""
    return [load(entry) for entry in _read(keyword)]


@cache
def load(entry: Entry) -> type[Block]:
    """The block class of a declaration; its module is imported."""
    return cast("type[Block]", getattr(import_module(f"{_LIBRARY}.{entry.module}"), entry.name))


def opaque_keyword(section: str, keyword: str) -> OpaqueKeyword | None:
    """What is known of a keyword that is passed through, or None when that is its name at most."""
    kept = (entry for entry in entries(keyword) if entry.kept and section in entry.sections)
    return next(map(load_opaque, kept), None)


@cache
def load_opaque(entry: Entry) -> OpaqueKeyword:
    """The declaration of a keyword whose lines are kept; its module is imported."""
    return cast("OpaqueKeyword", getattr(import_module(f"{_LIBRARY}.{entry.module}"), entry.name))


def opaque_keywords() -> list[OpaqueKeyword]:
    """Every declaration of a keyword whose lines are kept, in the order of the catalogue."""
    return [load_opaque(entry) for entry in index.ENTRIES if entry.kept]


def block_classes() -> list[type[Block]]:
    """Every declaration of a keyword whose lines are read, in the order of the catalogue."""
    return [load(entry) for entry in index.ENTRIES if not entry.kept]


def in_order(keywords: Iterable[str]) -> list[str]:
    """Those of the keywords of which more is known than the name, in the order of the catalogue."""
    given = set(keywords)
    return [keyword for keyword in _by_keyword() if keyword in given]


@lru_cache(_ASKED)
def sections_of(keyword: str) -> tuple[str, ...] | None:
    """The sections where a keyword belongs; () when not confirmed, None for an unknown keyword."""
    found = entries(keyword)
    if not found and keyword not in NAMES:
        return None
    if any(entry.sections_inferred for entry in found):
        return ()
    sections = [section for entry in found for section in entry.sections]
    return tuple(dict.fromkeys([*sections, *NAMES.get(keyword, ())]))


def facts_of(keyword: str, section: str = "") -> Facts:
    """What the class of a keyword says of it besides its fields; nothing of a keyword whose lines are not read."""
    found = declared(keyword, section)
    return found.facts if found else Block.facts


def has_certain_section(keyword: str) -> bool:
    """Whether it is certain where a keyword belongs; of postprocessing that is inferred."""
    certain = (sections_of(keyword) or ("",))[0] in CERTAIN_SECTIONS
    return certain or bool(_read(keyword)) or sections_of(keyword) == ()


@lru_cache(_ASKED)
def may_give(keyword: str, section: str, what: Gift) -> bool:
    """Whether lines of a keyword that are not read may give a model something.

    An unknown keyword may give anything, and so may one that stands in a section where it does not belong.
    """
    if found := block_class(section, keyword):
        facts = found.facts
        makes = what == "elements" and facts.defines in ("nodes", "elements", "sets")
        return makes or what in facts.gives or (what != "elements" and facts.zero_length)
    if kept := opaque_keyword(section, keyword):
        return what in kept.gives
    misplaced = bool(_read(keyword)) and section not in NAMES.get(keyword, ())
    return misplaced or keyword not in NAMES or what in GIVES.get(keyword, ())


def is_read_somewhere(keyword: str) -> bool:
    """Return True if the lines of a keyword are read in one section at least."""
    return bool(_read(keyword))


@cache
def definers(what: Names) -> list[str]:
    """The keywords that define things of a kind."""
    return [entry.keyword for entry in index.ENTRIES if what.name in entry.defines]


@cache
def users(what: Names) -> list[str]:
    """The keywords that name things of a kind."""
    return [entry.keyword for entry in index.ENTRIES if what.name in entry.names]


@cache
def telling_lines() -> frozenset[str]:
    """The lines that one keyword alone has."""
    return frozenset(line for entry in index.ENTRIES for line in entry.telling)


def may_have_no_length(keyword: str) -> bool:
    """Whether the elements of a keyword may have no length."""
    return keyword in ZERO_LENGTH or any(entry.zero_length for entry in entries(keyword))


def is_extension(keyword: str) -> bool:
    """Whether a keyword is mudline's own."""
    return facts_of(keyword).extension


def is_superseded(keyword: str) -> bool:
    """Whether newer keywords of the seabed take the place of one."""
    return _of_seabed(keyword) and bool(facts_of(keyword, "MODEL").superseded_by)


def gives_laws(keyword: str) -> bool:
    """Whether a keyword gives elements their law of the seabed, by itself or with the curves of others."""
    facts = facts_of(keyword, "MODEL")
    given = facts.extension or supersedes(keyword) or is_superseded(keyword)
    return given and (is_superseded(keyword) or facts.defines != "curves")


def supersedes(keyword: str) -> bool:
    """Whether a keyword takes the place of older ones of the seabed."""
    return _of_seabed(keyword) and facts_of(keyword, "MODEL").supersedes


@lru_cache(_ASKED)
def _of_seabed(keyword: str) -> bool:
    """Whether a keyword is one of the two families of the seabed, which exclude each other."""
    return any(entry.subject == "seabed" for entry in entries(keyword))


def holds_in_soil(keyword: str) -> bool:
    """Whether a keyword gives soil springs."""
    return facts_of(keyword).soil_springs


def begins_keyword(text: str) -> bool:
    """Whether known keywords begin with a text that is none itself."""
    return text not in keywords() and any(known.startswith(text) for known in keywords())


@cache
def keywords() -> tuple[str, ...]:
    """Every known keyword."""
    return tuple(sorted({*_by_keyword(), *NAMES}))


@cache
def read_keywords() -> tuple[str, ...]:
    """Every keyword of which more is known than its name."""
    return tuple(sorted(_by_keyword()))


_SAME_BEGINNING = 0.8
"""Share of the longer of two names that has to be the same from its first letter on."""


def meant_section(name: str) -> str:
    """The section that an unknown one was to be, or ""."""
    return nearest(name, SECTIONS) or _begun(name, SECTIONS) or _before(name, SECTIONS)


def suggest_keyword(keyword: str, section: str = "", effort: Effort | None = None, but: Collection[str] = ()) -> str:
    """The keyword that an unknown one was to be, or ""; one that belongs in the section of a block before others.

    Those that it cannot have been are left out by `but`.
    """
    known = [name for name in keywords() if name not in but] if but else keywords()
    own = [name for name in known if section in (sections_of(name) or ())] if section else []
    singular = keyword[:-3] + "Y" if keyword.endswith("IES") else keyword
    return (
        nearest(keyword, own, effort)
        or nearest(keyword, known, effort)
        or (singular if singular in known and singular != keyword else "")
        or _begun(keyword, known)
        or _before(keyword, [name for name in read_keywords() if name not in but])
    )


def meant_in(keyword: str, section: str) -> str:
    """The keyword of a section that is spelt nearly as one that does not belong in it, or ""."""
    near = [name for name in keywords() if nearest(keyword, [name])]
    return nearest(keyword, [name for name in near if section in (sections_of(name) or ())])


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
