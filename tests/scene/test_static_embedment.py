"""How deep the weight alone presses elements into their law, by set."""

from __future__ import annotations

from typing import Any

import pytest

from mudline.results.summary import static_embedment
from tests.builders.decks import CURVED_BED, LINEAR_BED, METRIC, line_deck
from tests.builders.scenes import scene_of
from tests.scene.test_contact_input import WEIGHT


def rows(seabed: str) -> list[dict[str, Any]]:
    return static_embedment(scene_of(line_deck(METRIC, seabed)))


def test_linear_laws_and_curves() -> None:
    (row,) = rows(LINEAR_BED)
    assert row == {
        "set": "ALL",
        "element": 1,
        "weight": pytest.approx(WEIGHT),
        "law": "linear",
        "ratio": pytest.approx(WEIGHT / 50000.0 / 0.25),
        "penetration": pytest.approx(WEIGHT / 50000.0),
        "stiffness": 50000.0,
        "extrapolated": None,
    }
    (row,) = rows(CURVED_BED)
    assert row["law"] == "curve:Clay"
    assert row["ratio"] == pytest.approx(WEIGHT / 8000.0)
    assert row["stiffness"] == pytest.approx(8000.0 / 0.25)
    assert rows(CURVED_BED.replace("0.5, 4000", "0.5, 40"))[0]["extrapolated"] == "above"
    lifting = rows(CURVED_BED.replace("0.5, 4000", "0.5, -4000"))
    assert lifting[0]["ratio"] is None
    assert rows(LINEAR_BED.replace("50000", "0"))[0]["penetration"] is None


def test_nodal_laws_have_the_ends_and_the_inside_of_a_line() -> None:
    end, inside = rows(LINEAR_BED + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=90000\n")
    assert end["penetration"] == pytest.approx(WEIGHT * 10.0 / (2 * 90000.0))
    assert inside["penetration"] == pytest.approx(WEIGHT * 10.0 / 90000.0)
    assert (end["law"], end["stiffness"], end["set"]) == ("nodal", 90000.0, "ALL")


def test_without_a_weight_there_are_no_rows() -> None:
    nodal = "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=90000\n"
    assert rows(nodal.replace("ALL", "Left"))
    light = line_deck(METRIC, LINEAR_BED + nodal).replace("7850.0", "10.0")
    assert static_embedment(scene_of(light)) == []
    assert static_embedment(scene_of("$MODEL\n*OCEAN\n 5, 1025\n")) == []
    lost = line_deck(METRIC, nodal).replace(" 11, -0.05, 100.0\n", "")
    assert static_embedment(scene_of(lost)) == []
