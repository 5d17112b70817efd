"""The proof that a migrated deck means what it meant: every law over a sweep of positions, bit by bit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

from mudline.contact.input import ContactInput, LawAssignment, LawKind
from mudline.contact.model import ContactModel
from mudline.curves import ForceCurve
from mudline.deck.parameters import folded
from mudline.migration.migrating import Migration
from mudline.scene.bed import BedValues
from mudline.scene.build import resolve
from mudline.scene.external import ExternalElements
from mudline.scene.floor import Floor
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, Indices
from mudline.scene.profile_file import parse_profile


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
    floor = after.floor
    if floor.file in files:
        floor = replace(floor, points=parse_profile(files[floor.file], floor.file, 2), missing="", file="")
    if not before.floor.same(floor):
        yield Difference("the bed", f"{_shape(before.floor)} before, {_shape(floor)} after")


def _shape(floor: Floor) -> str:
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
        before.bed.of_element,
        after.bed.of_element,
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
    for name in BedValues._fields:
        if name == "characteristic":  # checked before: those in force are the default, which the new family has as well
            continue
        one, other = (np.asarray(scene.bed.column(name)[chosen], dtype=np.float64) for scene in (before, after))
        if name in ("friction", "lateral", "suction"):
            one, other = (np.where(np.isnan(values), 0.0, values) for values in (one, other))
        same = _same_bits(one, other).reshape(len(chosen), -1).all(axis=1)
        for index in np.flatnonzero(~same).tolist():
            yield index, f"{name.replace('_', ' ')}: {one[index]} before, {other[index]} after"


def _sets(scene: Scene) -> list[str]:
    """The sets that laws name, each once, in the order of the last block that names it."""
    names = [grant.set_.name for grant in scene.laws.grants if grant.set_ is not scene.set_table.everything]
    last = {folded(name): name for name in names}
    order = {folded(name): position for position, name in enumerate(names)}
    return [last[key] for key in sorted(last, key=lambda key: order[key])]


_ALL_PAIRS = 40
_DIAMETERS = (0.2731, 0.5)
_FIRST = 2**40


class StandIns:
    """Elements of two diameters in no set, each set, and two sets; of many sets only those that follow each other.

    The last block that holds an element wins. That is an order of the blocks; it is the same in two decks when it is
    the same for every two blocks that follow each other.
    """

    def __init__(self, sets: Sequence[str]) -> None:
        self.sets = sets
        pairs = list(combinations(sets, 2) if len(sets) <= _ALL_PAIRS else pairwise(sets))
        self.memberships: list[tuple[str, ...]] = [(), *((name,) for name in sets), *pairs]

    def elements(self) -> ExternalElements:
        """The elements, each with two nodes of its own."""
        count = len(self.memberships) * len(_DIAMETERS)
        members: dict[str, list[int]] = {name: [] for name in self.sets}
        for number, membership in self._numbered():
            for name in membership:
                members[name].append(number)
        return ExternalElements(
            "stand-ins",
            _FIRST + np.arange(count),
            _FIRST + np.arange(2 * count).reshape(count, 2),
            np.array(_DIAMETERS * len(self.memberships)),
            np.ones(count),
            {name: np.array(ids, dtype=np.int64) for name, ids in members.items()},
        )

    def names(self) -> dict[int, str]:
        """What each element is called, by its number."""
        return {
            number: f"an element of {' and '.join(membership)}" if membership else "an element of no set but ALL"
            for number, membership in self._numbered()
        }

    def _numbered(self) -> Iterator[tuple[int, tuple[str, ...]]]:
        for index in range(len(self.memberships) * len(_DIAMETERS)):
            yield _FIRST + index, self.memberships[index // len(_DIAMETERS)]


_FRACTIONS = (0.25, 0.5, 0.75)
_PLAIN = np.array([-1.0, -1e-9, 0.0, 5e-324, 1e-9, 1e-3, 0.1, 1.0, 37.5, 1e6])


def depths_of(inputs: Sequence[ContactInput]) -> Floats:
    """Depths (steps, elements) for inputs with the same elements, in their unit of length.

    For an element with a curve: every point of its curves and the floats beside it, three places within each segment,
    and places far beyond both ends; for every element the seabed itself, just above and below it, and some depths.
    """
    curves: dict[tuple[int, ...], Floats] = {}
    columns: list[Floats] = []
    of_element = np.column_stack([given.curve_index for given in inputs]).tolist()
    for diameter, indices in zip(inputs[0].diameter.tolist(), map(tuple, of_element), strict=True):
        if indices not in curves:
            found = [ratios_of(given.curves[index]) for given, index in zip(inputs, indices, strict=True) if index >= 0]
            curves[indices] = np.unique(np.concatenate(found)) if found else np.zeros(0)
        columns.append(np.concatenate([_PLAIN, curves[indices] * diameter]))
    steps = max((len(column) for column in columns), default=0)
    return np.column_stack(
        [np.pad(column, (0, steps - len(column)), mode="edge") for column in columns] or [_PLAIN[:0]]
    )


def ratios_of(curve: ForceCurve) -> Floats:
    """Ratios at, beside and between the points of a curve, and beyond its ends."""
    points = curve.ratios
    widths = np.diff(points)
    inside = [points[:-1] + fraction * widths for fraction in _FRACTIONS]
    width = float(points[-1] - points[0])
    beyond = np.array([points[0] - width, points[0] - 10.0 * width, points[-1] + width, points[-1] + 10.0 * width])
    beside = [np.nextafter(points, -np.inf), points, np.nextafter(points, np.inf)]
    found: Floats = np.concatenate([*beside, *inside, beyond])
    kept: Floats = found[np.isfinite(found)]
    return kept
