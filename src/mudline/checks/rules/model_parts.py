"""Parts of a model that lack something, or have it twice: sections, nodes without elements, ends that hang free.

A deck without `$LOAD CASE`, or without `$MODEL`, is a part of a job, and nothing is missing in it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from mudline.checks.context import LintContext
from mudline.language.deck.model import Opaque, raw_lines
from mudline.language.deck.parameters import folded, name_key
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.catalogue import may_give
from mudline.language.keywords.contents import idents_given, kinds_of, names_given
from mudline.language.keywords.model import Block
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Gift, Names
from mudline.language.rules import rule
from mudline.language.syntax.rows import read_number
from mudline.model.contact.input import LawKind
from mudline.model.scene.context import records_of
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Mask, first_of
from mudline.model.scene.sections import Section, format_of

GEO002 = Code("GEO002", "number-and-curve", Severity.WARNING)
GEO003 = Code("GEO003", "drag-diameter-assumed", Severity.INFO)
GEO006 = Code("GEO006", "repeated-section", Severity.WARNING)
GEO007 = Code("GEO007", "element-without-section", Severity.WARNING)
GEO009 = Code("GEO009", "node-without-element", Severity.INFO)
GEO010 = Code("GEO010", "end-not-held", Severity.INFO)
GEO015 = Code("GEO015", "no-elements", Severity.INFO)
GEO016 = Code("GEO016", "added-mass-order", Severity.INFO)

_PARTS = ("MODEL", "LOAD CASE")
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
    for where, entry in records_of(context.written("GEOMETRIC SETS")):
        if entry.mooring is not None:
            continue  # its format has no field for a curve, and EA must be given
        for curve, (key, numbers) in _CURVES.items():
            if getattr(entry, curve) is None:
                continue
            if numbers_given := [name for name in numbers if getattr(entry.section, name, None) is not None]:
                names = " and ".join(_NAMES[name] for name in numbers_given)
                message = f"{names} is given as a number, and {key}= names a curve for it: remove one of them"
                yield Problem(GEO002, message, where=where.inside(format_of(entry), _NAMES[numbers_given[0]]))


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


@rule(GEO016)
def added_mass_order(context: LintContext) -> Iterator[Problem]:
    """A line of `*HYDRODYNAMIC SETS` gives two different added mass coefficients, whose order is inferred.

    mudline reads the normal coefficient first, as in decks of the older program (.das). The manual's page on theory
    lists the tangential one first, and no public page shows the line itself. Nothing that mudline evaluates depends on
    the order, but it matters if the values are copied. If the coefficients are the defaults, the normal inertia minus 1
    and 0, leave both fields empty: then there is no doubt.

    Example on sets:
          GEN=3, 4
        |*HYDRODYNAMIC SETS
        | SET=ALL, TYPE=CONSTANT
        - 1.0, 0.0, 2.0, 1.0, 0.0
        + 1.0, 0.0, 2.0

    Finds: 16:17
    """
    if context.deck.file.lower().endswith(".das"):
        return
    lines = []
    for where, entry in context.records("HYDRODYNAMIC SETS"):
        normal, tangential, inertia = (
            number(entry.constant, name) for name in ("normal_added_mass", "tangential_added_mass", "normal_inertia")
        )
        if abs(normal - tangential) > 0.0:
            lines.append((where.inside("constant", "normal_added_mass"), normal, tangential, inertia))
    if lines:
        where, normal, tangential, inertia = lines[0]
        others = f"; so are those of {len(lines) - 1} more sets" * (len(lines) > 1)
        defaults = normal == inertia - 1.0 and tangential == 0.0
        advice = "these are the defaults, remove both" if defaults else "keep them if they are meant so"
        message = (
            f"the added masses are read as {normal:g} normal, {tangential:g} tangential (inferred){others}: {advice}"
        )
        yield Problem(GEO016, message, where=where)


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


# -------------------------------------------------------------------------------------------- what a whole model lacks


def _is_whole(context: LintContext) -> bool:
    """Return True if a deck shows a whole model and a load case of it, and no line of them is lost."""
    scene = context.scene
    reading = scene.context
    shown = {section.name for section in scene.deck.sections if section.name in _PARTS}
    if len(shown) < len(_PARTS) or not len(scene.element_ids) or reading.external_definers or reading.restart:
        return False
    blocks = [each for each in context.once(_with_lines) if each[1] in _PARTS and each[2].keyword in reading.unread]
    lost = any(scene.deck.lost(where, kept=False) for where, *_ in blocks)
    return not lost and reading.unread == {block.keyword for _, _, block, _ in blocks}


def _with_lines(context: LintContext) -> list[tuple[Where, str, Block | Opaque, list[str]]]:
    """Return place, section, block and lines that are passed through of every block of the scene's deck."""
    return [(*placed, raw_lines(placed[2])) for placed in context.scene.deck.every_block()]


def lacks(context: LintContext, *gifts: Gift) -> bool:
    """Return True if a model lacks something of these kinds: no unread line may give it."""
    return context.once(_is_whole) and not _unread_give(context, *gifts)


def _unread_give(context: LintContext, *gifts: Gift) -> bool:
    """Return True if an unread line may give a model something of these kinds."""
    return any(
        may_give(block.keyword, section, gift)
        for _, section, block, lines in context.once(_with_lines)
        if section in _PARTS and (lines or type(block) is Opaque)
        for gift in gifts
    )


@rule(GEO015)
def no_elements(context: LintContext) -> Iterator[Problem]:
    """The deck has a model with nodes and a load case, but no element.

    Without elements nothing lies on the seabed: no contact is checked or evaluated, and a deck without a finding may
    still be wrong. Add *ELEMENT or *LINES, if the deck is more than a part of a job. A deck that continues another
    one takes the elements from there.

    Example:
         $MODEL
         *NODE
          1, 50.0, 0.0
          3, 50.0, 20.0
          GEN=1, 3
        +*ELEMENT
        + 1, 1, 2
        + GEN=1, 2
         $LOAD CASE
         *BOUNDARY
          TYPE=CONSTANT
          1, 1
          3, 1

    Finds: 1:1
    """
    scene = context.scene
    models = [i for i, section in enumerate(context.deck.own_sections) if section.name == _PARTS[0]]
    shown = {section.name for section in scene.deck.sections if len(scene.node_ids)}
    reading = scene.context
    if len(scene.element_ids) or not shown.issuperset(_PARTS) or reading.external_definers or reading.restart:
        return
    if models and not reading.unread and not reading.misplaced and not _unread_give(context, "elements"):
        yield Problem(
            GEO015, "no elements, so there is no contact to check: add *ELEMENT or *LINES", where=Where(models[0], -1)
        )


@rule(GEO007)
def element_without_section(context: LintContext) -> Iterator[Problem]:
    """An element has no geometric properties, while others of its model have.

    No set with a line in *GEOMETRIC SETS holds it: it has neither stiffness nor weight. A range of a set ends too
    early, or a new part of the line was not put into a set. Extend the set, or give it a section. Decks with only the
    model or only the load case are left out. So are elements that take no properties, such as joints and springs.

    Example on held:
          GEN=1, 2
        |*ELEMENT SETS
        | SET=Pipe
        - 1
        + 1, 2
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=Pipe
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 8:2
    """
    scene = context.scene
    if not context.blocks("GEOMETRIC SETS") or not lacks(context, "elements", "sections"):
        return
    bare = np.flatnonzero((scene.section_table.of_element < 0) & ~without_sections(scene))
    if bare.size and bare.size < len(scene.element_ids):
        what = first_of("element", scene.element_ids[bare])
        message = f"{what} without a line in *GEOMETRIC SETS: put it into a set that has one, or give it a section"
        yield Problem(GEO007, message, where=scene.table.numbered.where(int(bare[0])))


@rule(GEO009)
def node_without_element(context: LintContext) -> Iterator[Problem]:
    """A node belongs to no element, and nothing else refers to it.

    It has no effect. It is left over from an earlier layout, or the number of a node in *ELEMENT is wrong. Remove the
    node, or correct the element.

    Example on held:
          GEN=1, 3
        - 9, 50.0, 30.0

    Finds: 6:2
    """
    scene = context.scene
    if not lacks(context, "elements"):
        return
    used = np.zeros(len(scene.node_ids), dtype=np.bool_)
    ends = scene.element_nodes
    used[ends[ends >= 0]] = True
    used |= context.once(_named_nodes)
    free = np.flatnonzero(~used & _placed(scene))
    if free.size:
        what = first_of("node", scene.node_ids[free])
        message = f"{what} of no element: remove it, or correct the element that should end there"
        yield Problem(GEO009, message, where=scene.nodes.where(int(free[0])))


@rule(GEO010)
def end_not_held(context: LintContext) -> Iterator[Problem]:
    """A line ends at a node that nothing holds.

    Neither *BOUNDARY nor a spring, a vessel or a body refers to the node, so the end is free. That is right for a pipe
    that is laid or hangs from one end, and otherwise a wrong number. Hold the node, or correct the number. A deck that
    holds no node at all is left out.

    Example on held:
        + 3, 1

    Finds: 4:2
    """
    scene = context.scene
    if not lacks(context, "elements", "supports") or (scene.element_nodes < 0).any():
        return
    counts = np.bincount(scene.element_nodes.ravel(), minlength=len(scene.node_ids))
    held = context.once(_named_nodes)
    free = np.flatnonzero((counts == 1) & ~held & _placed(scene))
    if free.size and held.any():
        what = first_of("node", scene.node_ids[free])
        at, it = ("the end of a line is", "it") if free.size == 1 else ("ends of lines are", "them")
        message = f"{what} at {at} held by nothing: add {it} to *BOUNDARY, or leave {it} if the end is free"
        yield Problem(GEO010, message, where=scene.nodes.where(int(free[0])))


def _placed(scene: Scene) -> Mask:
    """Return a mask of the nodes whose place is known; nodes of a GEN= between undefined nodes have none."""
    x, y = scene.coordinates[:, 0], scene.coordinates[:, 1]
    return ~(np.isnan(x) & np.isnan(y))


def _named_nodes(context: LintContext) -> Mask:
    """Return a mask of the nodes that anything but an element refers to, also in lines whose form is not public."""
    scene = context.scene
    numbers: set[int] = set()
    for _, _, block, lines in context.once(_with_lines):
        if not isinstance(block, Opaque):
            if block.facts.defines in ("nodes", "elements"):
                continue
            if Names.NODE in kinds_of(type(block), "names"):
                numbers.update(ident for _, ident in idents_given(block, Names.NODE) if isinstance(ident, int))
        for word in (word for line in lines for word in line.replace("=", ",").split(",")):
            value = read_number(word.strip())
            if value is not None and value.is_integer() and abs(value) < 2**53:
                numbers.add(int(value))
    named = np.zeros(len(scene.node_ids), dtype=np.bool_)
    indices = scene.nodes.indices(np.array(sorted(numbers), dtype=np.int64)) if numbers else np.zeros(0, np.intp)
    named[indices[indices >= 0]] = True
    for line in scene.held:  # those of a GEN= among them
        named[line.nodes] = True
    return named
