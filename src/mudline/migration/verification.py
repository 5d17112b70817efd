"""The proof that a migrated deck means what it meant: every law over a sweep of positions, bit by bit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mudline.contact.input import ContactInput, LawAssignment, LawKind
from mudline.contact.model import ContactModel
from mudline.deck.parameters import folded
from mudline.migration.migrating import Migration
from mudline.migration.stand_ins import StandIns
from mudline.migration.sweep import depths_of
from mudline.scene.laws import ResistanceValues
from mudline.scene.model import Scene, resolve
from mudline.scene.numbering import Floats, Indices
from mudline.scene.seabed import SeabedShape, parse_profile


class Difference(NamedTuple):
    """An element, or a set of stand-ins for elements, for which the two decks say different things."""

    what: str
    text: str


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was compared: elements, those of them that stand for a kind each, positions; and what differs."""

    elements: int
    kinds: int
    positions: int
    stand_ins: int
    differences: tuple[Difference, ...]


def verify(migration: Migration) -> Verdict:
    """Compare the decks before and after.

    Elements that differ in nothing but their number and place have the same law in both decks; one of each kind is
    evaluated over a sweep that covers every segment of its curve and both ends, and its forces and stiffnesses must be
    bitwise equal; so must its friction, mobilisation, lateral resistance and suction, and the shape of the bed. Then
    the same for stand-ins: one for every set that a seabed block names and for pairs of them, which shows for elements
    that the deck does not show, those of `*LINES`, that the same block wins.
    """
    before, after = migration.before, migration.after
    differences = [*_floors(before, after, migration.files)]
    kinds, positions, found = _compare(before, after, {})
    differences += found
    stand_ins = StandIns(_sets(before))
    external = stand_ins.elements()
    _, more, found = _compare(resolve(before.deck, external), resolve(after.deck, external), stand_ins.names())
    return Verdict(len(before.element_ids), kinds, positions + more, len(external.ids), (*differences, *found))


def _floors(before: Scene, after: Scene, files: dict[str, bytes]) -> Iterator[Difference]:
    floor = after.seabed
    if floor.file in files:
        floor = replace(floor, points=parse_profile(files[floor.file], floor.file, 2), missing="", file="")
    if not before.seabed.same(floor):
        yield Difference("the bed", f"{_shape(before.seabed)} before, {_shape(floor)} after")


def _shape(floor: SeabedShape) -> str:
    return f"{floor.kind.value} (slope {floor.slope!r}, {len(floor.points)} points)"


def _compare(before: Scene, after: Scene, names: Mapping[int, str]) -> tuple[int, int, list[Difference]]:
    """Number of kinds and of positions, and the differences; `names` has what an element is called, by its number."""
    chosen = _kinds(before, after)
    if not len(chosen):
        return 0, 0, []
    old, new = _part(before, chosen), _part(after, chosen)
    depths = depths_of([old, new])
    called = [names.get(number, f"element {number}") for number in before.element_ids[chosen].tolist()]
    differences = [
        Difference(called[index], text)
        for index, text in [*_laws(before, after, chosen), *_beds(before, after, chosen)]
    ]
    positions = np.repeat(-depths, 2, axis=1)[:, :, np.newaxis] * np.array([1.0, 0.0, 0.0])
    one, other = ContactModel(old).evaluate(positions), ContactModel(new).evaluate(positions)
    for name in ("force", "stiffness", "slope", "ratio"):
        here, there = getattr(one, name), getattr(other, name)
        for element in np.flatnonzero(~_same_bits(here, there).all(axis=0)).tolist():
            step = int(np.flatnonzero(~_same_bits(here[:, element], there[:, element]))[0])
            depth = float(depths[step, element])
            values = f"{float(here[step, element])!r} before, {float(there[step, element])!r} after"
            differences.append(Difference(called[element], f"{name} at depth {depth!r}: {values}"))
    return len(chosen), depths.size, differences


def _same_bits(one: Floats, other: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    same: np.ndarray[tuple[int, ...], np.dtype[np.bool_]] = one.view(np.uint64) == other.view(np.uint64)
    return same


def _kinds(before: Scene, after: Scene) -> Indices:
    """One element of each kind: what gives it its law before and after, its bed before and after, its diameter."""
    columns = [
        before.laws.of_element,
        after.laws.of_element,
        before.resistance.of_element,
        after.resistance.of_element,
        before.diameter.view(np.int64),
        after.diameter.view(np.int64),
    ]
    _, first = np.unique(np.column_stack(columns), axis=0, return_index=True)
    return np.sort(first)


def _part(scene: Scene, chosen: Indices) -> ContactInput:
    """The chosen elements (k), each with two nodes of its own, whether the deck has nodes for them or not.

    An element without a diameter gets one: its law is the same for every diameter.
    """
    count = len(chosen)
    arrays = scene.law_arrays()
    (on_curve,), (linear,) = (np.nonzero(arrays.law[chosen] == kind) for kind in (LawKind.CURVE, LawKind.LINEAR))
    diameter = scene.diameter[chosen]
    return ContactInput(
        node_ids=np.arange(1, 2 * count + 1),
        coordinates=np.zeros((2 * count, 3)),
        element_ids=scene.element_ids[chosen],
        element_nodes=np.arange(2 * count, dtype=np.intp).reshape(count, 2),
        length=np.ones(count),
        diameter=np.where(np.isnan(diameter), 1.0, diameter),
        laws=(
            LawAssignment("curve", on_curve, {"curve": arrays.curve_index[chosen[on_curve]]}),
            LawAssignment("linear", linear, {"stiffness": arrays.linear_stiffness[chosen[linear]]}),
        ),
        curves=arrays.curves,
    )


def _laws(before: Scene, after: Scene, chosen: Indices) -> Iterator[tuple[int, str]]:
    """The kind of law, as a rigid bed and none at all give no force of their own."""
    for index in np.flatnonzero(before.law[chosen] != after.law[chosen]).tolist():
        element = int(chosen[index])
        yield index, f"law: {before.law_names[element]} before, {after.law_names[element]} after"


def _beds(before: Scene, after: Scene, chosen: Indices) -> Iterator[tuple[int, str]]:
    """Friction, lateral resistance and suction: a coefficient, resistance or suction that is not given is 0."""
    for name in ResistanceValues._fields:
        if name == "characteristic":  # checked before: those in force are the default, which the new family has as well
            continue
        one, other = (np.asarray(scene.resistance.column(name)[chosen], dtype=np.float64) for scene in (before, after))
        if name in ("friction", "lateral", "suction"):
            one, other = (np.where(np.isnan(values), 0.0, values) for values in (one, other))
        same = _same_bits(one, other).reshape(len(chosen), -1).all(axis=1)
        for index in np.flatnonzero(~same).tolist():
            yield index, f"{name.replace('_', ' ')}: {one[index]} before, {other[index]} after"


def _sets(scene: Scene) -> list[str]:
    """The sets that laws name, each once, in the order of the last block that names it."""
    names = [grant.set_.name for grant in scene.laws.set_laws if grant.set_ is not scene.set_table.everything]
    last = {folded(name): name for name in names}
    order = {folded(name): position for position, name in enumerate(names)}
    return [last[key] for key in sorted(last, key=lambda key: order[key])]
