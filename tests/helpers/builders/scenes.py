"""Decks and scenes of texts, and what reading, resolving, comparing and expanding them finds."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.editing.comparison.comparing import compare
from mudline.editing.comparison.model import Difference
from mudline.editing.variations.files import ExpansionPlan
from mudline.editing.variations.planning import plan
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.model.scene.model import Scene, resolve
from tests.helpers.builders.decks import varied_deck

Finding = tuple[str, str, int, int]
"""Severity letter, code, line and column."""


def deck_of(text: str | bytes, name: str = "deck.keyxm", folder: Path | None = None, units: str | None = None) -> Deck:
    """The deck of a text; the name says its form."""
    return load_bytes(text if isinstance(text, bytes) else text.encode(), name, folder=folder, units=units)


def faults(text: str) -> list[str]:
    """What was noticed in reading a deck: place, code and message."""
    deck = deck_of(text)
    return [f"{found.line}:{found.column} {found.code} {found.message}" for found in deck.diagnose(deck.problems)]


def scene_of(text: str | bytes, name: str = "deck.keyxm") -> Scene:
    return resolve(deck_of(text, name))


def legal_scene(text: str, name: str = "deck.keyxm", units: str | None = None) -> Scene:
    """The scene of a deck that can be evaluated."""
    return resolve(deck_of(text, name, units=units)).require()


def diagnostics(scene: Scene) -> list[Diagnostic]:
    return scene.deck.diagnose(scene.problems)


def reported(text: str) -> list[Finding]:
    """What resolving a deck tells, without what reading it tells."""
    return _places(diagnostics(scene_of(text)))


def all_reported(text: str) -> list[Finding]:
    """What reading and resolving a deck tell."""
    scene = scene_of(text)
    return _places(scene.deck.diagnose([*scene.deck.problems, *scene.problems]))


def _places(found: list[Diagnostic]) -> list[Finding]:
    return [(one.severity.value[0].upper(), one.code, one.line, one.column) for one in found]


def messages(text: str) -> list[str]:
    return [found.message for found in diagnostics(scene_of(text))]


def members(scene: Scene) -> dict[str, list[int]]:
    """Element numbers of every set."""
    return {name: ids.tolist() for name, ids in scene.sets.items()}


def nodes_of(scene: Scene) -> dict[int, list[float]]:
    return dict(zip(scene.node_ids.tolist(), scene.coordinates.tolist(), strict=True))


def ends_of(scene: Scene) -> dict[int, list[int]]:
    """Node numbers of every element; 0 for a node that is not known."""
    ids = [*scene.node_ids.tolist(), 0]
    pairs = [[ids[end] for end in ends] for ends in scene.element_nodes.tolist()]
    return dict(zip(scene.element_ids.tolist(), pairs, strict=True))


def differences(
    before: str | bytes, after: str | bytes, tolerance: float = 0.0, name: str = "b.keyxm"
) -> list[Difference]:
    """What differs between two texts; the second one has the form that its name tells."""
    return compare(scene_of(before, "a.keyxm"), scene_of(after, name), tolerance)


def brief(found: list[Difference]) -> list[tuple[str, object, object]]:
    """Places and values only."""
    return [(one.where, one.before, one.after) for one in found]


def planned(variations: str, combinations: str = " DESCRIPTION=all, FILENAME=%Period%\n") -> ExpansionPlan:
    return plan(deck_of(varied_deck(variations, combinations), "study.keyxm"))


def refused(content: str | bytes, name: str = "study.keyxm", folder: Path | None = None) -> list[Diagnostic]:
    """Why a deck cannot be expanded."""
    with pytest.raises(DeckError) as caught:
        plan(deck_of(content, name, folder))
    return list(caught.value.diagnostics)


def only(found: list[Diagnostic]) -> tuple[str, int, int, str]:
    """The one reason: code, line, column, message."""
    assert len(found) == 1, found
    return found[0].code, found[0].line, found[0].column, found[0].message
