"""Catalogue of sections and keywords: modules that declare them, and suggestions for unknown names.

A keyword is declared for some sections; in other sections another module may declare it with another meaning. The
index, `index.json`, is generated from the declarations by `make index` and maps keywords to modules: unused
declarations are not imported.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from functools import cache, lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any

from pydantic_core import from_json

from mudline.basics.spelling import Effort, common_start, nearest
from mudline.language.diagnostics import Severity
from mudline.language.keywords.model import Block
from mudline.language.keywords.names_only import GIVES, NAMES, ZERO_LENGTH
from mudline.language.keywords.reader import read_block
from mudline.language.keywords.values import Entry, Facts, Gift, Names, OpaqueKeyword
from mudline.language.syntax.fields import first_key
from mudline.language.syntax.tree import LeafKind, RawBlock

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
"""Sections whose keywords are known for certain."""

_ASKED = 1024
"""Size of the caches by name: decks may hold any name."""


@cache
def index() -> tuple[Entry, ...]:
    """Return the entries of all declarations in the library, by subject, section and name."""
    rows: list[dict[str, Any]] = from_json(Path(__file__).with_name("index.json").read_bytes())
    for row in rows:
        row |= {name: tuple(value) for name, value in row.items() if isinstance(value, list)}
    return tuple(Entry(**row) for row in rows)


@cache
def _by_keyword() -> dict[str, list[Entry]]:
    """Return the entries of the index by keyword: one for each declaration of the keyword."""
    by_keyword: dict[str, list[Entry]] = {}
    for entry in index():
        by_keyword.setdefault(entry.keyword, []).append(entry)
    return by_keyword


def entries(keyword: str) -> list[Entry]:
    """Return the entries of a keyword in the index, one for each of its declarations."""
    return _by_keyword().get(keyword, [])


def _read(keyword: str) -> list[Entry]:
    return [entry for entry in entries(keyword) if not entry.kept]


@lru_cache(_ASKED)
def block_class(section: str, keyword: str) -> type[Block] | None:
    """Return the declaration of a keyword in a section, or None if it is passed through."""
    return next((load(entry) for entry in _read(keyword) if section in entry.sections), None)


@lru_cache(_ASKED)
def declared(keyword: str, section: str = "") -> type[Block] | None:
    """Return the declaration of a keyword, or None if its lines are not read.

    The declaration for the section comes first; without one another counts, as the keyword may be misplaced.
    """
    return block_class(section, keyword) or next(map(load, _read(keyword)), None)


def declarations(keyword: str) -> list[type[Block]]:
    """Return the declarations of a keyword: its meaning may depend on the section."""
    return [load(entry) for entry in _read(keyword)]


@cache
def load(entry: Entry) -> Any:
    """Return a declaration, a block class or an `OpaqueKeyword`; its module is imported."""
    return getattr(import_module(f"mudline.language.keywords.library.{entry.module}"), entry.name)


def opaque_keyword(section: str, keyword: str) -> OpaqueKeyword | None:
    """Return the declaration of a keyword that is passed through; None if at most its name is known."""
    kept = (entry for entry in entries(keyword) if entry.kept and section in entry.sections)
    return next(map(load, kept), None)


def opaque_keywords() -> list[OpaqueKeyword]:
    """Return every declaration of a keyword whose lines are kept, in the order of the catalogue."""
    return [load(entry) for entry in index() if entry.kept]


def block_classes() -> list[type[Block]]:
    """Return every declaration of a keyword whose lines are read, in the order of the catalogue."""
    return [load(entry) for entry in index() if not entry.kept]


def in_order(keywords: Iterable[str]) -> list[str]:
    """Return the keywords that the index contains, in the order of the catalogue."""
    chosen = set(keywords)
    return [keyword for keyword in _by_keyword() if keyword in chosen]


@lru_cache(_ASKED)
def sections_of(keyword: str) -> tuple[str, ...] | None:
    """Return the sections where a keyword belongs; () if not confirmed, None for an unknown keyword."""
    declared_entries = entries(keyword)
    if not declared_entries and keyword not in NAMES:
        return None
    if any(entry.sections_inferred for entry in declared_entries):
        return ()
    sections = [section for entry in declared_entries for section in entry.sections]
    return tuple(dict.fromkeys([*sections, *NAMES.get(keyword, ())]))


def facts_of(keyword: str, section: str = "") -> Facts:
    """Return the facts declared for a keyword; empty facts if its lines are not read."""
    block = declared(keyword, section)
    return block.facts if block else Block.facts


def has_certain_section(keyword: str) -> bool:
    """Return True if the sections of a keyword are certain; those of postprocessing keywords are inferred."""
    certain = (sections_of(keyword) or ("",))[0] in CERTAIN_SECTIONS
    return certain or bool(_read(keyword)) or sections_of(keyword) == ()


@lru_cache(_ASKED)
def may_give(keyword: str, section: str, what: Gift) -> bool:
    """Return True if unread lines of a keyword may define a property of the model.

    An unknown or misplaced keyword may define any of them.
    """
    if block := block_class(section, keyword):
        facts = block.facts
        makes = what == "elements" and facts.defines in ("nodes", "elements", "sets")
        return makes or what in facts.gives or (what != "elements" and facts.zero_length)
    if kept := opaque_keyword(section, keyword):
        return what in kept.gives
    misplaced = bool(_read(keyword)) and section not in NAMES.get(keyword, ())
    return misplaced or keyword not in NAMES or what in GIVES.get(keyword, ())


def is_read_somewhere(keyword: str) -> bool:
    """Return True if the lines of a keyword are read in at least one section."""
    return bool(_read(keyword))


@cache
def definers(what: Names) -> list[str]:
    """Return the keywords that define objects of a kind."""
    return [entry.keyword for entry in index() if what.name in entry.defines]


@cache
def users(what: Names) -> list[str]:
    """Return the keywords that refer to objects of a kind."""
    return [entry.keyword for entry in index() if what.name in entry.names]


@cache
def telling_lines() -> frozenset[str]:
    """Return the lines that occur in one keyword only."""
    return frozenset(line for entry in index() for line in entry.telling)


def may_have_no_length(keyword: str) -> bool:
    """Return True if the elements of a keyword may have no length."""
    return keyword in ZERO_LENGTH or any(entry.zero_length for entry in entries(keyword))


def is_extension(keyword: str) -> bool:
    """Return True if a keyword is an extension of mudline."""
    return facts_of(keyword).extension


def is_superseded(keyword: str) -> bool:
    """Return True if newer keywords of the seabed supersede a keyword."""
    return _of_seabed(keyword) and bool(facts_of(keyword, "MODEL").superseded_by)


def gives_laws(keyword: str) -> bool:
    """Return True if a keyword assigns contact laws to elements, by itself or with the curves of other keywords."""
    facts = facts_of(keyword, "MODEL")
    family = facts.extension or supersedes(keyword) or is_superseded(keyword)
    return family and (is_superseded(keyword) or facts.defines != "curves")


def supersedes(keyword: str) -> bool:
    """Return True if a keyword supersedes older keywords of the seabed."""
    return _of_seabed(keyword) and facts_of(keyword, "MODEL").supersedes


@lru_cache(_ASKED)
def _of_seabed(keyword: str) -> bool:
    """Return True if a keyword belongs to one of the two families of the seabed, which exclude each other."""
    return any(entry.subject == "seabed" for entry in entries(keyword))


def hold_in_soil(keywords: Iterable[str]) -> bool:
    """Return True if one of some keywords defines soil springs."""
    return any(facts_of(keyword).soil_springs for keyword in keywords)


@cache
def keywords() -> tuple[str, ...]:
    """Return every known keyword."""
    return tuple(sorted({*_by_keyword(), *NAMES}))


@cache
def read_keywords() -> tuple[str, ...]:
    """Return every keyword of which more is known than its name."""
    return tuple(sorted(_by_keyword()))


_SAME_BEGINNING = 0.8
"""Least length of a common beginning of two names, as a share of the longer name."""


def meant_section(name: str) -> str:
    """Return the known section closest to an unknown name, or ""."""
    return nearest(name, SECTIONS) or _begun(name, SECTIONS) or _before(name, SECTIONS)


def suggest_keyword(keyword: str, section: str = "", effort: Effort | None = None, but: Collection[str] = ()) -> str:
    """Return the known keyword closest to an unknown name, or ""; keywords of the block's section come first.

    Keywords in `but` are left out.
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


_TRIED = 4
"""Greatest number of similar known names whose lines are compared with those of an unknown name."""


def meant_keyword(text: str, raw: RawBlock, section: str) -> str:
    """Return the known keyword that an unknown one stands for: the nearest whose lines these may be, or ""."""
    tried: tuple[str, ...] = ()
    while len(tried) < _TRIED and (near := _suggested(raw.name, section, tried)):
        if _may_be(text, raw, near, section) or _stands_apart(text[slice(*raw.head.span)], near):
            return near
        tried += (near,)
    return ""


@lru_cache(256)
def _suggested(keyword: str, section: str, but: tuple[str, ...]) -> str:
    """Return `suggest_keyword`, cached for keywords of many decks, or of a deck that is read several times."""
    return suggest_keyword(keyword, section, None, but)


def _stands_apart(line: str, near: str) -> bool:
    """Return True if words follow far behind the name, like the numbers of cards; any line may have these."""
    words = r"[ \t]+".join(map(re.escape, near.split(" ")))
    return re.match(rf"\*[ \t]*{words}(?:[ \t]{{2,}}|\t)\S", line, re.IGNORECASE) is not None


def _may_be(text: str, raw: RawBlock, near: str, section: str) -> bool:
    """Return True if a keyword is allowed in a section, and most lines can be read as those of the keyword."""
    elsewhere = section not in (sections_of(near) or (section,))
    if elsewhere and section in SECTIONS and section not in CERTAIN_SECTIONS:
        return False
    block = declared(near, section)
    if block is None:
        keys = [key for entry in entries(near) for key in load(entry).name_settings]
        return not keys or any(first_key(text, leaf.span) in keys for leaf in raw.leaves)
    read = read_block(text, RawBlock(raw.head, near, raw.leaves, raw.older), block, last=False)
    places = (each.span.start for each in read.problems if each.span and each.weight is Severity.ERROR)
    faults = len({text.count("\n", raw.head.span.start, place) for place in places})
    data = [leaf for leaf in raw.leaves if leaf.kind not in (LeafKind.BLANK, LeafKind.COMMENT)]
    lines = sum(text.count("\n", *leaf.span) or 1 for leaf in data)
    return not lines or 2 * max(faults, read.lost) < lines


def meant_in(keyword: str, section: str) -> str:
    """Return the keyword of a section that is spelt almost like a keyword that does not belong there, or ""."""
    near = [name for name in keywords() if nearest(keyword, [name])]
    return nearest(keyword, [name for name in near if section in (sections_of(name) or ())])


def words_behind(name: str, near: str) -> bool:
    """Return True if a name is a known one followed by other words."""
    return name.startswith(near) and name[len(near) : len(near) + 1] in (" ", ",")


def _begun(name: str, known: Collection[str]) -> str:
    """Return the known name with the longest common beginning, if this is most of both names; else ""."""
    head = name[: int(_SAME_BEGINNING * len(name))]
    common, near = max(((common_start(name, each), each) for each in known if each.startswith(head)), default=(0, ""))
    return near if common >= _SAME_BEGINNING * max(len(name), len(near)) else ""


def _before(name: str, known: Collection[str]) -> str:
    """Return the longest known name that is followed by other words in a name; else ""."""
    return max((each for each in known if words_behind(name, each)), key=len, default="")
