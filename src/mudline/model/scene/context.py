"""Shared state of resolving a deck: the evaluated deck, and the list of problems."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import counted, short_repr
from mudline.basics.spelling import Effort, edits, equally_near, nearest, same_marks
from mudline.language.codes.fields import SYN016
from mudline.language.deck.model import Deck, NamedPlace, Opaque, raw_lines, unread_lines
from mudline.language.deck.parameters import EvaluatedDeck, all_labels_read, bare, folded, labels_given, name_key
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import MORE, Blocks, Code, Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.catalogue import meant_in, suggest_keyword
from mudline.language.keywords.model import ListRow
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.text import hint, shown
from mudline.language.keywords.values import Names
from mudline.language.syntax.tree import canonical_name, is_comment, mark_of
from mudline.model.scene.deck_values import (
    definition_by,
    first_written,
    is_read_definer,
    makes,
    makes_labels,
    sets_in,
    texts_in,
)

if TYPE_CHECKING:
    from mudline.language.keywords.library.curvilinear import CurvilinearNodes
    from mudline.language.keywords.library.seabed_properties import Surface

MOST_NAMED = 3
"""Number of names listed in a message, each of which may be the one that was meant."""

_NUMBERED = {"NODE": "node", "ELEMENT": "element"}
"""Keywords whose objects have numbers."""


class _Uses(NamedTuple):
    """Uses of objects of a kind that the deck does not show: code, number and place of the first, count, and effect."""

    code: Code
    first: int | None
    where: Where
    times: int = 0
    blocks: Blocks = Blocks.NEVER


@dataclass(eq=False)
class NamesOfKind:
    """Names of a kind: those that fields use, and those that they define, by their folded form."""

    kind: Names
    used: list[NamedPlace] = field(default_factory=list)
    defined: dict[str, list[NamedPlace]] = field(default_factory=dict)

    @property
    def thing(self) -> str:
        """Object of the kind, in words."""
        return self.kind.value.removeprefix("a ").removeprefix("an ")

    @property
    def known(self) -> dict[str, str]:
        """Defined names, as first written, by their folded form."""
        return {key: given[0].name for key, given in self.defined.items()}


@dataclass(repr=False, eq=False)
class Context:
    """Evaluated deck, deck as written, and the problems found while resolving it.

    unread: keywords with a part that could not be used and defines nodes, elements, sets or curves.
    doubtful: first and last number that a faulty GEN= may have been meant to define, by keyword.
    excused: undefined numbers that an unreadable number of a node or an element may be, by its place.
    """

    deck: EvaluatedDeck
    written: Deck
    problems: list[Problem] = field(default_factory=list)
    unread: set[str] = field(default_factory=set)
    doubtful: dict[str, list[tuple[int, int]]] = field(default_factory=dict)
    excused: dict[Where, set[int]] = field(default_factory=dict)
    _misread: dict[str, list[tuple[Where, str]]] = field(default_factory=dict)
    _reported: dict[str, int] = field(default_factory=dict)
    _placeless: set[tuple[int, int]] = field(default_factory=set)
    _out_of_sight: dict[tuple[str, str], _Uses] = field(default_factory=dict)
    _effort: Effort = field(default_factory=Effort)

    __repr__ = short_repr

    def __post_init__(self) -> None:
        if self.deck.problems or self.deck.bases:
            self.unread |= {block.keyword for where, _, block in self.deck.every_block() if self.deck.lost(where)}

    def blocks(self, keyword: str, section: str = "MODEL") -> Sequence[tuple[Where, Any]]:
        """Return `Deck.blocks` of the evaluated deck, found once for all callers."""
        return self.placed.get((section, keyword), ())

    def records(self, keyword: str, name: str = "sets", section: str = "MODEL") -> list[tuple[Where, Any]]:
        """Return `records_of` the same blocks."""
        return records_of(self.blocks(keyword, section), name)

    @cached_property
    def placed(self) -> dict[tuple[str, str], list[tuple[Where, Any]]]:
        """Blocks of every section and keyword."""
        return placed_blocks(self.deck)

    @cached_property
    def _names(self) -> dict[Names, NamesOfKind]:
        """Names that the fields of the deck give, by kind in the order of `Names`."""
        by_kind: dict[Names, NamesOfKind] = {}
        for place in self.deck.names():
            names = by_kind.get(place.kind) or by_kind.setdefault(place.kind, NamesOfKind(place.kind))
            if place.role == "names":
                names.used.append(place)
            else:
                names.defined.setdefault(name_key(place.name), []).append(place)
        return {kind: by_kind[kind] for kind in Names if kind in by_kind}

    def names(self, kind: Names) -> NamesOfKind:
        """Return the names of a kind that the fields of the deck give."""
        return self._names.get(kind) or NamesOfKind(kind)

    def names_of(self, kinds: Collection[Names]) -> list[NamesOfKind]:
        """Return the same for those of some kinds that the fields of the deck name."""
        return [names for kind, names in self._names.items() if kind in kinds]

    @cached_property
    def unread_lines(self) -> list[tuple[Where, str, str]]:
        """Lines of the deck itself that are not read, without comments: place, keyword and text."""
        return [
            (where._replace(path=path), block.keyword, line)
            for where, _, block in self.written.alone.every_block()
            for path, line in unread_lines(block)
            if not is_comment(line, words=True)
        ]

    @cached_property
    def unread_text(self) -> str:
        """Lines that are not read, also those of continued decks, in the form in which names are compared."""
        return "\n".join(folded(line) for _, _, block in self.deck.every_block() for line in raw_lines(block))

    @cached_property
    def surfaces(self) -> list[tuple[Where, Surface]]:
        """Rigid surfaces of the deck, then the elastic ones, each in the order of the file; the last one is used."""
        surfaces = self.deck.blocks_with("seabed_type")
        return sorted(surfaces, key=lambda placed: placed[1].facts.seabed_type == "ELASTIC")

    def report(self, code: Code, message: str, where: Where, severity: Severity | None = None) -> None:
        """Add a problem."""
        self.note(Problem(code, message, None, severity, where))

    def note(self, problem: Problem) -> None:
        """Add a problem, unless there are very many of its code already."""
        code = problem.code.code
        count = self._reported[code] = self._reported.get(code, 0) + 1
        if count <= MOST_REPORTED:
            self.problems.append(problem)
        elif count == MOST_REPORTED + 1:
            self.problems.append(replace(problem, message=MORE))

    def report_missing(
        self,
        code: Code,
        message: str,
        where: Where,
        keyword: str,
        lacks: int | str | None = None,
        *,
        blocks: Blocks | None = None,
    ) -> None:
        """Add a name or number that is not defined; nodes and elements out of sight are added together at the end.

        `lacks` is the missing object, None if it is not a single one. A number is not missing if an unreadable number
        becomes equal to it by one edit.
        """
        if isinstance(lacks, int):
            places = [at for at, written in self._misread.get(keyword, ()) if edits(written, str(lacks), 1) <= 1]
            for at in places:
                self.excused.setdefault(at, set()).add(lacks)
            if places:
                return
        number = lacks if isinstance(lacks, int) else None
        unread = (name for name in self.external_definers if not (is_read_definer(name) or makes_labels(name)))
        definer = next((name for name in unread if self._definition_by(name, keyword, number)), "")
        if keyword in _NUMBERED and definer:
            use = self._out_of_sight.get((definer, keyword), _Uses(code, number, where))
            use = use._replace(times=use.times + 1, blocks=blocks or use.blocks)
            self._out_of_sight[definer, keyword] = use
        elif self._reported.get(code.code, 0) <= MOST_REPORTED:
            self.note(replace(self.missing(code, message, where, keyword, lacks), blocks=blocks))

    def report_label(self, code: Code, label: str, where: Where, keyword: str, blocks: Blocks | None = None) -> None:
        """Add a label of a node or an element that is not defined.

        Lines that are not read may make labels in ways that are not known: in a deck with such lines a label is only
        added, as a warning, if it is spelt nearly as a label in them.
        """
        if self.external_definers:
            name = bare(label)
            near = "" if folded(name) in self.labels else self.near(name, self.labels)
            if near and same_marks(name, near) and not self.is_guessed_label(where):
                makers = " or ".join(f"*{keyword}" for keyword in self.external_definers if makes_labels(keyword))
                makers += " or *LABEL" if "LABEL" in self.deck.keywords() else ""
                message = f"label {shown(label)} is not in {makers} (did you mean {{{self.labels[near]}}}?)"
                self.report(code, f"{message}: correct it", where, Severity.WARNING)
            return
        if not all_labels_read(self.written):
            return
        thing = _NUMBERED[keyword]
        known = labels_given(self.written, Names[keyword])
        what = f"{thing} {shown(label)} is a label, and nothing in this deck makes labelled {thing}s"
        if known:
            what = f"{thing} label {shown(label)} is not defined{self.hint(bare(label), known)}"
        message = f"{what}: define it in *LABEL, or give a number"
        self.report_missing(code, message, where, "LABEL", blocks=blocks)

    def misread(self, keyword: str, where: Where) -> None:
        """Remember the place of an unreadable number of a node or an element."""
        origin = self.deck.origin if where.section < len(self.deck.own_sections) else None
        span = origin.span(where) if isinstance(origin, TextOrigin) else None
        written = origin.source.unified[slice(*span)] if isinstance(origin, TextOrigin) and span else ""
        if not written or written.startswith("=") or "," in written:
            self.unread.add(keyword)
        else:
            self._misread.setdefault(keyword, []).append((where, written))

    def report_out_of_sight(self) -> None:
        """Add, once for each unread keyword, how often the deck uses objects that it may define."""
        for (definer, keyword), use in self._out_of_sight.items():
            thing = _NUMBERED[keyword]
            first = "" if use.first is None else f" (first: {thing} {use.first})"
            message = (
                f"*{definer} may define {thing}s that this deck does not show: {counted(use.times, 'use')} of such "
                f"{thing}s{first} cannot be checked"
            )
            own = self.written.alone.every_block()
            blocks = (where for where, name, block in own if (name, block.keyword) == ("MODEL", definer))
            where = next(blocks, use.where)
            self.note(Problem(use.code, message, None, Severity.INFO, where, None, use.blocks))

    def _definition_by(self, definer: str, keyword: str, number: int | None) -> str:
        """Return in words how a definer may define an object; "" if it cannot, or has other numbers."""
        words = definition_by(definer, keyword)
        known = words and number is not None and catalogue.facts_of(definer).out_of_sight
        placed = self._on_cables if known else None
        return "" if placed is not None and not any(number in numbers for numbers in placed) else words

    @cached_property
    def _on_cables(self) -> list[range] | None:
        """Numbers of the nodes on cables, in ranges; None if some of them are not known."""
        ranges: list[range] = []
        for where, block in self.blocks("NODE,CURVILINEAR"):
            for entry in cast("CurvilinearNodes", block).entries:
                if hasattr(entry, "nodes"):
                    numbers = entry.nodes.column(0).tolist()
                    ranges += [range(int(number), int(number) + 1) for number in numbers if math.isfinite(number)]
                    readable = all(map(math.isfinite, numbers))
                else:
                    start, end, step = entry.generate.start, entry.generate.end, entry.generate.increment or 1
                    readable = False
                    if isinstance(start, int) and isinstance(end, int) and isinstance(step, int) and step > 0:
                        readable = True
                        ranges.append(range(start + step, end, step))
                if not readable or self.deck.lost(where):
                    return None
        return ranges

    def missing(self, code: Code, message: str, where: Where, keyword: str, lacks: int | str | None = None) -> Problem:
        """Return the problem of an undefined name or number: a warning if something unread could define it."""
        name = "" if lacks is None else str(lacks)
        if source := self.possible_definition(keyword, lacks if isinstance(lacks, int) else None):
            cause = keyword if source == self._misplaced_definition(keyword) else ""
            message = f"{message}; {source}"
            return Problem(code, message, None, Severity.WARNING, where, maybe_defined_by=cause, lacks=name)
        return Problem(code, message, where=where, lacks=name)

    def possible_definition(self, keyword: str, number: int | None = None) -> str:
        """Return in words what could define a missing object of a keyword, or ""; `number` None stands for any."""
        if keyword == "ELEMENT SETS" and (lost := catalogue.in_order(filter(is_read_definer, self.unread))):
            return f"a line of *{lost[0]} that could not be used may define it"
        definitions = (self._definition_by(definer, keyword, number) for definer in self.external_definers)
        if words := next(filter(None, definitions), ""):
            return words
        if self.restart:
            return "the deck that *RESTART continues may define it"
        if keyword in self.unread or (number is None and keyword in self._misread):
            return f"a line of *{keyword} that could not be used may define it"
        if any(number is None or low <= number <= high for low, high in self.doubtful.get(keyword, ())):
            return f"a GEN= of *{keyword} that could not be used may define it"
        return self._misplaced_definition(keyword)

    def _misplaced_definition(self, keyword: str) -> str:
        return f"{self.misplaced[keyword][0]} may define it" if keyword in self.misplaced else ""

    def hint(self, word: str, names: Mapping[str, str]) -> str:
        """Return ` (did you mean X?)` for the names spelt nearly as `word`, or ""; the keys of `names` are folded.

        If several names are equally close, all of them are named.
        """
        near = equally_near(folded(word), names, self._effort)
        return hint(" or ".join(names[each] for each in near[:MOST_NAMED]), word)

    def near(self, word: str, known: Collection[str]) -> str:
        """Return the name among `known`, all of them folded, that is spelt nearly as `word`, or ""."""
        return nearest(folded(word), known, self._effort)

    def generator(self, row: ListRow) -> tuple[int, int, int] | None:
        """Return the three values of a GEN=, the last one 1 unless given; None if one of them is not known."""
        values = [getattr(row, name) for name in type(row).model_fields]
        if values[2] is None:
            values[2] = 1
        usable = all(isinstance(value, int) and abs(value) <= LARGEST_WHOLE for value in values)
        return (values[0], values[1], values[2]) if usable else None

    def is_guessed_label(self, where: Where) -> bool:
        """Return True if the label at this place was guessed from a word without braces, which is reported."""
        return self._position(where) in self._guessed_labels

    def cannot_place(self, where: Where) -> None:
        """Remember that an element ends at the label at this place, and that no node with that label is known."""
        self._placeless.add(self._position(where))

    def of_deck(self) -> list[Problem]:
        """Return the problems of reading the deck; guessed labels that elements end at are errors."""
        if not self._placeless:
            return self.deck.problems
        return [
            replace(problem, severity=Severity.ERROR)
            if problem.code == SYN016 and self._position(problem) in self._placeless
            else problem
            for problem in self.deck.problems
        ]

    def _position(self, problem: Problem | Where) -> tuple[int, int]:
        """Return line and column of a problem or a value."""
        place = self.deck.place(problem)
        return place.line, place.column

    @cached_property
    def external_definers(self) -> list[str]:
        """Keywords of the model that make nodes, elements or sets which the deck does not show; unread ones first."""
        keywords = catalogue.in_order(keyword for keyword in self.deck.keywords() if makes(keyword))
        return sorted(keywords, key=is_read_definer)

    @cached_property
    def restart(self) -> bool:
        """True if the deck continues another one that is not known."""
        return self.deck.incomplete if self.deck.bases else "RESTART" in self.deck.keywords("LOAD CASE")

    @cached_property
    def _guessed_labels(self) -> set[tuple[int, int]]:
        return {self._position(problem) for problem in self.deck.problems if problem.code == SYN016}

    @cached_property
    def misplaced(self) -> dict[str, tuple[str, Where]]:
        """Keywords that are not read at their place: outside any section, in a wrong section, or misspelt.

        Each has the first of its places, and that place in words.
        """
        outside = [canonical_name(line) for line in self.deck.preamble if mark_of(line) == "*"]
        keywords = {name: (f"the *{name} before the first section", Where()) for name in outside}
        places: dict[tuple[str, str], Where] = {}
        for where, section, block in self.deck.every_block():
            if isinstance(block, Opaque):
                places.setdefault((section, block.keyword), where)
        effort = Effort()
        for (name, keyword), where in places.items():
            for likely, words in self._meant(name, keyword, effort):
                keywords.setdefault(likely, (words, where))
        return keywords

    def _meant(self, section: str, keyword: str, effort: Effort) -> Iterator[tuple[str, str]]:
        sections = catalogue.sections_of(keyword)
        if sections is None and section == "MODEL":
            yield suggest_keyword(keyword, effort=effort), f"*{keyword}, which is not known,"
        elif sections and section not in sections:
            for name in (keyword, meant_in(keyword, section)):
                yield name, f"the *{keyword} in ${section}, where it does not belong,"

    @cached_property
    def opaque_set_names(self) -> dict[str, str]:
        """Names of the element sets that lines make, by their folded form."""
        return first_written(self.deck, sets_in) if self.external_definers else {}

    @cached_property
    def labels(self) -> dict[str, str]:
        """Possible labels of nodes that lines make, and those of `*LABEL`, by their folded form."""
        return first_written(self.deck, texts_in) | labels_given(self.written, Names.NODE)


def placed_blocks(deck: Deck) -> dict[tuple[str, str], list[tuple[Where, Any]]]:
    """Return the same as `Deck.blocks` for every section and keyword."""
    blocks: dict[tuple[str, str], list[tuple[Where, Any]]] = {}
    own = len(deck.own_sections)
    for where, section, block in sorted(deck.every_block(), key=lambda placed: placed[0].section < own):
        if type(block) is not Opaque:  # isinstance of a model takes several times as long
            blocks.setdefault((section, block.keyword), []).append((where, block))
    return blocks


def records_of(blocks: Iterable[tuple[Where, Any]], name: str = "sets") -> list[tuple[Where, Any]]:
    """Return every record in a list of some blocks, by default what stands below a SET=, with its place."""
    return [
        (where._replace(path=(name, index)), record)
        for where, block in blocks
        for index, record in enumerate(getattr(block, name) or ())
    ]
