"""Parts of a deck that a variation changes: values of its parameters, and blocks that actions add or remove."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple, cast

from mudline.basics.files import reason
from mudline.basics.limits import LARGEST_FILE
from mudline.basics.outside import without_text
from mudline.basics.spelling import Effort
from mudline.editing.variations.names import keyword_of, section_of, undefined_parameter
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import DEFINING, Definition, Parameters, folded, list_items, unquoted
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem, Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.library.preprocessor import VariedBlock
from mudline.language.keywords.text import shown, suggestion
from mudline.language.keywords.values import Equation
from mudline.language.syntax.fields import is_one_field
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import LeafKind, parse
from mudline.model.scene.deck_values import find_file, not_found

Values = Mapping[str, str]
"""Values as written in `*PARAMETERS`, by the name of the parameter there."""


class ParameterTarget(NamedTuple):
    """A parameter: its name and the text of its value, both as written, and the place of the value."""

    name: str
    text: str
    span: Span
    in_list: bool = False

    def field(self, value: str) -> str | None:
        """Return a value as written in place of the old one, or None if it cannot be written there."""
        field = parameter_field(value)
        bare = field is not None and field == unquoted(field) and Equation.match(field) is None
        if not self.in_list or not bare or read_number(value) is not None:
            return field
        return f'"{field}"'  # a colon or a slash would mean something else in a list


class ParameterTargets:
    """Parameters of a deck that was read from text; the last of several with the same name applies."""

    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.parameters = Parameters(deck)
        self._targets: dict[str, ParameterTarget] = {}
        self._effort = Effort()

    def target(self, name: str) -> ParameterTarget:
        """Return a parameter that is known to exist."""
        key = folded(name)
        if key not in self._targets:
            self._targets[key] = self._written(self.parameters.definitions[key])
        return self._targets[key]

    def _written(self, definition: Definition) -> ParameterTarget:
        where, origin = definition.where, cast("TextOrigin", self.deck.origin)
        span = cast("Span", origin.span(where))
        text = origin.source.text[slice(*span)]
        if not text.startswith("/"):
            return ParameterTarget(definition.name, text, span)
        prefix = self.deck.at(where._replace(path=(*where.path[:-1], "name")))
        item = next(item for item in reversed(list_items(prefix, text)[0]) if item.name == definition.name)
        start = span.start + item.start
        return ParameterTarget(item.name, item.value, Span(start, start + len(item.value)), in_list=True)

    def undefined(self, name: str, where: Where) -> Problem | None:
        """Return the problem of a name that is not a parameter, else None."""
        known = self.parameters.definitions
        if folded(name) in known:
            return None
        return undefined_parameter(name, (definition.name for definition in known.values()), self._effort, where)

    def in_a_name(self, name: str, values: Values) -> str | None:
        """Return a parameter's value for a file name: as written, unquoted; None for an equation without a value."""
        target = self.target(name)
        written = values.get(target.name, target.text)
        if Equation.match(written) is None:
            return unquoted(written)
        evaluated = Parameters(self.deck, values).values.get(folded(name))
        if isinstance(evaluated, float) and evaluated.is_integer() and abs(evaluated) < 1e15:
            return str(int(evaluated))
        return None if evaluated is None else str(evaluated)


def parameter_field(text: str) -> str | None:
    """Return a value as a field of `*PARAMETERS`, quoted if it has blanks or commas; None if it cannot be written."""
    if read_number(text) is not None or Equation.match(text):
        return text
    if not text:
        return None
    if is_one_field(text) and (unquoted(text) != text or not (set(text) & set(' \t"') or text[0] in "/=")):
        return text
    return None if '"' in text else f'"{text}"'


# -------------------------------------------------------------------------------------------------------------- actions


class Addition(NamedTuple):
    """Lines to add at the end of a section, each with a LF."""

    section: int
    text: str


Removal = frozenset[tuple[int, int]]
"""Blocks to leave out, by section and block."""
Action = Removal | Addition


class RefusedError(Exception):
    """Reason why an action cannot be carried out."""


def action_of(deck: Deck, varied: VariedBlock) -> Action:
    """Return the effect of an ACTION= line on a deck that was read from text; raises RefusedError."""
    keyword = keyword_of(varied)
    if DEFINING in (catalogue.sections_of(keyword) or ()):
        raise RefusedError(f"*{keyword} describes the decks: a variation cannot add or remove it")
    section = _section(deck, varied, keyword)
    if varied.action != "REMOVE":
        return _addition(deck, varied, keyword, section)
    blocks = [(where, block.keyword) for where, name, block in deck.every_block() if name == section]
    gone = Removal((where.section, where.block) for where, name in blocks if name == keyword)
    if not gone:
        hint = suggestion(keyword, {name for _, name in blocks})
        raise RefusedError(f"${section} has no *{keyword}{hint} that could be removed")
    return gone


def _section(deck: Deck, varied: VariedBlock, keyword: str) -> str:
    """Return the section of an action, which the deck has."""
    there = [section.name for section in deck.sections]
    if varied.section is not None:
        name = section_of(varied)
    else:
        belongs = catalogue.sections_of(keyword) or ()
        if len(belongs) != 1:
            known = " or ".join(f"${name}" for name in belongs)
            raise RefusedError(f"missing SECTION= for *{keyword}{f': {known}' if known else ''}")
        name = belongs[0]
    if name not in there:
        raise RefusedError(f"the deck has no section ${name}{suggestion(name, there)} for *{keyword}")
    return name


def _addition(deck: Deck, varied: VariedBlock, keyword: str, section: str) -> Addition:
    last = max(index for index, deck_section in enumerate(deck.sections) if deck_section.name == section)
    if varied.file is None:
        return Addition(last, f"*{keyword}\n")
    if deck.folder is None:
        given = f"FILE={varied.file} lies beside the deck, which came from standard input"
        raise RefusedError(f"{given}: give the deck as a file")
    path = find_file(deck.folder, varied.file)
    if path is None:
        why, severity = not_found(deck.folder, unquoted(varied.file))
        gone = f"file {shown(unquoted(varied.file))} was not found beside the deck"
        raise RefusedError(why if severity is Severity.ERROR else gone)
    try:
        text = _block_text(_content(path, varied.file), keyword)
    except RefusedError as error:
        raise RefusedError(without_text(str(error), path, deck.folder)) from error
    try:
        text.encode(cast("TextOrigin", deck.origin).source.encoding)
    except UnicodeEncodeError as error:
        raise RefusedError(f"{varied.file} holds {text[error.start]!r}, which the encoding of the deck lacks") from None
    return Addition(last, text)


def _content(path: Path, name: str) -> Source:
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise RefusedError(f"{name} has more than {LARGEST_FILE // 10**6} million bytes: expected a block")
        source = Source.from_bytes(path.read_bytes(), name)
    except OSError as error:
        raise RefusedError(f"{name} cannot be read: {reason(error)}") from error
    faults = [problem.message for problem in source.problems if problem.weight is Severity.ERROR]
    if faults:
        raise RefusedError(f"{name}: {faults[0]}")
    return source


def _block_text(source: Source, keyword: str) -> str:
    """Return the lines of a file as blocks of a keyword, with the keyword line added if the file has none."""
    tree = parse(source)
    if tree.sections:
        raise RefusedError(f"{source.name} opens the section ${tree.sections[0].name}: expected only the block")
    others = [block.name for block in tree.preamble.blocks if block.name != keyword]
    if others:
        raise RefusedError(f"{source.name} holds *{others[0]}, expected *{keyword} only")
    text = source.unified.replace("\r\n", "\n")
    text = text if text.endswith("\n") or not text else f"{text}\n"
    if all(leaf.kind in (LeafKind.BLANK, LeafKind.COMMENT) for leaf in tree.preamble.leaves) and tree.preamble.blocks:
        return text
    return f"*{keyword}\n{text}"
