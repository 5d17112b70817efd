"""What each part of a deck becomes for the evaluator, and what cannot be evaluated and why."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from mudline.language.deck.loading import load_bytes, load_path
from mudline.language.diagnostics import DeckError
from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.input import AssignedLaw
from mudline.model.contact.tables import LawTables
from mudline.model.results.summary import static_embedment
from mudline.model.results.totals import carried
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import (
    CURVED_BED,
    FOOT,
    IMPERIAL,
    LINEAR_BED,
    METRIC,
    POUND,
    Units,
    full_bed,
    line_deck,
)
from tests.helpers.builders.scenes import scene_of

NODAL = "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=90000\n"
WEIGHT = (7850.0 * math.pi / 4 * (0.25**2 - 0.22**2) - 1025.0 * math.pi / 4 * 0.25**2) * 9.81


def made(seabed: str) -> ContactInput:
    return scene_of(line_deck(METRIC, seabed)).contact_input()


def made_law(seabed: str, name: str) -> AssignedLaw:
    return made(seabed).assigned[name]


def everywhere(given: ContactInput, law: str, parameter: str) -> FloatArray:
    """Return a parameter of a law for all elements or nodes, NaN where they do not have it."""
    assigned = given.assigned[law]
    on_nodes = assigned.law.acts_on == "nodes"
    return assigned.spread(parameter, len(given.node_ids) if on_nodes else len(given.element_ids))


def refusal(seabed: str) -> str:
    with pytest.raises(DeckError) as caught:
        scene_of(line_deck(METRIC, seabed)).contact()
    (reported,) = caught.value.diagnostics
    return f"{reported.line - line_deck(METRIC, '').count(chr(10))}: {reported.code} {reported.message}"


# normal laws


def test_a_nodal_law_replaces_the_others() -> None:
    scene = scene_of(
        line_deck(METRIC, LINEAR_BED + "*SEABED CONTACT\n SET=Right\n NODAL STIFFNESS=90000\n SMOOTHING=NONE\n")
    )
    assert scene.law_names == ["linear"] * 5 + ["nodal"] * 5
    assert scene.law_sets == ["ALL"] * 5 + ["Right"] * 5
    given = scene.contact_input()
    assert given.assigned["linear"].rows.tolist() == [0, 1, 2, 3, 4]
    assert set(given.assigned) == {"linear", "nodal"}
    stiffness = everywhere(given, "nodal", "stiffness")
    assert np.isnan(stiffness[:5]).all()
    assert (stiffness[5:] == 90000.0).all()
    assert not given.assigned["nodal"]["half_width"].any()
    result = ContactModel(given).evaluate()
    assert result.ratio[9] == pytest.approx(0.2)
    assert not result.force[5:].any()
    assert not result.stiffness[5:].any()
    assert result.normal_force[10] == pytest.approx(4500.0)
    assert result.normal_force[5] == pytest.approx(4500.0 + 50000 * 0.05 * 5)


def test_a_node_between_two_nodal_laws_has_the_later_one_and_a_bare_block_takes_none_away() -> None:
    seabed = LINEAR_BED + "*SEABED CONTACT\n SET=Right\n NODAL STIFFNESS=7\n SET=Left\n NODAL STIFFNESS=5\n"
    assert everywhere(made(seabed), "nodal", "stiffness").tolist() == [5.0] * 6 + [7.0] * 5
    given = made(LINEAR_BED + "*SEABED CONTACT\n SET=Right\n NODAL STIFFNESS=7\n SET=Left\n SMOOTHING=0.01\n")
    assert (everywhere(given, "nodal", "stiffness")[5:] == 7.0).all()


# smoothing


def test_a_nodal_law_leaves_rigid_elements_alone() -> None:
    rigid = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
    scene = scene_of(line_deck(METRIC, rigid + NODAL))
    assert scene.law_names == ["rigid"] * 10
    assert refusal(rigid + NODAL).startswith("2: EXT001 *SEABED CONTACT needs an elastic seabed, and the seabed is rig")


def test_submerged_weight() -> None:
    np.testing.assert_allclose(scene_of(line_deck(METRIC, "")).submerged_weight, WEIGHT, rtol=1e-14)
    dry = line_deck(METRIC, "").replace("*OCEAN", "*TIME").replace(" 500.0, 1025.0, 9.81\n", " 0, 1\n")
    assert np.isnan(scene_of(dry).submerged_weight).all()
    assumed = line_deck(METRIC, "").replace("500.0, 1025.0, 9.81", "500.0")
    np.testing.assert_allclose(scene_of(assumed).submerged_weight, WEIGHT, rtol=1e-14)
    later = line_deck(METRIC, "*OCEAN\n 500.0, 1025.0, 3.7\n")
    np.testing.assert_allclose(scene_of(later).submerged_weight, WEIGHT * 3.7 / 9.81, rtol=1e-14)


@pytest.mark.parametrize("units", [METRIC, IMPERIAL], ids=["metric", "imperial"])
def test_a_pipe_on_a_seabed_above_the_water_has_its_weight_in_air(units: Units) -> None:
    """The bed rises from 0 to 20 m over 100 m, through 11 m of water at 55 m: in the middle of element 6."""
    profile = f"*SEABED PROFILE\n TYPE=SLOPING\n SLOPE={math.degrees(math.atan(0.2))!r}\n"
    water = f"*OCEAN\n {units.value(11.0, 1)}, {units.value(1025.0, -4, 1)}, {units.value(9.81, 1)}\n"
    scene = scene_of(line_deck(units, profile + water), f"deck.{units.suffix}")
    in_air = 7850.0 * math.pi / 4 * (0.25**2 - 0.22**2) * 9.81  # 852.8 N/m; in water WEIGHT, 359.2 N/m
    wanted = [WEIGHT] * 5 + [0.5 * (WEIGHT + in_air)] + [in_air] * 4
    np.testing.assert_allclose(scene.submerged_weight * units.force / units.length, wanted, rtol=1e-12)
    deep = scene_of(line_deck(METRIC, profile))
    np.testing.assert_allclose(deep.submerged_weight, WEIGHT, rtol=1e-14)


def test_elements_that_begin_outside_of_the_seabed_are_in_the_water() -> None:
    """The plane begins at 70 m, where element 8 does; the bed of the water, 500 m deep, is not known."""
    planes = "*SEABED PLANES\n PLANE=Land\n POINT=600, 0, 0\n SLOPE=0\n BOUNDS=70, 200, -10, 10\n"
    weight = scene_of(line_deck(METRIC, planes)).submerged_weight
    assert weight[:7] == pytest.approx(WEIGHT)
    assert weight[7:] == pytest.approx(7850.0 * math.pi / 4 * (0.25**2 - 0.22**2) * 9.81)


def test_widths_of_linear_laws() -> None:
    def width(lines: str) -> list[float]:
        given = made(LINEAR_BED + f"*SEABED CONTACT\n SET=Left\n{lines}")
        if "smoothed" not in given.assigned:
            return []
        widths = given.assigned["smoothed"].spread("half_width", 10, 0.0)
        return [float(widths[0]), float(widths[9])]

    assert width(" SMOOTHING=0.004\n") == [0.004, 0.0]
    assert width(" SMOOTHING=NONE\n") == []
    assert width("") == [pytest.approx(min(0.1 * WEIGHT / 50000.0, 0.0025)), 0.0]
    assert set(made(LINEAR_BED).assigned) == {"linear"}
    assert set(made(CURVED_BED + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.01\n").assigned) == {"curve"}
    one_sided = made_law(LINEAR_BED + "*SEABED CONTACT\n SET=Left\n SMOOTHING=0.01\n FORM=ONE-SIDED\n", "smoothed")
    assert one_sided.rows.tolist() == [0, 1, 2, 3, 4]
    assert one_sided["one_sided"].all()


def test_widths_of_nodal_laws_count_half_the_elements_of_a_node() -> None:
    widths = made_law(LINEAR_BED + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=1000000\n", "nodal")["half_width"]
    np.testing.assert_allclose(widths[[0, 10]], 0.1 * WEIGHT * 5.0 / 1e6)
    np.testing.assert_allclose(widths[1:10], 0.1 * WEIGHT * 10.0 / 1e6)
    soft = made_law(LINEAR_BED + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=1000\n", "nodal")
    np.testing.assert_allclose(soft["half_width"], np.full(11, 0.0025))


def test_without_a_weight_nothing_is_smoothed_and_the_plan_says_so() -> None:
    text = line_deck(METRIC, LINEAR_BED + "*SEABED CONTACT\n SET=ALL\n").replace("7850.0", "100.0")
    stage = scene_of(text).contact().plan["smoothing"]
    assert not stage.active
    assert stage.why == "none for 10 elements of SMOOTHING=AUTO: no submerged weight above 0 is known"


# unloading, suction


def test_unloading_is_for_laws_per_length() -> None:
    unloading = made_law(LINEAR_BED + "*SEABED UNLOADING\n SET=Left\n STIFFNESS=200000\n", "unloading")
    assert unloading.rows.tolist() == [0, 1, 2, 3, 4]
    assert unloading["stiffness"].tolist() == [200000.0] * 5
    per_node = refusal(LINEAR_BED + NODAL + "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=200000\n")
    assert per_node.startswith("9: EXT009 10 elements (first: 1) have NODAL STIFFNESS=")
    assert refusal(LINEAR_BED + "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=0\n").startswith(
        "7: EXT009 unloading stiffness 0.0: it must be above 0"
    )
    both = LINEAR_BED + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.01\n*SEABED UNLOADING\n SET=ALL\n STIFFNESS=200000\n"
    assert refusal(both).startswith("9: EXT009 10 elements (first: 1) have smoothing too")


def test_suction_of_cohesion_and_of_explicit_laws() -> None:
    law = made_law(
        LINEAR_BED + "*SEABED SUCTION\n SET=Right\n COHESION=5000\n CYCLIC=0.5\n CUTOFF=0.1, 0.7\n", "suction"
    )
    assert law.rows.tolist() == [5, 6, 7, 8, 9]
    np.testing.assert_allclose(law["force_factor"], np.full(5, 1.12 * 0.25 * 5000.0 / 0.25**0.18))
    np.testing.assert_allclose(law["depth_factor"], np.full(5, 0.98 * 0.25))
    assert (law["first_corner"][0], law["second_corner"][0], law["cyclic"][0]) == (0.1, 0.7, 0.5)
    assert law["regularisation"][0] == 1e-3
    own = made_law(
        LINEAR_BED + "*SEABED SUCTION\n SET=ALL\n COHESION=5000\n FORCE=70, 0.2\n REGULARISATION=0.01\n", "suction"
    )
    assert (own["force_factor"][0], own["force_exponent"][0], own["depth_exponent"][0]) == (70.0, 0.2, 0.26)
    assert (own["first_corner"][0], own["second_corner"][0], own["regularisation"][0]) == (0.2, 0.8, 0.01)
    rigid = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n*SEABED SUCTION\n SET=ALL\n COHESION=5\n"
    assert refusal(rigid).startswith("2: EXT001 *SEABED SUCTION needs an elastic seabed")


def test_user_units_have_no_defaults_of_suction() -> None:
    def reported(lines: str) -> str:
        text = line_deck(METRIC, LINEAR_BED + "*SEABED SUCTION\n SET=ALL\n" + lines)
        scene = resolve(load_bytes(text.encode(), "deck.keyx", units="user"))
        try:
            scene.contact()
        except DeckError as error:
            return error.diagnostics[0].message
        return ""

    assert reported(" COHESION=5\n REGULARISATION=0.001\n").startswith("COHESION= needs metric or imperial units")
    assert reported(" FORCE=5, 0.2\n DEPTH=1, 0.3\n").startswith(
        "REGULARISATION= is missing: with user units it has no def"
    )
    assert reported(" COHESION=5\n FORCE=5, 0.2\n DEPTH=1, 0.3\n REGULARISATION=0.001\n") == ""
    assert reported(" FORCE=5, 0.2\n DEPTH=1, 0.3\n REGULARISATION=0.001\n") == ""


# friction, lateral, trench


def test_friction_of_properties_has_mobilisation_lengths() -> None:
    friction = made_law(LINEAR_BED + " FRICTION=0.3, 0.5, , 0.02\n", "friction")
    assert friction.rows.tolist() == list(range(11))
    assert (friction["axial_mobilisation"][4], friction["lateral_mobilisation"][4]) == (3.048, 0.02)
    assert (friction["axial_coefficient"][4], friction["lateral_coefficient"][4]) == (0.3, 0.5)
    assert np.isnan(friction["axial_stiffness"]).all()
    assert np.isnan(friction["lateral_stiffness"]).all()
    assert np.isnan(friction["angle"]).all()
    uneven = line_deck(METRIC, LINEAR_BED + " FRICTION=0.3, 0.5\n")
    for number, place in ((2, 1.0), (3, 3.0), (4, 4.0)):
        uneven = uneven.replace(f" {number}, -0.05, {10.0 * (number - 1)}\n", f" {number}, -0.05, {place}\n")
    lengths = scene_of(uneven).contact_input().assigned["friction"]["axial_mobilisation"]
    assert lengths[:5].tolist() == [1.0, 1.0, 1.0, 1.0, 3.048]
    surface = made_law("*ELASTIC SURFACE\n 50000, 0.3, 0.5, , , , 1.5, 2.5\n", "friction")
    assert surface.rows.tolist() == list(range(11))


def test_friction_of_the_keyword_replaces_that_of_properties_at_its_nodes() -> None:
    seabed = LINEAR_BED + " FRICTION=0.3, 0.5\n*SEABED FRICTION\n SET=Right\n COEFFICIENTS=0.1, 0.2\n STIFFNESS=900\n"
    friction = made_law(seabed + " DIRECTIONS=30\n CRITERION=ELLIPSE\n", "friction")
    assert np.isfinite(friction["axial_stiffness"]).tolist() == [False] * 5 + [True] * 6
    assert (friction["axial_stiffness"][5], friction["lateral_stiffness"][5]) == (900.0, 900.0)
    assert (friction["axial_coefficient"][5], friction["lateral_coefficient"][5]) == (0.1, 0.2)
    assert friction["elliptic"].tolist() == [False] * 5 + [True] * 6
    assert friction["angle"][5] == 30.0
    assert np.isnan(friction["angle"][4])


def test_lateral_springs_take_the_transverse_coefficient_away() -> None:
    seabed = LINEAR_BED + " FRICTION=0.3, 0.5\n SET=Left\n STIFFNESS=1\n FRICTION=0.3, 0.5\n LATERAL=70\n"
    laws = made(seabed).assigned
    assert laws["lateral"].rows.tolist() == [0, 1, 2, 3, 4]
    assert laws["lateral"]["stiffness"].tolist() == [70.0] * 5
    assert laws["friction"]["lateral_coefficient"].tolist() == [0.0] * 6 + [0.5] * 5


def test_a_trench_counts_its_own_elements() -> None:
    seabed = (
        LINEAR_BED
        + " FRICTION=0.3, 0.5\n*SEABED TRENCH\n SET=Right\n GEOMETRY=1, 2, 3\n PEAK=100\n CENTRELINE=0,0,9,9\n"
    )
    given = made(seabed)
    law = given.assigned["trench peak"]
    assert law.rows.tolist() == [5, 6, 7, 8, 9]
    assert law["peak"].tolist() == [100.0] * 5
    assert (law["bottom"][0], law["upper"][0]) == (2.0, 3.0)
    assert [law[name][2] for name in ("start_y", "start_z", "end_y", "end_z")] == [0.0, 0.0, 9.0, 9.0]
    rows = LawTables(given).trench
    assert rows is not None
    assert rows.nodes.tolist() == [5, 6, 7, 8, 9, 10]
    assert rows.amount.tolist() == [500.0, 1000.0, 1000.0, 1000.0, 1000.0, 500.0]
    laid = made_law(seabed.replace("0,0,9,9", "LAID"), "trench peak")
    assert np.isnan([laid[name] for name in ("start_y", "start_z", "end_y", "end_z")]).all()


# rigid and shaped seabeds


def test_a_rigid_bed_restrains_nodes_along_its_normal() -> None:
    scene = scene_of(line_deck(METRIC, "*RIGID SURFACE\n 0.3, 0.4\n 1.0\n"))
    contact = scene.contact()
    assert contact.plan["friction"].why == "none on a rigid seabed, whose reaction is that of a constraint: 10 elements"
    points = scene.coordinates.copy()
    points[:4, 0] = 5.0
    result = contact.evaluate(np.array([points, points + np.array([9.0, 0.0, 0.0])]))
    assert result.restrained is not None
    assert result.restrained[0].tolist() == [False] * 4 + [True] * 7
    assert np.flatnonzero(carried(result.step(0))).tolist() == [4, 5, 6, 7, 8, 9]  # with both ends
    assert not result.restrained[1].any()
    assert result.step(0).restrained is not None
    assert "linear" in made(LINEAR_BED).assigned
    assert scene_of(line_deck(METRIC, LINEAR_BED)).contact().evaluate().restrained is None


@pytest.mark.parametrize(
    ("keyword", "content", "why"),
    [
        ("TYPE=2D", "0, -1\n50, 0\n100, -1\n", "straight lines through 3 points"),
        ("TYPE=2D\n INTERPOLATION=CUBIC BESSEL", "0, -1\n50, 0\n100, -1\n", "Bessel's cubics through 3 points"),
        ("TYPE=2D\n INTERPOLATION=CUBIC SPLINE", "0, -1\n50, 0\n100, -1\n", "a cubic spline through 3 points"),
        ("TYPE=3D", "-1, -9, -9\n-1, 200, -9\n-1, 0, 99\n", ""),
        ("TYPE=3D\n INTERPOLATION=CUBIC", "-1, -9, -9\n-1, 200, -9\n-1, 0, 99\n", ""),
    ],
)
def test_beds_of_points(tmp_path: Path, keyword: str, content: str, why: str) -> None:
    (tmp_path / "bed.txt").write_text(content)
    path = tmp_path / "deck.keyxm"
    path.write_text(line_deck(METRIC, LINEAR_BED + f"*SEABED PROFILE\n {keyword}\n FILE=bed.txt\n"))
    contact = resolve(load_path(path)).contact()
    assert why in contact.plan["seabed surface"].why
    assert np.isfinite(contact.evaluate().gap).any()


def model(units: Units) -> ContactModel:
    return scene_of(line_deck(units, full_bed(units), span=5.0), f"deck.{units.suffix}").contact()


METRES, FEET = model(METRIC), model(IMPERIAL)


@given(st.lists(st.tuples(*(st.floats(-0.3, 0.3),) * 3), min_size=2, max_size=5))
def test_every_feature_is_the_same_in_feet_and_pounds(moves: list[tuple[float, float, float]]) -> None:
    start = METRES.input.coordinates
    series = np.array([start + np.array([0.2 * up, along, across]) for up, along, across in moves])
    times = np.arange(len(moves), dtype=np.float64)
    metric = METRES.evaluate(series, times=times)
    imperial = FEET.evaluate(series / FOOT, times=times)

    def same(ours: NDArray[np.float64], theirs: NDArray[np.float64], factor: float, least: float = 1.0) -> None:
        # relative to the largest value; forces at least to the weight of the line:
        # round-off of positions times a stiffness is a force
        scale = max(float(np.nanmax(np.abs(ours))), least)
        assert np.allclose(theirs * factor / scale, ours / scale, rtol=0.0, atol=1e-12, equal_nan=True)

    same(metric.depth, imperial.depth, FOOT)
    same(metric.ratio, imperial.ratio, 1.0)
    same(metric.force, imperial.force, POUND / FOOT, 1000.0)
    same(metric.normal_force, imperial.normal_force, POUND, 1000.0)
    assert metric.friction is not None
    assert imperial.friction is not None
    same(metric.friction, imperial.friction, POUND, 1000.0)


def rows(seabed: str) -> list[dict[str, Any]]:
    return static_embedment(scene_of(line_deck(METRIC, seabed)))


def test_linear_laws_and_curves() -> None:
    (row,) = rows(LINEAR_BED)
    assert row == {
        "set": "ALL",
        "element": 1,
        "filled": False,
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
