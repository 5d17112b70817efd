"""Results of long series and large models: written in pieces, exact in every format."""

from __future__ import annotations

import csv
import io
import json
import tracemalloc

import numpy as np
import pytest

from mudline.deck.loading import load_bytes
from mudline.diagnostics import DeckError
from mudline.results.evaluation import Evaluation, Tension, evaluate_scene, prepare
from mudline.results.formats import csv_text, json_text, plan_rows, write_npz
from mudline.results.totals import StepTotal, Total, step_totals, totals
from mudline.scene.build import resolve
from mudline.scene.model import Scene
from mudline.scene.positions import Positions
from tests.cli.decks import CLEAN, ILLEGAL, PULLING


def scene(text: str = CLEAN) -> Scene:
    return resolve(load_bytes(text.encode(), "deck.keyxm"))


def series(steps: int, text: str = CLEAN, tension: Tension = "keep", *, absent: tuple[int, ...] = ()) -> Evaluation:
    """The deck going down by 1 mm a step."""
    found = scene(text)
    moved = found.coordinates - np.arange(steps)[:, np.newaxis, np.newaxis] * np.array([0.001, 0.0, 0.0])
    present = ~np.isin(found.node_ids, absent)
    moved[:, ~present] = np.nan
    return evaluate_scene(found, Positions(moved, present, np.arange(steps, dtype=np.float64)), tension)


def long_model(elements: int) -> Evaluation:
    numbers = f"*NODE\n 1, -0.1, 0.0\n {elements + 1}, -0.1, 100.0\n GEN=1, {elements + 1}\n"
    numbers += f"*ELEMENT\n 1, 1, 2\n GEN=1, {elements}\n"
    rest = CLEAN.partition("*ELEMENT SETS\n SET=Pipe\n 1, 2\n")[2].replace("Pipe", "ALL")
    return evaluate_scene(scene(f"$MODEL\n{numbers}{rest}"))


@pytest.mark.parametrize("absent", [(), (3,), (1, 3), (1, 2, 3)])
def test_formats_agree(absent: tuple[int, ...]) -> None:
    evaluation = series(5, absent=absent)
    found = json.loads("".join(json_text(evaluation)))
    stream = io.BytesIO()
    write_npz(evaluation, stream)
    with np.load(io.BytesIO(stream.getvalue()), allow_pickle=False) as archive:
        arrays = dict(archive)
    for table in ("elements", "nodes"):
        rows = [row | {"time": step["time"]} for step in found["steps"] for row in step[table]]
        lines = list(csv.DictReader("".join(csv_text(evaluation, table)).splitlines()))
        assert [(row["time"], row.get("force", row.get("gap"))) for row in rows] == (
            [(float(line["time"]), float(line.get("force") or line["gap"])) for line in lines]
        )
    forces = [[element["force"] for element in step["elements"]] for step in found["steps"]]
    assert np.array_equal(arrays["force"], np.array(forces).reshape(arrays["force"].shape))
    assert arrays["element"].tolist() == ([1, 2] if not absent else [1] if absent == (3,) else [])
    assert arrays["reaction"].shape == (5, 3 - len(absent), 3)


def test_pieces_are_small() -> None:
    evaluation = series(4000)
    tracemalloc.start()
    sizes = {
        name: sum(len(piece) for piece in pieces)
        for name, pieces in (
            ("json", json_text(evaluation)),
            ("csv", csv_text(evaluation, "elements")),
            ("nodes", csv_text(evaluation, "nodes")),
        )
    }
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert sizes["json"] > 4e6
    assert peak < 1e6


def test_pieces_of_a_large_model_are_small() -> None:
    evaluation = long_model(100_000)
    tracemalloc.start()
    size = sum(len(piece) for piece in csv_text(evaluation, "elements"))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert size > 5e6
    assert peak < 20e6


def test_large_model_is_whole() -> None:
    evaluation = long_model(40_000)
    found = json.loads("".join(json_text(evaluation)))
    assert [element["element"] for element in found["elements"]] == list(range(1, 40_001))
    assert len(found["nodes"]) == 40_001
    assert len("".join(csv_text(evaluation, "nodes")).splitlines()) == 40_002
    assert {element["force"] for element in found["elements"]} == {1500.0}


def test_cut_curve_by_step() -> None:
    cut = series(400, PULLING, "cut")
    laws = [element["law"] for step in json.loads("".join(json_text(cut)))["steps"] for element in step["elements"]]
    assert set(laws) == {"curve:Clay", "curve-cut"}
    stream = io.BytesIO()
    write_npz(cut, stream)
    with np.load(io.BytesIO(stream.getvalue())) as archive:
        assert archive["law"].ravel().tolist() == laws
        assert (archive["force"][archive["law"] == "curve-cut"] == 0.0).all()


def test_totals() -> None:
    evaluation = evaluate_scene(scene())
    (total,) = totals(evaluation)
    assert total == Total("curve:Clay", "Pipe", 2, 1, 0.1, 15000.0)
    assert step_totals(evaluation, None) == []


def test_totals_of_steps() -> None:
    evaluation = series(300)
    found = step_totals(evaluation, None)
    assert len(found) == 300
    assert found[0] == StepTotal(0.0, 1, 1, 1, 0.1, 15000.0)
    assert found[-1][1:4] == (2, 1, 2)
    assert step_totals(evaluation, 3) == found[:3]
    summed = evaluation.result.reaction[..., 0].sum(axis=1)
    assert np.allclose([each.reaction for each in found], summed, rtol=1e-12)


def test_totals_of_nothing() -> None:
    evaluation = series(2, absent=(2,))
    assert totals(evaluation) == []
    assert step_totals(evaluation, None) == [(0.0, 0, None, None, None, 0.0), (1.0, 0, None, None, None, 0.0)]


def test_sum_that_overflows_warns_nobody() -> None:
    deck = CLEAN.replace(" 0.1, 1000.0\n 0.5, 3000.0", " 0.2, 1.5E307\n 0.5, 3.0E307").replace(" 3, 0.3,", " 3, -0.1,")
    deck = deck.replace(", 10.0\n", ", 5.0\n").replace(", 20.0\n", ", 15.0\n")
    (total,) = totals(evaluate_scene(scene(deck)))
    assert total.reaction > 1e308


def test_plan() -> None:
    rows = plan_rows(prepare(scene()).model.plan)
    assert rows[0] == {"stage": "floor", "active": True, "why": "one flat bed at X = 0"}


def test_scene_with_errors_is_refused() -> None:
    for refuse in (evaluate_scene, prepare):
        with pytest.raises(DeckError, match="REF001"):
            refuse(scene(ILLEGAL))


def test_positions_that_are_not_finite() -> None:
    found = scene()
    values = np.zeros((2, 3, 3))
    values[1, 1, 1] = np.inf
    with pytest.raises(DeckError, match=r"RUN001 node 2 at step 1: its position \(0.0, inf, 0.0\) is not finite"):
        evaluate_scene(found, Positions(values, np.ones(3, dtype=bool), np.arange(2.0)))
