"""The text data file of OrcaFlex: its items, their values and their names."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml

from mudline.basics.quantities import shown
from mudline.language.diagnostics import DeckError
from mudline.tools.exporting import orcaflex
from mudline.tools.exporting.line_model import LineModel
from mudline.tools.exporting.report import Outcome
from tests.tools.exporting.decks import BOTH, ELASTIC, EXPORTABLE, WEIGHT, model_of, sample, text

SOIL = ELASTIC + "*SEABED SOIL\n SET=ALL\n STRENGTH=2000.0, 1000.0\n BUOYANCY=1.5, 6000.0\n"


def written(model: LineModel) -> dict[str, Any]:
    return checked(orcaflex.write(model, "deck.yml")["deck.yml"])


def checked(content: str) -> dict[str, Any]:
    """A file that keeps to the schema of what is written."""
    found: dict[str, Any] = yaml.safe_load(content)
    schema = json.loads(Path(__file__).with_name("orcaflex-schema.json").read_text(encoding="utf-8"))
    pytest.importorskip("jsonschema").Draft202012Validator(schema).validate(found)
    return found


@pytest.mark.parametrize("name", EXPORTABLE)
def test_samples_keep_to_the_schema_of_what_is_written(name: str) -> None:
    found = written(sample(name))
    types = {each["Name"] for each in found["LineTypes"]}
    assert {row[0] for line in found["Lines"] for row in line["LineType, Length, TargetSegmentLength"]} == types


@pytest.mark.parametrize(("place", "lost"), [("25.0", False), ("24.9993", False), ("24.9", True)])
def test_segments_are_the_elements_where_these_are_of_one_length(place: str, lost: bool) -> None:
    model = model_of(text().replace("*ELEMENT\n", f" 6, 0.0, {place}\n*ELEMENT\n", 1))
    written(model)
    assert ("*ELEMENT lengths" in [entry.keyword for entry in model.report.lost]) == lost


def test_a_line_on_a_linear_seabed() -> None:
    model = model_of(text())
    found = written(model)
    sea = found["Environment"]
    assert sea["WaterDepth"] == pytest.approx(100.05)  # the underside touches where the axis does in the deck
    assert sea["SeabedNormalStiffness"] == pytest.approx(200.0)  # kN/m/m2
    assert sea["SeabedShearStiffness"] == pytest.approx(max(0.3 * WEIGHT / 0.01, 0.5 * WEIGHT / 0.02) / 0.1 / 1e3)
    (shear,) = (entry for entry in model.report.lost if entry.target == "one SeabedShearStiffness")
    along, across = (shown(share * WEIGHT / 1e3, 4) for share in (0.3 / 0.01, 0.5 / 0.02))
    assert shear.effect == f"the stiffer of {along} kN/m2 along and {across} kN/m2 across"
    (pipe,), (line,) = found["LineTypes"], found["Lines"]
    assert (pipe["MassPerUnitLength"], pipe["EA"], pipe["OD"]) == (0.05, 1e5, 0.1)
    assert (pipe["SeabedAxialFrictionCoefficient"], pipe["SeabedLateralFrictionCoefficient"]) == (0.3, 0.5)
    assert line["LineType, Length, TargetSegmentLength"] == [["ALL", 50.0, 5.0]]
    key = next(key for key in line if key.startswith("Connection, "))
    assert line[key] == [
        ["Fixed", 0.0, 0.0, -100.0, 0.0, 90.0, 0.0, None],
        ["Fixed", 50.0, 0.0, -100.0, 0.0, 90.0, 0.0, None],
    ]


def test_ends_that_are_held_against_rotation_are_clamped() -> None:
    (line,) = written(model_of(text(held=BOTH + " 1, 5\n 1, 6\n")))["Lines"]
    assert line["ConnectionxBendingStiffness, ConnectionyBendingStiffness"] == [["Infinity", None], [0.0, None]]


def test_the_nonlinear_soil_has_strength_and_density() -> None:
    model = model_of(text(bed=SOIL))
    sea = written(model)["Environment"]
    assert sea["SeabedModel"] == "Nonlinear soil model"
    assert (sea["SoilShearStrengthAtMudline"], sea["SoilShearStrengthGradient"]) == (2.0, 1.0)
    assert sea["SoilDensity"] == pytest.approx(1.0 + 6000.0 / 10.0 / 1e3)
    assert [entry.status for entry in model.report.entries if entry.keyword == "*SEABED SOIL"] == [Outcome.CARRIED]


def test_parameters_of_a_soil_that_are_not_the_defaults_are_listed() -> None:
    model = model_of(text(bed=SOIL + " SUCTION=0.4, 1.0\n REPENETRATION=0.5\n"))
    written(model)
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED SOIL parameters")
    assert entry.effect == "set by hand: suction 0.4, repenetration 0.5"


def test_one_of_two_soils_holds_for_all() -> None:
    sets = "*ELEMENT SETS\n SET=Half\n GEN=1, 4\n"
    model = model_of(text(sets=sets, bed=SOIL + " SET=Half\n STRENGTH=500.0\n"))
    assert written(model)["Environment"]["SoilShearStrengthAtMudline"] == 2.0
    assert [entry.target for entry in model.report.entries if entry.keyword == "*SEABED SOIL"] == [
        "Nonlinear soil model",
        "one soil",
    ]


@pytest.mark.parametrize(("slope", "direction"), [(2.0, 30.0), (-2.0, 210.0)])
def test_a_slope_rises_in_its_direction(slope: float, direction: float) -> None:
    bed = f"{ELASTIC}*SEABED PROFILE\n TYPE=SLOPING\n DIRECTION=30.0\n SLOPE={slope}\n"
    sea = written(model_of(text(bed=bed)))["Environment"]
    assert (sea["SeabedSlope"], sea["SeabedSlopeDirection"]) == (2.0, direction)


def test_a_profile_has_the_points_of_the_deck(tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text("20, -0.5\n0, 0.0\n500, 0.5\n")
    bed = ELASTIC + "*SEABED PROFILE\n TYPE=2D\n DIRECTION=-10.0\n FILE=bed.txt\n"
    sea = written(model_of(text(bed=bed), folder=tmp_path))["Environment"]
    rows = sea["SeabedProfileDistanceFromSeabedOrigin, SeabedProfileDepth"]
    assert rows == [[0.0, pytest.approx(100.05)], [20.0, pytest.approx(100.55)], [500.0, pytest.approx(99.55)]]
    assert (sea["SeabedType"], sea["SeabedSlopeDirection"]) == ("Profile", 350.0)


def test_another_shape_is_the_profile_below_the_line_with_its_error() -> None:
    planes = (
        "*SEABED PLANES\n PLANE=A\n POINT=0.0, 0.0, 0.0\n SLOPE=1.0\n PLANE=B\n POINT=0.0, 31.0, 0.0\n SLOPE=-3.0\n"
    )
    model = model_of(text(bed=ELASTIC + planes))
    sea = written(model)["Environment"]
    rows = sea["SeabedProfileDistanceFromSeabedOrigin, SeabedProfileDepth"]
    assert (len(rows), rows[0][0], rows[-1][0]) == (201, 0.0, 50.0)
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED PLANES")
    assert "below Line1, level across it: up to 0 m off" in entry.effect or "e-" in entry.effect


def test_diameters_that_differ_are_listed() -> None:
    sets = "*ELEMENT SETS\n SET=Thick\n GEN=1, 4\n"
    sections = " OPTION=MOORING\n SET=ALL\n 1.0E8, 50.0, 0.1\n SET=Thick\n 1.0E8, 90.0, 0.14\n"
    model = model_of(text(sets=sets, sections=sections))
    written(model)
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*GEOMETRIC SETS diameter")
    assert entry.effect.startswith("its axis touches 20 mm higher")


def test_a_slope_that_is_too_steep_is_refused() -> None:
    with pytest.raises(DeckError, match="slopes up to 45 degrees"):
        written(model_of(text(bed=ELASTIC + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=50.0\n")))
