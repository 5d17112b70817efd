"""Every argument of all that is public is refused by its name, or used: a new one has to be called here."""

from __future__ import annotations

import dataclasses
import inspect
import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import mudline
from tests.api.test_arguments import CURVE, DECK, MODEL, RESULT, SCENE, SERIES, STATE, WHERE, Wrong
from tests.helpers.builders.decks import CLEAN

DT: dict[str, Any] = {"positions": WHERE, "velocities": np.zeros_like(WHERE), "state": STATE, "dt": 0.1}
STEPS: dict[str, Any] = {"positions": WHERE, "present": np.ones(3, np.bool_), "velocities": np.zeros_like(WHERE)}
DECK_FIELDS = {each.name: getattr(DECK, each.name) for each in dataclasses.fields(DECK)}
READ: dict[str, Any] = {"path": "nowhere.keyxm", "units": "metric"}
BACKBONE: dict[str, Any] = {
    "model": "f114",
    "diameter": 0.3,
    "strength": (5000.0, 1500.0),
    "weight": 6000.0,
    "depth": 0.4,
    "tolerance": 0.01,
    "first": 0.001,
    "name": "clay",
    "legacy": True,
    "extend": True,
}
DIFF: dict[str, Any] = {"tolerance": 0.1, "strict": True}
REPORT: dict[str, Any] = {
    "decks": DECK,
    "path": "nowhere/report.html",
    "sections": ["verdict"],
    "rest_shape": True,
    "title": "Riser",
    "document": "1",
    "revision": "A",
    "fields": {"Client": "Us"},
    "date": "today",
    "template": None,
    "logo": None,
}
PUBLIC: dict[str, tuple[Callable[..., object], dict[str, Any]]] = {
    "read": (mudline.read, READ),
    "lint": (mudline.lint, {**READ, "select": ["SYN"], "ignore": ["SYN"]}),
    "from_keyword": (mudline.from_keyword, {"text": CLEAN, "units": "metric"}),
    "from_json": (mudline.from_json, {"text": DECK.to_json()}),
    "from_yaml": (mudline.from_yaml, {"text": DECK.to_yaml()}),
    "read_positions": (mudline.read_positions, {"path": "nowhere.csv", "scene": SCENE, "columns": {"x": "X"}}),
    "validate": (mudline.validate, READ),
    "format": (mudline.format, {"deck": DECK}),
    "fix": (mudline.fix, {"deck": DECK, "select": ["SYN"], "ignore": ["SYN"], "unsafe": True}),
    "migrate": (mudline.migrate, {"deck": DECK, "verify": True}),
    "expand": (mudline.expand, {"deck": DECK}),
    "export": (mudline.export, {"deck": DECK, "to": "moordyn", "name": "riser.txt", "rest_shape": False}),
    "backbone": (mudline.backbone, BACKBONE),
    "show": (mudline.show, {"deck": DECK}),
    "diff": (mudline.diff, {"before": DECK, "after": DECK, **DIFF, "units": "metric", "gitignore": True}),
    "diff_matrix": (mudline.diff_matrix, {"before": DECK, "decks": [DECK], **DIFF}),
    "report": (mudline.report, REPORT),
    "contact_warnings": (mudline.contact_warnings, {"scene": SCENE, "result": RESULT, "positions": WHERE}),
    "Deck": (mudline.Deck, DECK_FIELDS),
    "Deck.block": (DECK.block, {"keyword": "OCEAN", "section": "MODEL"}),
    "Deck.blocks": (DECK.blocks, {"keyword": "NODE", "section": "MODEL"}),
    "Deck.add": (lambda **given: DECK.copy().add(**given), {"block": DECK.block("OCEAN"), "section": "MODEL"}),
    "Deck.remove": (lambda **given: DECK.copy().remove(**given), {"what": "OCEAN"}),
    "Deck.set": (lambda **given: DECK.copy().set(**given), {"path": "OCEAN.depth", "value": 100.0}),
    "Deck.write": (DECK.write, {"path": "nowhere/deck.keyxm"}),
    "Deck.keywords": (DECK.keywords, {"section": "MODEL"}),
    "Scene": (mudline.Scene, {"resolved": SCENE._resolved}),
    "Scene.contact": (SCENE.contact, {"tension": "keep", "backend": "numpy"}),
    "ContactModel": (mudline.ContactModel, {"given": MODEL.input, "backend": "numpy", "threads": 1}),
    "ContactModel.evaluate": (MODEL.evaluate, {**STEPS, "times": [0.0]}),
    "ContactModel.stream": (lambda **given: list(MODEL.stream(**given)), {**STEPS, "times": [0.0], "together": True}),
    "ContactModel.step": (MODEL.step, {**DT, "out": MODEL.step(**DT)}),
    "ContactModel.tangent": (MODEL.tangent, {**DT, "back": True}),
    "ContactModel.stiffest": (MODEL.stiffest, {"positions": WHERE, "velocities": np.zeros_like(WHERE)}),
    "ContactResult.friction_state_of": (RESULT.friction_state_of, {"side": 0}),
    "ContactResult.step": (SERIES.step, {"index": 0}),
    "ContactResult.steps": (SERIES.steps, {"start": 0, "stop": 1}),
    "ContactResult.to_dataframe": (RESULT.to_dataframe, {"table": "elements"}),
    "ContactResult.to_arrow": (RESULT.to_arrow, {"table": "elements"}),
    "ContactResult.plot": (RESULT.plot, {"path": None, "elements": [1], "ax": None, "panel": "force"}),
    "study": (mudline.study, {"deck": DECK, "only": ["pruning"], "heave": 1.0, "period": 9.0, "tracked": iter}),
    "ForceCurve": (mudline.ForceCurve, {"points": [(0, 0), (1, 1)], "name": "x"}),
    "ForceCurve.evaluate": (CURVE.evaluate, {"ratios": [0.1], "out": None}),
    "ForceCurve.segment": (CURVE.segment, {"ratios": [0.1]}),
    "ForceCurve.extrapolated": (CURVE.extrapolated, {"ratios": [0.1]}),
    "ForceCurve.plot": (CURVE.plot, {"ax": None}),
    "ForceCurve.ratios_at_force": (CURVE.ratios_at_force, {"force": 1.0}),
}
"""A call of all that is public and takes arguments."""
UNCHECKED = {"ForceCurve.fill"}
"""For callers that check by themselves, as it says: it is called in the innermost loop."""
ARGUMENTS = [(name, argument) for name, (_, given) in PUBLIC.items() for argument in given]


def taken(thing: Callable[..., object]) -> list[str]:
    return [name for name in inspect.signature(thing).parameters if name != "self"]


def test_nothing_public_is_left_out() -> None:
    """A new function, method or argument has to be called here."""
    made = {"Deck": DECK, "Scene": SCENE, "ContactModel": MODEL, "ForceCurve": CURVE}
    functions = {name: getattr(mudline, name) for name in mudline.__all__}
    found = {name: taken(one) for name, one in functions.items() if inspect.isfunction(one) or name in made}
    for owner, one in {**made, "ContactResult": RESULT}.items():
        methods = inspect.getmembers(type(one), inspect.isfunction)
        found |= {f"{owner}.{name}": taken(method) for name, method in methods if name in dir(one) and name[0] != "_"}
    wanted = {name: list(given) for name, (_, given) in PUBLIC.items()}
    assert {name: sorted(arguments) for name, arguments in found.items() if arguments and name not in UNCHECKED} == {
        name: sorted(arguments) for name, arguments in wanted.items()
    }


REFUSED_OR_RIGHT: list[Wrong] = [b"\xff", math.nan, -1, -0.5, "", [], {}, [[1, 2], [3]], np.zeros((0, 3)), "\0"]


@pytest.mark.parametrize(("name", "argument"), ARGUMENTS, ids=map(".".join, ARGUMENTS))
def test_every_argument_is_refused_by_its_name(name: str, argument: str) -> None:
    """What may be right for some, as no text or no element, is taken or refused in the same way."""
    call, given = PUBLIC[name]
    others = {
        "ContactResult.plot": "|file format|needs time steps",
        "Deck.set": "|cannot be read|expected|out of range|has no field",
    }
    named = argument.removesuffix("s") + others.get(name, "")
    with pytest.raises(ValueError, match=argument):
        call(**{**given, argument: object()})
    for bad in REFUSED_OR_RIGHT:
        try:
            call(**{**given, argument: bad})
        except mudline.DeckError:
            pass
        except ValueError as error:
            assert re.search(named, str(error)), bad  # noqa: PT017 - the error is that of most, not of all
        except FileNotFoundError:
            assert "path" in given, bad
        except KeyError:
            assert name in ("Deck.block", "Deck.remove"), bad
