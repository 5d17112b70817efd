"""Properties, conditions and seabed laws that elements and nodes are given twice, or not; two elements in one place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.model_parts import lacks, without_sections
from mudline.checks.rules.references import in_water
from mudline.checks.rules.seabed_support import in_another_pipe
from mudline.language.codes.contact import SBD025
from mudline.language.codes.references import REF010
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Code, Problem, Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_name
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.language.syntax.fields import read_line
from mudline.language.syntax.rows import read_number
from mudline.model.contact.input import LawKind
from mudline.model.scene.laws import SetLaw, present
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, first_of
from mudline.model.scene.references import of_vessels
from mudline.model.scene.sets import ALL, NamedSet

GEO008 = Code("GEO008", "missing-hydrodynamics", Severity.INFO)
GEO013 = Code("GEO013", "overlapping-properties", Severity.INFO)
GEO014 = Code("GEO014", "parallel-elements", Severity.WARNING)
BND001 = Code("BND001", "held-twice", Severity.WARNING)
BND002 = Code("BND002", "constant-and-vessel", Severity.WARNING)
SBD008 = Code("SBD008", "overlapping-sets", Severity.INFO)


@rule(GEO013)
def overlapping_properties(context: LintContext) -> Iterator[Problem]:
    """Elements have two sections, or two lines of coefficients, from two sets that overlap in part.

    The later line holds for the elements that both sets have. A set that refines a larger one given before it is usual,
    and not reported; sets that overlap in part are mostly a wrong end of a range. Correct the sets. A set that is given
    twice is reported as REF022, and seabed properties as SBD008. The elements of a *TAPER have no line in
    *GEOMETRIC SETS.

    Example on sets:
          SET=Riser
        + 1, 2
        - GEN=1, 3
          SET=Flowline
          GEN=3, 4
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=Riser
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
        | SET=Flowline
        | 207.0E9, 79.6E9, 0.3239, 0.2731, 7850.0

    Finds: 18:6
    """
    scene = context.scene
    count = len(scene.element_ids)
    blocks = scene.deck.blocks_with("gives")
    reported: dict[frozenset[str], tuple[str, Where, list[str]]] = {}
    for gives in dict.fromkeys(block.facts.gives for _, block in blocks):
        giving = dict.fromkeys(block.keyword for _, block in blocks if block.facts.gives == gives)
        known = [
            (keyword, where, set_)
            for keyword in giving
            for where, entry in context.records(keyword)
            if is_name(entry.set_name) and (set_ := scene.set_table.find(entry.set_name)) and set_.elements.size
        ]
        for earlier, later, elements in overlaps([set_ for *_, set_ in known], count):
            (before, _, first), (keyword, where, second) = known[earlier], known[later]
            refined = before == keyword and (within(first, second, count) or within(second, first, count))
            if refined or first.open or second.open:
                continue
            which = first_of("element", scene.element_ids[np.sort(elements)])
            holds = "this line holds for them" if before == keyword else f"it is of *{before}, and which holds is open"
            words = f"{which} the values of SET={shown(first.name)}: {holds}"
            pair = frozenset((first.name, second.name))
            reported.setdefault(pair, (words, where.inside("set"), []))[2].append(f"*{keyword}")
    for words, where, keywords in reported.values():
        also = f"{' and '.join(dict.fromkeys(keywords))} also give{'s' * (len(set(keywords)) == 1)}"
        yield Problem(GEO013, f"{also} {words}; correct the sets, if that is not meant", where=where)


@rule(GEO008)
def missing_hydrodynamics(context: LintContext) -> Iterator[Problem]:
    """Elements have no hydrodynamic properties in a load case with waves or a current.

    No set of *HYDRODYNAMIC SETS holds them, so neither drag nor added mass acts on them. That is right in a moonpool,
    and a mistake elsewhere. Inner pipes of *PIP SECTION need no coefficients. Put the elements into a set with
    coefficients.

    Example on held:
         $MODEL
        |*OCEAN
        | 420.0, 1025.0, 9.81

          GEN=1, 2
        |*ELEMENT SETS
        | SET=Pipe
        - 1
        + 1, 2
        |*HYDRODYNAMIC SETS
        | SET=Pipe, TYPE=CONSTANT
        | 1.0, 0.0, 2.0
         $LOAD CASE
        |*CURRENT
        | TYPE=UNIFORM
        | 0.5

    Finds: 10:2
    """
    scene = context.scene
    if not any(in_water(context.deck)) or not lacks(context, "elements", "hydrodynamics"):
        return
    covered = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for _, entry in context.records("HYDRODYNAMIC SETS"):
        set_ = scene.set_table.find(entry.set_name) if isinstance(entry.set_name, str) else None
        if set_ is None:
            return
        covered[set_.elements] = True
    bare = np.flatnonzero(~(covered | without_sections(scene) | in_another_pipe(scene)))
    if bare.size:
        what = first_of("element", scene.element_ids[bare])
        message = f"{what} without coefficients in *HYDRODYNAMIC SETS: give them, else neither drag nor added mass acts"
        yield Problem(GEO008, message, where=scene.table.numbered.where(int(bare[0])))


@rule(GEO014)
def parallel_elements(context: LintContext) -> Iterator[Problem]:
    """Two elements lie between the same two nodes.

    Their stiffness, weight and drag add up. Springs, hinges and flex joints next to a pipe are left out. A second pipe
    is mostly a copied line of *ELEMENT, or has a wrong node number. Correct the nodes, or remove one of the elements.

    Example on held:
          GEN=1, 2
        - 3, 2, 1

    Finds: 9:2
    """
    scene = context.scene
    ends = scene.element_nodes
    joins = (ends[:, 0] >= 0) & (ends[:, 1] >= 0) & (ends[:, 0] != ends[:, 1])
    pairs = ends.min(axis=1) * len(scene.node_ids) + ends.max(axis=1)
    unread = (keyword for keyword in context.keywords if catalogue.declared(keyword) is None)
    if np.diff(np.sort(pairs[joins])).all() or any(map(catalogue.may_have_no_length, unread)):
        return
    usable = np.flatnonzero(joins & ~without_sections(scene))
    _, firsts, same = np.unique(pairs[usable], return_index=True, return_inverse=True)
    twice = np.flatnonzero(firsts[same] != np.arange(len(usable)))
    if twice.size:
        first, second = usable[firsts[same[twice[0]]]], usable[twice]
        which = first_of("element", scene.element_ids[second])
        message = f"{which} between nodes that element {scene.element_ids[first]} joins already: correct the nodes, or"
        yield Problem(GEO014, f"{message} remove one", where=scene.table.numbered.where(int(second[0])))


@rule(BND001)
def held_twice(context: LintContext) -> Iterator[Problem]:
    """A degree of freedom of a node is held twice.

    If the two values differ, one of them has no effect, and the language does not say which: a warning. The same value
    twice is an info. Remove one of the lines, or correct the node or the degree of freedom.

    Example on held:
          1, 1
        - 1, 1, 0.5
          3, 1

    Finds: 13:5
    """
    scene = context.scene
    lines = [line for line in scene.held if line.where.section < len(context.deck.own_sections)]
    holders: dict[tuple[int, int], Indices] = {}
    for number, line in enumerate(lines):
        holder = holders.setdefault((line.where.section, line.dof), np.full(len(scene.node_ids), -1))
        again = line.nodes[holder[line.nodes] >= 0]
        if again.size:
            same = all(lines[earlier].how == line.how for earlier in set(holder[again].tolist()))
            before = lines[int(holder[again[0]])].how[0]
            values = "in the same way" if same else f"at {before}, and at {line.how[0]} here"
            node = first_of("node", scene.node_ids[again])
            message = f"degree of freedom {line.dof} of {node} is held above {values}"
            severity = Severity.INFO if same else None
            yield Problem(BND001, f"{message}: remove one of the lines, or correct it", None, severity, line.where)
        holder[line.nodes] = number


@rule(BND002)
def constant_and_vessel(context: LintContext) -> Iterator[Problem]:
    """A node is held in place and follows a vessel in the same degree of freedom.

    It cannot do both, and the manual forbids it: a run stops, or one of the conditions has no effect. Remove one of
    them, or correct the node. The form of lines of TYPE=VESSEL is not public. A line with only a node and a vessel
    is taken to prescribe all degrees of freedom (inferred).

    Example:
         $MODEL
         *NODE
          1, 480.0, 0.0
          2, 490.0, 0.0
         *ELEMENT
          1, 1, 2
         *VESSEL
          VESSEL=Barge
          INITIAL POSITION=500.0, 0.0, 0.0
         $LOAD CASE
         *BOUNDARY
          TYPE=CONSTANT
          1, 1
          TYPE=VESSEL
        - 1, Barge
        + 2, Barge

    Finds: 15:2
    """
    scene = context.scene
    vessels = of_vessels(scene.context)
    held = scene.held if vessels else []
    for where, _, line in scene.context.unread_lines if held else ():
        if where[:2] not in vessels:
            continue
        first, *others = read_line(line, Span(0, len(line))).groups[0].fields
        node = read_number(first.text)
        if node is None or not node.is_integer():
            continue
        index = scene.nodes.indices(np.array([int(node)]))[0]
        here = (line_held for line_held in held if line_held.where.section == where.section)
        freedoms = {line_held.dof for line_held in here if index >= 0 and (line_held.nodes == index).any()}
        values = (read_number(field.text) for field in others)
        moved = {int(value) for value in values if value is not None} or freedoms
        both = sorted(freedoms & moved)
        if both:
            message = f"node {first.text} follows a vessel, and TYPE=CONSTANT holds it in degree of freedom {both[0]}"
            yield Problem(BND002, f"{message}: remove one of the two (inferred)", where=where.inside(*first.span))


# ------------------------------------------------------------------------------------------------------- seabed laws


@rule(SBD008)
def overlapping_sets(context: LintContext) -> Iterator[Problem]:
    """Elements are given seabed properties twice.

    The later definition in the file overrides the earlier one as a whole. A set that refines a larger set given before
    it is the usual way to write a deck and is not reported. Two cases are reported:

    * a definition overrides an earlier one for all its elements, as SET=ALL does after the other sets. It is a warning
      if its values differ;
    * two sets overlap, and each has elements that the other one lacks.

    For curves of *EMBEDMENT no order is documented: any overlap of two different curves is a warning. Put the larger
    set first, or give each element one definition.

    Example on sets:
          GEN=3, 4
        |*SEABED PROPERTIES
        | TYPE=ELASTIC
        + SET=ALL
        + STIFFNESS=50000.0
        | SET=Flowline
        | STIFFNESS=500000.0
        - SET=ALL
        - STIFFNESS=50000.0

    Finds: 18:6
    """
    new = _own_grants(context, "new")
    if len(new) > 1:
        yield from (problem for _, problem in _properties(context.scene, new))
    embedment = [grant for grant in _own_grants(context, "legacy") if grant.curve >= 0]
    if len(embedment) > 1:
        yield from _embedment(context.scene, embedment)


def _own_grants(context: LintContext, family: str) -> list[SetLaw]:
    """Return the laws that the deck itself gives, without the deck that it continues."""
    grants = [grant for grant in context.scene.laws.set_laws if grant.family == family]
    own = len(context.scene.deck.own_sections) if grants else 0
    return [grant for grant in grants if grant.where.section < own]


@rule(SBD025)
def law_without_effect(context: LintContext) -> Iterator[Problem]:
    """A seabed definition applies to no element.

    Several later definitions together override it for all elements of the set; or a later legacy surface replaces it;
    or the set is made of subsets without any element. A change of its values has no effect on the results. Remove it,
    or correct the sets. A single later definition that overrides an earlier one for all its elements is reported as
    SBD008, an empty set as REF010, and a mix of legacy and new keywords as SBD016. Not reported are the stiffness of a
    legacy surface next to curves for every element, and values that an extension keyword replaces, as Flexcom still
    reads them.

    Example on sets:
          GEN=3, 4
        |*SEABED PROPERTIES
        | TYPE=ELASTIC
        - SET=ALL
        - STIFFNESS=50000.0
        | SET=Riser
        | STIFFNESS=40000.0
        | SET=Flowline
        | STIFFNESS=60000.0

    Finds: 16:6
    """
    if len(context.scene.element_ids):
        yield from _unused_properties(context)
    # Two types are reported by SBD002.
    surfaces = context.scene.context.surfaces if len(context.scene.laws.types) == 1 else []
    for where, surface in surfaces[:-1]:
        message = (
            f"these values apply to no element, as a later *{surface.keyword} overrides them: remove one of the two"
        )
        yield Problem(SBD025, message, where=where.inside("properties"))


def _unused_properties(context: LintContext) -> Iterator[Problem]:
    """Yield sets of *SEABED PROPERTIES that no element follows, unless SBD008 or REF010 gives the reason."""
    scene = context.scene
    followed = {*present(scene.laws.covered)}
    new = _own_grants(context, "new")
    idle_grants = {id(grant) for index, grant in enumerate(scene.laws.set_laws) if index not in followed}
    if not any(id(grant) in idle_grants for grant in new):
        return
    reported = {earlier for earlier, _ in _properties(scene, new)} if len(new) > 1 else set()
    empty = {problem.where for problem in context.problems_of(REF010)}
    for index, grant in enumerate(new):
        set_ = grant.set_
        if id(grant) not in idle_grants or grant.unknown or set_.open or index in reported:
            continue
        why = f"no subset of SET={shown(set_.name)} has any: correct the set"
        if set_.elements.size:
            why = f"later ones override it for all of SET={shown(set_.name)}: remove it, or correct the sets"
        if set_.elements.size or set_.where not in empty:
            place = grant.where._replace(path=(*grant.where.path[:2], "set"))
            yield Problem(SBD025, f"this definition applies to no element, as {why}", where=place)


def overlaps(sets: Sequence[NamedSet], count: int) -> Iterator[tuple[int, int, Indices]]:
    """Yield the overlaps of each set with the sets that held its elements until then.

    Each has the places of the earlier and the later set in the list, and the elements (indices) that are in both. Sets
    of unknown elements are compared with sets of the same name.
    """
    holder = np.full(count, -1, dtype=np.intp)
    names: dict[str, int] = {}
    for index, later in enumerate(sets):
        before = holder[later.elements]
        first = int(before[0]) if index and before.size else -1
        if np.count_nonzero(before == first) == len(before):  # as mostly: of one set, or of none
            if first >= 0:
                yield first, index, later.elements
        else:
            order = np.argsort(before, kind="stable")
            parts, starts = np.unique(before[order], return_index=True)
            for earlier, elements in zip(parts.tolist(), np.split(later.elements[order], starts[1:]), strict=False):
                if earlier >= 0:
                    yield earlier, index, elements
        name = folded(later.name)
        if not later.elements.size and name in names:
            yield names[name], index, later.elements
        names[name] = index
        holder[later.elements] = index


def _properties(scene: Scene, grants: list[SetLaw]) -> Iterator[tuple[int, Problem]]:
    """Yield the reported overlaps, each with the place of the overridden definition in the list."""
    for earlier, later, elements in overlaps([grant.set_ for grant in grants], len(scene.element_ids)):
        first, second = grants[earlier].set_, grants[later].set_
        where = grants[later].where
        place = where._replace(path=(*where.path[:2], "set"))
        if within(first, second, len(scene.element_ids)):
            of_set = "this set" if folded(first.name) == folded(second.name) else f"SET={shown(first.name)}"
            message = (
                f"the earlier definition of {of_set} is overridden by this one for all its elements: put the larger "
                "set first, or remove one"
            )
            lost = not _alike(scene, grants[earlier], grants[later])
            yield earlier, Problem(SBD008, message, None, Severity.WARNING if lost else None, place)
        elif not within(second, first, len(scene.element_ids)) and not _alike(scene, grants[earlier], grants[later]):
            message = (
                f"this definition overrides the earlier one of SET={shown(first.name)} for "
                f"{scene.describe(np.sort(elements), '', '')}: give each element one definition"
            )
            yield earlier, Problem(SBD008, message, where=place)


def within(part: NamedSet, whole: NamedSet, count: int) -> bool:
    """Return True if the elements of one set are all in another one, as far as they are known."""
    if folded(whole.name) in (folded(part.name), folded(ALL)):
        return True
    if part.open or whole.open:
        return False
    if len(whole.elements) == count:
        return True
    return len(part.elements) <= len(whole.elements) and bool(
        np.isin(part.elements, whole.elements, assume_unique=True).all()
    )


def _alike(scene: Scene, left: SetLaw, right: SetLaw) -> bool:
    """Return True if two sets of *SEABED PROPERTIES give the same values, including the points of their curves."""
    first, second = (_entry(scene, grant) for grant in (left, right))
    same = left.kind is right.kind is LawKind.CURVE and np.array_equal(_points(scene, left), _points(scene, right))
    names = [name for name in type(first).model_fields if name != "set_name" and not (same and name == "stiffness")]
    return all(getattr(first, name) == getattr(second, name) for name in names)


def _points(scene: Scene, grant: SetLaw) -> Floats:
    """Return the points of the curve of a set; a NaN, which equals nothing, if there is no curve."""
    return scene.laws.curves[grant.curve].points if grant.curve >= 0 else np.array([np.nan])


def _entry(scene: Scene, grant: SetLaw) -> Any:  # noqa: ANN401 - an entry of a keyword that is imported when it is read
    """Return the entry of *SEABED PROPERTIES that gives a law."""
    return scene.deck.at(grant.where._replace(path=grant.where.path[:2]))


def _embedment(scene: Scene, grants: list[SetLaw]) -> Iterator[Problem]:
    """Yield overlaps of *EMBEDMENT that matter: different curves, on elements that no newer keyword holds."""
    curves = scene.laws.curves
    for earlier, later, elements in overlaps([grant.set_ for grant in grants], len(scene.element_ids)):
        first, second = curves[grants[earlier].curve], curves[grants[later].curve]
        held = elements[scene.laws.of_element[elements] != scene.laws.covered[elements]]
        if np.array_equal(first.points, second.points) or (elements.size and not held.size):
            continue
        which = first_of("element", scene.element_ids[np.sort(held)]) if held.size else "elements"
        message = (
            f"*EMBEDMENT gives another curve for {which}, of SET={shown(grants[earlier].set_.name)}: the later one is "
            "used, which is not documented (inferred); give each element one curve"
        )
        yield Problem(SBD008, message, None, Severity.WARNING, second.title)
