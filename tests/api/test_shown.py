"""What a session shows: representations of a line or two, `dir`, and completion."""

from __future__ import annotations

import pickle
import rlcompleter
from pathlib import Path

import numpy as np
import pytest

import mudline
from mudline.model.contact.seabed import SlopingSeabed
from mudline.model.results.evaluation import evaluate_scene
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

SAMPLES = Path(__file__).parents[2] / "samples"

USED = {
    "mudline": "Deck Scene ContactModel ContactResult ContactState Plan ForceCurve read lint from_keyword",
    "deck": "blocks file keywords scene sections source to_json to_keyword to_yaml units",
    "scene": "contact coordinates curves deck diameter element_ids element_nodes law_names law_sets length node_ids "
    "sets units",
    "contact": "evaluate initial_state input plan step stiffest stream tangent",
    "result": "contact depth force friction gap normal_force ratio reaction slope state step stiffness",
    "state": "friction positions suction touchdown unloading",
    "curve": "evaluate extrapolated forces name ratios ratios_at_force segment slopes",
}
INTERNAL = {
    "deck": "alone base_of bases diagnose folder_of incomplete lost origin own_sections place require written",
    "scene": "context extensions laws nodes resistance seabed section_table set_table table",
}


def own(thing: object) -> bool:
    return type(thing).__module__.startswith("mudline")


def test_representations_of_the_main_objects(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(SAMPLES)
    deck = mudline.read("scr-touchdown.keyxm")
    scene = deck.scene()
    contact = scene.contact()
    assert repr(deck) == "<Deck 'scr-touchdown.keyxm': metric, 3 sections, 16 blocks>"
    assert repr(scene) == "<Scene of 'scr-touchdown.keyxm': metric, 201 nodes, 200 elements, 7 sets, 2 curves>"
    assert repr(contact) == (
        "<ContactModel: 201 nodes, 200 elements; seabed surface, normal law, friction, assembly; "
        "one step after the other>"
    )
    result = contact.evaluate(np.zeros((4, 201, 3)))
    assert repr(result) == "<ContactResult: elements (4, 200), nodes (4, 201); with friction, friction_state>"
    assert repr(contact.plan) == (
        "<Plan: seabed surface, normal law, friction, assembly; without smoothing, unloading, suction, lateral, "
        "trench; one step after the other>"
    )
    before = contact.initial_state()
    _, after = contact.step(scene.coordinates, None, before)
    assert repr(before) == "<ContactState before the first step: friction>"
    assert repr(after) == "<ContactState after a step of 201 nodes: friction>"
    assert repr(evaluate_scene(resolve(deck))) == (
        "<Evaluation of 'scr-touchdown.keyxm': metric, 1 step, 200 elements, 201 nodes>"
    )
    assert repr(contact.stiffest()) == "<Stiffest: curve, friction>"


def test_representations_where_there_is_little() -> None:
    contact = mudline.from_keyword(CLEAN).scene().contact()
    assert repr(contact.initial_state()) == "<ContactState before the first step: nothing to remember>"
    assert repr(contact.evaluate()) == "<ContactResult: elements (2,), nodes (3,)>"
    assert repr(SlopingSeabed(5.0)).startswith("<SlopingSeabed: plane through the origin, slope 5 deg")


def test_errors_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "bad.keyxm"
    path.write_text(BAD_NUMBER, encoding="utf-8")
    (finding,) = mudline.lint(path)
    assert repr(finding).startswith("<Diagnostic: error ")
    with pytest.raises(mudline.DeckError) as caught:
        mudline.read(path)
    assert repr(caught.value).startswith("<DeckError: 1 diagnostic; ")
    assert repr(mudline.DeckError([])) == "<DeckError: 0 diagnostics>"
    again = pickle.loads(pickle.dumps(caught.value))  # noqa: S301 - our own bytes
    assert (again.diagnostics, str(again)) == (caught.value.diagnostics, str(caught.value))


@pytest.mark.parametrize("name", USED)
def test_dir_and_completion_show_what_is_needed(name: str) -> None:
    deck = mudline.read(SAMPLES / "full-cycle.keyxm")
    scene = deck.scene()
    contact = scene.contact()
    things = {
        "mudline": mudline,
        "deck": deck,
        "scene": scene,
        "contact": contact,
        "result": contact.evaluate(),
        "state": contact.initial_state(),
        "curve": scene.curves["soft clay"],
    }
    used = set(USED[name].split())
    assert used <= set(dir(things[name]))
    assert set(INTERNAL.get(name, "").split()).isdisjoint(dir(things[name]))
    completer = rlcompleter.Completer(things)
    offered = [completer.complete(f"{name}.", index) for index in range(200)]
    assert used <= {word.removeprefix(f"{name}.").rstrip("()") for word in offered if word}
