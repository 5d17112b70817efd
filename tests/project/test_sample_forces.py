"""The samples make physical sense: what the bed carries is the weight of what lies on it."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest

from mudline.language.deck.loading import load_bytes
from mudline.language.deck.parameters import Parameters
from mudline.model.scene.csv_file import read_external
from mudline.model.scene.model import resolve
from mudline.model.scene.positions import read_positions
from tests.helpers.samples import SAMPLES, Evaluated, evaluated, sample, submerged_weight

# ------------------------------------------------------------------------------------------- steel catenary riser


@pytest.fixture(scope="module")
def riser() -> Evaluated:
    return evaluated(sample("scr-touchdown.keyxm"))


def test_riser_hangs_in_equilibrium(riser: Evaluated) -> None:
    """The bed carries what lies on it and the shear of the bend behind the touchdown point."""
    weight, contact = submerged_weight(riser.scene), riser.result.contact
    assert np.flatnonzero(contact).tolist() == list(range(97))
    on_bed = weight * riser.scene.length[contact].sum()
    total = riser.result.normal_force.sum()
    assert total == pytest.approx((riser.result.force * riser.scene.length).sum(), rel=1e-12)
    assert 1.0 < total / on_bed < 1.02
    in_trench = riser.result.force[50:97]
    assert int(in_trench.argmax()) + 51 == 91
    assert 1.1 < in_trench.max() / weight < 1.2


def test_riser_by_hand(riser: Evaluated) -> None:
    """Element 1: depth 0.0088. Element 91: depth (0.0597 + 0.0596)/2, on the segment (0.20, 1058) to (0.30, 1210)."""
    ratio = 0.0088 / 0.27305
    assert riser.result.ratio[0] == pytest.approx(ratio, rel=1e-12)
    assert riser.result.force[0] == pytest.approx(751 + (1195 - 751) / 0.03 * (ratio - 0.02), rel=1e-12)
    ratio = 0.05965 / 0.27305
    assert riser.result.ratio[90] == pytest.approx(ratio, rel=1e-12)
    assert riser.result.force[90] == pytest.approx(1058 + 1520 * (ratio - 0.2), rel=1e-12)
    assert riser.result.slope[90] == pytest.approx(1520, rel=1e-12)
    assert riser.result.stiffness[90] == pytest.approx(1520 / 0.27305, rel=1e-12)
    assert riser.scene.law_names[39:41] == ["curve:Flowline Clay", "curve:Trench Clay"]
    assert riser.scene.law_names[160] == "none"


# ----------------------------------------------------------------------------------------------- the other decks


def test_legacy_line_is_carried_by_each_soil() -> None:
    line = evaluated(sample("legacy-flowline.keyxm"))
    weight = submerged_weight(line.scene)
    zones = {"curve:CLAY WEST": (0, 20), "curve:SAND": (21, 35), "linear": (36, 45), "curve:CLAY EAST": (46, 60)}
    for law, (start, stop) in zones.items():
        assert set(line.scene.law_names[start:stop]) == {law}
        assert line.result.force[start:stop] == pytest.approx(weight, rel=0.011)
    assert line.result.force[40] == pytest.approx(40000.0 * 0.0082, rel=1e-12)
    ratio = 0.0055 / 0.2191
    assert line.result.force[5] == pytest.approx(300 + 6000 * (ratio - 0.02), rel=1e-12)
    assert line.result.normal_force.sum() == pytest.approx(weight * 300.0, rel=0.02)


@pytest.mark.parametrize("soil", [1, 2, 3])
@pytest.mark.parametrize("flooded", [0, 1])
def test_every_case_of_the_parametric_deck_is_in_equilibrium(soil: int, flooded: int) -> None:
    name = "parametric.keyxm"
    text = (SAMPLES / name).read_text(encoding="utf-8")
    text = text.replace(" Soil Case, 2\n", f" Soil Case, {soil}\n").replace(" Flooded, 0\n", f" Flooded, {flooded}\n")
    deck = load_bytes(text.encode(), name)
    line = evaluated(deck)
    weight = cast("float", Parameters(deck).values["weight"])
    assert line.scene.law_names == ["curve:Clay"] * 90 + ["linear"] * 10
    assert line.result.force[0:90] == pytest.approx(weight, rel=1e-9)
    mattress = 220e3 if soil == 3 else 150e3
    assert line.result.stiffness[90:] == pytest.approx(mattress, rel=1e-15)
    assert line.result.gap[line.scene.node_ids == 101] == pytest.approx(-weight / mattress, rel=1e-12)
    on_the_second_segment = [(1, 0), (1, 1), (2, 1)]
    assert (line.result.ratio[0] > 0.02) == ((soil, flooded) in on_the_second_segment)


def test_lines_deck_gets_its_elements_from_a_file() -> None:
    deck = sample("lines-deck.keyxm")
    assert len(resolve(deck).element_ids) == 0
    scene = resolve(deck, read_external(SAMPLES / "elements.csv")).require()
    assert (len(scene.node_ids), len(scene.element_ids)) == (81, 80)
    assert {name: len(ids) for name, ids in scene.sets.items()} == {
        "ALL": 80,
        "Umbilical": 80,
        "Static Section": 40,
        "Dynamic Section": 40,
    }
    positions = read_positions(SAMPLES / "lines-positions.csv", scene.nodes)
    assert positions.present.all()
    result = scene.contact().evaluate(positions.values[0])
    assert np.flatnonzero(result.contact).tolist() == list(range(42))
    weight = submerged_weight(scene)
    assert result.force[:42] == pytest.approx(weight, rel=5e-3)
    on_bed = 200.0 + 2 * 9.14
    assert result.normal_force.sum() == pytest.approx(weight * on_bed, rel=5e-3)
