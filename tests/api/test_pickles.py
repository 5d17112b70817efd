"""What goes to other processes comes back with the same results: decks, scenes, models, states, results, findings."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest

import mudline
from mudline.checks.engine import LintSettings
from mudline.checks.fixing import lint_one
from mudline.checks.registry import rules
from mudline.language.deck.loading import load_path
from mudline.model.contact.plan import Backend
from mudline.model.scene.model import resolve
from tests.api.test_arguments import arrays_of
from tests.cli.runner import SAMPLES
from tests.helpers.builders.contact import everything, journey

Thing = TypeVar("Thing")

DECKS = sorted(path for path in SAMPLES.iterdir() if path.suffix.startswith((".keyx", ".das")))


def sent(thing: Thing) -> Thing:
    """What another process gets."""
    twin: Thing = pickle.loads(pickle.dumps(thing))  # noqa: S301 - our own bytes
    return twin


def bits(thing: object) -> dict[str, tuple[str, bytes]]:
    return {name: (str(array.dtype), array.tobytes()) for name, array in arrays_of(thing).items()}


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.name)
def test_decks_and_their_findings(path: Path) -> None:
    """One has values that are not known; others have equations, tables, curves, restarts and opaque lines."""
    deck = load_path(path)
    twin = sent(deck)
    assert twin == deck
    assert twin.diagnose(twin.problems) == deck.diagnose(deck.problems)
    scene, other = resolve(deck), resolve(twin)
    found = deck.diagnose(scene.findings)
    assert twin.diagnose(other.findings) == found
    assert sent(found) == found
    report = lint_one(path.name, path.read_bytes(), LintSettings(rules()), path.parent)
    assert sent(report) == report
    if not scene.blocking():
        assert bits(sent(scene.contact().evaluate())) == bits(other.contact().evaluate())


@pytest.mark.parametrize("backend", ["numpy", "auto"])
def test_models_states_and_results(backend: Backend) -> None:
    model = mudline.ContactModel(everything(12, 3), backend=backend)
    twin = sent(model)
    places, rates, _ = journey(12, 8, 1)
    whole = model.evaluate(places, velocities=rates)
    assert bits(twin.evaluate(places, velocities=rates)) == bits(whole) == bits(sent(whole))
    assert repr(twin.plan) == repr(model.plan)
    state, other = model.initial_state(), twin.initial_state()
    for place, rate in zip(places, rates, strict=True):
        one, state = model.step(place, rate, state)
        two, other = twin.step(place, rate, sent(other))
        assert bits(one) == bits(two)
        assert bits(state) == bits(other)


@pytest.mark.parametrize("path", [path for path in DECKS if path.stem in {"scr-soil", "slope-friction", "parametric"}])
def test_scenes(path: Path) -> None:
    scene = mudline.read(path).scene()
    twin = sent(scene)
    assert (twin.law_names, twin.law_sets, list(twin.curves)) == (scene.law_names, scene.law_sets, list(scene.curves))
    assert twin.curves == scene.curves
    for name in ("node_ids", "coordinates", "element_ids", "element_nodes", "length", "diameter"):
        assert np.array_equal(getattr(twin, name), getattr(scene, name), equal_nan=True)
        assert not getattr(twin, name).flags.writeable
    assert bits(twin.contact().evaluate()) == bits(scene.contact().evaluate())
