"""Laws of each element: its normal law and resistance, of both families, and its blocks of extension keywords."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import wraps
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from mudline.basics.short_repr import short_repr
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Code, Problem, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_partly_unknown
from mudline.language.keywords.values import UNKNOWN, known_name
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.context import Context
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.numbering import Floats, Indices, Mask, looked_up, marked, picked
from mudline.model.scene.sets import NamedSet, Sets, later_wins

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_properties import ElasticSurface, SeabedProperties, SeabedSet
    from mudline.language.keywords.model import Record


DIRECTIONS = ("longitudinal", "transverse")
"""Directions of friction, as the names of its fields begin."""

NOTHING = -1


class SetLaw(NamedTuple):
    """Law that one place of the deck gives to a set of elements; an unknown set is open and holds none.

    kind: kind of law.
    set_: the set.
    where: place of the law.
    family: "legacy" or "new".
    stiffness: linear stiffness, NaN for other laws.
    curve: index in the table's curves.
    unknown: the law could not be read or found, which is reported.
    """

    kind: LawKind
    set_: NamedSet
    where: Where
    family: str
    stiffness: float = math.nan
    curve: int = NOTHING
    unknown: bool = False


@dataclass(slots=True, repr=False, eq=False)
class LawTable:
    """Laws of sets, legacy ones first, and the law that each element follows.

    curves: the named curves, then those of `*EMBEDMENT`.
    set_laws: the laws in the order in which they were found.
    of_element: index (m,) of the law of each element, -1 for none.
    covered: the last law (m,) of the new family that holds an element, also one without stiffness.
    types: places that give "RIGID" or "ELASTIC".
    gaps: places after which lines may give more laws.
    """

    curves: list[SceneCurve]
    set_laws: list[SetLaw] = field(default_factory=list)
    of_element: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    covered: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    types: dict[str, list[Where]] = field(default_factory=dict)
    gaps: list[Where] = field(default_factory=list)

    __repr__ = short_repr

    @property
    def uncertain(self) -> bool:
        """True if some law belongs to elements that the deck does not show: any element may have it."""
        return any(set_law.set_.open for set_law in self.set_laws)


def read_laws(context: Context, sets: Sets, named: list[SceneCurve], by_set: list[SceneCurve], count: int) -> LawTable:
    """Return the law of each of `count` elements.

    In both families a curve takes precedence over a number. Of two curves or two numbers, that of the new family is
    used.
    """
    laws = LawTable(curves=[*named, *by_set])
    if any(map(catalogue.is_superseded, context.unread)):
        laws.gaps.append(Where(len(context.deck.sections)))
    legacy = [*_surfaces(context, sets, laws), *_embedment(sets, laws, len(named))]
    new = list(_properties(context, sets, laws, named))
    laws.set_laws = legacy + new
    wins = later_wins([set_law.set_ for set_law in new], count)
    laws.of_element = later_wins([set_law.set_ for set_law in legacy], count)
    laws.covered = looked_up(np.array([*range(len(legacy), len(laws.set_laws)), NOTHING], dtype=np.intp), wins)
    gives = np.array([*(set_law.kind is not LawKind.NONE or set_law.unknown for set_law in laws.set_laws), False])
    replaced = looked_up(gives, laws.covered)
    if any(set_law.kind is LawKind.CURVE for set_law in legacy):
        kinds = np.array([*(set_law.kind for set_law in laws.set_laws), LawKind.NONE])
        curves = looked_up(kinds == LawKind.CURVE, laws.of_element)
        replaced = replaced & ~(curves & looked_up(kinds == LawKind.LINEAR, laws.covered))
    count_replaced = np.count_nonzero(replaced)
    if count_replaced == count:
        laws.of_element = laws.covered
    elif count_replaced:
        laws.of_element = np.where(replaced, laws.covered, laws.of_element)
    return laws


def _surfaces(context: Context, sets: Sets, laws: LawTable) -> Iterator[SetLaw]:
    """Yield rigid surfaces, and the linear stiffness that holds where no curve of `*EMBEDMENT` does, in any order."""
    for where, _ in context.blocks("RIGID SURFACE"):
        laws.types.setdefault("RIGID", []).append(where)
        yield SetLaw(LawKind.RIGID, sets.everything, where, "legacy")
    for where, block in context.blocks("ELASTIC SURFACE"):
        laws.types.setdefault("ELASTIC", []).append(where)
        place = where.inside("properties", "stiffness")
        stiffness = getattr(cast("ElasticSurface", block).properties, "stiffness", None)
        if stiffness is not None:
            value = float(cast("float", stiffness))
            yield SetLaw(LawKind.LINEAR, sets.everything, place, "legacy", value, unknown=not value >= 0)


def _embedment(sets: Sets, laws: LawTable, first: int) -> Iterator[SetLaw]:
    for index, curve in enumerate(laws.curves[first:], first):
        holder = (sets.find(curve.name) if curve.name else None) or _unknown(curve.name)
        yield SetLaw(LawKind.CURVE, holder, curve.where, "legacy", curve=index, unknown=not curve.usable)


def _unknown(name: str | None) -> NamedSet:
    return NamedSet(name or "", np.zeros(0, dtype=np.intp), None, open=True)


def typed_blocks(context: Context) -> Iterator[tuple[Where, SeabedProperties, str | None]]:
    """Yield the `*SEABED PROPERTIES` blocks with their type: a block without TYPE= has that of the block before it."""
    type_: str | None = None
    for where, block in context.blocks("SEABED PROPERTIES"):
        properties = cast("SeabedProperties", block)
        type_ = type_ if properties.type_ is None else properties.type_
        yield where, properties, type_


def _properties(context: Context, sets: Sets, laws: LawTable, named: list[SceneCurve]) -> Iterator[SetLaw]:
    curves = {folded(curve.name): index for index, curve in enumerate(named) if curve.name}
    for where, properties, type_ in typed_blocks(context):
        if known_name(properties.type_):
            laws.types.setdefault(str(properties.type_), []).append(where.inside("type"))
        if not properties.sets and is_partly_unknown(properties.sets):
            laws.gaps.append(where)
        for place, entry, name, named_set in sets.entries([(where, properties)]):
            values = (entry.stiffness, entry.friction, entry.lateral, entry.suction)
            if UNKNOWN in values and None not in values:  # a line that could not be used may be another SET=
                laws.gaps.append(place)
            holder = named_set or _unknown(name)
            stiffness, written = entry.stiffness, place.inside("stiffness")
            if isinstance(stiffness, str):
                curve = curves.get(folded(stiffness), NOTHING)
                unknown = curve == NOTHING or not named[curve].usable
                yield SetLaw(LawKind.CURVE, holder, written, "new", curve=curve, unknown=unknown)
            elif type_ == "RIGID":  # on a rigid seabed a stiffness has no effect
                yield SetLaw(LawKind.RIGID, holder, place, "new")
            elif stiffness is None or stiffness is UNKNOWN:
                unknown = stiffness is UNKNOWN or not type_
                yield SetLaw(LawKind.NONE, holder, place, "new", unknown=unknown)
            else:
                value = float(stiffness)
                yield SetLaw(LawKind.LINEAR, holder, written, "new", value, unknown=not value >= 0)


class ResistanceValues(NamedTuple):
    """Values of one place of the deck, NaN for values that it does not give.

    Friction coefficients, mobilisation lengths, largest characteristic lengths and friction stiffnesses are those of
    the longitudinal, then of the transverse direction.
    """

    friction: tuple[float, float] = (math.nan, math.nan)
    mobilisation: tuple[float, float] = (math.nan, math.nan)
    characteristic: tuple[float, float] = (math.nan, math.nan)
    constant: float = math.nan
    friction_stiffness: tuple[float, float] = (math.nan, math.nan)
    lateral: float = math.nan
    suction: float = math.nan
    extent: float = math.nan


class SeabedResistance(NamedTuple):
    """Resistance of elements, NaN where the deck gives none, in the deck's units.

    values: the values that the deck gives.
    places: their places.
    of_element: index (m,) of each element in them, -1 for elements without any.
    """

    values: Sequence[ResistanceValues]
    places: Sequence[Where]
    of_element: Indices

    @property
    def has_mobilisation(self) -> bool:
        """True if a mobilisation length above 0 is given."""
        return any(length > 0.0 for entry in self.values for length in entry.mobilisation)

    def column(self, name: str) -> Floats:
        """Return a field of `ResistanceValues` for all elements: (m,), or (m, 2) for fields of two directions."""
        table = np.array([getattr(entry, name) for entry in (*self.values, ResistanceValues())], dtype=np.float64)
        return table[self.of_element]


def read_resistance(context: Context, laws: LawTable) -> SeabedResistance:
    """Return the resistance of the last block of `*SEABED PROPERTIES` that holds an element, or of the legacy surface.

    A block is taken as a whole.
    """
    surfaces = [surface.properties for _, surface in context.surfaces]
    values = [_resistance(surface, surface, surface, "suction_") for surface in surfaces]
    places = [where.inside("properties") for where, _ in context.surfaces]
    position_of = np.full(len(laws.set_laws) + 1, len(surfaces) - 1, dtype=np.intp)
    for index in present(laws.covered):
        place = laws.set_laws[index].where
        place = place._replace(path=place.path[:2])
        position_of[index] = len(values)
        entry: SeabedSet = context.deck.at(place)
        values.append(_resistance(entry, entry.friction, entry.suction))
        places.append(place)
    return SeabedResistance(values, places, looked_up(position_of, laws.covered))


def present(covered: Indices) -> list[int]:
    """Return the indices that occur, without -1, in ascending order."""
    return np.bincount(covered[covered >= 0]).nonzero()[0].tolist()


def _resistance(entry: object, friction: object, suction: object, prefix: str = "") -> ResistanceValues:
    """Return the values of an entry; those of suction have a `prefix` in their names."""

    def two(name: str) -> tuple[float, float]:
        if friction is None:
            return math.nan, math.nan
        return number(friction, f"longitudinal{name}"), number(friction, f"transverse{name}")

    return ResistanceValues(
        friction=two(""),
        mobilisation=two("_mobilisation"),
        characteristic=two("_length"),
        constant=number(friction, "constant"),
        friction_stiffness=two("_stiffness"),
        lateral=number(entry, "lateral"),
        suction=number(suction, f"{prefix}stiffness"),
        extent=number(suction, f"{prefix}extent"),
    )


class Extension(NamedTuple):
    """Blocks of one keyword in the order of the file; `of_element` (m,) is the block of each element, or -1."""

    entries: list[Record]
    places: list[Where]
    sets: list[NamedSet | None]
    of_element: Indices

    def blocks(self) -> Iterator[tuple[Record, Where, Mask]]:
        """Yield each block with its place, and a mask (m,) of the elements that follow it."""
        for index, (entry, where) in enumerate(zip(self.entries, self.places, strict=True)):
            yield entry, where, self.of_element == index

    def values(self, at: Indices, *names: str, default: float = math.nan) -> Floats:
        """Return a number of the block of each index, `default` if the block does not give it, NaN for -1.

        `names` lead to it: a field, or a field of a record and a field in it.
        """
        *outer, name = names
        parts: Iterable[object] = self.entries
        for step in outer:
            parts = [getattr(part, step, None) for part in parts]
        return picked((number(part, name, default) for part in parts), at)

    def says(self, at: Indices, name: str, word: str) -> Mask:
        """Return a mask that is True for each index whose block gives a word in a field; False for -1."""
        return marked((getattr(entry, name, None) == word for entry in self.entries), at)

    def asking(self, name: str) -> Mask:
        """Return a mask (m,) of elements whose block gives a field, if a number at least 0.

        If the field is mandatory, every element with a block counts.
        """
        flags = []
        for entry in self.entries:
            value = getattr(entry, name, None)
            number_asks = value >= 0.0 if isinstance(value, float | int) else value is not None
            flags.append(number_asks or type(entry).model_fields[name].is_required())
        return marked(flags, self.of_element)


def read_extensions(context: Context, sets: Sets, count: int) -> dict[str, Extension]:
    """Return the extensions that the deck gives, by keyword in the order of the catalogue."""
    keywords = {block.keyword for _, block in context.deck.blocks_with("extension") if block.facts.later_wins}
    extensions = {}
    for keyword in catalogue.in_order(keywords):
        found = list(sets.entries(context.blocks(keyword)))
        if any(name is None for _, _, name, _ in found):
            context.unread.add(keyword)
        holders = [holder for _, _, _, holder in found]
        extensions[keyword] = Extension(
            [entry for _, entry, _, _ in found], [where for where, *_ in found], holders, later_wins(holders, count)
        )
    return extensions


def rule_of_extension(
    code: Code, keyword: str, *, blocks: bool = True
) -> Callable[[Callable[[Any, Extension], Iterator[Problem]]], object]:
    """Return a decorator that makes a rule of a function of a resolved deck and its blocks of an extension keyword.

    A rule that only advises (`blocks` False) has the scene of the deck. Nothing is reported in decks without blocks.
    """

    def register(find: Callable[[Any, Extension], Iterator[Problem]]) -> object:
        @rule(code, blocks=blocks)
        @wraps(find)
        def check(subject: Any) -> Iterable[Problem]:  # noqa: ANN401 - as the function of any rule
            scene = subject if blocks else subject.scene
            extension = scene.extensions.get(keyword)
            return find(scene, extension) if extension else ()

        return check

    return register
