"""Results of long series and large models: written in pieces, exact in every format."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from mudline.contact import numpy_driver
from mudline.diagnostics import DeckError
from mudline.results.evaluation import Evaluation, Tension, evaluate_scene, prepare
from mudline.results.forms import plan_rows, text
from mudline.results.totals import StepTotal, Total
from mudline.scene.positions import Positions
from tests.builders.decks import CLEAN, ILLEGAL
from tests.builders.scenes import scene_of
from tests.results.written import arrays_of, json_of, pieces, steps_of, totals_of


def series(steps: int, text: str = CLEAN, tension: Tension = "keep", *, absent: tuple[int, ...] = ()) -> Evaluation:
    """The deck going down by 1 mm a step."""
    found = scene_of(text)
    moved = found.coordinates - np.arange(steps)[:, np.newaxis, np.newaxis] * np.array([0.001, 0.0, 0.0])
    present = ~np.isin(found.node_ids, absent)
    moved[:, ~present] = np.nan
    return evaluate_scene(found, Positions(moved, present, np.arange(steps, dtype=np.float64)), tension)


@pytest.mark.untraced
def test_pieces_are_small(monkeypatch: pytest.MonkeyPatch) -> None:
    """With pieces of an eighth of the usual size, so that an eighth of the steps is many pieces."""
    monkeypatch.setattr(numpy_driver, "BLOCK", numpy_driver.BLOCK // 8)
    monkeypatch.setattr(text, "_BLOCK", text._BLOCK // 8)
    monkeypatch.setattr(text, "_PIECE", text._PIECE // 8)
    evaluation = series(4_500)
    tracemalloc.start()
    sizes = {
        name: sum(len(piece) for piece in found)
        for name, found in (
            ("json", pieces(evaluation, "json")),
            ("csv", pieces(evaluation, "csv")),
            ("nodes", pieces(evaluation, "csv", "nodes")),
        )
    }
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert sizes["json"] > 7e6
    assert peak < 5e6, "the results of a chunk, not of all steps"


def test_totals() -> None:
    evaluation = evaluate_scene(scene_of(CLEAN))
    (total,) = totals_of(evaluation)
    assert total == Total("curve:Clay", "Pipe", 2, 1, 0.1, 15000.0)
    assert steps_of(evaluation) == []


def test_totals_of_steps() -> None:
    evaluation = series(300)
    found = steps_of(evaluation)
    assert len(found) == 300
    assert found[0] == StepTotal(0.0, 1, 1, 1, 0.1, 15000.0)
    assert found[-1][1:4] == (2, 1, 2)
    assert steps_of(evaluation, 3) == found[:3]
    summed = arrays_of(evaluation)["reaction"][..., 0].sum(axis=1)
    assert np.allclose([each.reaction for each in found], summed, rtol=1e-12)


def test_totals_of_nothing() -> None:
    evaluation = series(2, absent=(2,))
    assert totals_of(evaluation) == []
    assert steps_of(evaluation) == [StepTotal(time, 0, None, None, None, 0.0) for time in (0.0, 1.0)]


def test_sum_that_overflows_warns_nobody() -> None:
    deck = CLEAN.replace(" 0.1, 1000.0\n 0.5, 3000.0", " 0.2, 1.5E307\n 0.5, 3.0E307").replace(" 3, 0.3,", " 3, -0.1,")
    deck = deck.replace(", 10.0\n", ", 5.0\n").replace(", 20.0\n", ", 15.0\n")
    (total,) = totals_of(evaluate_scene(scene_of(deck)))
    assert total.reaction is not None
    assert total.reaction > 1e308


def test_plan() -> None:
    rows = plan_rows(prepare(scene_of(CLEAN)).model.plan)
    assert rows[0] == {"stage": "floor", "active": True, "why": "one flat seabed at X = 0"}


def test_scene_with_errors_is_refused() -> None:
    for refuse in (evaluate_scene, prepare):
        with pytest.raises(DeckError, match="REF001"):
            refuse(scene_of(ILLEGAL))


def test_positions_that_are_not_finite() -> None:
    found = scene_of(CLEAN)
    values = np.zeros((2, 3, 3))
    values[1, 1, 1] = np.inf
    with pytest.raises(DeckError, match=r"RUN001 node 2 at step 1: its position \(0.0, inf, 0.0\) is not finite"):
        json_of(evaluate_scene(found, Positions(values, np.ones(3, dtype=bool), np.arange(2.0))))
