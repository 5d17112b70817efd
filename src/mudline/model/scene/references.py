"""Checks of names, labels and numbers against those that the deck defines.

They are in fields, and in lines that are not read: in these also equations, and settings whose name shows what their
value must be.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from functools import cache, cached_property
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.language.codes.fields import SYN002, SYN006
from mudline.language.codes.lines import SYN001
from mudline.language.codes.references import REF001, REF002, REF005, REF006, REF010, REF015, REF019
from mudline.language.deck.model import Opaque, raw_lines
from mudline.language.deck.parameters import NoValueError, Parameters, name_key
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import idents_given, is_read, kinds_of
from mudline.language.keywords.fields import Setting
from mudline.language.keywords.model import Block, record_schema
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Equation, Label, Names, number_meant
from mudline.language.syntax.fields import FieldGroup, read_line
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.tree import data_lines
from mudline.model.scene.context import Context
from mudline.model.scene.deck_values import file_name, find_file, not_found
from mudline.model.scene.numbering import Numbered
from mudline.model.scene.sets import Sets, sets_of_postprocessing

if TYPE_CHECKING:
    from mudline.language.keywords.library.attachments import DragChains
    from mudline.language.keywords.library.lines import LinePathSections, LineSectionGroups


CURVES = frozenset(
    {
        *(Names.MOMENT_CURVATURE, Names.FORCE_STRAIN, Names.TORQUE_TWIST, Names.STRESS_STRAIN),
        *(Names.DAMPER, Names.DRAG_LIFT, Names.PIP_STIFFNESS, Names.S_N_CURVE, Names.HARDENING),
    }
)
"""Kinds of curves except those of a seabed."""
THINGS = frozenset(
    {
        *(Names.VESSEL, Names.BODY, Names.AUXILIARY, Names.CABLE, Names.LINE, Names.SECTION_GROUP),
        *(Names.VECTOR, Names.AXIS, Names.GUIDE),
    }
)
"""Kinds of named objects that are not curves."""


def undefined(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are not defined; a warning if that is not certain, because not all was read."""
    for names in context.names_of(kinds):
        if not names.used or not (definers := catalogue.definers(names.kind)) or not context.deck.keywords():
            continue
        known = names.known
        doubt = _doubt(context, definers)
        advice = f"define it in {' or '.join(f'*{keyword}' for keyword in definers)}, or correct the name"
        for use in names.used:
            if name_key(use.name) in known or not use.name:
                continue
            message = f"{names.thing} {shown(use.name)} is not defined{context.hint(use.name, known)}: {advice}"
            severity = Severity.WARNING if doubt else None
            yield Problem(code, message + doubt, None, severity, use.where, blocks=Blocks.NEVER, lacks=use.name)


def _doubt(context: Context, definers: Collection[str]) -> str:
    """Return in words the unread line that may define an object; "" if there is none."""
    for where, _, block in context.deck.every_block():
        if block.keyword in definers and (type(block) is Opaque or not is_read(block) or context.deck.lost(where)):
            return f"; a line of *{block.keyword} that was not read may define it"
    words = (context.possible_definition(keyword) for keyword in definers)
    return next((f"; {definition}" for definition in words if definition), "")


def repeated(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are defined a second time."""
    for names in context.names_of(kinds):
        for definitions in names.defined.values():
            for later in definitions[1:]:
                message = (
                    f"{names.thing} {shown(later.name)} is already defined: choose another name, or keep one of them"
                )
                yield Problem(code, message, where=later.where)


def unused(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are not used: an info if the keywords that would use them are not read, or not in the deck."""
    for names in context.names_of(kinds):
        used = {name_key(use.name) for use in names.used}
        users = catalogue.users(names.kind)
        for key, (first, *_) in names.defined.items():
            if key in used or key in context.unread_text:
                continue
            by = f"name it in {' or '.join(f'*{keyword}' for keyword in users)}, or remove it" if users else "remove it"
            severity = None if users else Severity.INFO
            yield Problem(code, f"{names.thing} {shown(first.name)} is not used: {by}", None, severity, first.where)


def check_idents(context: Context, nodes: Numbered, elements: Numbered) -> None:
    """Report undefined nodes and elements that keywords refer to, except where nodes and sets are made."""
    for where, _, block in context.deck.every_block():
        if type(block) is Opaque or not _names_idents(type(block)):
            continue
        for kind, known in ((Names.NODE, nodes), (Names.ELEMENT, elements)):
            named = [(ident, where._replace(path=path)) for path, ident in idents_given(block, kind)]
            if named:
                check_numbers(context, kind, known, named)


@cache
def _names_idents(block: type[Block]) -> bool:
    elsewhere = block.facts.defines or block.model_fields["keyword"].default == KEYWORD
    return not elsewhere and not kinds_of(block, "names").isdisjoint((Names.NODE, Names.ELEMENT))


def check_chains(context: Context) -> None:
    """Report every GEN= of `*DRAG CHAIN` that repeats the chain of a node without one before it."""
    known: set[object] = set()
    for where, block in context.blocks("DRAG CHAIN"):
        for index, chain in enumerate(cast("DragChains", block).chains):
            generate = getattr(chain, "generate", None)
            master = getattr(chain, "node", None) if generate is None else generate.master
            if generate is None:
                known.add(master)
            elif isinstance(master, int) and master not in known and "DRAG CHAIN" not in context.unread:
                message = f"GEN= repeats the chain of a node: node {master} has none before this line; define it above"
                context.report(REF010, message, where.inside("chains", index, "generate", 0), Severity.ERROR)


KEYWORD = "BOUNDARY"
"""Keyword with its own check: some nodes of its ranges may be undefined."""


def check_numbers(context: Context, kind: Names, known: Numbered, named: Sequence[tuple[object, Where]]) -> None:
    """Report undefined nodes or elements, numbers or labels; any other value could not be read and is skipped.

    Labels of elements are checked only in a deck with `*LABEL`. Undefined elements do not keep a deck from being
    evaluated.
    """
    is_node, keyword = kind is Names.NODE, kind.name
    code, blocks = (REF006, None) if is_node else (REF005, Blocks.NEVER)
    keywords = context.deck.keywords()
    shows = len(known) > 0 or keyword in keywords
    labels = "LABEL" in keywords and not context.external_definers
    if is_node:
        labels = shows or bool(context.external_definers)
    for ident, where in named if labels else ():
        if isinstance(ident, Label) and not (is_node and context.is_guessed_label(where)):
            context.report_label(code, ident, where, keyword, blocks=blocks)
    numbers = [(ident, where) for ident, where in named if isinstance(ident, int)]
    missing = np.flatnonzero(known.indices(np.array([number for number, _ in numbers], dtype=np.int64)) < 0)
    for index in missing[: MOST_REPORTED + 1].tolist() if shows else ():
        number, where = numbers[index]
        message = f"{keyword.lower()} {number} is not defined: define it in *{keyword}, or correct the number"
        context.report_missing(code, message, where, keyword, number, blocks=blocks)


def shows_nodes(context: Context, nodes: Numbered) -> bool:
    """Return True if the deck shows nodes: a deck without any has its model somewhere else."""
    return len(nodes) > 0 or "NODE" in context.deck.keywords()


def check_lines(context: Context) -> None:
    """Report names of lines and groups in `*LINE PATH SECTIONS`: warnings at most."""
    blocks = (cast("LineSectionGroups", block) for _, block in context.blocks("LINE SECTION GROUPS"))
    groups = {name_key(group.name): group.name for block in blocks for group in block.groups if group.name}
    for where, block in context.blocks("LINE PATH SECTIONS"):
        for index, path in enumerate(cast("LinePathSections", block).paths):
            place = where.inside("paths", index)
            if path.line and "LINE PATHS" in context.external_definers:
                _check_name(context, ("LINE=", "line", "*LINE PATHS"), path.line, place.inside("line"), context.labels)
            for number, section in enumerate(path.sections):
                if section.repeat:
                    what = ("REPEAT=", "group", "*LINE SECTION GROUPS")
                    _check_name(context, what, section.repeat, place.inside("sections", number, "repeat"), groups)


def _check_name(context: Context, what: tuple[str, str, str], name: str, where: Where, known: dict[str, str]) -> None:
    """Report an undefined name, given by a KEY for an object of a keyword; `known` has the names by folded form."""
    key, thing, keyword = what
    if name_key(name) in known:
        return
    message = f"{key} names no {thing}: {shown(name)} is not defined{context.hint(name, known)}; define it in {keyword}"
    source = context.possible_definition(keyword[1:])
    context.report(REF001, f"{message}; {source}" if source else message, where, Severity.WARNING)


# ---------------------------------------------------------------------------------------------- lines that are not read

_EQUATION = re.compile(r"=\[[^\[\]\r\n]*\]")
_LONGEST = 4000
"""Number of characters of a line that is checked: a longer one is data of another kind."""
_DEFINING = ("MODEL", "LOAD CASE")
_OF_RESULTS = ("DATABASE POSTPROCESSING", "POSTPROCESSING")
_WORTH = re.compile(r"[={]|[0-9OolI]\.[0-9OolI]")
"""Pattern of a line that is checked."""
_FREE = ("NAME", Names.FILE.name)
"""Settings whose value may be any text."""
_THINGS = ("GEN", *(kind.name for kind in (Names.SET, Names.ELEMENT, Names.NODE, Names.VESSEL)))
"""Settings that begin a line about an object which has a curve."""


def check_unread_lines(context: Context, sets: Sets, nodes: Numbered | None) -> None:
    """Check every line of a deck itself that is not read, except titles and other text for people.

    `nodes` are those of the deck, None if other nodes are used.
    """
    looking, vessels = _Looking(context, sets), of_vessels(context)
    for where, keyword, line in context.unread_lines:
        holds = where[:2] in vessels
        if len(line) > _LONGEST or not (holds or _WORTH.search(line)):
            continue
        kept = catalogue.opaque_keyword(context.written.sections[where.section].name, keyword)
        if not (kept and kept.free_text):
            looking.look(where, keyword, line)
            if holds:
                looking.condition(where, keyword, line, nodes)


def of_vessels(context: Context) -> set[tuple[int, int]]:
    """Return section and block of every `*BOUNDARY` whose lines that are not read are those of TYPE=VESSEL."""
    places = {where[:2] for where, keyword, _ in context.unread_lines if keyword == KEYWORD}
    blocks = {(section, block): context.written.sections[section].blocks[block] for section, block in places}
    types = {at: {held.type_ for held in getattr(block, "types", ()) if held.unread} for at, block in blocks.items()}
    return {at for at, given in types.items() if given == {Names.VESSEL.name}}


def _uses_curve(groups: list[FieldGroup]) -> bool:
    """Return True if CURVE= of a line uses a curve: after a number, a label, or the setting of an object.

    If CURVE= comes first, it may name a new curve.
    """
    first = groups[0]
    text = first.fields[0].text
    of_object = not first.key and (read_number(text) is not None or Label.match(text) is not None)
    return any(group.key == "CURVE" for group in groups) and (first.key in _THINGS or of_object)


class _Looking:
    def __init__(self, context: Context, sets: Sets) -> None:
        self.context = context
        self.sets = sets
        self.parameters: Parameters | None = None

    def look(self, where: Where, keyword: str, line: str) -> None:
        """Check a line."""
        for match in _EQUATION.finditer(line):
            self._equation(match[0], where.inside(*match.span()))
        known = catalogue.sections_of(keyword) is not None
        _, groups, problems = read_line(line, Span(0, len(line)))
        self._keyless(where, keyword, groups)
        for problem in problems:  # an equation that is not closed; other marks may be text
            if problem.code == SYN006 and problem.span and line.startswith("=[", problem.span.start):
                self._warn(SYN006, problem.message, where.inside(*problem.span))
        for group in groups:
            for field in group.fields:
                if field.text.startswith("{") and Label.match(field.text) and self.context.external_definers:
                    self.context.report_label(REF006, field.text, where.inside(*field.span), "NODE")
                if known and group.key not in _FREE and (number := number_meant(field.text)):
                    message = f"{shown(field.text)} is not a number: write {number}"
                    self._warn(SYN002, message, where.inside(*field.span))
            value = group.fields[0]
            if not known or not group.key or not value.text or value.text.startswith("=["):
                continue
            place = where.inside(*value.span)
            if group.key == Names.SET.name:
                self._set(place, keyword, value.text)
            elif group.key == Names.VESSEL.name:
                self._vessel(place, keyword, value.text)
            elif group.key == Names.FILE.name:
                self._file(place, value.text)
            elif group.key == "CURVE" and _uses_curve(groups):
                self._curve(place, keyword, value.text)

    def condition(self, where: Where, keyword: str, line: str, nodes: Numbered | None) -> None:
        """Check the node that follows a vessel, first on its line, and the vessel if it is on the same line.

        The form of the line is not public: a node, a vessel and degrees of freedom are what decks show.
        """
        first, *others = read_line(line, Span(0, len(line))).groups[0].fields
        node = read_number(first.text)
        if (node is None and not Label.match(first.text)) or (node is not None and not node.is_integer()):
            return
        if node is not None and nodes is not None and shows_nodes(self.context, nodes):
            lacks = (nodes.indices(np.array([node])) < 0).any()
            if lacks and not self.context.possible_definition("NODE", int(node)):
                message = f"node {node:.0f} is not defined: define it in *NODE, or correct the number"
                self._warn(REF006, message, where.inside(*first.span), lacks=f"{node:.0f}")
        for field in others:
            if field.text and read_number(field.text) is None and not field.text.startswith(("=[", "{")):
                self._vessel(where.inside(*field.span), keyword, field.text)

    def _keyless(self, where: Where, keyword: str, groups: list[FieldGroup]) -> None:
        """Report a line of a keyword that is read, if the key before its first value is missing."""
        block = catalogue.block_class(self.context.written.sections[where.section].name, keyword)
        first = groups[0].fields[0]
        alone = len(groups) > 1 and not groups[0].key and len(groups[0].fields) == 1 and first.text[:1].isalpha()
        if block is None or not alone:
            return
        records = [record for slot in record_schema(block).slots for record in slot.record.values()]
        for keys in (record_schema(record).keys for record in records):
            slot = keys.get(groups[1].key)
            if slot is not None and isinstance(slot.about, Setting) and slot.about.inline:
                message = f"no line of *{keyword} begins so: write {next(iter(keys))}={first.text}"
                self._warn(SYN001, message, where.inside(*first.span))
                return

    def _warn(
        self, code: Code, message: str, where: Where, severity: Severity = Severity.WARNING, lacks: str = ""
    ) -> None:
        problem = Problem(
            code, f"{message}; the line is not read", None, severity, where, blocks=Blocks.NEVER, lacks=lacks
        )
        self.context.note(problem)

    def _equation(self, text: str, where: Where) -> None:
        self.parameters = self.parameters or Parameters(self.context.written)
        try:
            self.parameters.evaluate(Equation(text), where)
        except NoValueError as reason:
            if reason.problem:
                self.context.note(replace(reason.problem, blocks=Blocks.NEVER))

    def _set(self, where: Where, keyword: str, name: str) -> None:
        """Report an undefined set that a line names; postprocessing may have its own sets."""
        if keyword in catalogue.definers(Names.SET) or not self._is_of_model(where, keyword, _OF_RESULTS):
            return
        of_results = self.context.written.sections[where.section].name in _OF_RESULTS
        own = self._sets_of_results if of_results else {}
        if self.sets.find(name) is None and name_key(name) not in own:
            hint = self.context.hint(name, self.sets.names) or self.context.hint(name, own)
            message = f"set {shown(name)} is not defined{hint}: define it in *ELEMENT SETS"
            self._warn(REF001, message, where, lacks=name)

    @cached_property
    def _sets_of_results(self) -> dict[str, str]:
        return sets_of_postprocessing(self.context.deck)

    def _is_of_model(self, where: Where, keyword: str, more: Collection[str] = ()) -> bool:
        """Return True if a line's section uses objects of the model, or is in `more`, and its keyword makes none.

        A deck without a model is a part of a job, and so is a deck that continues another one that is not known.
        """
        section = self.context.written.sections[where.section].name
        kept = catalogue.opaque_keyword(section, keyword)
        makes = kept is not None and (kept.name_settings or kept.makes)
        shown_ = bool(self.context.deck.keywords()) and not self.context.restart
        return (section in _DEFINING or section in more) and not makes and shown_

    def _vessel(self, where: Where, keyword: str, name: str) -> None:
        definers = catalogue.definers(Names.VESSEL)
        if keyword in definers or self.context.restart or self.context.deck.keywords().isdisjoint(definers):
            return
        vessels = self.context.names(Names.VESSEL).known
        if vessels and name_key(name) not in vessels:
            message = f"vessel {shown(name)} is not defined{self.context.hint(name, vessels)}"
            self._warn(REF019, message, where, lacks=name)

    def _curve(self, where: Where, keyword: str, name: str) -> None:
        """Report an undefined curve that a line of the model or of a load case uses.

        Nothing is reported if another unread line may define it.
        """
        if not self._is_of_model(where, keyword):
            return
        key, kinds = name_key(name), (*CURVES, Names.CURVE)
        definers = {keyword for kind in kinds for keyword in catalogue.definers(kind)}
        if key not in self.curves and key not in self._other_words and self.context.unread.isdisjoint(definers):
            meant = self.context.hint(name, self.curves)
            message = f"curve {shown(name)} is not defined{meant}: correct the name, or define it"
            self._warn(REF002, message, where, lacks=name)

    @cached_property
    def curves(self) -> dict[str, str]:
        """Curves of all kinds that the deck defines, by their folded names."""
        kinds = self.context.names_of(CURVES | {Names.CURVE})
        return {key: name for names in kinds for key, name in names.known.items()}

    @cached_property
    def _other_words(self) -> set[str]:
        """Texts in unread lines that use no curve: a curve with one of these names may be defined there."""
        words: set[str] = set()
        for _, _, block in self.context.deck.every_block():
            for line in data_lines(raw_lines(block), words=True):
                worth = "CURVE" in line.upper() and len(line) <= _LONGEST
                if not worth or not _uses_curve(read_line(line, Span(0, len(line))).groups):
                    pieces = line.replace("=", ",").split(",")
                    words.update(name_key(piece) for each in pieces for piece in (each, *each.split()))
        return words

    def _file(self, where: Where, written: str) -> None:
        """Report a missing file; a path with folders of another machine is looked for like any other.

        A file of postprocessing may be one that the run makes.
        """
        folder = self.context.written.folder
        name = file_name(written)
        given = self.context.written.sections[where.section].name in catalogue.CERTAIN_SECTIONS
        if folder is None or not given or "%" in name or find_file(folder, name) is not None:
            return
        message, severity = not_found(folder, name)
        self._warn(REF015, message, where, severity)
