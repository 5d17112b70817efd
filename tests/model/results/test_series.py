"""Results of long series and large models: written in pieces, exact in every format."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from mudline.language.diagnostics import DeckError
from mudline.model.contact import numpy_driver
from mudline.model.contact.arrays import Positions
from mudline.model.results.evaluation import Evaluation, Tension, evaluate_scene
from mudline.model.results.forms import text
from tests.helpers.builders.decks import CLEAN
from tests.helpers.builders.scenes import scene_of
from tests.model.results.written import arrays_of, json_of, pieces, steps_of


def series(steps: int, text: str = CLEAN, tension: Tension = "keep", *, absent: tuple[int, ...] = ()) -> Evaluation:
    """The deck going down by 1 mm a step."""
    found = scene_of(text)
    moved = found.coordinates - np.arange(steps)[:, np.newaxis, np.newaxis] * np.array([0.001, 0.0, 0.0])
    present = ~np.isin(found.node_ids, absent)
    moved[:, ~present] = np.nan
    return evaluate_scene(found, Positions(moved, present, np.arange(steps, dtype=np.float64)), tension)


@pytest.mark.untraced
def test_pieces_are_small(monkeypatch: pytest.MonkeyPatch) -> None:
    """With pieces of a sixteenth of the usual size, so that few steps are many pieces."""
    monkeypatch.setattr(numpy_driver, "BLOCK", numpy_driver.BLOCK // 16)
    monkeypatch.setattr(text, "_BLOCK", text._BLOCK // 16)
    monkeypatch.setattr(text, "_PIECE", text._PIECE // 16)
    evaluation = series(2_500)
    peaks = {}
    for name, form, table in (("json", "json", "elements"), ("elements", "csv", "elements"), ("nodes", "csv", "nodes")):
        tracemalloc.start()
        size = sum(len(piece) for piece in pieces(evaluation, form, table))
        peaks[name] = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert size > 1.5e5
    assert max(peaks["elements"], peaks["nodes"]) < 3e6, "the results of a chunk, not of all steps"
    assert peaks["json"] < 3e6 + 1300 * 2_500, "besides, the lines of each step, which stand behind the results"


def test_totals_of_steps() -> None:
    evaluation = series(300)
    found = steps_of(evaluation)
    assert len(found) == 300
    assert found[0] == {
        "time": 0.0,
        "reaction": 15000.0,
        "touching": 1,
        "first": 1,
        "last": 1,
        "slipping": None,
        "deepest": 0.1,
        "sucked": None,
    }
    assert (found[-1]["touching"], found[-1]["first"], found[-1]["last"]) == (2, 1, 2)
    summed = arrays_of(evaluation)["reaction"][..., 0].sum(axis=1)
    assert np.allclose([each["reaction"] for each in found], summed, rtol=1e-12)


def test_positions_that_are_not_finite() -> None:
    found = scene_of(CLEAN)
    values = np.zeros((2, 3, 3))
    values[1, 1, 1] = np.inf
    with pytest.raises(DeckError, match=r"RUN001 node 2 at step 1: its position \(0.0, inf, 0.0\) is not finite"):
        json_of(evaluate_scene(found, Positions(values, np.ones(3, dtype=bool), np.arange(2.0))))
