"""Names in `*VARIATION` and `*COMBINATIONS` that lead nowhere, found in any deck without planning what it describes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple, cast

from mudline.codes.references import REF001, REF013
from mudline.codes.words import SYN009, SYN010
from mudline.deck.model import Deck, Opaque
from mudline.deck.parameters import Parameters, folded
from mudline.diagnostics import Problem, Severity, Where
from mudline.keywords import catalogue
from mudline.keywords.text import hint, shown, suggestion
from mudline.spelling import Effort, nearest
from mudline.syntax.tree import canonical_name
from mudline.variations.names import name_key, placeholders, unquoted

if TYPE_CHECKING:
    from mudline.keywords.library.combinations import Combinations
    from mudline.keywords.library.parameters import Parameters as ParameterBlock
    from mudline.keywords.library.variation import Variation, VariedBlock

_SECTION = "PREPROCESSOR"
_ALL = "all"


class _Named(NamedTuple):
    """A name, and where it stands."""

    name: str
    where: Where


def undefined_parameters(deck: Deck) -> Iterator[Problem]:
    """What PARA= and a `%name%` of a folder or file name, and `*PARAMETERS` does not define."""
    named = [*_varied(deck), *_in_names(deck)]
    known = _parameters(deck) if named else None
    effort = Effort()
    for name, where in named:
        if known is not None and folded(name) not in known:
            near = suggestion(name, known.values(), effort)
            message = f"parameter {shown(name)} is not defined{near}: define it in *PARAMETERS"
            yield Problem(REF013, message, where=where)


def undefined_variations(deck: Deck) -> Iterator[Problem]:
    """What VARIATIONS= calls and no `*VARIATION` defines; `*EXCEL VARIATIONS`, which is not read, may define it."""
    called = list(_called(deck))
    present = deck.keywords(_SECTION)
    if not called or "EXCEL VARIATIONS" in present or _unsure(deck, "VARIATION"):
        return
    variations = [
        cast("str | None", variation.name) for _, block in _variations(deck) for variation in block.variations
    ]
    if None in variations:
        return
    known = {name_key(name): unquoted(name) for name in variations if name is not None}
    effort = Effort()
    for name, where in called:
        if name_key(name) not in known and name_key(name) != _ALL:
            near = suggestion(unquoted(name), known.values(), effort)
            message = f"there is no variation {shown(unquoted(name))}{near}: define it in *VARIATION"
            yield Problem(REF001, message, where=where)


def misspelt_keywords(deck: Deck) -> Iterator[Problem]:
    """What KEYWORD= of an action says and is not known, but spelt nearly as a keyword that is: a warning."""
    effort = Effort()
    for varied, where in _actions(deck):
        words = cast("list[str] | None", varied.keyword) or ()
        name = canonical_name("*" + ",".join(map(unquoted, words)))
        if near := _meant(name, catalogue.keywords(), effort):
            message = f"keyword *{name} is not known{hint(near)}: correct it"
            yield Problem(SYN009, message, None, Severity.WARNING, where._replace(path=(*where.path, "keyword", 0)))


def misspelt_sections(deck: Deck) -> Iterator[Problem]:
    """What SECTION= of an action says and is not known, but spelt nearly as a section that is: a warning."""
    effort = Effort()
    for varied, where in _actions(deck):
        name = canonical_name("$" + unquoted(varied.section or "").removeprefix("$"))
        if near := _meant(name, catalogue.SECTIONS, effort):
            message = f"section ${name} is not known{hint(near)}: correct it"
            yield Problem(SYN010, message, None, Severity.WARNING, where._replace(path=(*where.path, "section")))


def _meant(name: str, known: Collection[str], effort: Effort) -> str:
    """The known name that is spelt nearly as one that is not known, or ""."""
    return "" if not name or name in known else nearest(name, known, effort)


def _actions(deck: Deck) -> Iterator[tuple[VariedBlock, Where]]:
    for where, block in _variations(deck):
        for i, variation in enumerate(block.variations):
            for j, varied in enumerate(variation.blocks):
                yield varied, where._replace(path=("variations", i, "blocks", j))


def _variations(deck: Deck) -> Iterable[tuple[Where, Variation]]:
    return deck.blocks("VARIATION", _SECTION)


def _combinations(deck: Deck) -> Iterable[tuple[Where, Combinations]]:
    return deck.blocks("COMBINATIONS", _SECTION)


def _varied(deck: Deck) -> Iterator[_Named]:
    """The parameters that vary."""
    for where, block in _variations(deck):
        for i, variation in enumerate(block.variations):
            for j, varied in enumerate(variation.parameters):
                if cast("str | None", varied.parameter) is not None:
                    path = ("variations", i, "parameters", j, "parameter")
                    yield _Named(unquoted(varied.parameter), where._replace(path=path))


def _in_names(deck: Deck) -> Iterator[_Named]:
    """The parameters in names of folders and files."""
    for where, block in _combinations(deck):
        given: list[tuple[str | None, tuple[str | int, ...]]] = [(block.directory, ("directory",))]
        for i, combination in enumerate(block.combinations):
            path = ("combinations", i)
            given.append((combination.subdirectory, (*path, "subdirectory")))
            given.append((combination.filename, (*path, "filename")))
        for text, place in given:
            for name in placeholders(unquoted(text or "")):
                yield _Named(name, where._replace(path=place))


def _called(deck: Deck) -> Iterator[_Named]:
    """The variations that combinations call."""
    for where, block in _combinations(deck):
        for i, combination in enumerate(block.combinations):
            for j, line in enumerate(combination.variations):
                for number, name in enumerate(cast("list[str] | None", line.names) or ()):
                    path = ("combinations", i, "variations", j, "names", number)
                    yield _Named(name, where._replace(path=path))


def _parameters(deck: Deck) -> dict[str, str] | None:
    """Names of parameters by their folded form; None where a line that could not be read may define more."""
    blocks: Iterable[tuple[Where, ParameterBlock]] = deck.blocks("PARAMETERS", _SECTION)
    listed = [parameter for _, block in blocks for parameter in block.parameters]
    unread = any(cast("str | None", parameter.name) is None for parameter in listed)
    if unread or _unsure(deck, "PARAMETERS"):
        return None
    defined = {key: found.name for key, found in Parameters(deck).definitions.items()}
    without_value = [parameter.name for parameter in listed if cast("object", parameter.value) is None]
    return {folded(name): name for name in without_value} | defined


def _unsure(deck: Deck, keyword: str) -> bool:
    """Whether a line of a keyword could not be used, or a block with a misspelt name may be meant for one."""
    for i, section in enumerate(deck.sections):
        for j, block in enumerate(section.blocks):
            if block.keyword == keyword and section.name == _SECTION:
                if deck.origin.lost(i, j):
                    return True
            elif isinstance(block, Opaque) and nearest(block.keyword, [keyword]):
                return True
    return False
