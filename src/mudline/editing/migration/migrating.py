"""A deck with legacy seabed keywords rewritten in the new family, in the same form, and the proof of equal meaning."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from mudline.editing.migration.refusals import misspelt, refusals, superseded_blocks
from mudline.editing.migration.rewriting import Rewriting, rewrite, unused_definitions
from mudline.language.codes import MIG001
from mudline.language.deck.forms import form_of
from mudline.language.deck.keyword_text import as_text
from mudline.language.deck.loading import dump
from mudline.language.deck.model import Deck, Opaque, comment_texts
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem
from mudline.language.keywords.catalogue import is_superseded, supersedes
from mudline.language.syntax.edits import edited_bytes
from mudline.language.syntax.source import Source
from mudline.model.contact.input import ContactInput, LawAssignment, LawKind
from mudline.model.contact.model import ContactModel
from mudline.model.curves import ForceCurve
from mudline.model.scene.deck_values import data_lines
from mudline.model.scene.laws import ResistanceValues
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.representatives import representatives, shows_elements
from mudline.model.scene.seabed import SeabedShape, parse_profile


@dataclass(frozen=True, slots=True)
class Migration:
    """A migrated deck: the scenes before and after, the new deck and its content, the new files beside it by name.

    `replaced` counts the legacy blocks by keyword.
    """

    before: Scene
    after: Scene
    deck: Deck
    content: bytes
    files: dict[str, bytes] = field(default_factory=dict)
    replaced: Counter[str] = field(default_factory=Counter)


def legacy_blocks(deck: Deck) -> Counter[str]:
    """Count the blocks of each legacy keyword in the model."""
    return Counter(block.keyword for _, block in superseded_blocks(deck))


def migrate(deck: Deck, continued_by: Sequence[str] = (), *, extended: bool = False) -> Migration:
    """Rewrite the legacy seabed keywords of a deck in the new family; the deck keeps its form.

    `continued_by` names decks that continue this one with seabed keywords of their own; `extended` says that one may
    have more elements, so that what no element of this deck follows is kept. A deck without legacy keywords stays as it
    is: nothing is `replaced`, and there is no `content`. Raises DeckError for a deck with errors, and (MIG001) for what
    the new family cannot say.
    """
    before, replaced = resolve(deck), legacy_blocks(deck)
    if problems := list(refusals(deck, before.require(), continued_by) if replaced else misspelt(deck)):
        raise DeckError(deck.diagnose(problems))
    if not replaced:
        return Migration(before, before, deck, b"", {}, replaced)
    text = as_text(deck)
    made = rewrite(text, unused_definitions(before, extended=extended))
    origin = text.origin
    assert isinstance(origin, TextOrigin)  # noqa: S101 - `as_text` gives no other
    content = edited_bytes(origin.source, made.edits)
    changed = read_source(Source.from_bytes(content, deck.file), units=deck.units)
    changed = replace(changed, source=deck.source, folder=deck.folder)
    after = _checked(deck, before, changed, made)
    if not isinstance(deck.origin, TextOrigin):
        content = dump(changed, form_of(deck.file)).encode()
    files = {name: lines.encode() for name, lines in made.files.items()}
    return Migration(before, after, changed, content, files, replaced)


def _checked(deck: Deck, before: Scene, changed: Deck, made: Rewriting) -> Scene:
    """The scene of the new deck; raises DeckError when it lost anything or has new faults."""
    after = resolve(changed)
    faults = [problem.message for problem in after.errors()]
    lost = Counter(_comments(deck)) - Counter(_comments(changed))
    faults += [f"the comment {text!r} would be lost or read as data" for text in lost]
    if _others(deck) != _others(changed):
        faults.append("a block of another keyword would change")
    expected = Counter(problem.code.code for problem in before.findings)
    new = Counter(problem.code.code for problem in after.findings)
    if not np.array_equal(before.law, after.law):
        faults.append("an element would have a law of another kind")
    for code in (new - expected) - Counter({"REF015": len(made.files)}):
        faults.append(f"it would have a new finding {code}")
    if faults:
        where, _ = superseded_blocks(deck)[0]
        problems = [Problem(MIG001, f"the deck is left unchanged: {fault}", where=where) for fault in faults]
        raise DeckError(deck.diagnose(problems))
    return after


def _comments(deck: Deck) -> Iterator[str]:
    """The text of every comment, those among the lines of opaque blocks included."""
    yield from comment_texts(deck)
    opaque = (block.lines for section in deck.sections for block in section.blocks if isinstance(block, Opaque))
    for lines in opaque:
        data = set(data_lines(lines))
        yield from (line[1:] for line in lines if line not in data)


def _others(deck: Deck) -> list[object]:
    """Everything but the blocks that a migration rewrites, without the comments.

    Those in an opaque block are among its lines, and a keyword below it that becomes a comment is among them.
    """
    return [
        (
            section.name,
            section.lines,
            [line for line in data_lines(block.lines) if line.strip()] if isinstance(block, Opaque) else block,
        )
        for section in deck.sections
        for block in section.blocks
        if section.name != "MODEL" or not (is_superseded(block.keyword) or supersedes(block.keyword))
    ]


# ---------------------------------------------------------------------------------------------------------------- proof


class Difference(NamedTuple):
    """What the two decks define differently: an element, or the seabed, and how it differs."""

    what: str
    text: str


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was compared and what differs.

    `elements` of the deck are of `kinds`; one of each kind and `representatives` for its sets were evaluated, at
    `positions` in all. There are none for a deck that shows all its elements.
    """

    elements: int
    kinds: int
    positions: int
    representatives: int
    differences: tuple[Difference, ...]


def verify(migration: Migration) -> Verdict:
    """Compare the decks before and after.

    Elements that differ in nothing but their number and place have the same law in both decks; one of each kind is
    evaluated over a sweep that covers every segment of its curve and both ends, and its forces and stiffnesses must be
    bitwise equal; so must its friction, mobilisation, lateral resistance and suction, and the shape of the seabed. Then
    the same for representative elements: in every set that a seabed block names and in pairs of them, which shows that
    the same block wins for elements that the deck does not show, those of `*LINES`.
    """
    before, after = migration.before, migration.after
    differences = [*_seabed_shapes(before.seabed, after.seabed, migration.files)]
    kinds, positions, found = _compare(before, after, {})
    differences += found
    if shows_elements(before):
        return Verdict(len(before.element_ids), kinds, positions, 0, tuple(differences))
    external, names = representatives(before)
    _, more, found = _compare(resolve(before.deck, external), resolve(after.deck, external), names)
    return Verdict(len(before.element_ids), kinds, positions + more, len(external.ids), (*differences, *found))


def _seabed_shapes(before: SeabedShape, after: SeabedShape, files: Mapping[str, bytes]) -> Iterator[Difference]:
    """The seabed, where it differs; the file of a profile has not been written yet and is among `files`."""
    if after.file in files:
        after = replace(after, points=parse_profile(files[after.file], after.file, 2), missing="", file="")
    if not before.same(after):
        one, other = (f"{it.kind.value} (slope {it.slope!r}, {len(it.points)} points)" for it in (before, after))
        yield Difference("the seabed", f"{one} before, {other} after")


# ------------------------------------------------------------------------------------------------------------ elements


def _compare(before: Scene, after: Scene, names: Mapping[int, str]) -> tuple[int, int, list[Difference]]:
    """Number of kinds and of positions, and the differences; `names` describes elements by their number."""
    chosen = _one_of_each_kind(before, after)
    if not len(chosen):
        return 0, 0, []
    inputs = _contact_input(before, chosen), _contact_input(after, chosen)
    depths = _depths(inputs)
    labels = [names.get(number, f"element {number}") for number in before.element_ids[chosen].tolist()]
    found = [*_laws(before, after, chosen), *_values(before, after, chosen), *_forces(inputs, depths)]
    return len(chosen), depths.size, [Difference(labels[index], text) for index, text in found]


def _one_of_each_kind(before: Scene, after: Scene) -> Indices:
    """One element of each kind: the same source of law and of friction, and the same diameter, before and after."""
    columns = [
        column
        for scene in (before, after)
        for column in (scene.laws.of_element, scene.resistance.of_element, scene.diameter.view(np.int64))
    ]
    _, first = np.unique(np.column_stack(columns), axis=0, return_index=True)
    return np.sort(first)


def _laws(before: Scene, after: Scene, chosen: Indices) -> Iterator[tuple[int, str]]:
    """The kind of law: a rigid seabed and no law at all both give no force here."""
    for index in np.flatnonzero(before.law[chosen] != after.law[chosen]).tolist():
        element = int(chosen[index])
        yield index, f"law: {before.law_names[element]} before, {after.law_names[element]} after"


def _values(before: Scene, after: Scene, chosen: Indices) -> Iterator[tuple[int, str]]:
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


def _forces(inputs: Sequence[ContactInput], depths: Floats) -> Iterator[tuple[int, str]]:
    """The first depth at which an element differs in a result."""
    positions = np.repeat(-depths, 2, axis=1)[:, :, np.newaxis] * np.array([1.0, 0.0, 0.0])
    results = [ContactModel(given).evaluate(positions) for given in inputs]
    for name in ("force", "stiffness", "slope", "ratio"):
        one, other = (getattr(result, name) for result in results)
        different = ~_same_bits(one, other)
        for element in np.flatnonzero(different.any(axis=0)).tolist():
            step = int(np.argmax(different[:, element]))
            values = f"{float(one[step, element])!r} before, {float(other[step, element])!r} after"
            yield element, f"{name} at depth {float(depths[step, element])!r}: {values}"


def _same_bits(one: Floats, other: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    same: np.ndarray[tuple[int, ...], np.dtype[np.bool_]] = one.view(np.uint64) == other.view(np.uint64)
    return same


def _contact_input(scene: Scene, chosen: Indices) -> ContactInput:
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


# -------------------------------------------------------------------------------------------------------------- depths

_FRACTIONS = (0.25, 0.5, 0.75)
_PLAIN = np.array([-1.0, -1e-9, 0.0, 5e-324, 1e-9, 1e-3, 0.1, 1.0, 37.5, 1e6])


def _depths(inputs: Sequence[ContactInput]) -> Floats:
    """Depths (steps, elements) for inputs with the same elements, one or more, in their unit of length.

    For an element with a curve: every point of its curves and the floats beside it, three places within each segment,
    and places far beyond both ends; for every element the seabed itself, just above and below it, and some depths.
    """
    curves: dict[tuple[int, ...], Floats] = {}
    columns: list[Floats] = []
    of_element = np.column_stack([given.curve_index for given in inputs]).tolist()
    for diameter, indices in zip(inputs[0].diameter.tolist(), map(tuple, of_element), strict=True):
        if indices not in curves:
            found = [_ratios(given.curves[index]) for given, index in zip(inputs, indices, strict=True) if index >= 0]
            curves[indices] = np.unique(np.concatenate(found)) if found else np.zeros(0)
        columns.append(np.concatenate([_PLAIN, curves[indices] * diameter]))
    steps = max(map(len, columns))
    return np.column_stack([np.pad(column, (0, steps - len(column)), mode="edge") for column in columns])


def _ratios(curve: ForceCurve) -> Floats:
    """Ratios at, beside and between the points of a curve, and beyond its ends."""
    points = curve.ratios
    inside = [points[:-1] + fraction * np.diff(points) for fraction in _FRACTIONS]
    width = float(points[-1] - points[0])
    beyond = np.array([points[0] - width, points[0] - 10.0 * width, points[-1] + width, points[-1] + 10.0 * width])
    beside = [np.nextafter(points, -np.inf), points, np.nextafter(points, np.inf)]
    found: Floats = np.concatenate([*beside, *inside, beyond])
    return found[np.isfinite(found)]
