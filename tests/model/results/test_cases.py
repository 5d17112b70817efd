"""What is worst in the results of a deck, against its lines at all steps."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace

import pytest

import mudline
from mudline.model.contact.result import ResultPart
from mudline.model.contact.touchdown import line_summaries
from mudline.model.results.cases import CaseSummary, case_summary, worst_first, write_parquet
from mudline.model.results.evaluation import Evaluation, evaluate_scene
from mudline.model.results.series import SeriesSummary
from mudline.model.scene.model import resolve
from mudline.model.scene.positions import read_positions
from tests.helpers.builders.decks import CLEAN
from tests.helpers.builders.scenes import legal_scene
from tests.helpers.samples import SAMPLES


def heave() -> Evaluation:
    scene = resolve(mudline.read(SAMPLES / "scr-touchdown.keyxm"))
    return evaluate_scene(scene, read_positions(SAMPLES / "positions.csv", scene.nodes))


def single_steps(evaluation: Evaluation) -> Iterator[ResultPart]:
    """The same steps, one at a time."""
    for part in evaluation.parts():
        for step in range(part.count):
            only = part.result.step(step).as_series()
            times = None if evaluation.time is None else evaluation.time[part.start + step : part.start + step + 1]
            yield ResultPart(part.start + step, replace(only, times=times))


def test_row_is_the_worst_of_the_lines() -> None:
    evaluation = heave()
    watch = SeriesSummary(evaluation, "case")
    lines = []
    for part in evaluation.parts():
        watch.take(part)
        lines += line_summaries(part.result)
    found = case_summary(watch, "deck", [], None)
    pushes = [(line.largest_force, line.time) for line in lines if line.largest_force is not None]
    force, time = max(pushes, key=lambda each: each[0].force)
    assert (found.largest_force, found.largest_force_element, found.largest_force_time) == (
        force.force,
        force.element,
        time,
    )
    arcs = [point.arc_length for line in lines for point in line.touchdown]
    assert (found.touchdown_from, found.touchdown_to) == (min(arcs), max(arcs))
    assert found.contact_length == max(line.contact_length for line in lines)
    heaviest = max(lines, key=lambda line: line.reaction or 0.0)
    assert (found.reaction, found.ratio) == (heaviest.reaction, heaviest.ratio)
    assert found.submerged_weight == pytest.approx(heaviest.submerged_weight)
    assert found.empty_weight == pytest.approx(heaviest.empty_weight)
    assert (found.steps, found.in_contact, found.largest_uplift) == (8, 30, None)


def test_a_conductor_in_the_soil_has_no_touchdown() -> None:
    """The line touches down on a quarter of element 2; of a conductor of 9 m beside it 6 m are in the soil."""
    conductor = CLEAN.replace("*ELEMENT\n", " 4, -6.0, 40.0\n 5, 3.0, 40.0\n*ELEMENT\n 3, 4, 5\n", 1)
    rows = []
    for text in (CLEAN, conductor + "*P-Y\n SET=ALL\n DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n"):
        evaluation = evaluate_scene(legal_scene(text))
        watch = SeriesSummary(evaluation, "case")
        for part in evaluation.parts():
            watch.take(part)
        rows.append(case_summary(watch, "deck", [], None))
    assert rows[1].touchdown_from == rows[0].touchdown_from == pytest.approx(10.0 + 10.008 / 4, rel=1e-4)
    assert rows[1].contact_length == rows[0].contact_length


def test_row_does_not_depend_on_how_many_steps_come_at_a_time() -> None:
    evaluation = heave()
    watches = SeriesSummary(evaluation, "case"), SeriesSummary(evaluation, "case")
    for watch, parts in zip(watches, (evaluation.parts(), single_steps(evaluation)), strict=True):
        for part in parts:
            watch.take(part)
    found, single = (case_summary(watch, "deck", [], None) for watch in watches)
    assert found.ratio == pytest.approx(single.ratio, rel=1e-14)  # numpy adds up weights in another order
    assert found.submerged_weight == pytest.approx(single.submerged_weight, rel=1e-14)
    assert found.empty_weight == pytest.approx(single.empty_weight, rel=1e-14)
    whole, apart = (
        replace(row, ratio=None, submerged_weight=None, empty_weight=None)
        for row in (found, single)  # sums of parts
    )
    assert whole == apart


def test_a_name_that_is_not_utf_8_is_escaped_in_parquet() -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    stream = io.BytesIO()
    write_parquet([CaseSummary("odd\udcff.keyxm", "failed", "no such file")], stream)
    assert parquet.read_table(stream).column("deck").to_pylist() == ["odd\\udcff.keyxm"]


def test_order_of_rows() -> None:
    rows = [
        CaseSummary("none", "evaluated", units="metric"),
        CaseSummary("small", "evaluated", units="metric", largest_force=100.0),
        CaseSummary("imperial", "evaluated", units="imperial", largest_force=10.0),
        CaseSummary("second", "failed", "why"),
        CaseSummary("own", "evaluated", units="user", largest_force=120.0),
        CaseSummary("first", "failed", "why"),
    ]
    assert [row.deck for row in worst_first(rows)] == ["second", "first", "imperial", "own", "small", "none"]
