"""Sections of pipes, and the elements that have them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawKind
from mudline.deck.model import Deck
from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.keywords.catalogue import ZERO_LENGTH
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_TOLD

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSet, GeometricSets

GEO001 = Code("GEO001", "inner-exceeds-outer", Severity.ERROR)
GEO002 = Code("GEO002", "number-and-curve", Severity.WARNING)
GEO003 = Code("GEO003", "drag-diameter-assumed", Severity.INFO)
GEO004 = Code("GEO004", "zero-length-element", Severity.ERROR)

_FORMATS = ("flexible", "rigid", "mooring", "truss")
_BENDING = ("eiyy", "eizz")
_CURVES = {
    "eiyy_curve": ("EIYY", ("eiyy",)),
    "eizz_curve": ("EIZZ", ("eizz",)),
    "gj_curve": ("GJ", ("gj",)),
    "ea_curve": ("EA", ("ea",)),
    "ei_curve": ("EI", _BENDING),
    "hysteresis_curve": ("EI_HYSTERESIS", _BENDING),
    "e_curve": ("E", ("e",)),
}
"""Which numbers of the property line a curve stands in for; the setting that names the curve."""
_NAMES = {"eiyy": "EIyy", "eizz": "EIzz", "gj": "GJ", "ea": "EA", "e": "E"}


def _sections(deck: Deck) -> Iterator[tuple[Where, GeometricSet]]:
    for where, block in deck.blocks("GEOMETRIC SETS"):
        for index, entry in enumerate(cast("GeometricSets", block).sets):
            yield where._replace(path=("sets", index)), entry


def format_of(entry: GeometricSet) -> str:
    """The format of the property line, "" without one."""
    return next((name for name in _FORMATS if getattr(entry, name) is not None), "")


@rule(GEO001)
def inner_exceeds_outer(context: LintContext) -> Iterator[Problem]:
    """The internal diameter of a section is not smaller than its external diameter.

    The pipe has no wall: its mass and stiffness would be zero or negative. The two fields are exchanged, or the wall
    thickness was subtracted from the wrong one. Correct Do or Di.

    Bad:
        $MODEL
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=ALL
         207.0E9, 79.6E9, 0.2889, 0.3239, 7850.0

    Good:
        $MODEL
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=ALL
         207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 5:27
    """
    yield from islice(_without_wall(context.scene.deck), MOST_TOLD)


def _without_wall(deck: Deck) -> Iterator[Problem]:
    for where, entry in _sections(deck):
        outer, inner = (getattr(entry.section, name, None) for name in ("do", "di"))
        if isinstance(outer, int | float) and isinstance(inner, int | float) and inner >= outer > 0:
            message = f"internal diameter {inner!r} is not smaller than the external diameter {outer!r}: correct one"
            yield Problem(GEO001, message, where=where._replace(path=(*where.path, format_of(entry), "Di")))


@rule(GEO002)
def number_and_curve(context: LintContext) -> Iterator[Problem]:
    """A stiffness is given twice: as a number, and by a curve.

    Where SET= names a curve of the non-linear stiffness, its number on the property line is to be left empty. With both
    it is not clear which one a run takes. Leave the field empty, or remove the curve.

    Bad:
        $MODEL
        *GEOMETRIC SETS
         OPTION=FLEXIBLE
         SET=ALL, EI=Bend Stiffener
         23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429, 0.3429

    Good:
        $MODEL
        *GEOMETRIC SETS
         OPTION=FLEXIBLE
         SET=ALL, EI=Bend Stiffener
         , , 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429, 0.3429

    Finds: 5:2
    """
    yield from islice(_given_twice(context.deck), MOST_TOLD)


def _given_twice(deck: Deck) -> Iterator[Problem]:
    for where, entry in _sections(deck):
        if entry.mooring is not None:
            continue  # its format has no place for a curve, and EA must be given
        for curve, (key, numbers) in _CURVES.items():
            if getattr(entry, curve) is None:
                continue
            if given := [name for name in numbers if getattr(entry.section, name, None) is not None]:
                names = " and ".join(_NAMES[name] for name in given)
                message = f"{names} is given as a number, and {key}= names a curve for it: remove one of them"
                place = where._replace(path=(*where.path, format_of(entry), _NAMES[given[0]]))
                yield Problem(GEO002, message, where=place)


@rule(GEO003)
def drag_diameter_assumed(context: LintContext) -> Iterator[Problem]:
    """A flexible section under a force-embedment curve has no Do: the drag diameter Dd is taken.

    The embedment ratio is a depth divided by the external diameter, so the stiffness of the seabed depends on it. The
    drag diameter is often larger, as it takes in marine growth, fairings or strakes. Give Do, the last field but one of
    the property line.

    Bad:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *GEOMETRIC SETS
         OPTION=FLEXIBLE
         SET=ALL
         23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3910, 0.3429
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Good:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *GEOMETRIC SETS
         OPTION=FLEXIBLE
         SET=ALL
         23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3910, 0.3429, 0.3429
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Finds: 12:53
    """
    scene = context.scene
    table = scene.section_table
    if all(section.source != "Dd" for section in table.sections):
        return
    on_curve = table.of_element[(scene.law == LawKind.CURVE) & (table.of_element >= 0)]
    for index, count in zip(*(part.tolist() for part in np.unique(on_curve, return_counts=True)), strict=True):
        section = table.sections[index]
        if section.source == "Dd" and not np.isnan(section.diameter) and not section.faulty:
            elements = "an element" if count == 1 else f"{count} elements"
            message = (
                f"the embedment ratio of {elements} on a curve is formed with Dd = {section.diameter:g}, as the "
                "section has no Do: give Do"
            )
            yield Problem(GEO003, message, where=section.where._replace(path=(*section.where.path, "flexible", "Dd")))


@rule(GEO004)
def zero_length_element(context: LintContext) -> Iterator[Problem]:
    """The two nodes of an element lie at one place.

    The element has no length and no direction, so it has neither a stiffness nor a share of the seabed. A node was
    copied without changing its coordinates, or two parts that meet have a node each. Correct the node, or join the
    parts at one node. In a model with flex joints, hinges, springs or dampers, which may have no length, this is a
    warning.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
         3, 12.0, 10.0
         4, 12.0, 20.0
        *ELEMENT
         1, 1, 2
         2, 2, 3
         3, 3, 4

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
         3, 12.0, 15.0
         4, 12.0, 20.0
        *ELEMENT
         1, 1, 2
         2, 2, 3
         3, 3, 4

    Finds: 9:2
    """
    scene = context.scene
    known = np.flatnonzero((scene.element_nodes >= 0).all(axis=1))
    first, second = scene.element_nodes[known].T
    same = known[(scene.coordinates[first] == scene.coordinates[second]).all(axis=1)]
    joints = scene.deck.keywords().intersection(ZERO_LENGTH)
    hint = f", or keep it if *{min(joints)} makes it one without length" if joints else ""
    told: set[Where] = set()
    for index in same[:MOST_TOLD].tolist():
        where = scene.table.numbered.where(index)
        if where in told:
            continue  # others of the same GEN=
        told.add(where)
        one, other = scene.node_ids[scene.element_nodes[index]].tolist()
        nodes = f"both its ends are node {one}" if one == other else f"nodes {one} and {other} lie at one place"
        message = f"element {scene.element_ids[index]} has no length, {nodes}: correct it{hint}"
        yield Problem(GEO004, message, None, Severity.WARNING if joints else None, where)
