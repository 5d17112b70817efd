"""Element sets: lists, ranges and subsets to indices of elements; names compare without case."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import REF001, REF005, REF008, REF009, REF010
from mudline.deck.parameters import folded
from mudline.diagnostics import Severity, Where
from mudline.keywords.text import shown, suggestion
from mudline.scene.context import Context
from mudline.scene.external import ExternalElements
from mudline.scene.numbering import Indices, Numbered

if TYPE_CHECKING:
    from mudline.keywords.library.element_sets import ElementRange, ElementSet, ElementSets, SetList

ALL = "all"


@dataclass(slots=True)
class NamedSet:
    """A set: its name as first written, the indices of its elements in ascending order, where it is defined.

    `open` says that it has, or may have, elements that the deck does not show.
    """

    name: str
    elements: Indices
    where: Where | None
    open: bool = False


@dataclass(slots=True)
class Sets:
    """All sets by folded name; ALL is there, unless the deck's elements are not known."""

    context: Context
    elements: Numbered
    named: dict[str, NamedSet] = field(default_factory=dict)

    def find(self, name: str | None, where: Where) -> NamedSet | None:
        """The set that a SET= names (None means ALL); None, and a problem, when there is no such set."""
        key = ALL if name is None else folded(name)
        found = self.named.get(key)
        if found is None:
            known = [entry.name for entry in self.named.values()]
            message = f"set {shown(str(name))} is not defined{suggestion(str(name), known)}: define it in *ELEMENT SETS"
            self.context.tell_missing(REF001, message, where, "ELEMENT SETS")
        return found


def read_sets(context: Context, elements: Numbered, external: ExternalElements | None = None) -> Sets:
    """Every set of the model; a file of elements adds to them, or defines more."""
    sets = _Reader(context, elements).read()
    for name, ids in (external.sets if external else {}).items():
        known = sets.named.setdefault(folded(name), NamedSet(name, np.zeros(0, dtype=np.intp), None))
        known.elements = np.union1d(known.elements, elements.indices(ids))
    return sets


class _Reader:
    def __init__(self, context: Context, elements: Numbered) -> None:
        self.context = context
        self.elements = elements
        self.definitions: dict[str, list[tuple[ElementSet, Where]]] = {}
        self.sets = Sets(context, elements)

    def read(self) -> Sets:
        named = self.sets.named
        everything = np.arange(len(self.elements), dtype=np.intp)
        named[ALL] = NamedSet("ALL", everything, None, open=bool(self.context.definers or self.context.restart))
        for key, name in self.context.harvested.items():
            named.setdefault(key, NamedSet(name, np.zeros(0, dtype=np.intp), None, open=True))
        for where, block in self.context.deck.blocks("ELEMENT SETS"):
            for index, entry in enumerate(cast("ElementSets", block).sets):
                self._collect(entry, where._replace(path=("sets", index)))
        for key in self.definitions:
            named.pop(key, None)
        for key in self.definitions:
            self._expand(key)
        return self.sets

    def _collect(self, entry: ElementSet, where: Where) -> None:
        if not isinstance(entry.name, str):
            return
        key = folded(entry.name)
        if key == ALL:
            message = "set ALL is predefined: every element belongs to it; choose another name"
            self.context.tell(REF009, message, where._replace(path=(*where.path, "name")))
        else:
            self.definitions.setdefault(key, []).append((entry, where))

    def _expand(self, key: str) -> None:
        """Expand a set and, before it, its subsets; an explicit stack, as chains may be long."""
        stack = [key]
        open_keys: list[str] = []
        while stack:
            current = stack[-1]
            if current in self.sets.named and current not in open_keys:
                stack.pop()
                continue
            if current in open_keys:
                stack.pop()
                open_keys.remove(current)
                self._settle(current)
                continue
            open_keys.append(current)
            for name, where in self._subsets(current):
                other = folded(name)
                if other in open_keys:
                    message = f"set {shown(name)} contains itself through SUBSET={name}"
                    self.context.tell(REF008, message, where)
                elif other in self.definitions:
                    stack.append(other)
                elif other not in self.sets.named:
                    known = [entry.name for entries in self.definitions.values() for entry, _ in entries]
                    message = f"SUBSET={name} names no set{suggestion(name, known)}"
                    self.context.tell_missing(REF008, message, where, "ELEMENT SETS")

    def _subsets(self, key: str) -> list[tuple[str, Where]]:
        return [
            (member.subset, where._replace(path=(*where.path, "members", index, "subset")))
            for entry, where in self.definitions[key]
            for index, member in enumerate(entry.members)
            if hasattr(member, "subset") and isinstance(member.subset, str)
        ]

    def _settle(self, key: str) -> None:
        """The union of all members of all definitions of a name."""
        first, place = self.definitions[key][0]
        parts: list[Indices] = []
        uncertain = False
        for entry, where in self.definitions[key]:
            for index, member in enumerate(entry.members):
                inner = where._replace(path=(*where.path, "members", index))
                if hasattr(member, "elements"):
                    found, labelled = self._listed(member, inner)
                    uncertain |= labelled
                    parts.append(found)
                elif hasattr(member, "generate"):
                    parts.append(self._range(member.generate, inner))
                elif (other := self.sets.named.get(folded(member.subset))) is not None:
                    uncertain |= other.open
                    parts.append(other.elements)
        elements = np.unique(np.concatenate(parts)) if parts else np.zeros(0, dtype=np.intp)
        uncertain |= any(self._unsure(where) for _, where in self.definitions[key])
        self.sets.named[key] = NamedSet(first.name, elements, place, uncertain)
        if not elements.size and not uncertain and not self._has_members(key):
            self.context.tell(REF010, f"set {shown(first.name)} has no element", place)

    def _has_members(self, key: str) -> bool:
        """Whether anything was listed: what is listed and undefined has been told already."""
        return any(entry.members for entry, _ in self.definitions[key])

    def _unsure(self, where: Where) -> bool:
        return bool(self.context.definers) or self.context.deck.origin.damaged(where)

    def _listed(self, member: SetList, where: Where) -> tuple[Indices, bool]:
        numbers = [number for number in member.elements if isinstance(number, int)]
        labelled = len(numbers) < len(member.elements)
        indices = self.elements.indices(np.array(numbers, dtype=np.int64))
        for missing in np.flatnonzero(indices < 0).tolist():
            number = numbers[missing]
            path = (*where.path, "elements", member.elements.index(number))
            message = f"element {number} is not defined"
            self.context.tell_missing(REF005, message, where._replace(path=path), "ELEMENT")
        return indices[indices >= 0], labelled

    def _range(self, given: ElementRange, where: Where) -> Indices:
        """Elements of a range, without building it: it may be as long as a slip of the pen makes it."""
        place = where._replace(path=(*where.path, "generate"))
        start, end, step = given.start, given.end, 1 if given.increment is None else given.increment
        if not (isinstance(start, int) and isinstance(end, int) and isinstance(step, int)):
            return np.zeros(0, dtype=np.intp)
        if end < start or step < 1:
            message = f"GEN={start}, {end}, {step} holds nothing: the end comes before the start"
            message = message if step >= 1 else f"GEN={start}, {end}, {step}: the increment must be at least 1"
            self.context.tell(REF010, message, place, Severity.ERROR)
            return np.zeros(0, dtype=np.intp)
        ids = self.elements.ids
        found = np.flatnonzero((ids >= start) & (ids <= end) & ((ids - start) % step == 0))
        wanted = (end - start) // step + 1
        if len(found) < wanted and not self.context.supplier("ELEMENT"):
            message = f"GEN={start}, {end}, {step}: {wanted - len(found)} of its {wanted} elements are not defined"
            self.context.tell(REF005, message, place, Severity.WARNING if len(found) else None)
        return found
