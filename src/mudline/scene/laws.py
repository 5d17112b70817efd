"""Which normal law each element gets: both families, the later definition wins."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import REF002, SBD001, SBD002, SBD004, SBD005, SBD009
from mudline.contact.inputs import LawKind
from mudline.deck.parameters import folded
from mudline.diagnostics import Where
from mudline.keywords.text import shown, suggestion
from mudline.scene.context import Context
from mudline.scene.force_curves import SceneCurve
from mudline.scene.numbering import Indices, Numbered
from mudline.scene.sections import SectionTable
from mudline.scene.sets import NamedSet, Sets

if TYPE_CHECKING:
    from mudline.keywords.library.elastic_surface import ElasticSurface
    from mudline.keywords.library.seabed_properties import SeabedProperties, SeabedSet

NOTHING = -1


@dataclass(frozen=True, slots=True)
class Grant:
    """What one place of the deck gives to a set of elements.

    `family` is "legacy" or "new"; `unknown` marks a law that could not be read or found, of which enough has been said.
    """

    kind: LawKind
    set_: NamedSet
    where: Where
    family: str
    stiffness: float = float("nan")
    curve: int = NOTHING
    unknown: bool = False


@dataclass(slots=True)
class LawTable:
    """The grants in the order in which they were found, and the one that each element follows (m,), -1 for none."""

    grants: list[Grant] = field(default_factory=list)
    of_element: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    covered: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    curves: list[SceneCurve] = field(default_factory=list)
    referenced: set[int] = field(default_factory=set)
    types: dict[str, list[Where]] = field(default_factory=dict)


def read_laws(
    context: Context, sets: Sets, named: list[SceneCurve], by_set: list[SceneCurve], count: int
) -> LawTable:
    """The law of each of `count` elements. `covered` (m,) is the last new-family block that holds an element."""
    laws = LawTable(curves=[*named, *by_set])
    laws.of_element = np.full(count, NOTHING, dtype=np.intp)
    laws.covered = np.full(count, NOTHING, dtype=np.intp)
    _legacy(context, sets, laws, len(named))
    _new_family(context, sets, laws, len(named))
    _check_types(context, laws)
    return laws


def _give(laws: LawTable, grant: Grant) -> None:
    laws.of_element[grant.set_.elements] = len(laws.grants)
    laws.grants.append(grant)


def _legacy(context: Context, sets: Sets, laws: LawTable, first_curve: int) -> None:
    """`*ELASTIC SURFACE` and `*RIGID SURFACE` hold for all; a curve of `*EMBEDMENT` wins in whatever order they stand."""
    everything = sets.named["all"]
    for where, _ in context.deck.blocks("RIGID SURFACE"):
        laws.types.setdefault("RIGID", []).append(where)
        _give(laws, Grant(LawKind.RIGID, everything, where, "legacy"))
    for where, block in context.deck.blocks("ELASTIC SURFACE"):
        laws.types.setdefault("ELASTIC", []).append(where)
        place = where._replace(path=("properties", "stiffness"))
        stiffness = getattr(cast("ElasticSurface", block).properties, "stiffness", None)
        if stiffness is not None:
            value = float(cast("float", stiffness))
            usable = value >= 0
            _give(laws, Grant(LawKind.LINEAR, everything, place, "legacy", value, unknown=not usable))
        elif not laws.curves[first_curve:] and not context.deck.origin.damaged(where._replace(path=("properties",))):
            message = "no stiffness here and no *EMBEDMENT in the model: nothing carries the elements vertically"
            context.tell(SBD004, message, where)
    for offset, curve in enumerate(laws.curves[first_curve:]):
        name = None if curve.name == "ALL" else curve.name
        found = sets.find(name, curve.where)
        if found is not None:
            index = first_curve + offset
            laws.referenced.add(index)
            unknown = curve.curve is None
            _give(laws, Grant(LawKind.CURVE, found, curve.where, "legacy", curve=index, unknown=unknown))


def _new_family(context: Context, sets: Sets, laws: LawTable, curves: int) -> None:
    """The last block that holds an element is taken whole; where it gives no stiffness, a legacy law stays."""
    wins = np.full(len(laws.of_element), NOTHING, dtype=np.intp)
    by_name = {folded(curve.name): index for index, curve in enumerate(laws.curves[:curves])}
    for where, block in context.deck.blocks("SEABED PROPERTIES"):
        properties = cast("SeabedProperties", block)
        if properties.type_ is not None:
            laws.types.setdefault(properties.type_, []).append(where._replace(path=("type",)))
        for index, entry in enumerate(properties.sets):
            place = where._replace(path=("sets", index))
            found = sets.find(entry.set_name, place)
            grant = _grant(context, laws, entry, place, found or _no_elements(sets), by_name, properties.type_)
            if found is None:
                continue
            wins[found.elements] = len(laws.grants)
            laws.covered[found.elements] = len(laws.grants)
            laws.grants.append(grant)
    gives = np.array([grant.kind is not LawKind.NONE or grant.unknown for grant in laws.grants] + [False])
    replaced = gives[wins]
    laws.of_element[replaced] = wins[replaced]


def _no_elements(sets: Sets) -> NamedSet:
    return NamedSet("", sets.named["all"].elements[:0], None)


def _grant(
    context: Context,
    laws: LawTable,
    entry: SeabedSet,
    where: Where,
    found: NamedSet,
    by_name: dict[str, int],
    type_: str | None,
) -> Grant:
    place = where._replace(path=(*where.path, "stiffness"))
    stiffness = entry.stiffness
    if stiffness is None:
        kind = LawKind.RIGID if type_ == "RIGID" else LawKind.NONE
        return Grant(kind, found, where, "new", unknown=context.deck.origin.damaged(where))
    if not isinstance(stiffness, str):
        value = float(stiffness)
        return Grant(LawKind.LINEAR, found, place, "new", value, unknown=not value >= 0)
    index = by_name.get(folded(stiffness))
    if index is None:
        known = [curve.name for curve in laws.curves[: len(by_name)]]
        message = f"curve {shown(stiffness)} is not defined{suggestion(stiffness, known)}: *SEABED STIFFNESS has no such curve"
        context.tell_missing(REF002, message, place, "SEABED STIFFNESS")
        return Grant(LawKind.CURVE, found, place, "new", unknown=True)
    laws.referenced.add(index)
    return Grant(LawKind.CURVE, found, place, "new", curve=index, unknown=laws.curves[index].curve is None)


def _check_types(context: Context, laws: LawTable) -> None:
    """One contact model in a deck, and curves only on an elastic bed."""
    rigid, elastic = laws.types.get("RIGID", []), laws.types.get("ELASTIC", [])
    if rigid and elastic:
        later, other = (rigid[0], "elastic") if rigid[0] > elastic[0] else (elastic[0], "rigid")
        this = "rigid" if other == "elastic" else "elastic"
        context.tell(SBD002, f"a {this} seabed here and {_an(other)} one before: a model has one of them", later)
    for index, curve in enumerate(laws.curves):
        if curve.embedment and (rigid or not elastic) and not _unread_type(context):
            why = "the seabed is rigid" if rigid else "the model has no elastic seabed (*ELASTIC SURFACE or TYPE=ELASTIC)"
            context.tell(SBD005, f"*EMBEDMENT needs an elastic seabed: {why}", curve.where)
        elif rigid and not elastic and index in laws.referenced:
            for grant in laws.grants:
                if grant.curve == index:
                    message = f"curve {curve.name!r} on a rigid seabed: a force-embedment curve needs TYPE=ELASTIC"
                    context.tell(SBD001, message, grant.where)


def _an(word: str) -> str:
    return f"an {word}" if word[0] in "aeiou" else f"a {word}"


def _unread_type(context: Context) -> bool:
    """Whether a `*SEABED PROPERTIES` gives no type that could be read: that has been told."""
    return any(cast("SeabedProperties", block).type_ is None for _, block in context.deck.blocks("SEABED PROPERTIES"))


def check_diameters(context: Context, laws: LawTable, sections: SectionTable, elements: Numbered) -> None:
    """Elements on a curve need a diameter; told once for each place that gives the curve."""
    on_curve = np.array([grant.kind is LawKind.CURVE for grant in laws.grants] + [False])[laws.of_element]
    missing = on_curve & np.isnan(sections.diameter) & ~sections.faulty
    for index, count in Counter(laws.of_element[missing].tolist()).items():
        grant = laws.grants[index]
        first = int(elements.ids[np.flatnonzero(missing & (laws.of_element == index))[0]])
        what = f"element {first} has" if count == 1 else f"{count} elements (first: {first}) have"
        message = f"{what} a curve and no external diameter: give Do (or Dd) in *GEOMETRIC SETS"
        context.tell_missing(SBD009, message, grant.where, "GEOMETRIC SETS")
