"""docs/scaling.md is made from docs/scaling.json, and the simulated scheduler does what a real one would."""

from __future__ import annotations

import json

import pytest

from tests.benchmarks.schedule import Cluster, simulate

pytest.importorskip("distributed", reason="distributed is not installed")

IDEAL = Cluster(10, overhead=0.0, start=0.0, spread=0.0, slow=0.0, failure_hours=1e12)


def test_the_page_is_made_from_its_figures() -> None:
    from tests.benchmarks.scaling import PAGE, page  # noqa: PLC0415 - imports dask

    figures = json.loads(PAGE.with_suffix(".json").read_text(encoding="utf-8"))
    assert PAGE.read_text(encoding="utf-8") == page(figures), "run python -m tests.benchmarks.scaling"
    assert figures["lint"]["decks"] == 10_000
    assert figures["evaluate"]["cases"] == 1000


def test_what_was_measured_of_archives_is_shown() -> None:
    from tests.benchmarks.scaling import archived  # noqa: PLC0415 - imports dask

    found = archived({"index": {"decks": 500, "alone": 4.0, "cluster": 3.25, "again": 0.5}})
    assert "| index, 500 decks | 4 | 3.25 | 0.5 |\n\nAll rows of all tables were equal" in found
    assert archived({}) == ""


def test_ideal_workers_share_all_work() -> None:
    found = simulate(1000.0, 1.0, IDEAL)
    assert found.seconds == pytest.approx(100.0)
    assert found.efficiency == pytest.approx(1.0)
    assert found.repeated == 0


def test_one_sender_bounds_what_many_workers_do() -> None:
    found = simulate(10_000.0, 1.0, Cluster(1000, 0.02, start=0.0, spread=0.0, slow=0.0, failure_hours=1e12))
    assert found.seconds == pytest.approx(10_000 * 0.02 + 1.0)


def test_chunks_of_workers_that_die_are_done_again() -> None:
    found = simulate(10_000.0, 10.0, Cluster(10, 0.0, failure_hours=1.0))
    calm = simulate(10_000.0, 10.0, Cluster(10, 0.0, failure_hours=1e12))
    assert found.repeated > 0
    assert calm.repeated == 0
    assert found.seconds > calm.seconds
