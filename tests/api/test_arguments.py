"""What public functions refuse: every argument of a wrong kind, shape or value, by its name; what cannot be written."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest

import mudline
from mudline.model.contact.input import ContactInput
from mudline.model.contact.plan import Backend
from tests.helpers.builders.contact import all_laws, everything, journey, without
from tests.helpers.builders.decks import CLEAN

Wrong: TypeAlias = Any
Call = Callable[[Any], object]

DECK = mudline.from_keyword(CLEAN)
SCENE = DECK.scene()
OTHER = mudline.from_keyword(
    CLEAN.replace(" 3, 0.3, 20.0\n", " 3, 0.3, 20.0\n 4, 0.3, 30.0\n").replace(" 2, 2, 3\n", " 2, 2, 3\n 3, 3, 4\n")
).scene()
MODEL = SCENE.contact()
STATE = MODEL.initial_state()
RESULT = MODEL.evaluate()
SERIES = MODEL.evaluate(np.array([SCENE.coordinates, SCENE.coordinates]))
CURVE = SCENE.curves["Clay"]
HISTORY = mudline.ContactModel(everything(4, 1))
FULL, _, _ = journey(4, 2, 1)
WHERE = SCENE.coordinates


def instead(bad: Wrong, kind: type) -> Wrong:
    """What is given, and something else where that would be right."""
    return object() if isinstance(bad, kind) else bad


NO_OBJECT: dict[str, Wrong] = {
    "none": None,
    "number": 3,
    "nan": math.nan,
    "text": "x",
    "bytes": b"x",
    "list": [1, 2],
    "ragged": [[1, 2], [3]],
    "mapping": {},
    "set": {1},
    "complex": 1j,
    "class": object,
    "objects": np.array([object()]),
    "date": np.datetime64("2020-01-01"),
}
"""Values that are no deck, scene, model, state or result."""

OBJECTS: dict[str, tuple[str, Call]] = {
    "read_positions scene": ("scene", lambda bad: mudline.read_positions("x.csv", bad)),
    "contact_warnings scene": ("scene", lambda bad: mudline.contact_warnings(bad, RESULT)),
    "contact_warnings result": ("result", lambda bad: mudline.contact_warnings(SCENE, bad)),
    "Scene": ("resolved", mudline.Scene),
    "ContactModel": ("given", mudline.ContactModel),
    "step state": ("state", lambda bad: MODEL.step(WHERE, None, bad)),
    "tangent state": ("state", lambda bad: MODEL.tangent(WHERE, None, bad)),
    "Deck sections": ("sections", lambda bad: mudline.Deck("x", sections=instead(bad, list))),
}


@pytest.mark.parametrize("bad", NO_OBJECT.values(), ids=NO_OBJECT)
@pytest.mark.parametrize("name", OBJECTS)
def test_what_is_not_one_of_our_objects(name: str, bad: Wrong) -> None:
    argument, call = OBJECTS[name]
    with pytest.raises(TypeError, match=f"^{argument} must be "):
        call(bad)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_not_finite(bad: float) -> None:
    calls: dict[str, Callable[[], object]] = {
        "point 2 is not finite": lambda: mudline.ForceCurve([(0, 0), (1, bad)]),
        "ratio": lambda: CURVE.evaluate([0.1, bad]),
        r"ratio .*\(index 1\)": lambda: CURVE.segment([0.1, bad]),
        r"ratio .* \(index 1\)": lambda: CURVE.extrapolated([0.1, bad]),
        "the force": lambda: CURVE.ratios_at_force(bad),
        "its position": lambda: MODEL.evaluate(np.full((3, 3), bad)),
        "^node 1 at step 0: its position": lambda: MODEL.step(np.full((3, 3), bad), None, STATE),
        "its velocity": lambda: HISTORY.evaluate(FULL[0], velocities=np.full(FULL[0].shape, bad)),
        "times": lambda: MODEL.evaluate([WHERE, WHERE], times=[0.0, bad]),
        "dt": lambda: MODEL.step(WHERE, None, STATE, bad),
    }
    for message, call in calls.items():
        with pytest.raises(ValueError, match=message):
            call()


# ---------------------------------------------------------------------------------------------- words and whole numbers


@pytest.mark.parametrize("bad", [3, -1, "", "x", "Metric", b"metric", [], ["metric"], {}, np.array(["metric", "user"])])
def test_units_that_are_none(bad: Wrong, tmp_path: Path) -> None:
    path = tmp_path / "deck.keyxm"
    path.write_text(CLEAN, encoding="utf-8")
    calls: list[Callable[[], object]] = [
        lambda: mudline.read(path, units=bad),
        lambda: mudline.lint(path, units=bad),
        lambda: mudline.from_keyword(CLEAN, units=bad),
        lambda: mudline.Deck("x", units=bad),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=r"^units must be one of metric, imperial, user, not "):
            call()


@pytest.mark.parametrize("bad", ["", "x", b"x", [], [0.1], {}, 1j, np.datetime64("2020-01-01")], ids=repr)
def test_a_time_step_that_is_no_number(bad: Wrong) -> None:
    for call in (MODEL.step, MODEL.tangent):
        with pytest.raises(TypeError, match=r"^dt must be a number, not "):
            call(WHERE, None, STATE, bad)


@pytest.mark.parametrize("bad", [0, -1, -0.5])
def test_numbers_out_of_range(bad: float) -> None:
    with pytest.raises(ValueError, match="dt must be finite and above 0"):
        MODEL.step(WHERE, None, STATE, bad)
    with pytest.raises(IndexError, match="index 2 is out of range: the series has 2 steps"):
        SERIES.step(2)
    with pytest.raises(ValueError, match="a single state has no steps"):
        RESULT.step(0)
    with pytest.raises(ValueError, match="a single state has no steps"):
        RESULT.steps(0, 1)


OUT: list[Any] = [
    3,
    "xy",
    [np.empty(1), np.empty(1)],
    (),
    (np.empty(1),),
    (np.empty(1), None),
    (np.empty(1), [0.0]),
    (np.empty(1), np.empty(2)),
    (np.empty(1), np.empty(1, np.float32)),
    (np.empty(1), np.broadcast_to(0.0, (1,))),
]


@pytest.mark.parametrize("bad", OUT, ids=range(len(OUT)))
def test_what_cannot_take_the_values_of_a_curve(bad: Wrong) -> None:
    with pytest.raises((TypeError, ValueError), match=r"^out must be "):
        CURVE.evaluate([0.1], out=bad)


# ---------------------------------------------------------------------------------------- what belongs to another model


def test_a_state_of_another_model_is_refused() -> None:
    _, after = OTHER.contact().step(OTHER.coordinates, None, OTHER.contact().initial_state())
    history = OTHER.contact().initial_state() if OTHER.contact().plan.history else HISTORY.initial_state()
    for state in (dataclasses.replace(after, positions=OTHER.coordinates), history):
        with pytest.raises(ValueError, match=r"^state must be one of this model"):
            MODEL.step(WHERE, None, state)
    longer = mudline.ContactModel(everything(5, 1))
    with pytest.raises(ValueError, match=r"^state must be one of this model"):
        HISTORY.step(FULL[0], np.zeros(FULL[0].shape), longer.initial_state())


def test_a_result_of_another_scene_is_refused() -> None:
    assert len(OTHER.node_ids) != len(SCENE.node_ids)
    with pytest.raises(ValueError, match=r"^result must be that of the scene"):
        mudline.contact_warnings(SCENE, OTHER.contact().evaluate())


FIELDS = [
    each.name for each in dataclasses.fields(ContactInput) if each.init and each.name not in {"left_out", "names"}
]


@pytest.mark.parametrize("bad", [3, "x", [1.0], [None], np.array(["x"]), {}], ids=repr)
@pytest.mark.parametrize("name", [name for name in FIELDS if name != "seabed"])
def test_an_input_is_made_of_arrays(name: str, bad: Wrong) -> None:
    if name == "curves" and isinstance(bad, list):
        bad = np.zeros(2)
    with pytest.raises((TypeError, ValueError), match=name):
        dataclasses.replace(MODEL.input, **{name: bad})


# ---------------------------------------------------------------------------------------- what is shared is not written


def arrays_of(thing: Wrong) -> dict[str, np.ndarray[Any, Any]]:
    found = {each.name: getattr(thing, each.name) for each in dataclasses.fields(thing)}
    return {name: value for name, value in found.items() if isinstance(value, np.ndarray)}


def test_arrays_of_a_scene_cannot_be_written() -> None:
    names = ("node_ids", "coordinates", "element_ids", "element_nodes", "length", "diameter")
    held = {name: getattr(SCENE, name) for name in names} | dict(SCENE.sets) | arrays_of(MODEL.input)
    held |= {"ratios": CURVE.ratios, "forces": CURVE.forces, "slopes": CURVE.slopes}
    for name, array in held.items():
        assert not array.flags.writeable, name
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 1


def test_names_of_a_scene_cannot_be_written_and_what_is_done_to_the_deck_does_not_reach_it() -> None:
    deck = mudline.from_keyword(CLEAN)
    scene = deck.scene()
    assert (scene.law_names, scene.law_sets) == (("curve:Clay", "curve:Clay"), ("Pipe", "Pipe"))
    for held in (deck, scene.deck):
        (_, curves), (_, nodes) = next(held.blocks("SEABED STIFFNESS")), next(held.blocks("NODE"))
        curves.curves[0].points.values[...] = 1.0
        nodes.entries.clear()
        held.sections.clear()
    assert scene.contact().evaluate().normal_force.tobytes() == RESULT.normal_force.tobytes()


def test_the_arrays_that_an_input_was_made_of_stay_as_they_were() -> None:
    ids = np.array(MODEL.input.node_ids)
    assert np.shares_memory(dataclasses.replace(MODEL.input, node_ids=ids).node_ids, ids)
    assert ids.flags.writeable


def test_writing_into_results_changes_nothing_else() -> None:
    model = mudline.ContactModel(everything(4, 1), backend="numpy")
    places, rates, _ = journey(4, 3, 1)
    wanted = [each.tobytes() for each in arrays_of(model.evaluate(places, velocities=rates)).values()]
    result, state = model.step(places[0], rates[0], model.initial_state())
    for made in (result, model.evaluate(places.copy(), velocities=rates)):  # a series keeps the positions themselves
        for array in arrays_of(made).values():
            if array.flags.writeable:
                array[...] = 1
    _, once_more = model.step(places[0], rates[0], model.initial_state())
    for one, other in zip(arrays_of(state).values(), arrays_of(once_more).values(), strict=True):
        assert one.tobytes() == other.tobytes()
    assert [each.tobytes() for each in arrays_of(model.evaluate(places, velocities=rates)).values()] == wanted


# ------------------------------------------------------------------------------------------------------------- threads


_LEFT_OUT = ("soil", "trench peak", "trench wall", "trench table", "lateral", "nodal", "smoothed", "suction spring")
"""Laws that are left out: the others remember steps, and are compiled in a third of the time."""


@pytest.mark.covered
@pytest.mark.slow
@pytest.mark.parametrize("backend", ["numpy", "fast"])
def test_eight_threads_give_the_bits_of_one(backend: Backend) -> None:
    if backend == "fast":
        pytest.importorskip("numba")
    remembering = without(all_laws(60, 3), *_LEFT_OUT)
    model = mudline.ContactModel(remembering, backend=backend, threads=2)
    runs = [journey(60, 60, seed) for seed in range(8)]

    def bits(number: int) -> list[bytes]:
        places, rates, _ = runs[number % 8]
        whole = model.evaluate(places, velocities=rates)
        state = model.initial_state()
        for place, rate in zip(places[:5], rates[:5], strict=True):
            last, state = model.step(place, rate, state)
        return [each.tobytes() for each in (*arrays_of(whole).values(), *arrays_of(last).values())]

    with ThreadPoolExecutor(8) as pool:
        together = list(pool.map(bits, range(32)))
    assert together == [bits(number) for number in range(8)] * 4
