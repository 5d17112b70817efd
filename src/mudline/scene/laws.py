"""Which normal law each element gets: both families, the later definition wins."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawKind
from mudline.deck.parameters import folded
from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.force_curves import SceneCurve, set_name
from mudline.scene.numbering import Indices, looked_up
from mudline.scene.sets import NamedSet, Sets, later_wins
from mudline.short_repr import short_repr

if TYPE_CHECKING:
    from mudline.keywords.library.elastic_surface import ElasticSurface
    from mudline.keywords.library.seabed_properties import SeabedProperties, SeabedSet

NOTHING = -1


@dataclass(frozen=True, slots=True)
class Grant:
    """What one place of the deck gives to a set of elements; a set that is not known is open and holds none.

    `family` is "legacy" or "new"; `curve` an index in the table's curves. `unknown` marks a law that could not be read
    or found: enough has been said of it.
    """

    kind: LawKind
    set_: NamedSet
    where: Where
    family: str
    stiffness: float = float("nan")
    curve: int = NOTHING
    unknown: bool = False

    __repr__ = short_repr


@dataclass(slots=True)
class LawTable:
    """The grants as they were found, legacy ones first, and the one that each element follows (m,), -1 for none.

    `covered` (m,) is the last grant of the new family that holds an element, also one without stiffness. `curves` are
    the named ones, then those of `*EMBEDMENT`; `referenced` the folded names that a STIFFNESS= gives. `types` has the
    places that say "RIGID" or "ELASTIC".
    """

    curves: list[SceneCurve]
    grants: list[Grant] = field(default_factory=list)
    of_element: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    covered: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    referenced: set[str] = field(default_factory=set)
    types: dict[str, list[Where]] = field(default_factory=dict)

    __repr__ = short_repr

    @property
    def uncertain(self) -> bool:
        """Whether some law belongs to elements that the deck does not show: any element may have it."""
        return any(grant.set_.open for grant in self.grants)

    def followers(self, curve: int) -> Indices:
        """Indices of the elements on a curve."""
        on_curve = np.array([*(grant.curve == curve for grant in self.grants), False])
        return np.flatnonzero(on_curve[self.of_element])


def read_laws(context: Context, sets: Sets, named: list[SceneCurve], by_set: list[SceneCurve], count: int) -> LawTable:
    """The law of each of `count` elements."""
    laws = LawTable(curves=[*named, *by_set])
    surfaces = [*_rigid_surface(context, sets, laws), *_elastic_surface(context, sets, laws)]
    legacy = [*surfaces, *_embedment(sets, laws, len(named))]
    new = list(_properties(context, sets, laws, named))
    laws.grants = legacy + new
    laws.of_element = later_wins([grant.set_ for grant in legacy], count)
    wins = later_wins([grant.set_ for grant in new], count)
    laws.covered = looked_up(np.array([*range(len(legacy), len(laws.grants)), NOTHING], dtype=np.intp), wins)
    gives = np.array([*(grant.kind is not LawKind.NONE or grant.unknown for grant in laws.grants), False])
    replaced = looked_up(gives, laws.covered)
    if replaced.all():
        laws.of_element = laws.covered
    elif replaced.any():
        laws.of_element = np.where(replaced, laws.covered, laws.of_element)
    return laws


def _rigid_surface(context: Context, sets: Sets, laws: LawTable) -> Iterator[Grant]:
    for where, _ in context.deck.blocks("RIGID SURFACE"):
        laws.types.setdefault("RIGID", []).append(where)
        yield Grant(LawKind.RIGID, sets.everything, where, "legacy")


def _elastic_surface(context: Context, sets: Sets, laws: LawTable) -> Iterator[Grant]:
    """The linear stiffness that holds where no curve of `*EMBEDMENT` does, in whatever order they stand."""
    for where, block in context.deck.blocks("ELASTIC SURFACE"):
        laws.types.setdefault("ELASTIC", []).append(where)
        place = where._replace(path=("properties",))
        stiffness = getattr(cast("ElasticSurface", block).properties, "stiffness", None)
        field_ = place._replace(path=("properties", "stiffness"))
        if stiffness is not None:
            value = float(cast("float", stiffness))
            yield Grant(LawKind.LINEAR, sets.everything, field_, "legacy", value, unknown=not value >= 0)
        elif context.disturbed(place):
            yield Grant(LawKind.LINEAR, sets.everything, field_, "legacy", unknown=True)


def _embedment(sets: Sets, laws: LawTable, first: int) -> Iterator[Grant]:
    for index, curve in enumerate(laws.curves[first:], first):
        found = sets.find(curve.name) if curve.named else None
        yield Grant(
            LawKind.CURVE,
            found or _unknown(curve.name),
            curve.where,
            "legacy",
            curve=index,
            unknown=not curve.usable,
        )


def _unknown(name: str | None) -> NamedSet:
    return NamedSet(name or "", np.zeros(0, dtype=np.intp), None, open=True)


def typed_blocks(context: Context) -> Iterator[tuple[Where, SeabedProperties, str | None]]:
    """The `*SEABED PROPERTIES` blocks with their type: a block without TYPE= has that of the block before it."""
    type_: str | None = None
    for where, block in context.deck.blocks("SEABED PROPERTIES"):
        properties = cast("SeabedProperties", block)
        type_ = None if context.lacks_value(where, "type") else properties.type_ or type_
        yield where, properties, type_


def _properties(context: Context, sets: Sets, laws: LawTable, named: list[SceneCurve]) -> Iterator[Grant]:
    curves = {folded(curve.name): index for index, curve in enumerate(named) if curve.named}
    for where, properties, type_ in typed_blocks(context):
        if properties.type_ is not None and type_ is not None:
            laws.types.setdefault(properties.type_, []).append(where._replace(path=("type",)))
        reading = _Reading(context, laws, curves, type_)
        for index, entry in enumerate(properties.sets):
            place = where._replace(path=("sets", index))
            name = set_name(context, entry.set_name, place)
            found = None if name is None else sets.find(name)
            yield reading.grant(entry, place, found or _unknown(name))


@dataclass(frozen=True, slots=True)
class _Reading:
    """What is needed to understand a STIFFNESS=."""

    context: Context
    laws: LawTable
    curves: dict[str, int]
    type_: str | None

    def grant(self, entry: SeabedSet, where: Where, found: NamedSet) -> Grant:
        """The law of a set. On a rigid bed a stiffness counts for nothing."""
        place = where._replace(path=(*where.path, "stiffness"))
        stiffness = entry.stiffness
        unread = self.context.disturbed(where)
        if isinstance(stiffness, str):
            index = self.curves.get(folded(stiffness), NOTHING)
            unknown = unread or index == NOTHING or not self.laws.curves[index].usable
            return Grant(LawKind.CURVE, found, place, "new", curve=index, unknown=unknown)
        if self.type_ == "RIGID":
            return Grant(LawKind.RIGID, found, where, "new")
        if stiffness is None:
            return Grant(LawKind.NONE, found, where, "new", unknown=unread or self.type_ is None)
        value = float(stiffness)
        return Grant(LawKind.LINEAR, found, place, "new", value, unknown=unread or not value >= 0)
