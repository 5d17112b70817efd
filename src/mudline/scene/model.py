"""A resolved deck: arrays, names, and the way back to the deck."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.codes import RUN001
from mudline.contact.errors import ElementError
from mudline.contact.input import ContactInput, LawKind
from mudline.contact.model import ContactModel
from mudline.contact.plan import Backend
from mudline.deck.evaluation import EvaluatedDeck
from mudline.deck.parameters import folded
from mudline.diagnostics import Blocks, DeckError, Problem, Severity, Where
from mudline.scene.bed import Bed
from mudline.scene.by_name import ByName
from mudline.scene.checks.running import checked
from mudline.scene.contact_parts.build import laws_of, seabed_of, table_of
from mudline.scene.contact_parts.refused import RefusedError
from mudline.scene.context import Context
from mudline.scene.elements import ElementTable
from mudline.scene.extensions import Extension, with_nodal_stiffness
from mudline.scene.floor import Floor
from mudline.scene.force_curves import SceneCurve
from mudline.scene.laws import Grant, LawTable
from mudline.scene.left_out import left_out
from mudline.scene.numbering import Floats, Ids, Indices, Mask, Numbered
from mudline.scene.refusals import refusals
from mudline.scene.section_weight import submerged_weight
from mudline.scene.sections import SectionTable
from mudline.scene.sets import Sets, set_key
from mudline.short_repr import counted, cut, outline, short_repr

if TYPE_CHECKING:
    from mudline.curves import ForceCurve


_INTERNAL = frozenset(
    [
        "bed",
        "blocking",
        "context",
        "errors",
        "extensions",
        "findings",
        "floor",
        "grant",
        "law_arrays",
        "law_name",
        "laws",
        "nodal",
        "nodes",
        "noticed",
        "problems",
        "require",
        "require_evaluable",
        "section_table",
        "set_table",
        "table",
    ]
)
"""What the rest of the program uses of a scene; `dir` leaves it out."""


class LawArrays(NamedTuple):
    """The normal law of elements (m,): `LawKind`, index in `curves` or -1, linear stiffness or NaN."""

    law: NDArray[np.int8]
    curve_index: Indices
    curves: tuple[ForceCurve, ...]
    linear_stiffness: Floats

    def __repr__(self) -> str:
        return short_repr(self)


@dataclass
class Scene:
    """Nodes (n), elements (m), sets, curves and laws of a deck as arrays, in the deck's units; X is up.

    `Deck.scene` makes scenes; `contact` makes the evaluator.

    Attributes:
        deck: the deck with its equations evaluated.
        nodes: definitions of the nodes.
        table: definitions of the elements.
        set_table: sets as indices.
        section_table: cross-sections of the elements.
        laws: what gives each element its normal law.
        bed: friction, lateral stiffness and suction of each element.
        extensions: what the extension keywords say of each element, by keyword.
        floor: shape of the seabed.
        noticed: what went wrong while the deck was resolved.
    """

    deck: EvaluatedDeck
    nodes: Numbered
    table: ElementTable
    set_table: Sets
    section_table: SectionTable
    laws: LawTable
    bed: Bed
    extensions: dict[str, Extension]
    floor: Floor
    noticed: list[Problem]

    def __repr__(self) -> str:
        counts = [
            counted(len(self.node_ids), "node"),
            counted(len(self.element_ids), "element"),
            counted(len(self.set_table.named), "set"),
            counted(len(self.curves), "curve"),
        ]
        if errors := len(self.errors()):
            counts.append(counted(errors, "error"))
        return outline(f"Scene of {cut(self.deck.file, 80)!r}", ", ".join([self.units, *counts]))

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if name not in _INTERNAL]

    @property
    def context(self) -> Context:
        """What was noticed on the way, and what could not be read."""
        return self.set_table.context

    @property
    def units(self) -> str:
        """The unit system: "metric", "imperial" or "user"."""
        return self.deck.units

    @property
    def node_ids(self) -> Ids:
        """Node numbers (n,), in the order in which they first appear."""
        return self.nodes.ids

    @property
    def coordinates(self) -> Floats:
        """Node coordinates (n, 3), X up."""
        return self.nodes.values

    @property
    def element_ids(self) -> Ids:
        """Element numbers (m,)."""
        return self.table.numbered.ids

    @property
    def element_nodes(self) -> Indices:
        """Indices (m, 2) of each element's nodes."""
        return self.table.nodes

    @property
    def length(self) -> Floats:
        """Element lengths (m,) between the deck's coordinates."""
        return self.table.length

    @cached_property
    def diameter(self) -> Floats:
        """External diameters (m,): Do, else Dd of a FLEXIBLE section; NaN where there is none."""
        return self.section_table.diameter

    @cached_property
    def sets(self) -> ByName[Ids]:
        """Element numbers (k,) of every set by its name, found without case; ALL included."""
        named = self.set_table.named.values()
        return ByName("set", ((entry.name, self.element_ids[entry.elements]) for entry in named), set_key)

    @cached_property
    def curves(self) -> ByName[ForceCurve]:
        """The force-embedment curves by name, found without case; one of `*EMBEDMENT` has the name of its set.

        Of two curves of one name the later one holds, a named one before that of a set.
        """
        held: dict[str, SceneCurve] = {}
        for entry in self.laws.curves:
            before = held.get(folded(entry.name))
            if entry.named and (before is None or before.embedment or not entry.embedment):
                held[folded(entry.name)] = entry
        return ByName("curve", ((entry.name, entry.curve) for entry in held.values() if entry.curve is not None))

    def grant(self, element: int) -> Grant | None:
        """What gives the element of an index its law."""
        index = int(self.laws.of_element[element])
        return self.laws.grants[index] if index >= 0 else None

    @cached_property
    def nodal(self) -> Mask:
        """Elements (m,) whose law is a stiffness of their nodes: `*SEABED CONTACT` replaces what they had."""
        contact = self.extensions.get("SEABED CONTACT")
        if contact is None:
            return np.zeros(len(self.element_ids), dtype=np.bool_)
        found: Mask = with_nodal_stiffness(contact) & (self._granted != LawKind.RIGID)
        return found

    @cached_property
    def _granted(self) -> NDArray[np.int8]:
        """`LawKind` of what each element is granted, whatever replaces it."""
        kinds = np.array([*(grant.kind for grant in self.laws.grants), LawKind.NONE], dtype=np.int8)
        return kinds[self.laws.of_element]

    @cached_property
    def law(self) -> NDArray[np.int8]:
        """`LawKind` of each element (m,)."""
        return np.where(self.nodal, np.int8(LawKind.NODAL), self._granted)

    @cached_property
    def law_names(self) -> list[str]:
        """`curve:NAME`, `linear`, `nodal`, `rigid` or `none` for each element."""
        names = [*(self.law_name(grant) for grant in self.laws.grants), "nodal", "none"]
        index = np.where(self.nodal, len(names) - 2, self.laws.of_element)
        return [names[position] for position in index.tolist()]

    @cached_property
    def law_sets(self) -> list[str | None]:
        """Name of the set through which each element got its law; None without a law."""
        names = [None if grant.kind is LawKind.NONE else grant.set_.name for grant in self.laws.grants]
        found = [[*names, None][index] for index in self.laws.of_element.tolist()]
        for element in np.flatnonzero(self.nodal).tolist():
            contact = self.extensions["SEABED CONTACT"]
            holder = contact.sets[int(contact.of_element[element])]
            found[element] = None if holder is None else holder.name
        return found

    def law_name(self, grant: Grant) -> str:
        """Name of the law that a grant gives."""
        if grant.kind is LawKind.CURVE and grant.curve >= 0:
            return f"curve:{self.laws.curves[grant.curve].name}"
        return grant.kind.name.lower()

    @cached_property
    def findings(self) -> list[Problem]:
        """All that is wrong with the deck, as far as evaluating it goes."""
        return [*self.context.of_deck(), *self.problems]

    @cached_property
    def problems(self) -> list[Problem]:
        """What resolving the deck noticed, and what the checks of the scene find."""
        return [*self.noticed, *checked(self)]

    def blocking(self, tension: Literal["keep", "cut"] = "keep") -> list[Problem]:
        """The findings that keep the scene from being evaluated; `tension` is that of `contact`."""
        blocks = (Blocks.ALWAYS, Blocks.WITH_TENSION) if tension == "keep" else (Blocks.ALWAYS,)
        return [problem for problem in self.findings if problem.blocking in blocks]

    def errors(self) -> list[Problem]:
        """What is wrong with the deck itself, so that the scene cannot be used.

        A warning may keep the scene from being evaluated too: what it lacks may stand where it is not read.
        """
        return [problem for problem in self.blocking("cut") if problem.weight is Severity.ERROR]

    def require_evaluable(self, tension: Literal["keep", "cut"] = "keep") -> Scene:
        """The scene itself; raises DeckError for the findings that keep it from being evaluated."""
        if problems := self.blocking(tension):
            raise DeckError(self.deck.diagnose(problems))
        return self

    def require(self) -> Scene:
        """The scene itself; raises DeckError for errors on which a result depends."""
        if errors := self.errors():
            raise DeckError(self.deck.diagnose(errors))
        return self

    def contact(self, tension: Literal["keep", "cut"] = "keep", *, backend: Backend = "auto") -> ContactModel:
        """The evaluator of this scene, with only the stages it needs.

        `backend` "fast" steps through history with compiled loops (extra `mudline[fast]`), "numpy" never does, "auto"
        does where a series is so long that compiling pays.

        Raises ImportError where "fast" is not installed, and DeckError for the findings that keep the scene from being
        evaluated, and (RUN001) for what no check covers.
        """
        return ContactModel(self.contact_input(tension), backend=backend)

    def contact_input(self, tension: Literal["keep", "cut"] = "keep") -> ContactInput:
        """The arrays that the evaluator is made from; raises DeckError as `contact` does."""
        self.require_evaluable(tension)
        if problems := list(refusals(self)):
            raise DeckError(self.deck.diagnose(problems))
        try:
            return self._contact_input(tension)
        except RefusedError as error:
            raise self._refused(str(error), error.where) from error
        except ElementError as error:
            index = int(np.flatnonzero(self.element_ids == error.element)[0])
            raise self._refused(f"{error}; this cannot be evaluated", self.table.numbered.where(index)) from error

    def _refused(self, message: str, where: Where) -> DeckError:
        return DeckError(self.deck.diagnose([Problem(RUN001, message, where=where)]))

    def _contact_input(self, tension: Literal["keep", "cut"]) -> ContactInput:
        arrays = self.law_arrays()
        laws = laws_of(self, arrays)
        return ContactInput(
            node_ids=self.node_ids,
            coordinates=self.coordinates,
            element_ids=self.element_ids,
            element_nodes=self.element_nodes,
            length=np.where(np.isfinite(self.length), self.length, 0.0),  # what is not finite has no spring
            diameter=self.diameter,
            laws=tuple(laws),
            curves=arrays.curves,
            tables=tuple(table_of(self)),
            tension=tension,
            seabed=seabed_of(self),
            weight=submerged_weight(self),
            left_out=left_out(self, [law.law for law in laws]),
        )

    def law_arrays(self) -> LawArrays:
        """The law of every element as arrays, whatever else is known of it."""
        linear = np.array([*(grant.stiffness for grant in self.laws.grants), np.nan])[self.laws.of_element]
        usable = [index for index, entry in enumerate(self.laws.curves) if entry.curve is not None]
        number = {index: position for position, index in enumerate(usable)}
        curve_of_grant = np.array([*(number.get(grant.curve, -1) for grant in self.laws.grants), -1], dtype=np.intp)
        return LawArrays(
            self.law,
            np.where(self.nodal, -1, curve_of_grant[self.laws.of_element]),
            tuple(entry.curve for entry in self.laws.curves if entry.curve is not None),
            np.where(self.nodal, np.nan, linear),
        )
