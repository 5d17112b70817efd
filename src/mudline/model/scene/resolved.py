"""Resolved deck: nodes, elements, sets, curves and laws as arrays, and by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from mudline.basics.arguments import read_only
from mudline.basics.limits import SHOWN_LETTERS
from mudline.basics.short_repr import LETTERS, UnknownNameError, counted, cut, listed, listed_numbers
from mudline.language.codes import RUN001
from mudline.language.codes.references import REF001
from mudline.language.deck.parameters import EvaluatedDeck, folded, name_key
from mudline.language.diagnostics import DeckError, Problem, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.catalogue import facts_of
from mudline.language.keywords.text import suggestion
from mudline.language.keywords.values import Names
from mudline.model.contact.input import LawKind
from mudline.model.curves import ForceCurve
from mudline.model.scene.context import Context
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.laws import Extension, LawTable, SeabedResistance, SetLaw
from mudline.model.scene.mesh import MeshElements
from mudline.model.scene.numbering import Floats, Ids, Indices, Mask, Numbered, first_of, marked, picked
from mudline.model.scene.references import CURVES, THINGS, undefined
from mudline.model.scene.seabed import SeabedKind, SeabedShape, on_land
from mudline.model.scene.sections import SectionTable, Surroundings, read_surroundings
from mudline.model.scene.sets import Sets

Value = TypeVar("Value")


class ByName(Mapping[str, Value]):
    """Mapping whose names are case-insensitive and ignore surrounding spaces.

    Iteration gives the names as the deck first writes them. An unknown name raises UnknownNameError, a KeyError that
    lists the known names.
    """

    def __init__(self, kind: str, entries: Iterable[tuple[str, Value]], key: Callable[[str], str] = folded) -> None:
        """Hold `entries`, pairs of name and value; of two with one `key` the later is kept. `kind` names them."""
        self._kind = kind
        self._key = key
        self._entries = {key(name): (name, value) for name, value in entries}

    def __getitem__(self, name: str) -> Value:
        found = self._find(name)
        if found is None:
            raise self._missing(name)
        return found[1]

    def __iter__(self) -> Iterator[str]:
        return (name for name, _ in self._entries.values())

    def __len__(self) -> int:
        return len(self._entries)

    def __repr__(self) -> str:
        if not self:
            return f"<no {self._kind}s>"
        return cut(f"<{counted(len(self), self._kind)}: {listed(list(self))}", LETTERS) + ">"

    def _repr_html_(self) -> str:
        """Return names and values as a table, for notebooks."""
        from mudline.basics.html_repr import html_page, html_table  # noqa: PLC0415 - only notebooks ask for it

        texts = (
            listed_numbers(value.tolist()) if isinstance(value, np.ndarray) else repr(value) for value in self.values()
        )
        rows = zip(self, texts, strict=True)
        return html_page(f"{self._kind}s".capitalize(), f"{len(self)}", html_table(("name", "is"), rows, len(self)))

    def _ipython_key_completions_(self) -> list[str]:
        """Return the names, for the completion of `["` in notebooks."""
        return list(self)

    def _find(self, name: object) -> tuple[str, Value] | None:
        return self._entries.get(self._key(name)) if isinstance(name, str) else None

    def _missing(self, name: object) -> UnknownNameError:
        if not isinstance(name, str):
            return UnknownNameError(f"a {self._kind} is found by its name, a str, not by {type(name).__name__}")
        names = list(self)
        return UnknownNameError.among(self._kind, cut(name, SHOWN_LETTERS), names, suggestion(name, names))


class Replaced(NamedTuple):
    """Elements (m,) to which the blocks of an extension keyword give another kind of law, by one of their fields."""

    kind: LawKind
    field: str
    extension: Extension
    elements: Mask


class LawArrays(NamedTuple):
    """Normal law of elements (m,): `LawKind`, index in `curves` or -1, linear stiffness or NaN."""

    law: NDArray[np.int8]
    curve_index: Indices
    curves: tuple[ForceCurve, ...]
    linear_stiffness: Floats


@dataclass(repr=False)
class ResolvedDeck:
    """Nodes (n), elements (m), sets, curves and laws of a deck as arrays, in the deck's units; X is up.

    Attributes:
        deck: the deck with its equations evaluated.
        nodes: definitions of the nodes.
        table: definitions of the elements.
        set_table: sets as indices.
        section_table: cross-sections of the elements.
        laws: the normal law of each element and its origin.
        other_curves: curves that are not those of the seabed.
        resistance: friction, lateral stiffness and suction of each element.
        extensions: the extension blocks of each element, by keyword.
        seabed: shape of the seabed.
        noticed: problems found while the deck was resolved.
    """

    deck: EvaluatedDeck
    nodes: Numbered
    table: MeshElements
    set_table: Sets
    section_table: SectionTable
    laws: LawTable
    other_curves: list[SceneCurve]
    resistance: SeabedResistance
    extensions: dict[str, Extension]
    seabed: SeabedShape
    noticed: list[Problem]

    @cached_property
    def context(self) -> Context:
        """State of resolving: problems, and parts that could not be read."""
        return self.set_table.context

    @property
    def may_have_more_laws(self) -> bool:
        """True if a line that could not be used may give elements a law of the seabed."""
        return any(map(catalogue.gives_laws, self.context.unread))

    @property
    def shows_elements(self) -> bool:
        """True if the deck shows all elements that its laws are for: none come from `*LINES` or another deck."""
        return bool(len(self.element_ids)) and not self.set_table.everything.open

    @property
    def lacks(self) -> bool:
        """True if the deck uses something that it does not define, or gives a curve two forces at one ratio."""
        curves = {folded(each.name) for each in self.laws.curves if not each.embedment}
        clashing = any(each.curve is not None and not each.whole for each in self.laws.curves)
        missing = any(each.lacks for each in self.noticed) or not self.referenced <= curves
        others = chain.from_iterable(undefined(self.context, kinds, REF001) for kinds in (CURVES, THINGS))
        return missing or clashing or bool(self.context.excused) or any(True for _ in others)

    @cached_property
    def referenced(self) -> set[str]:
        """Folded names of force-embedment curves that a STIFFNESS= gives."""
        return {folded(use.name) for use in self.context.names(Names.CURVE).used}

    @property
    def source(self) -> str:
        """Deck: the file that it was made from, or its own."""
        return str(self.deck.source or self.deck.file)

    @property
    def units(self) -> str:
        """Unit system: "metric", "imperial" or "user"."""
        return self.deck.units

    @cached_property
    def node_ids(self) -> Ids:
        """Node numbers (n,), in the order in which they first appear."""
        return self.nodes.ids

    @cached_property
    def coordinates(self) -> Floats:
        """Node coordinates (n, 3), X up."""
        return self.nodes.values

    @cached_property
    def element_ids(self) -> Ids:
        """Element numbers (m,)."""
        return self.table.numbered.ids

    @cached_property
    def element_nodes(self) -> Indices:
        """Indices (m, 2) of each element's nodes."""
        return self.table.nodes

    @cached_property
    def length(self) -> Floats:
        """Element lengths (m,) between the deck's coordinates."""
        return self.table.length

    @cached_property
    def diameter(self) -> Floats:
        """External diameters (m,): Do, else Dd of a FLEXIBLE section; NaN if there is none."""
        return self.section_table.diameter

    @cached_property
    def surroundings(self) -> Surroundings:
        """Water of the last `*OCEAN`, and gravity."""
        return read_surroundings(self.deck)

    @cached_property
    def mass_per_length(self) -> Floats:
        """Mass per length (m,), in the deck's units; NaN where it is not known, or not above 0."""
        return self.section_table.mass_per_length()

    @cached_property
    def submerged_weight(self) -> Floats:
        """Weight less buoyancy per length (m,), in the deck's units; NaN where it is not known or overflows.

        If the seabed lies above the water of `*OCEAN`, as at a landfall, it is the weight in air.
        """
        around, land = self.surroundings, None
        if self.seabed.kind is not SeabedKind.FLAT:
            land = on_land(self.seabed, around.depth, self.coordinates, self.element_nodes)
        return self.section_table.submerged_weight(around, land)

    @cached_property
    def sets(self) -> ByName[Ids]:
        """Element numbers (k,) of every set by its name, found without case; ALL included."""
        named = self.set_table.named.values()
        return ByName("set", ((entry.name, read_only(self.element_ids[entry.elements])) for entry in named), name_key)

    @cached_property
    def curves(self) -> ByName[ForceCurve]:
        """Force-embedment curves by name, found without case; a curve of `*EMBEDMENT` has the name of its set.

        Of two curves with the same name the later one is kept; a named curve takes precedence over that of a set.
        """
        held: dict[str, SceneCurve] = {}
        for entry in self.laws.curves:
            before = held.get(folded(entry.name))
            if entry.name and (before is None or before.embedment or not entry.embedment):
                held[folded(entry.name)] = entry
        return ByName("curve", ((entry.name, entry.curve) for entry in held.values() if entry.curve is not None))

    def refusal(
        self, message: str, where: Where | None = None, *, element: int | None = None, node: int | None = None
    ) -> DeckError:
        """Return the error of a deck that cannot be evaluated (RUN001), with the line of the place or object."""
        if element is not None:
            where = self.table.numbered.where(int(np.flatnonzero(self.element_ids == element)[0]))
        elif node is not None:
            where = self.nodes.where(int(np.flatnonzero(self.node_ids == node)[0]))
        return DeckError(self.deck.diagnose([Problem(RUN001, message, where=where)]))

    def line_of(self, where: Where | None) -> int:
        """Return the line of a place in its file; 0 for none."""
        return 0 if where is None else self.deck.place(where).line

    def set_law(self, element: int) -> SetLaw | None:
        """Return the law of the set through which the element of an index has its law."""
        index = int(self.laws.of_element[element])
        return self.laws.set_laws[index] if index >= 0 else None

    @cached_property
    def replaced(self) -> list[Replaced]:
        """Laws of extension keywords that replace other laws of elements; the last one takes effect."""
        replaced_laws: list[Replaced] = []
        soft = self.laws_given != LawKind.RIGID
        for keyword, extension in reversed(self.extensions.items()):
            law, field = facts_of(keyword).gives_law
            if law:
                replaced_laws.append(Replaced(LawKind[law.upper()], field, extension, extension.asking(field) & soft))
        return replaced_laws

    @property
    def replacing(self) -> Indices:
        """Block of its keyword that replaced the law of each element (m,), -1 for those that keep their own."""
        blocks = np.full(len(self.element_ids), -1)
        for _, _, extension, elements in self.replaced:
            blocks = np.where(elements, extension.of_element, blocks)
        return blocks

    @cached_property
    def nodal(self) -> Mask:
        """Elements (m,) with nodal stiffness: `*SEABED CONTACT` replaces their law."""
        nodal: Mask = self.law == LawKind.NODAL
        return nodal

    @cached_property
    def laws_given(self) -> NDArray[np.int8]:
        """`LawKind` (m,) of the law of each element's set, before any replacement."""
        kinds = np.array([*(set_law.kind.value for set_law in self.laws.set_laws), LawKind.NONE.value], dtype=np.int8)
        return kinds[self.laws.of_element]

    @cached_property
    def law(self) -> NDArray[np.int8]:
        """`LawKind` of each element (m,)."""
        kinds = self.laws_given
        for kind, _, _, elements in self.replaced:
            kinds = np.where(elements, np.int8(kind), kinds)
        return kinds

    def followers(self, curve: int) -> Indices:
        """Return indices of the elements that follow a curve, without those whose law an extension replaced."""
        on_curve = marked((set_law.curve == curve for set_law in self.laws.set_laws), self.laws.of_element)
        return np.flatnonzero(on_curve & (self.law == LawKind.CURVE))

    @cached_property
    def law_names(self) -> list[str]:
        """Law of each element: `curve:NAME`, or the name of another `LawKind` in lower case."""
        names = np.array([*map(self.law_name, self.laws.set_laws), "none"], dtype=object)[self.laws.of_element]
        for kind, _, _, elements in self.replaced:
            names[elements] = kind.name.lower()
        return list(map(str, names))

    @cached_property
    def law_sets(self) -> list[str | None]:
        """Name of the set through which each element got its law; None without a law."""
        names = [None if set_law.kind is LawKind.NONE else set_law.set_.name for set_law in self.laws.set_laws]
        of_elements = np.array([*names, None], dtype=object)[self.laws.of_element]
        for _, _, extension, elements in self.replaced:
            holders = np.array([*(set_ and set_.name for set_ in extension.sets), None], dtype=object)
            of_elements[elements] = holders[extension.of_element[elements]]
        return list(of_elements)

    def describe(self, elements: Mask | Indices, one: str = "has", many: str = "have") -> str:
        """Return elements for a message, given as mask or indices: `element 3 has`, or `4 elements (first: 3) have`."""
        return first_of("element", self.element_ids[elements], one, many)

    def law_name(self, set_law: SetLaw) -> str:
        """Return the name of the law that a set_law gives."""
        if set_law.kind is LawKind.CURVE and set_law.curve >= 0:
            return f"curve:{self.laws.curves[set_law.curve].name}"
        return set_law.kind.name.lower()

    def law_arrays(self) -> LawArrays:
        """Return the law of every element as arrays, even if other values of it are unknown."""
        linear = picked((set_law.stiffness for set_law in self.laws.set_laws), self.laws.of_element)
        replaced = self.law != self.laws_given
        usable = [index for index, entry in enumerate(self.laws.curves) if entry.curve is not None]
        number = {index: position for position, index in enumerate(usable)}
        curve_of_law = np.array([*(number.get(set_law.curve, -1) for set_law in self.laws.set_laws), -1], dtype=np.intp)
        return LawArrays(
            self.law,
            np.where(replaced, -1, curve_of_law[self.laws.of_element]),
            tuple(entry.curve for entry in self.laws.curves if entry.curve is not None),
            np.where(replaced, np.nan, linear),
        )
