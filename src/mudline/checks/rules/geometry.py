"""Sections of pipes: values that are given twice, or not at all."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from mudline.checks.context import Found, Joined, LintContext, entries_of_sets, joint
from mudline.checks.rules.coordinates import UNT006
from mudline.checks.rules.unusual import UNT004, UNT005
from mudline.language.deck.model import Opaque
from mudline.language.deck.parameters import folded, name_key
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.contents import idents_given, is_partly_unknown, names_given
from mudline.language.keywords.model import FieldSpec, Part, record_schema
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.numbering import Mask
from mudline.model.scene.rules.fields import GEO001
from mudline.model.scene.sections import Section, format_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.geometric_sets import GeometricSet
    from mudline.model.scene.model import Scene

GEO002 = Code("GEO002", "number-and-curve", Severity.WARNING)
GEO003 = Code("GEO003", "drag-diameter-assumed", Severity.INFO)
GEO006 = Code("GEO006", "repeated-section", Severity.WARNING)

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
"""Setting of each curve, and the numbers of the property line that it replaces."""
_NAMES = {"eiyy": "EIyy", "eizz": "EIzz", "gj": "GJ", "ea": "EA", "e": "E"}


@rule(GEO002)
def number_and_curve(context: LintContext) -> Iterator[Problem]:
    """A stiffness is given twice: as a number, and by a curve.

    If the line with SET= names a curve of non-linear stiffness, its number on the property line must be left empty.
    With both it is not clear which of them a run uses. Leave the field empty, or remove the curve.

    Example:
         $MODEL
         *GEOMETRIC SETS
          OPTION=FLEXIBLE
          SET=ALL, EI=Bend Stiffener
        - 23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429, 0.3429
        + , , 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429, 0.3429
         *MOMENT-CURVATURE
          CURVE=Bend Stiffener
          0.0, 0.0
          23.5E3, 1.0
          40.0E3, 2.5

    Finds: 5:2
    """
    for where, entry in entries_of_sets(context.written("GEOMETRIC SETS")):
        if entry.mooring is not None:
            continue  # its format has no field for a curve, and EA must be given
        for curve, (key, numbers) in _CURVES.items():
            if getattr(entry, curve) is None:
                continue
            if numbers_given := [name for name in numbers if getattr(entry.section, name, None) is not None]:
                names = " and ".join(_NAMES[name] for name in numbers_given)
                message = f"{names} is given as a number, and {key}= names a curve for it: remove one of them"
                place = where.inside(format_of(entry), _NAMES[numbers_given[0]])
                yield Problem(GEO002, message, where=place)


@rule(GEO003)
def drag_diameter_assumed(context: LintContext) -> Iterator[Problem]:
    """A flexible section under a force-embedment curve has no Do: the drag diameter Dd is used.

    The embedment ratio is a depth divided by the external diameter, so the stiffness of the seabed depends on it. The
    drag diameter is often larger, as it takes in marine growth, fairings or strakes. Give Do, the last field but one of
    the property line.

    Example on clay:
         $MODEL
        |*NODE
        | 1, -0.05, 0.0
        | 5, -0.05, 40.0
        | GEN=1, 5
        |*ELEMENT
        | 1, 1, 2
        | GEN=1, 4
        |*GEOMETRIC SETS
        | OPTION=FLEXIBLE
        | SET=ALL
        - 23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3910, 0.3429
        + 23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3910, 0.3429, 0.3429

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
                f"the embedment ratio of {elements} on a curve is computed with Dd = {section.diameter:g}, as the "
                "section has no Do: give Do"
            )
            yield Problem(GEO003, message, where=section.where.inside("flexible", "Dd"))


@rule(GEO006)
def repeated_section(context: LintContext) -> Iterator[Problem]:
    """A set has two sections, and another set has none; or a set has none at all.

    The later section of a set overrides the earlier one. That is legal. If another set lacks a section, though, it
    suggests an entry that was copied and kept the first name: the elements of the other set have neither stiffness nor
    mass. Correct the name in one of the two entries.

    A set without a section is also reported if no set has two, unless a keyword that is passed through names it, as
    that keyword may describe its elements. Nothing is reported if elements come from lines or from another deck, if a
    section names a set that is not defined (REF001), if every element has a section, or if a curve lacks a diameter
    (SBD009).

    Example on sets:
          GEN=3, 4
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=Riser
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
        - SET=Riser
        + SET=Flowline
        | 207.0E9, 79.6E9, 0.3239, 0.2731, 7850.0

    Finds: 18:6
    """
    scene = context.scene
    sections, reading = scene.section_table.sections, scene.context
    repeated = _repeated(sections)
    hidden = scene.section_table.open or reading.external_definers or reading.restart
    if not sections or hidden or any(scene.set_table.find(section.name) is None for section in sections):
        return
    lacking = scene.section_table.of_element < 0
    if not np.count_nonzero(lacking):
        return
    needing = lacking & ~without_sections(scene)
    sets = scene.set_table.named.values() if needing.any() else ()
    bare_sets = [s for s in sets if not s.open and lacking[s.elements].all() and needing[s.elements].any()]
    for section in repeated if bare_sets else ():
        message = (
            f"SET={shown(section.name)} already has a section, and SET={shown(bare_sets[0].name)} has none: correct "
            "one of the two names"
        )
        yield Problem(GEO006, message, where=section.where.inside("set"))
    for bare in () if repeated else bare_sets:
        on_curve = (scene.law[bare.elements] == LawKind.CURVE).any()  # SBD009 reports it
        if bare.where is not None and not on_curve and folded(bare.name) not in _passed_through(scene):
            message = f"the elements of SET={shown(bare.name)} have no section: give one in *GEOMETRIC SETS"
            yield Problem(GEO006, message, where=bare.where)


MOST_LENGTHS, USUAL_LENGTHS = 25.0, 8.0
"""Limits of the ratio of the longest to the shortest length of a section."""


@joint(GEO001, UNT004, UNT005, UNT006)
def row_of_another_option(context: LintContext, found: Found) -> Iterator[Joined]:
    """Join the findings in property lines under one OPTION= whose lengths fit each other only under another OPTION=."""
    text = context.text
    lines: dict[int, list[Problem]] = {}
    for problem in chain.from_iterable(found.values()) if text else ():
        lines.setdefault(text.place(problem).line if text else 0, []).append(problem)
    runs: list[tuple[str, list[Problem]]] = []
    for where, entry in entries_of_sets(context.blocks("GEOMETRIC SETS")):
        own = format_of(entry)
        others = _other_formats(entry, own)
        span = text.span(where.inside(own)) if text and others else None
        if entry.option or not runs:
            runs.append(("", []))
        if text and span:
            known, problems = runs[-1]
            message = f"the lengths of this row fit each other under {others}, not under OPTION={own.upper()}"
            here = lines.pop(text.source.position(span.start)[0], [])
            runs[-1] = known or f"{message}: correct OPTION= above it", problems + here
    for message, problems in runs:
        if problems:
            yield Joined(problems[0], problems[1:], message=message)


def _other_formats(entry: GeometricSet, own: str) -> str:
    """Return in words the other formats of a property line that its lengths fit; "" if its own format may be right."""
    section: Part | None = entry.section
    if section is None or is_partly_unknown(section):
        return ""
    values = [getattr(section, slot.name) for slot in record_schema(type(section)).columns]
    while values[-1] is None:
        values.pop()
    formats = {slot.name: record_schema(slot.row).columns for slot in record_schema(type(entry)).slots if slot.row}
    if _lengths_fit(values, formats.pop(own), MOST_LENGTHS):
        return ""
    fitting = (name for name, columns in formats.items() if _lengths_fit(values, columns, USUAL_LENGTHS))
    return " or ".join(f"OPTION={name.upper()}" for name in fitting)


def _lengths_fit(values: Sequence[object], columns: Sequence[FieldSpec], most: float) -> bool:
    """Return True if the values fit the columns of a property line, with lengths at most a factor of `most` apart."""
    values_by_name = {slot.name: value for slot, value in zip(columns, values, strict=False) if value is not None}
    units = {slot.name: slot.about.unit for slot in columns}
    numbers = {name: value for name, value in values_by_name.items() if isinstance(value, int | float)}
    lengths = [value for name, value in numbers.items() if units[name] == "L" and value > 0.0]
    complete = len(values) <= len(columns) and all(slot.name in values_by_name for slot in columns if slot.required)
    has_wall = numbers.get("di", 0.0) < numbers.get("do", math.inf)
    return complete and has_wall and max(lengths, default=0.0) <= most * min(lengths, default=0.0)


def without_sections(scene: Scene) -> Mask:
    """Return a mask of the elements that take no section, by number or set: springs, hinges and flex joints."""
    bare = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for _, block in scene.deck.blocks_with("zero_length"):
        numbers = [number for _, number in idents_given(block, Names.ELEMENT) if isinstance(number, int)]
        bare |= np.isin(scene.element_ids, numbers)
        for _, name in names_given(block, Names.SET):
            if set_ := scene.set_table.find(name):
                bare[set_.elements] = True
    return bare


def _passed_through(scene: Scene) -> set[str]:
    """Return the names after SET= and the like in blocks that are passed through."""
    blocks = (block for section in scene.deck.sections for block in section.blocks)
    lines = (line for block in blocks if isinstance(block, Opaque) for line in block.lines)
    return {folded(field.partition("=")[2]) for line in lines for field in line.split(",") if "=" in field}


def _repeated(sections: Iterable[Section]) -> list[Section]:
    """Return the sections of sets that already have a section."""
    known: dict[str, Where] = {}
    repeated: list[Section] = []
    for section in sections:
        name = name_key(section.name)
        if known.get(name, section.where) != section.where:  # a tapered joint has a section for each element
            repeated.append(section)
        known[name] = section.where
    return repeated
