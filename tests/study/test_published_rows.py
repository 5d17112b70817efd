"""Rows of the published tables come out of the code again: who changes a formula of a study makes its page again.

Only what no machine changes, and of what takes long a few rows. `test_published_numbers.py` has the same figures from
their definitions.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable

import numpy as np
import pytest

from mudline.scene.model import Scene
from mudline.study import sample_scene
from mudline.study.precision import contacts, curves, goals, integration, smoothing
from mudline.study.precision.exact_motions import reference_drop
from mudline.study.pruning import growth
from mudline.study.report import StudyOptions, StudyTable
from mudline.study.schemes import SCHEMES
from mudline.study.stability import deck_steps, landings, statics
from mudline.study.stability.contacts import CONTACTS, find_contacts
from tests.study.published import read


@pytest.fixture(scope="module")
def scene() -> Scene:
    return sample_scene()


def assert_published(table: StudyTable, name: str) -> None:
    """Every row of a table is in the file, cell by cell."""
    file = read(name)
    keys = [tuple(_cell(text) for text in row.values()) for row in file]
    rows = list(csv.DictReader("".join(table.csv()).splitlines()))
    assert rows
    for row in rows:
        assert row.keys() == file[0].keys()
        cells = tuple(_cell(text) for text in row.values())
        assert any(_alike(cells, key) for key in keys), (name, row)


def _cell(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _alike(one: Iterable[float | str], other: Iterable[float | str]) -> bool:
    return all(
        math.isclose(mine, yours, rel_tol=1e-6, abs_tol=1e-9)
        if isinstance(mine, float) and isinstance(yours, float)
        else mine == yours
        for mine, yours in zip(one, other, strict=True)
    )


def test_contacts_and_narrow_segments(scene: Scene) -> None:
    found, _ = find_contacts(scene)
    assert_published(CONTACTS.table(found, scene.units), "stability-contacts")
    segments = deck_steps.narrow_segments(scene, found)
    assert_published(deck_steps.SEGMENTS.table(segments, scene.units), "stability-steep-segments")


@pytest.mark.parametrize("scheme", ["velocity-verlet", "newmark"])
def test_landings_on_the_deck(scene: Scene, scheme: str) -> None:
    found, _ = find_contacts(scene)
    seabeds = [one for one in found if one.oscillation.kind == "normal"]
    landed = [deck_steps.deck_landing(one, SCHEMES[scheme], deck_steps.fall_on(scene, one)) for one in seabeds]
    assert_published(deck_steps.DECK_LANDINGS.table(landed, scene.units), "stability-deck-landings")


def test_landing_limits() -> None:
    over = [landings.envelope(SCHEMES[name], landings.LINEAR_FALL) for name in ("velocity-verlet", "rk4")]
    assert_published(landings.LIMITS.table(over), "stability-landing-limits")


def test_release_of_suction(scene: Scene) -> None:
    found = statics.releases(scene, scene.contact_input().assigned["suction"])
    assert_published(statics.RELEASE.table(found, scene.units), "stability-release")


def test_halvings_that_suffice(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(statics, "HALVED_RATIOS", (1e2, 2e3))
    assert_published(statics.HALVINGS.table(statics.halving_counts()), "stability-newton-halvings")


def test_motions(scene: Scene) -> None:
    """The cases, and a few steps on each."""
    cases = contacts.all_cases(contacts.contacts_of(scene), [])
    assert_published(integration.CASES.table(cases), "precision-cases")
    steps = read("precision-steps")
    errors = [name for name in steps[0] if name.startswith("error of")]
    for case in cases:
        for scheme, omega_dt in (("velocity-verlet", 0.1), ("newmark", 0.1), ("newmark", 0.3), ("rk4", 0.3)):
            row = integration.row(case, integration.TRIED[scheme], omega_dt)
            (kept,) = (
                one
                for one in steps
                if (one["case"], one["scheme"]) == (case.name, scheme) and float(one["omega dt"]) == omega_dt
            )
            assert row.errors == pytest.approx([float(kept[name]) for name in errors], rel=1e-6)
            assert row.work == pytest.approx(float(kept["force evaluations per period [-]"]))


def test_orders() -> None:
    steps = read("precision-steps")
    errors = [name for name in steps[0] if name.startswith("error of")]
    for row in read("precision-orders"):
        own = [one for one in steps if (one["case"], SCHEMES[one["scheme"]].title) == (row["case"], row["scheme"])]
        which = [one["error of"] for one in read("precision-orders") if one["case"] == row["case"]].index(
            row["error of"]
        )
        points = [(float(one["omega dt"]), float(one[errors[which]])) for one in own if one[errors[which]]]
        found = goals.order(points)
        assert (found is None) == (row["order"] == "")
        assert found is None or found == pytest.approx(float(row["order"]))


def test_errors_of_curve_methods(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(curves, "_TIMED", 10)
    rows = {(row["curve"], row["method"]): row for row in read("precision-curves")}
    for name, curve in scene.curves.items():
        for found in curves.evaluate_methods(name, curve, StudyOptions(), []):
            kept = rows[name, found.method]
            errors = [float(kept[f"error {which}[of largest force]"]) for which in ("", "beyond the points ")]
            assert [found.error, found.beyond] == pytest.approx(errors, rel=1e-3, abs=1e-15)


def test_growth_is_that_of_the_sizes() -> None:
    sizes = [
        growth.GrowthRow(row["number of"], int(row["size"]), *(float(row[heading]) for heading in list(row)[2:]))
        for row in read("pruning-sizes")
    ]
    assert_published(growth.FITS.table(growth.fits(sizes)), "pruning-growth")


def test_sampled_closed_forms() -> None:
    assert_published(curves.SAMPLES.table(curves.sampled_backbones()), "precision-backbones")


def test_smoothing() -> None:
    widths = np.array([0.0, 1e-6, 1e-4, 1e-3, 1e-2])
    rows = smoothing.at_rest(smoothing.PUBLISHED, widths)
    assert_published(smoothing.SMOOTHING.table(rows, "metric"), "precision-smoothing")
    hits = [row for row in smoothing.impacts(smoothing.weightless(reference_drop())) if row.share in {0.0, 0.1}]
    assert_published(smoothing.IMPACTS.table(hits), "precision-impacts")
