"""A resolved deck: arrays, names, and the way back to the deck."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from mudline.codes import REF007
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.model import ContactModel
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError, Problem, Severity
from mudline.scene.elements import ElementTable
from mudline.scene.laws import Grant, LawTable
from mudline.scene.numbering import Floats, Ids, Indices, Numbered
from mudline.scene.sections import SectionTable
from mudline.scene.sets import Sets

if TYPE_CHECKING:
    from mudline.curves import ForceCurve

_TOLERATED = (REF007.code,)
"""Errors with a stated meaning (the later definition holds) do not keep a scene from being used."""


@dataclass
class Scene:
    """Nodes (n), elements (m), sets, sections and laws of a deck, in the deck's units.

    `deck` has its equations evaluated. `problems` is what resolving noticed; `require` refuses a scene with errors.
    """

    deck: Deck
    nodes: Numbered
    table: ElementTable
    set_table: Sets
    section_table: SectionTable
    laws: LawTable
    problems: list[Problem]

    @property
    def units(self) -> str:
        """ "metric", "imperial" or "user"."""
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
    def sets(self) -> dict[str, Ids]:
        """Element numbers of every set, by its name as first written; ALL included."""
        return {entry.name: self.element_ids[entry.elements] for entry in self.set_table.named.values()}

    @cached_property
    def curves(self) -> dict[str, ForceCurve]:
        """The force-embedment curves by name; one of `*EMBEDMENT` has the name of its set. The later one holds."""
        return {entry.name: entry.curve for entry in self.laws.curves if entry.curve is not None}

    def grant(self, element: int) -> Grant | None:
        """What gives the element of an index its law."""
        index = int(self.laws.of_element[element])
        return self.laws.grants[index] if index >= 0 else None

    @cached_property
    def law(self) -> NDArray[np.int8]:
        """`LawKind` of each element (m,)."""
        kinds = np.array([*(grant.kind for grant in self.laws.grants), LawKind.NONE], dtype=np.int8)
        return kinds[self.laws.of_element]

    @cached_property
    def law_names(self) -> list[str]:
        """`curve:NAME`, `linear`, `rigid` or `none` for each element."""
        names = [self._law_name(grant) for grant in self.laws.grants] + ["none"]
        return [names[index] for index in self.laws.of_element.tolist()]

    @cached_property
    def law_sets(self) -> list[str | None]:
        """Name of the set through which each element got its law; None without a law."""
        names = [None if grant.kind is LawKind.NONE else grant.set_.name for grant in self.laws.grants]
        return [[*names, None][index] for index in self.laws.of_element.tolist()]

    def _law_name(self, grant: Grant) -> str:
        if grant.kind is LawKind.CURVE:
            return f"curve:{self.laws.curves[grant.curve].name}"
        return grant.kind.name.lower()

    def errors(self) -> list[Problem]:
        """What keeps the scene from being used."""
        found = (problem for problem in [*self.deck.problems, *self.problems] if problem.weight is Severity.ERROR)
        return [problem for problem in found if problem.code.code not in _TOLERATED]

    def require(self) -> Scene:
        """The scene itself; raises DeckError for errors on which a result depends."""
        if errors := self.errors():
            raise DeckError(self.deck.diagnose(errors))
        return self

    def contact(self, tension: Literal["keep", "cut"] = "keep") -> ContactModel:
        """The evaluator of this scene, with only the stages it needs.

        Raises DeckError for errors on which a result depends; ElementError (a ValueError) for an element that lacks
        what its law needs.
        """
        return ContactModel(self.contact_input(tension))

    def contact_input(self, tension: Literal["keep", "cut"] = "keep") -> ContactInput:
        """The arrays that the evaluator is made from."""
        self.require()
        usable = [index for index, entry in enumerate(self.laws.curves) if entry.curve is not None]
        number = {index: position for position, index in enumerate(usable)}
        curve_of_grant = np.array([*(number.get(grant.curve, -1) for grant in self.laws.grants), -1], dtype=np.intp)
        stiffness = np.array([*(grant.stiffness for grant in self.laws.grants), np.nan])
        return ContactInput(
            node_ids=self.node_ids,
            coordinates=self.coordinates,
            element_ids=self.element_ids,
            element_nodes=self.element_nodes,
            length=self.length,
            diameter=self.diameter,
            law=self.law,
            curve_index=curve_of_grant[self.laws.of_element],
            curves=tuple(entry.curve for entry in self.laws.curves if entry.curve is not None),
            linear_stiffness=stiffness[self.laws.of_element],
            tension=tension,
            left_out=self._left_out(),
        )

    def _left_out(self) -> dict[str, str]:
        """What the deck asks for and this version does not evaluate, by stage of the plan."""
        asked: dict[str, Counter[str]] = {}
        for keyword, stage in _LATER.items():
            if keyword in self.deck.keywords():
                asked.setdefault(stage, Counter())[f"*{keyword}"] += 1
        for _, block in self.deck.blocks("SEABED PROPERTIES"):
            for entry in block.sets:
                for name, stage in (("friction", "friction"), ("lateral", "friction"), ("suction", "suction")):
                    if getattr(entry, name) is not None:
                        asked.setdefault(stage, Counter())[f"{name.upper()}="] += 1
        for keyword in ("ELASTIC SURFACE", "RIGID SURFACE"):
            for _, block in self.deck.blocks(keyword):
                if block.slope is not None or block.profile is not None:
                    asked.setdefault("floor", Counter())[f"the slope or profile of *{keyword}"] += 1
                row = block.properties
                for stage, names in (("friction", ("longitudinal", "transverse", "lateral")), ("suction", ("suction_stiffness",))):
                    if any(getattr(row, name, None) for name in names):
                        asked.setdefault(stage, Counter())[f"the {stage} of *{keyword}"] += 1
        return {
            stage: f"not evaluated in this version: {', '.join(f'{what} ({n} times)' if n > 1 else what for what, n in c.items())}"
            for stage, c in asked.items()
        }


_LATER = {
    "SEABED PROFILE": "floor",
    "SEABED PLANES": "floor",
    "SEABED CONTACT": "normal law",
    "SEABED UNLOADING": "normal law",
    "SEABED SUCTION": "suction",
    "SEABED FRICTION": "friction",
    "SEABED TRENCH": "trench",
}
"""Keywords that this version keeps and does not evaluate, and the stage that they belong to."""
