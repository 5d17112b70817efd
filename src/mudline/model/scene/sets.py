"""Element sets: lists, ranges and subsets as indices of elements; names, compared without case, and their check."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mudline.basics.short_repr import short_repr
from mudline.language.codes.references import REF001, REF005, REF008, REF009, REF010
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.parameters import bare, folded, name_key
from mudline.language.diagnostics import Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_partly_unknown, names_given, set_slots
from mudline.language.keywords.text import advice_on, shown
from mudline.language.keywords.values import Names, known_name
from mudline.model.scene.context import Context
from mudline.model.scene.deck_values import settings_in
from mudline.model.scene.numbering import Indices, Numbered, distinct

if TYPE_CHECKING:
    from mudline.language.keywords.library import mesh
    from mudline.language.keywords.model import Block
    from mudline.model.scene.csv_file import ExternalElements

ALL = "all"
LONGEST_NAME = 256
"""Number of characters that the language allows in the name of a set."""
_NOTHING = np.zeros(0, dtype=np.intp)
_Entry = tuple[Where, Any, str | None, "NamedSet | None"]


@dataclass(slots=True, repr=False, eq=False)
class NamedSet:
    """Set of elements.

    name: its name as first written.
    elements: indices of its elements in ascending order.
    where: place of its definition.
    open: the set has, or may have, elements that the deck does not show.
    faulty: some of its lines could not be read, which is reported.
    listed: indices of its elements as each of its lines gives them, without those of subsets.
    """

    name: str
    elements: Indices
    where: Where | None
    open: bool = False
    faulty: bool = False
    listed: Sequence[Indices] = ()

    __repr__ = short_repr

    @property
    def in_order(self) -> Indices:
        """Indices of its elements in the order of its lines; in that of the file if the set has subsets."""
        listed = np.concatenate([_NOTHING, *self.listed])
        return listed if np.array_equal(np.sort(listed), self.elements) else self.elements


@dataclass(slots=True, repr=False, eq=False)
class Sets:
    """All sets by folded name; ALL is always there."""

    context: Context
    elements: Numbered
    named: dict[str, NamedSet] = field(default_factory=dict)

    __repr__ = short_repr

    @property
    def everything(self) -> NamedSet:
        """Predefined set ALL."""
        return self.named[ALL]

    @property
    def names(self) -> dict[str, str]:
        """Names as first written, by their folded form."""
        return {key: set_.name for key, set_ in self.named.items()}

    def find(self, name: str) -> NamedSet | None:
        """Return the set that a SET= names; None if there is no such set, which `check` reports."""
        return self.named.get(name_key(name))

    def entries(self, blocks: Iterable[tuple[Where, Block]]) -> Iterator[_Entry]:
        """Yield each record below a SET= of some blocks: place, record, name of the set or None if unreadable, set."""
        for where, block in blocks:
            for listed, named in set_slots(type(block)):
                for index, entry in enumerate(getattr(block, listed.name)):
                    given = getattr(entry, named.name)
                    name = known_name(named.about.default or None if given is None else given)
                    yield where.inside(listed.json, index), entry, name, None if name is None else self.find(name)

    def check(self, name: str, where: Where) -> None:
        """Report a name at a place if no set has it."""
        if self.find(name) is None:
            advice = advice_on(name) or "define it in *ELEMENT SETS"
            message = f"set {shown(name)} is not defined{self.context.hint(name, self.names)}: {advice}"
            self.context.report_missing(REF001, message, where, "ELEMENT SETS", name)


def read_sets(context: Context, elements: Numbered, external: ExternalElements | None = None) -> Sets:
    """Return every set of the model; a file of elements adds to them, or defines more."""
    sets = _SetReader(context, elements).read()
    for name, ids in (external.sets if external else {}).items():
        known = sets.named.setdefault(folded(name), NamedSet(name, _NOTHING, None))
        known.elements = np.union1d(known.elements, elements.indices(ids))
    return sets


def check_references(context: Context, sets: Sets, *, with_soil: bool) -> None:
    """Report undefined names of sets; those in soil springs only with `with_soil`.

    Postprocessing may have its own sets in addition to those of the model.
    """
    own = sets_of_postprocessing(context.deck)
    for name, where in ((use.name, use.where) for use in context.names(Names.SET).used):
        section = context.deck.sections[where.section]
        if not with_soil and cast("Block", section.blocks[where.block]).facts.soil_springs:
            continue
        if section.name in catalogue.CERTAIN_SECTIONS or not (name_key(name) in own or not context.deck.keywords()):
            sets.check(name, where)


def sets_of_postprocessing(deck: Deck) -> dict[str, str]:
    """Return the sets that sections other than the model define, by their folded names."""
    sections = (section for section in deck.sections if section.name not in catalogue.CERTAIN_SECTIONS)
    names = (name for section in sections for block in section.blocks for name in _sets_defined_by(block))
    return {name_key(name): bare(name) for name in names}


def _sets_defined_by(block: Block | Opaque) -> Iterator[str]:
    if not isinstance(block, Opaque):
        yield from (name for _, name in names_given(block, Names.SET, "defines"))
    elif block.keyword in catalogue.definers(Names.SET):
        yield from (group.fields[0].text for group in settings_in(block.lines) if group.key == Names.SET.name)


class _SetReader:
    """Reader of sets: it collects the definitions of each name, then expands them, subsets first."""

    def __init__(self, context: Context, elements: Numbered) -> None:
        self.context = context
        self.elements = elements
        self.definitions: dict[str, list[tuple[mesh.ElementSet, Where]]] = {}
        self.sets = Sets(context, elements)

    def read(self) -> Sets:
        named = self.sets.named
        context = self.context
        everything = np.arange(len(self.elements), dtype=np.intp)
        named[ALL] = NamedSet("ALL", everything, None, open=bool(context.external_definers or context.restart))
        for where, block in context.blocks("ELEMENT SETS"):
            for index, entry in enumerate(cast("mesh.ElementSets", block).sets):
                place = where.inside("sets", index)
                name = known_name(entry.name)
                if name is None:
                    context.unread.add("ELEMENT SETS")
                elif (key := name_key(name)) == ALL:
                    message = "set ALL is predefined and holds every element: choose another name"
                    context.report(REF009, message, place.inside("name"))
                else:
                    self.definitions.setdefault(key, []).append((entry, place))
        for key, name in context.opaque_set_names.items():
            if key not in self.definitions:
                named.setdefault(key, NamedSet(name, _NOTHING, None, open=True))
        for key in self.definitions:
            if key not in named:
                self._expand(key)
        return self.sets

    def _expand(self, key: str) -> None:
        """Expand a set after its subsets, with an explicit stack, as chains may be long."""
        waiting = [key]
        unfinished: set[str] = set()
        while waiting:
            current = waiting[-1]
            if current in self.sets.named:
                waiting.pop()
            elif current in unfinished:
                waiting.pop()
                unfinished.remove(current)
                self._settle(current)
            else:
                unfinished.add(current)
                self._await(current, waiting, unfinished)

    def _await(self, key: str, waiting: list[str], unfinished: set[str]) -> None:
        """Put the subsets to expand before a set on the stack; report those that cannot be expanded."""
        named = self.sets.named
        for entry, where in self.definitions[key]:
            for index, member in enumerate(entry.members):
                if member.rule != "set_subset":
                    continue
                name = known_name(cast("mesh.SetSubset", member).subset)
                if name is None:
                    continue
                subset = name_key(name)
                if subset in unfinished:
                    message = f"set {shown(name)} contains itself: SUBSET= leads back to it; remove one of these lines"
                    self.context.report(REF008, message, where.inside("members", index, "subset"))
                elif subset in self.definitions:
                    waiting.append(subset)
                elif subset not in named:
                    hint = self.context.hint(name, self._names)
                    message = f"SUBSET= names no set: {shown(name)} is not defined{hint}; define it"
                    place = where.inside("members", index, "subset")
                    self.context.report_missing(REF008, message, place, "ELEMENT SETS", name)

    @cached_property
    def _names(self) -> dict[str, str]:
        """Names of all sets, by their casefolded form."""
        return self.context.opaque_set_names | {key: found[0][0].name for key, found in self.definitions.items()}

    def _settle(self, key: str) -> None:
        """Store the union of all members of all definitions of a name."""
        definitions = self.definitions[key]
        first, place = definitions[0]
        listed, parts = list[Indices](), list[Indices]()
        faulty = any(is_partly_unknown(part) for entry, _ in definitions for part in (entry.members, *entry.members))
        unsure = faulty
        members = 0
        for entry, where in definitions:
            members += len(entry.members)
            for index, member in enumerate(entry.members):
                if member.rule == "set_subset":
                    name = known_name(cast("mesh.SetSubset", member).subset)
                    set_ = None if name is None else self.sets.named.get(name_key(name))
                    whole = set_ is not None and not set_.open
                    parts.append(_NOTHING if set_ is None else set_.elements)
                elif member.rule == "set_list":
                    indices, whole = self._listed(cast("mesh.SetList", member), where.inside("members", index))
                    listed.append(indices)
                else:
                    range_ = cast("mesh.SetGenerate", member).generate
                    indices, whole = self._range(range_, where.inside("members", index))
                    listed.append(indices)
                unsure |= not whole
        self.sets.named[key] = NamedSet(first.name, _union([*listed, *parts]), place, unsure, faulty, listed)
        if not members and not unsure:  # members that do not exist are reported at their place
            self.context.report(REF010, f"set {shown(first.name)} has no element: give it some, or remove it", place)

    def _listed(self, member: mesh.SetList, where: Where) -> tuple[Indices, bool]:
        """Return indices of the elements of a list, and True if these are all."""
        numbered = [(element, at) for at, element in enumerate(member.elements) if isinstance(element, int)]
        indices = self.elements.indices(np.array([number for number, _ in numbered], dtype=np.int64))
        missing = [numbered[at] for at in np.flatnonzero(indices < 0).tolist()]
        if len(missing) > 1 and (self.context.external_definers or self.context.restart):
            message = f"{len(missing)} elements of this list (first: {missing[0][0]}) are not defined"
            self.context.report_missing(REF005, message, where.inside("elements", missing[0][1]), "ELEMENT")
            missing = []
        for number, at in missing:
            message = f"element {number} is not defined: define it in *ELEMENT"
            self.context.report_missing(REF005, message, where.inside("elements", at), "ELEMENT", number)
        for at, element in enumerate(member.elements):
            if isinstance(element, str) and not self.context.is_guessed_label(where.inside("elements", at)):
                self.context.report_label(REF005, element, where.inside("elements", at), "ELEMENT")
        found = indices[indices >= 0]
        return found, len(found) == len(member.elements) and not is_partly_unknown(member.elements)

    def _range(self, range_: mesh.ElementRange, where: Where) -> tuple[Indices, bool]:
        """Return the elements of a range, without building it: a typing error may make it very long."""
        place = where.inside("generate")
        numbers = self.context.generator(range_)
        if numbers is None:
            return _NOTHING, False
        start, end, step = numbers
        if end < start or step < 1:
            why = "the increment must be at least 1" if step < 1 else "the end must not come before the start"
            self.context.report(REF010, f"GEN={start}, {end}, {step} holds nothing: {why}", place, Severity.ERROR)
            return _NOTHING, False
        elements = self.elements.between(start, end, step)
        count = (end - start) // step + 1
        lacking = count - len(elements)
        if lacking and not self.context.possible_definition("ELEMENT"):
            numbers_there = distinct(self.elements.ids[elements])
            gaps = np.flatnonzero(numbers_there != start + step * np.arange(len(numbers_there)))
            first = start + step * int(gaps[0] if len(gaps) else len(numbers_there))
            if lacking == 1:
                message = f"GEN={start}, {end}, {step}: element {first} is not defined: correct it, or define that"
            else:
                lacks = f"{lacking} of its {count} elements are not defined (first: {first})"
                message = f"GEN={start}, {end}, {step}: {lacks}: correct it, or define them"
            severity = Severity.WARNING if len(elements) else None
            self.context.note(Problem(REF005, message, None, severity, place, lacks=str(first)))
        return elements, not lacking


def _union(parts: list[Indices]) -> Indices:
    """Return the union of parts in ascending order; that of a part and others inside it is the part, not a copy."""
    largest = max(parts, key=len, default=_NOTHING)
    union = distinct(largest)
    rest = [part for part in parts if part is not largest and len(part)]
    if not rest:
        return union
    others = distinct(np.concatenate(rest))
    there = union[np.minimum(np.searchsorted(union, others), len(union) - 1)] == others
    return union if there.all() else distinct(np.concatenate([union, others]))


def later_wins(holders: Sequence[NamedSet | None], count: int) -> Indices:
    """Return for each of `count` elements the index of the last holder that has it, or -1; not to be written to.

    A set that holds several objects counts only with the last of them, so repeated sets take no extra time.
    """
    last = {id(holder.elements): index for index, holder in enumerate(holders) if holder is not None}
    order = sorted(last.values())
    whole = [index for index in order if len(cast("NamedSet", holders[index]).elements) == count]
    if not order or order[-1:] == whole[-1:]:
        return np.broadcast_to(np.intp(order[-1] if order else -1), (count,))
    winner = np.full(count, -1, dtype=np.intp)
    for index in order:
        winner[cast("NamedSet", holders[index]).elements] = index
    return winner
