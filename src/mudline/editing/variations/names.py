"""Names in `*VARIATION` and `*COMBINATIONS`: their comparison, and undefined names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from mudline.basics.spelling import Effort, nearest
from mudline.language.codes.lines import SYN009, SYN010
from mudline.language.codes.references import REF001, REF013
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.parameters import DEFINING, PLACEHOLDER, Parameters, folded, unquoted
from mudline.language.diagnostics import Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import of_keys
from mudline.language.keywords.model import FieldSpec
from mudline.language.keywords.text import hint, shown, suggestion
from mudline.language.keywords.values import Names, is_unknown, known_name
from mudline.language.syntax.tree import canonical_name

if TYPE_CHECKING:
    from mudline.language.keywords.library.preprocessor import Parameters as ParameterBlock
    from mudline.language.keywords.library.preprocessor import VariedBlock


def variation_key(name: str) -> str:
    """Return the name of a variation in the form in which names are compared."""
    return folded(" ".join(unquoted(name).split()))


def keyword_of(varied: VariedBlock) -> str:
    """Return the keyword of an action."""
    return canonical_name("*" + ",".join(map(unquoted, varied.keyword or ())))


def section_of(varied: VariedBlock) -> str:
    """Return the section that an action names, or ""."""
    return canonical_name("$" + unquoted(varied.section or "").removeprefix("$"))


def placeholders(template: str) -> list[str]:
    """Return the names between `%` in a template, in order."""
    return [match[1].strip(" \t") for match in PLACEHOLDER.finditer(template)]


def filled(template: str, value_of: Callable[[str], str]) -> str:
    """Return a template with every `%name%` replaced by `value_of` the name."""
    return PLACEHOLDER.sub(lambda match: value_of(match[1].strip(" \t")), template)


def undefined_parameter(name: str, known: Iterable[str], effort: Effort, where: Where) -> Problem:
    """Return the problem of a parameter that is not among the known parameters."""
    near = suggestion(name, known, effort)
    return Problem(REF013, f"parameter {shown(name)} is not defined{near}: define it in *PARAMETERS", where=where)


def undefined_variation(name: str, known: Iterable[str], effort: Effort, where: Where) -> Problem:
    """Return the problem of a variation that is not among the known variations, whose names have no quotes."""
    name = unquoted(name)
    near = suggestion(name, known, effort)
    return Problem(REF001, f"there is no variation {shown(name)}{near}: define it in *VARIATION", where=where)


# ------------------------------------------------------------------------------------------------------ in any deck

CALLS = of_keys("VARIATIONS")
"""Predicate of the field in which a combination names variations."""


def undefined_parameters(deck: Deck) -> Iterator[Problem]:
    """Yield parameters in PARA=, or as `%name%` in a folder or file name, that `*PARAMETERS` does not define."""
    varied = (name for name in deck.names() if name.kind is Names.PARAMETER and name.role == "names")
    named = [(unquoted(name.name), name.where) for name in varied]
    for where, block in deck.blocks("COMBINATIONS", DEFINING):
        for path, _, template in block.walk(of_keys("DIRECTORY", "SUBDIRECTORY", "FILENAME")):
            named += [(name, where.inside(*path)) for name in placeholders(unquoted(template))]
    known = _parameters(deck) if named else None
    effort = Effort()
    for name, where in named:
        if known is not None and folded(name) not in known:
            yield undefined_parameter(name, known.values(), effort, where)


def undefined_variations(deck: Deck) -> Iterator[Problem]:
    """Yield variations in VARIATIONS= that no `*VARIATION` defines; an unread `*EXCEL VARIATIONS` may define any."""
    called = [
        (name, where.inside(*path))
        for where, block in deck.blocks("COMBINATIONS", DEFINING)
        for path, _, name in block.walk(CALLS)
    ]
    present = deck.keywords(DEFINING)
    if not called or "EXCEL VARIATIONS" in present or _unsure(deck, "VARIATION"):
        return
    variations = [
        known_name(variation.name) for _, block in deck.blocks("VARIATION", DEFINING) for variation in block.variations
    ]
    if None in variations:
        return
    known = {variation_key(name): unquoted(name) for name in variations if name is not None}
    effort = Effort()
    for name, where in called:
        if variation_key(name) not in known and variation_key(name) != "all":
            yield undefined_variation(name, known.values(), effort, where)


def misspelt_actions(deck: Deck) -> Iterator[Problem]:
    """Yield unknown keywords and sections in KEYWORD= and SECTION= of an action that resemble known ones."""
    of_keywords, of_sections = Effort(), Effort()
    for where, block in deck.blocks("VARIATION", DEFINING):
        for path, _, varied in block.walk(_is_action):
            keyword, section = keyword_of(varied), section_of(varied)
            place = where.inside(*path)
            given = [
                (SYN009, "keyword *", keyword, catalogue.keywords(), of_keywords, place.inside("keyword", 0)),
                (SYN010, "section $", section, catalogue.SECTIONS, of_sections, place.inside("section")),
            ]
            for code, what, name, known, effort, at in given:
                if name and name not in known and (near := nearest(name, known, effort)):
                    message = f"{what}{name} is not known{hint(near)}: correct it"
                    yield Problem(code, message, None, Severity.WARNING, at)


def _is_action(slot: FieldSpec) -> bool:
    return "varied_block" in slot.record


def _parameters(deck: Deck) -> dict[str, str] | None:
    """Return names of parameters by casefolded form; None if a line that could not be read may define more."""
    blocks: Iterable[tuple[Where, ParameterBlock]] = deck.blocks("PARAMETERS", DEFINING)
    listed = [parameter for _, block in blocks for parameter in block.parameters]
    unread = any(is_unknown(parameter.name) for parameter in listed)
    if unread or _unsure(deck, "PARAMETERS"):
        return None
    defined = {key: definition.name for key, definition in Parameters(deck).definitions.items()}
    without_value = [parameter.name for parameter in listed if is_unknown(parameter.value)]
    return {folded(name): name for name in without_value} | defined


def _unsure(deck: Deck, keyword: str) -> bool:
    """Return True if a keyword may define more: a line could not be used, or a block may have its name misspelt."""
    for where, section, block in deck.every_block():
        if block.keyword == keyword and section == DEFINING:
            if deck.lost(where):
                return True
        elif isinstance(block, Opaque) and nearest(block.keyword, [keyword]):
            return True
    return False
