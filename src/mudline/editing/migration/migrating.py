"""Migration of a deck with legacy seabed keywords to the new family, in the same form, and its verification."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mudline.editing.comparison.comparing import compare
from mudline.editing.comparison.decks import representatives, without_spelling
from mudline.editing.comparison.model import Difference
from mudline.editing.migration.refusals import misspelt, refusals, superseded_blocks
from mudline.editing.migration.rewriting import MigrationRewriter, unused_definitions
from mudline.language.codes import MIG001
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.keyword_text import as_text
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck, Opaque, Section
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import DeckError, Problem, new_codes
from mudline.language.keywords.model import Part
from mudline.language.syntax.edits import edited_bytes
from mudline.language.syntax.tree import is_comment
from mudline.model.contact.input import ContactInput, LawAssignment, LawKind
from mudline.model.contact.model import ContactModel
from mudline.model.curves import ForceCurve
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.seabed import parse_profile


class Migration(NamedTuple):
    """A migrated deck.

    Attributes:
        before: scene before migration.
        after: scene after migration.
        deck: the new deck.
        content: content of its file.
        files: new files next to the deck, by name.
        replaced: number of legacy blocks by keyword.
    """

    before: Scene
    after: Scene
    deck: Deck
    content: bytes
    files: dict[str, bytes]
    replaced: Counter[str]


def legacy_blocks(deck: Deck) -> Counter[str]:
    """Count the blocks of each legacy keyword in the model."""
    return Counter(block.keyword for _, block in superseded_blocks(deck))


def migrate(deck: Deck, continued_by: Sequence[str] = (), *, extended: bool = False) -> Migration:
    """Rewrite the legacy seabed keywords of a deck in the new family; the deck keeps its form.

    `continued_by` names decks that continue this deck with seabed keywords of their own. `extended` says that such a
    deck may have more elements, so that definitions without elements are kept. A deck without legacy keywords is
    returned unchanged, with empty `replaced` and `content`. Raises DeckError for a deck with errors, and (MIG001) for
    statements that the new family cannot express.
    """
    before, replaced = resolve(deck), legacy_blocks(deck)
    if problems := list(refusals(deck, before.require(), continued_by) if replaced else misspelt(deck)):
        raise DeckError(deck.diagnose(problems))
    if not replaced:
        return Migration(before, before, deck, b"", {}, replaced)
    rewriter = MigrationRewriter(as_text(deck), unused_definitions(before, extended=extended))
    edits, files = rewriter.rewrite()
    content = edited_bytes(rewriter.origin.source, edits)
    changed = load_bytes(content, deck.file, form=KEYWORD, units=deck.units, folder=deck.folder)
    changed.source = deck.source
    after = _checked(deck, before, changed, files)
    if not isinstance(deck.origin, TextOrigin):
        content = dump(changed, form_of(deck.file)).encode()
    return Migration(before, after, changed, content, files, replaced)


def _checked(deck: Deck, before: Scene, changed: Deck, files: Mapping[str, bytes]) -> Scene:
    """Return the scene of the new deck; raises DeckError if it lost anything or has new faults."""
    after = resolve(changed)
    faults = [problem.message for problem in after.errors()]
    lost = Counter(_comments(deck)) - Counter(_comments(changed))
    faults += [f"the comment {text!r} would be lost or read as data" for text in lost]
    new = new_codes(before.findings, after.findings) - Counter({"REF015": len(files)})
    faults += [f"it would have a new finding {code}" for code in new]
    if not faults:
        faults += [f"{each.where} would change" for each in _differences(before, after, files)]
    if faults:
        where, _ = superseded_blocks(deck)[0]
        problems = [Problem(MIG001, f"the deck is left unchanged: {fault}", where=where) for fault in faults]
        raise DeckError(deck.diagnose(problems))
    return after


def _differences(before: Scene, after: Scene, files: Mapping[str, bytes]) -> list[Difference]:
    """Return the differences in meaning of the decks before and after a migration; `files` are not written yet."""
    if after.seabed.file in files:
        points = parse_profile(files[after.seabed.file], after.seabed.file, 2)
        after = replace(after, seabed=after.seabed._replace(points=points, missing="", file=""))
    return without_spelling(before, after, compare(before, after)).differences


def _comments(deck: Deck) -> Iterator[str]:
    """Yield the text of every comment without its mark, including those among the lines of opaque blocks."""
    yield from deck.preamble
    holders: list[Deck | Section | Part] = [deck, *deck.sections]
    for _, _, block in deck.every_block():
        if isinstance(block, Opaque):
            yield from (line[1:] for line in block.lines if is_comment(line, words=True))
        holders += [block, *(value for _, _, value in block.walk() if isinstance(value, Part))]
    for holder in holders:
        yield from (comment.text for comment in getattr(holder, "comments", ()))


# -------------------------------------------------------------------------------------------------------- verification


class MigrationDifference(NamedTuple):
    """Difference in meaning of the two decks: the element or the seabed, and the difference in words."""

    what: str
    text: str


class Verification(NamedTuple):
    """Result of a verification.

    Attributes:
        elements: number of elements of the deck.
        kinds: number of kinds of elements, of each of which one was evaluated.
        positions: number of evaluated positions.
        representatives: number of elements evaluated for sets; 0 for a deck that lists all its elements.
        differences: the differences.
    """

    elements: int
    kinds: int
    positions: int
    representatives: int
    differences: tuple[MigrationDifference, ...]


def verify(migration: Migration) -> Verification:
    """Compare the decks before and after a migration.

    Elements that differ only in number and place have the same law in both decks. One of each kind is evaluated over a
    sweep that covers every segment of its curve and both ends. Its forces and stiffnesses must be bitwise equal. So
    must its friction, mobilisation, lateral resistance and suction, and the shape of the seabed.

    The same is done for representative elements, in every set that a seabed block names and in pairs of these sets.
    This shows that the same block wins for elements that the deck does not list, such as those of `*LINES`.
    """
    before, after = migration.before, migration.after
    differences = []
    for each in _differences(before, after, migration.files):
        what, _, value = each.where.partition("/")
        differences.append(MigrationDifference(what, f"{value}: {each.before} before, {each.after} after"))
    kinds, positions, deviations = _compare(before, after, {})
    differences += deviations
    if before.shows_elements:
        return Verification(len(before.element_ids), kinds, positions, 0, tuple(differences))
    external, names = representatives(before)
    _, more, deviations = _compare(resolve(before.deck, external), resolve(after.deck, external), names)
    differences += deviations
    return Verification(len(before.element_ids), kinds, positions + more, len(external.ids), tuple(differences))


# ------------------------------------------------------------------------------------------------------------ elements


def _compare(before: Scene, after: Scene, names: Mapping[int, str]) -> tuple[int, int, list[MigrationDifference]]:
    """Return the numbers of kinds and positions, and the differences; `names` describes elements by their number."""
    chosen = _one_of_each_kind(before, after)
    if not len(chosen):
        return 0, 0, []
    inputs = _contact_input(before, chosen), _contact_input(after, chosen)
    depths = _depths(inputs)
    labels = [names.get(number, f"element {number}") for number in before.element_ids[chosen].tolist()]
    return len(chosen), depths.size, [MigrationDifference(labels[at], text) for at, text in _forces(inputs, depths)]


def _one_of_each_kind(before: Scene, after: Scene) -> Indices:
    """Return one element of each kind: same source of law and of friction, and same diameter, before and after."""
    columns = [
        column
        for scene in (before, after)
        for column in (scene.laws.of_element, scene.resistance.of_element, scene.diameter.view(np.int64))
    ]
    _, first = np.unique(np.column_stack(columns), axis=0, return_index=True)
    return np.sort(first)


def _forces(inputs: Sequence[ContactInput], depths: Floats) -> Iterator[tuple[int, str]]:
    """Yield the first depth at which an element differs in a result."""
    positions = np.repeat(-depths, 2, axis=1)[:, :, np.newaxis] * np.array([1.0, 0.0, 0.0])
    results = [ContactModel(contact_input).evaluate(positions) for contact_input in inputs]
    for name in ("force", "stiffness", "slope", "ratio"):
        old, new = (getattr(result, name) for result in results)
        different = old.view(np.uint64) != new.view(np.uint64)
        for element in np.flatnonzero(different.any(axis=0)).tolist():
            step = int(np.argmax(different[:, element]))
            values = f"{float(old[step, element])!r} before, {float(new[step, element])!r} after"
            yield element, f"{name} at depth {float(depths[step, element])!r}: {values}"


def _contact_input(scene: Scene, chosen: Indices) -> ContactInput:
    """Return the contact input of the chosen elements (k), each with two nodes of its own.

    An element without a diameter gets a diameter of 1: its law is the same for every diameter.
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
    """Return depths (steps, elements) for one or more inputs with the same elements, in their unit of length.

    For an element with a curve: every point of its curves and the adjacent floats, three places within each segment,
    and places far beyond both ends. For every element: the seabed, just above and below it, and some depths.
    """
    curves: dict[tuple[int, ...], Floats] = {}
    columns: list[Floats] = []
    of_element = np.column_stack([contact_input.curve_index for contact_input in inputs]).tolist()
    for diameter, indices in zip(inputs[0].diameter.tolist(), map(tuple, of_element), strict=True):
        if indices not in curves:
            ratios = [_ratios(given.curves[index]) for given, index in zip(inputs, indices, strict=True) if index >= 0]
            curves[indices] = np.unique(np.concatenate(ratios)) if ratios else np.zeros(0)
        columns.append(np.concatenate([_PLAIN, curves[indices] * diameter]))
    steps = max(map(len, columns))
    return np.column_stack([np.pad(column, (0, steps - len(column)), mode="edge") for column in columns])


def _ratios(curve: ForceCurve) -> Floats:
    """Return ratios at, next to and between the points of a curve, and beyond its ends."""
    points = curve.ratios
    inside = [points[:-1] + fraction * np.diff(points) for fraction in _FRACTIONS]
    width = float(points[-1] - points[0])
    beyond = np.array([points[0] - width, points[0] - 10.0 * width, points[-1] + width, points[-1] + 10.0 * width])
    beside = [np.nextafter(points, -np.inf), points, np.nextafter(points, np.inf)]
    ratios: Floats = np.concatenate([*beside, *inside, beyond])
    return ratios[np.isfinite(ratios)]
