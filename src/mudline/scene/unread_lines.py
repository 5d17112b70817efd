"""What is looked at in lines that are not read: equations, and settings whose name says what their value must be."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace

from mudline.codes.references import REF001, REF006, REF015
from mudline.deck.model import Deck, Opaque
from mudline.deck.parameters import NoValueError, Parameters, folded
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Blocks, Problem, Severity, Span, Where
from mudline.keywords import catalogue
from mudline.keywords.keeping import is_read
from mudline.keywords.text import shown
from mudline.keywords.values import Equation, Label, Names
from mudline.scene.context import Context
from mudline.scene.deck_values import bare, data_lines, file_name, find_file
from mudline.scene.names import names_of
from mudline.scene.references import check_label
from mudline.scene.sets import Sets
from mudline.syntax.fields import Field, read_line

_EQUATION = re.compile(r"=\[[^\[\]\r\n]*\]")
_LONGEST = 4000
"""Characters of a line that is looked at: a longer one is data of another kind."""
_DEFINING = ("MODEL", "LOAD CASE")
_UNREAD = "; the line is not read"

Line = tuple[Where, str]


def check_unread_lines(context: Context, sets: Sets) -> None:
    """Look at every line of a deck itself that is not read."""
    looking = _Looking(context, sets)
    for where, keyword, line in unread_lines(context.written):
        if ("=" in line or "{" in line) and len(line) <= _LONGEST:
            looking.look(where, keyword, line)


def unread_lines(deck: Deck) -> Iterator[tuple[Where, str, str]]:
    """The lines of a deck itself that are not read, without comments: their place, keyword and text."""
    for i, section in enumerate(deck.own_sections):
        for j, block in enumerate(section.blocks):
            if type(block) is Opaque:
                lines = ((Where(i, j, ("lines", n)), line) for n, line in enumerate(block.lines))
            elif not is_read(block) and isinstance(deck.origin, TextOrigin):
                lines = ((Where(i, j, ("unread", n)), line) for n, line in enumerate(deck.origin.kept_lines(i, j)))
            else:
                continue
            yield from ((where, block.keyword, line) for where, line in lines if [*data_lines([line])])


class _Looking:
    def __init__(self, context: Context, sets: Sets) -> None:
        self.context = context
        self.sets = sets
        self.parameters: Parameters | None = None
        self.vessels: dict[str, str] | None = None
        self.checks: dict[str, Callable[[Where, str, str], None]] = {
            Names.SET.name: self._set,
            Names.VESSEL.name: self._vessel,
            Names.FILE.name: self._file,
        }

    def look(self, where: Where, keyword: str, line: str) -> None:
        """Look at a line."""
        for match in _EQUATION.finditer(line):
            self._equation(match[0], where.inside(*match.span()))
        known = catalogue.sections_of(keyword) is not None
        for group in read_line(line, Span(0, len(line))).groups:
            for given in group.fields:
                self._label(given, where)
            value = group.fields[0]
            if known and value.text and not value.text.startswith("=[") and (check := self.checks.get(group.key)):
                check(where.inside(*value.span), keyword, value.text)

    def _note(self, problem: Problem) -> None:
        self.context.note(replace(problem, blocks=Blocks.NEVER))

    def _equation(self, text: str, where: Where) -> None:
        self.parameters = self.parameters or Parameters(self.context.written)
        try:
            self.parameters.evaluate(Equation(text), where)
        except NoValueError as reason:
            if reason.problem:
                self._note(reason.problem)

    def _label(self, given: Field, where: Where) -> None:
        if Label.match(given.text):
            check_label(self.context, REF006, given.text, where.inside(*given.span))

    def _set(self, where: Where, keyword: str, name: str) -> None:
        """A set that a line of the model or of a load case names; in other sections it may be defined there."""
        if keyword in catalogue.definers(Names.SET) or not self._is_of_model(where, keyword):
            return
        if self.sets.find(name) is None:
            near = self.context.near(name, self.sets.named)
            hint = f" (did you mean {self.sets.named[near].name}?)" if near else ""
            message = f"set {shown(name)} is not defined{hint}: define it in *ELEMENT SETS{_UNREAD}"
            self._note(Problem(REF001, message, None, Severity.WARNING, where, lacks=name))

    def _is_of_model(self, where: Where, keyword: str) -> bool:
        """Whether a line is of a section where sets are used that the model defines, and its keyword makes none."""
        section = self.context.written.sections[where.section].name
        kept = catalogue.opaque_keyword(section, keyword)
        makes = kept is not None and (kept.name_settings or kept.makes)
        return section in _DEFINING and not makes and bool(self.context.deck.keywords())

    def _vessel(self, where: Where, keyword: str, name: str) -> None:
        definers = catalogue.definers(Names.VESSEL)
        if keyword in definers or self.context.deck.keywords().isdisjoint(definers):
            return
        if self.vessels is None:
            found = names_of(self.context.deck, {Names.VESSEL}).get(Names.VESSEL)
            self.vessels = {key: given[0].name for key, given in found.defined.items()} if found else {}
        if self.vessels and folded(bare(name)) not in self.vessels:
            from mudline.scene.checks.names import REF019  # noqa: PLC0415 - only for a finding

            message = f"vessel {shown(name)} is not defined{self.context.hint(name, self.vessels)}{_UNREAD}"
            self._note(Problem(REF019, message, None, Severity.WARNING, where, lacks=name))

    def _file(self, where: Where, _: str, written: str) -> None:
        """A file beside the deck; a path with folders of another machine is looked for as any other is."""
        folder = self.context.written.folder
        name = file_name(written)
        if folder is None or "%" in name or find_file(folder, name) is not None:
            return
        looked = f"looked in {folder.as_posix()}"
        message = f"the file {shown(name)} was not found ({looked}): correct the name, or put the file there{_UNREAD}"
        self._note(Problem(REF015, message, None, None, where))
