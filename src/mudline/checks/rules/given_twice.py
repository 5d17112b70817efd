"""Keywords and records that are given twice and may be given once."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.rules.geometry import GEO006
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.keeping import is_read
from mudline.language.keywords.model import Block, FieldSpec, Path
from mudline.language.keywords.naming import is_name
from mudline.language.keywords.text import shown
from mudline.language.rules import rule

REF022 = Code("REF022", "given-twice", Severity.WARNING)


@rule(REF022)
def given_twice(context: LintContext) -> Iterator[Problem]:
    """A keyword that may be given once is given twice, or two records have the same set, vessel or heading.

    So are two records with the same frequency or depth. A run takes one of the two, and a change of the unused one has
    no effect. Mostly a copied block kept its first name. Of two sections or coefficients of a set the later one is
    used; for the others this is not documented. Remove one of them, or correct its name. Sets, curves, nodes, elements
    and seabed laws have their own rules.

    Example:
         $MODEL
         *OCEAN
          500.0, 1025.0, 9.81
        -*OCEAN
        - 450.0, 1025.0, 9.81

    Finds: 4:1
    """
    deck = context.scene.deck
    for i, section in enumerate(deck.own_sections):
        seen: set[object] = set()
        for j, block in enumerate(section.blocks):
            if not isinstance(block, Block):
                continue
            if block.facts.once and block.keyword in seen and is_read(block):
                message = f"*{block.keyword} already stands in this ${section.name}: remove one of the two"
                yield Problem(REF022, message, where=Where(i, j))
            seen.add(block.keyword)
            for path, slot, value in block.walk(_is_unique):
                known = is_name(value) or (isinstance(value, int | float) and math.isfinite(value))
                key = (block.keyword, *_list_of(path, j), slot.name, name_key(str(value)))
                if known and value != "" and key in seen:
                    yield Problem(REF022, _words(slot, value, block), where=Where(i, j, path))
                seen.add(key)


def _is_unique(slot: FieldSpec) -> bool:
    return slot.about.unique


def _list_of(path: Path, block: int) -> Path:
    """Return the path of the list whose records a field distinguishes; a list may go on in the next block."""
    return path[:-2] if len(path) <= len(("records", 0, "field")) else (block, *path[:-2])


def _words(slot: FieldSpec, value: object, block: Block) -> str:
    held = "the later one holds" if block.facts.later_wins else "which of them holds is not documented"
    words = shown(value) if isinstance(value, str) else f"{value:g}"
    label = f"{slot.key}={words}" if slot.key else f"{slot.label} {words}"
    return f"{label} is already given in *{block.keyword}, and {held}: remove one of the two, or correct it"


@joint(GEO006)
def said_of_the_section(_: LintContext, found: Found) -> Iterator[Joined]:
    """Join a repeated section of a set to the finding that another set has none."""
    for problem in found[GEO006.code]:
        same = [repeat for repeat in found.get(REF022.code, ()) if repeat.where == problem.where]
        if same:
            yield Joined(problem, same)
