"""Names, labels and numbers that fields give, against those that the deck defines."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes.fields import SYN003
from mudline.codes.lines import SYN001
from mudline.codes.references import REF001, REF005, REF006, REF010
from mudline.codes.words import SYN005
from mudline.deck.model import Deck
from mudline.deck.parameters import folded
from mudline.diagnostics import Code, Severity, Where
from mudline.keywords.kept import Names
from mudline.keywords.model import Block, names_given
from mudline.keywords.text import shown
from mudline.keywords.values import Label
from mudline.scene.context import MOST_REPORTED, Context
from mudline.scene.laws import LawTable
from mudline.scene.numbering import Numbered
from mudline.scene.opaque_names import bare, makes_labels
from mudline.scene.sets import Sets

if TYPE_CHECKING:
    from mudline.keywords.library.boundary import Boundary, FixedNode, FixedRange, FixedValues
    from mudline.keywords.library.element import ElementRows, Elements
    from mudline.keywords.library.element_sets import ElementSets
    from mudline.keywords.library.line_path_sections import LinePathSections
    from mudline.keywords.library.line_section_groups import LineSectionGroups
    from mudline.keywords.library.p_y import LateralSoil


def check_references(context: Context, sets: Sets, laws: LawTable, *, with_soil: bool) -> None:
    """Every name of a set or a curve; those of soil springs on demand."""
    for block, where, name in given_names(context.deck, Names.SET):
        if with_soil or not block.facts.soil_springs:
            sets.check(name, where)
    laws.referenced.update(folded(name) for _, _, name in given_names(context.deck, Names.CURVE))


def given_names(deck: Deck, what: Names) -> Iterator[tuple[type[Block], Where, str]]:
    """The names of a kind that the fields of a deck give: the class of their block, their place and the name."""
    for i, section in enumerate(deck.sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                for path, name in names_given(block, what):
                    yield type(block), Where(i, j, path), name


@dataclass(slots=True)
class NamedNodes:
    """Collects what names a node, number or label, and tells which of them the deck lacks."""

    context: Context
    nodes: Numbered
    numbers: list[int] = field(default_factory=list)
    places: list[Where] = field(default_factory=list)

    @property
    def judged(self) -> bool:
        """Whether the deck shows nodes at all: one without any has its model somewhere else."""
        return len(self.nodes) > 0 or "NODE" in self.context.deck.keywords()

    def add(self, node: object, where: Where) -> None:
        """Take note of a node; what is neither a number nor a label could not be read, and is no matter here."""
        if isinstance(node, Label):
            self._label(node, where)
        elif isinstance(node, int):
            self.numbers.append(node)
            self.places.append(where)

    def report(self) -> None:
        """Tell of the numbers that nothing defines."""
        missing = np.flatnonzero(self.nodes.indices(np.array(self.numbers, dtype=np.int64)) < 0)
        for index in missing[: MOST_REPORTED + 1].tolist() if self.judged else ():
            number = self.numbers[index]
            message = f"node {number} is not defined: define it in *NODE, or correct the number"
            self.context.report_missing(REF006, message, self.places[index], "NODE", number)

    def _label(self, label: Label, where: Where) -> None:
        check_label(self.context, REF006, label, where)
        if self.judged and not self.context.external_definers and not self.context.is_guessed_label(where):
            message = f"node {shown(label)} is a label, and nothing in this deck makes labelled nodes: give a number"
            self.context.report_missing(REF006, message, where, "NODE")


def check_soil(context: Context, nodes: Numbered) -> None:
    """Every NODE= of soil springs against the nodes of the deck."""
    named = NamedNodes(context, nodes)
    for where, block in context.deck.blocks_that(lambda declared: declared.facts.soil_springs):
        for i, springs in enumerate(cast("LateralSoil", block).sets):
            for j, curve in enumerate(springs.curves):
                named.add(getattr(curve, "node", None), where._replace(path=("sets", i, "curves", j, "node")))
    named.report()


_MOST_FREEDOMS = 6


def check_boundaries(context: Context, nodes: Numbered) -> None:
    """Every line of `*BOUNDARY` against the nodes of the deck and the six degrees of freedom."""
    checker = _BoundaryChecker(context, nodes)
    for where, block in context.deck.blocks("BOUNDARY", "LOAD CASE"):
        types = cast("Boundary", block).types
        if not types and not context.deck.origin.lost(where.section, where.block):
            message = "*BOUNDARY holds nothing: give TYPE= and nodes below it, or remove it"
            context.report(SYN001, message, where, Severity.WARNING)
        for i, held in enumerate(types):
            for j, entry in enumerate(held.entries):
                place = where._replace(path=("types", i, "entries", j))
                if hasattr(entry, "generate"):
                    checker.range(cast("FixedRange", entry), place)
                else:
                    checker.node(entry, place)
    checker.named.report()


class _BoundaryChecker:
    def __init__(self, context: Context, nodes: Numbered) -> None:
        self.context = context
        self.nodes = nodes
        self.named = NamedNodes(context, nodes)

    def node(self, entry: FixedNode, where: Where) -> None:
        """A node with its degree of freedom."""
        self.named.add(entry.node, where._replace(path=(*where.path, "node")))
        if _is_no_freedom(entry.dof):
            self._report_freedom(entry.dof, where._replace(path=(*where.path, "dof")))

    def range(self, entry: FixedRange, where: Where) -> None:
        """The nodes of a GEN=, and their degree of freedom."""
        place = where._replace(path=(*where.path, "generate"))
        values = cast("FixedValues | None", entry.generate)
        if values is None or self.context.deck.origin.damaged(place) or self.context.without_value(values, place):
            return
        at, step = _freedom_and_step(values)
        freedom = (values.third, values.fourth)[at - 2]
        if freedom is None:
            message = "this GEN= has no degree of freedom: write start, end [, increment], dof [, displacement]"
            self.context.report(SYN003, message, place)
        elif _is_no_freedom(freedom):
            self._report_freedom(freedom, place._replace(path=(*place.path, at)))
        start, end = values.start, values.end
        if isinstance(start, int) and isinstance(end, int) and isinstance(step, int):
            self._nodes(start, end, step, place)

    def _report_freedom(self, given: object, where: Where) -> None:
        message = f"{given} is no degree of freedom: expected 1 (vertical), 2 or 3 (horizontal), or 4 to 6 (rotations)"
        self.context.report(SYN005, message, where)

    def _nodes(self, start: int, end: int, step: int, where: Where) -> None:
        """The nodes of a range, without building it: it may be as long as a slip of the pen makes it."""
        written = f"GEN= holds the nodes from {start} to {end} in steps of {step}"
        if end < start or step < 1:
            why = "the increment must be at least 1" if step < 1 else "the end must not come before the start"
            self.context.report(REF010, f"{written}: there are none, {why}", where, Severity.ERROR)
            return
        found = len(self.nodes.between(start, end, step)) if len(self.nodes) else 0
        wanted = (end - start) // step + 1
        if found < wanted and self.named.judged and not self.context.possible_definition("NODE"):
            message = f"{written}: {wanted - found} of these {wanted} are not defined; correct it, or define them"
            self.context.report(REF006, message, where, Severity.WARNING if found else None)


def _freedom_and_step(values: FixedValues) -> tuple[int, object]:
    """Which value of a GEN= is the degree of freedom, counted from 0, and the increment.

    Of four values the third is taken for it only where the fourth cannot be one.
    """
    third, fourth = values.third, values.fourth
    if values.fifth is None and (
        fourth is None or (third is not None and _is_no_freedom(fourth) and not _is_no_freedom(third))
    ):
        return 2, 1
    return 3, 1 if third is None else third


def _is_no_freedom(freedom: object) -> bool:
    """Whether a value is no degree of freedom; one that could not be read may be one. Equations give 6.0 for 6."""
    known = isinstance(freedom, int | float) and not math.isnan(freedom)
    return known and freedom not in range(1, _MOST_FREEDOMS + 1)


_PATHS = "LINE PATHS"
_GROUPS = "LINE SECTION GROUPS"
_MARKS = re.compile(r"[0-9]+|\b\w{1,2}\b")
"""Numbers and words of one or two letters: things of a kind are told apart by them."""


def check_lines(context: Context) -> None:
    """The lines and groups that `*LINE PATH SECTIONS` names, and the labels of elements and sets: warnings at most."""
    groups = _groups(context)
    for where, block in context.deck.blocks("LINE PATH SECTIONS"):
        for index, path in enumerate(cast("LinePathSections", block).paths):
            place = where._replace(path=("paths", index))
            if path.line and _PATHS in context.external_definers:
                inner = place._replace(path=(*place.path, "line"))
                _check_name(context, ("LINE=", "line", _PATHS), path.line, inner, context.labels)
            for number, section in enumerate(path.sections):
                if section.repeat:
                    inner = place._replace(path=(*place.path, "sections", number, "repeat"))
                    _check_name(context, ("REPEAT=", "group", _GROUPS), section.repeat, inner, groups)
    for code, label, where in chain(_of_elements(context), _of_sets(context)) if context.external_definers else ():
        check_label(context, code, label, where)


def check_label(context: Context, code: Code, label: str, where: Where) -> None:
    """A label that no line names, but is spelt nearly as one that a line does, is told under a code, as a warning.

    Nothing is said of other labels: lines are not read, and may make labels in ways that are not known.
    """
    name = bare(label)
    if not context.external_definers or folded(name) in context.labels:
        return
    near = context.near(name, context.labels)
    if near and _is_slip(folded(name), near) and not context.is_guessed_label(where):
        makers = " or ".join(f"*{keyword}" for keyword in context.external_definers if makes_labels(keyword))
        message = f"label {shown(label)} does not stand in {makers} (did you mean {{{context.labels[near]}}}?)"
        context.report(code, f"{message}: correct it", where, Severity.WARNING)


def _is_slip(name: str, near: str) -> bool:
    """Whether one of two names that are spelt nearly alike is a slip of the pen: {End 2} is none of {End 1}."""
    return _MARKS.findall(name) == _MARKS.findall(near)


def _check_name(context: Context, what: tuple[str, str, str], name: str, where: Where, known: dict[str, str]) -> None:
    """A name, given by a KEY for a thing that a keyword defines; `known` has the names by their folded form."""
    key, thing, keyword = what
    if folded(bare(name)) in known:
        return
    near = context.near(name, known)
    hint = f" (did you mean {known[near]}?)" if near else ""
    message = f"{key} names no {thing}: {shown(name)} is not defined{hint}; define it in *{keyword}"
    supplier = context.possible_definition(keyword)
    context.report(REF001, f"{message}; {supplier}" if supplier else message, where, Severity.WARNING)


def _groups(context: Context) -> dict[str, str]:
    """Names of the groups of sections by their folded form."""
    blocks = (cast("LineSectionGroups", block) for _, block in context.deck.blocks(_GROUPS))
    return {folded(bare(group.name)): group.name for block in blocks for group in block.groups if group.name}


def _of_elements(context: Context) -> Iterator[tuple[Code, str, Where]]:
    """Labels of nodes."""
    for where, block in context.deck.blocks("ELEMENT"):
        for index, entry in enumerate(cast("Elements", block).entries):
            if hasattr(entry, "elements"):
                for (row, column), word in cast("ElementRows", entry).elements.words.items():
                    if isinstance(word, Label):
                        yield REF006, word, where._replace(path=("entries", index, "elements", row, column))


def _of_sets(context: Context) -> Iterator[tuple[Code, str, Where]]:
    """Labels of elements."""
    for where, block in context.deck.blocks("ELEMENT SETS"):
        for index, entry in enumerate(cast("ElementSets", block).sets):
            for number, member in enumerate(entry.members):
                for at, element in enumerate(getattr(member, "elements", None) or ()):
                    if isinstance(element, Label):
                        path = ("sets", index, "members", number, "elements", at)
                        yield REF005, element, where._replace(path=path)
