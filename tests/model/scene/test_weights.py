"""What weighs beside the sections: contents by load case, masses at nodes, and what no weight has."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mudline.language.deck.loading import load_path
from mudline.model.scene.model import resolve
from mudline.model.scene.weights import attached, contents, contents_case, left_out, operating_weight
from tests.helpers.builders.decks import CLEAN
from tests.helpers.builders.scenes import scene_of

BORE = math.pi / 4 * 0.46**2
EMPTY = 9.81 * math.pi / 4 * (7850.0 * (0.5**2 - 0.46**2) - 1025.0 * 0.5**2)
OIL = "$LOAD CASE\n*INTERNAL FLUID\n SET=ALL\n 50.0, 800.0\n"


def test_what_a_load_case_fills_stays_full_until_it_is_filled_anew() -> None:
    still, half = (
        "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n",
        "$LOAD CASE\n*INTERNAL FLUID\n SET=Half\n 50.0, 100.0\n",
    )
    scene = scene_of(CLEAN.replace(" 1, 2\n*GEO", " 1, 2\n SET=Half\n 2\n*GEO") + still + OIL + still + half)
    found = contents(scene)
    assert [one.number for one in found] == [1, 2, 3, 4]
    assert contents_case(scene) == 4
    assert contents_case(scene_of(CLEAN + OIL + OIL)) is None
    assert [one.density.tolist() for one in found] == [[0.0, 0.0], [800.0, 800.0], [800.0, 800.0], [800.0, 100.0]]
    np.testing.assert_allclose(found[3].mass, [800.0 * BORE, 100.0 * BORE])
    np.testing.assert_allclose(operating_weight(scene), EMPTY + 9.81 * BORE * np.array([800.0, 100.0]))
    np.testing.assert_allclose(scene.submerged_weight, EMPTY)


def test_an_element_is_full_whose_middle_is_at_the_level() -> None:
    level = float(scene_of(CLEAN).coordinates[:2, 0].mean())
    (found,) = contents(scene_of(CLEAN + OIL.replace("50.0", repr(level))))
    assert found.density.tolist() == [800.0, 0.0]


def test_without_contents_there_is_no_case() -> None:
    assert contents(scene_of(CLEAN + "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n")) == []
    assert operating_weight(scene_of(CLEAN)) is not None
    np.testing.assert_array_equal(operating_weight(scene_of(CLEAN)), scene_of(CLEAN).submerged_weight)


def test_masses_weigh_by_the_lengths_of_the_elements_at_their_nodes() -> None:
    """100 kg at the joint of 10 m and 10.008 m, 40 kg without weight at the end, a rotary inertia."""
    masses = "*MASS\n 2, 100.0\n 3, 40.0, TYPE=NO WEIGHT MASS\n 1, 900.0, TYPE=ROTARY INERTIA\n"
    scene = scene_of(CLEAN.replace("*SEABED PROPERTIES", masses + "*SEABED PROPERTIES"))
    found = attached(scene)
    np.testing.assert_allclose(found.weighing, [5.0, 50.0 / math.hypot(10.0, 0.4)])
    np.testing.assert_allclose(found.mass * scene.length, [50.0, 90.0])
    np.testing.assert_allclose(operating_weight(scene) - scene.submerged_weight, found.weighing * 9.81)
    emptied = operating_weight(scene, filled=False)
    np.testing.assert_array_equal(emptied, operating_weight(scene))  # nothing fills it, the masses stay


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("", []),
        (OIL, []),
        ("*COATINGS\n 1\n*DRAG CHAIN\n 1, 5.0, 40.0\n", ["*COATINGS", "*DRAG CHAIN"]),
        ("*PIP SECTION\n OUTER=Pipe, INNER=ALL\n", ["*PIP SECTION"]),
        ("*MASS\n 77, 100.0\n", ["*MASS (in part)"]),
        ("$LOAD CASE\n*DRILLING MUD\n 1200.0\n", ["*DRILLING MUD"]),
    ],
)
def test_what_no_weight_has(body: str, names: list[str]) -> None:
    assert left_out(scene_of(CLEAN + body)) == names


def test_contents_of_a_deck_that_is_continued_are_not_known(tmp_path: Path) -> None:
    (tmp_path / "base.keyxm").write_text(CLEAN + OIL, encoding="utf-8")
    (tmp_path / "next.keyxm").write_text("$LOAD CASE\n*RESTART\n LAST=base\n TYPE=STATIC\n", encoding="utf-8")
    scene = resolve(load_path(tmp_path / "next.keyxm"))
    assert (contents(scene), left_out(scene)) == ([], ["*INTERNAL FLUID of the deck that it continues"])
