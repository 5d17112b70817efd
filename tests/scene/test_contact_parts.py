"""What each part of a deck becomes for the evaluator, and what cannot be evaluated and why."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mudline.contact import ContactInput, ContactModel, LawKind
from mudline.deck.loading import load_bytes, load_path
from mudline.diagnostics import DeckError
from mudline.scene.build import resolve
from mudline.scene.section_weight import submerged_weight
from tests.scene.contact_decks import METRIC, deck
from tests.scene.decks import scene_of

LINEAR = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000\n"
CURVE = (
    "*SEABED STIFFNESS\n CURVE=Clay\n 0, 0\n 0.5, 4000\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
)
NODAL = "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=90000\n"
WEIGHT = (7850.0 * math.pi / 4 * (0.25**2 - 0.22**2) - 1025.0 * math.pi / 4 * 0.25**2) * 9.81


def made(seabed: str) -> ContactInput:
    return scene_of(deck(METRIC, seabed)).contact_input()


def refusal(seabed: str) -> str:
    with pytest.raises(DeckError) as caught:
        scene_of(deck(METRIC, seabed)).contact()
    (told,) = caught.value.diagnostics
    assert told.code == "RUN001"
    return f"{told.line - deck(METRIC, '').count(chr(10))}: {told.message}"


# normal laws


def test_a_nodal_law_replaces_the_others() -> None:
    scene = scene_of(deck(METRIC, LINEAR + "*SEABED CONTACT\n SET=Right\n NODAL STIFFNESS=90000\n SMOOTHING=NONE\n"))
    assert scene.law_names == ["linear"] * 5 + ["nodal"] * 5
    assert scene.law_sets == ["ALL"] * 5 + ["Right"] * 5
    given = scene.contact_input()
    assert given.law.tolist() == [LawKind.LINEAR] * 5 + [LawKind.NODAL] * 5
    assert given.extras.nodal is not None
    assert np.isnan(given.extras.nodal.stiffness[:5]).all()
    assert (given.extras.nodal.stiffness[5:] == 90000.0).all()
    assert not given.extras.nodal.half_width.any()
    result = ContactModel(given).evaluate()
    assert result.ratio[9] == pytest.approx(0.2)
    assert not result.force[5:].any()
    assert not result.stiffness[5:].any()
    assert result.normal_force[10] == pytest.approx(4500.0)
    assert result.normal_force[5] == pytest.approx(4500.0 + 50000 * 0.05 * 5)


def test_a_node_between_two_nodal_laws_has_the_later_one_and_a_bare_block_takes_none_away() -> None:
    seabed = LINEAR + "*SEABED CONTACT\n SET=Right\n NODAL STIFFNESS=7\n SET=Left\n NODAL STIFFNESS=5\n"
    nodal = made(seabed).extras.nodal
    assert nodal is not None
    assert nodal.stiffness.tolist() == [5.0] * 6 + [7.0] * 5
    nodal = made(LINEAR + "*SEABED CONTACT\n SET=Right\n NODAL STIFFNESS=7\n SET=Left\n SMOOTHING=0.01\n").extras.nodal
    assert nodal is not None
    assert (nodal.stiffness[5:] == 7.0).all()


def test_a_nodal_law_leaves_rigid_elements_alone() -> None:
    rigid = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
    assert scene_of(deck(METRIC, rigid + NODAL)).law.tolist() == [LawKind.RIGID] * 10


# smoothing


def test_submerged_weight() -> None:
    np.testing.assert_allclose(submerged_weight(scene_of(deck(METRIC, ""))), WEIGHT, rtol=1e-14)
    dry = deck(METRIC, "").replace("*OCEAN", "*TIME").replace(" 500.0, 1025.0, 9.81\n", " 0, 1\n")
    assert np.isnan(submerged_weight(scene_of(dry))).all()
    assumed = deck(METRIC, "").replace("500.0, 1025.0, 9.81", "500.0")
    np.testing.assert_allclose(submerged_weight(scene_of(assumed)), WEIGHT, rtol=1e-14)


def test_widths_of_linear_laws() -> None:
    def width(lines: str) -> list[float]:
        smoothing = made(LINEAR + f"*SEABED CONTACT\n SET=Left\n{lines}").extras.smoothing
        return [] if smoothing is None else [float(smoothing.half_width[0]), float(smoothing.half_width[9])]

    assert width(" SMOOTHING=0.004\n") == [0.004, 0.0]
    assert width(" SMOOTHING=NONE\n") == []
    assert width("") == [pytest.approx(min(0.1 * WEIGHT / 50000.0, 0.0025)), 0.0]
    assert made(LINEAR).extras.smoothing is None
    assert made(CURVE + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.01\n").extras.smoothing is None
    one_sided = made(LINEAR + "*SEABED CONTACT\n SET=Left\n SMOOTHING=0.01\n FORM=ONE-SIDED\n").extras.smoothing
    assert one_sided is not None
    assert one_sided.one_sided.tolist() == [True] * 5 + [False] * 5


def test_widths_of_nodal_laws_count_half_the_elements_of_a_node() -> None:
    nodal = made(LINEAR + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=1000000\n").extras.nodal
    assert nodal is not None
    np.testing.assert_allclose(nodal.half_width[[0, 10]], 0.1 * WEIGHT * 5.0 / 1e6)
    np.testing.assert_allclose(nodal.half_width[1:10], 0.1 * WEIGHT * 10.0 / 1e6)
    soft = made(LINEAR + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=1000\n").extras.nodal
    assert soft is not None
    np.testing.assert_allclose(soft.half_width, 0.0025)


def test_without_a_weight_nothing_is_smoothed_and_the_plan_says_so() -> None:
    text = deck(METRIC, LINEAR + "*SEABED CONTACT\n SET=ALL\n").replace("7850.0", "100.0")
    stage = scene_of(text).contact().plan["smoothing"]
    assert not stage.active
    assert stage.why == "none for 10 elements of SMOOTHING=AUTO: no submerged weight above 0 is known"


# unloading, suction


def test_unloading_is_for_laws_per_length() -> None:
    unloading = made(LINEAR + "*SEABED UNLOADING\n SET=Left\n STIFFNESS=200000\n").extras.unloading
    assert unloading is not None
    assert unloading[:5].tolist() == [200000.0] * 5
    assert np.isnan(unloading[5:]).all()
    assert made(LINEAR + NODAL + "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=200000\n").extras.unloading is None
    assert refusal(LINEAR + "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=0\n").startswith(
        "7: the unloading stiffness is not"
    )
    both = LINEAR + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.01\n*SEABED UNLOADING\n SET=ALL\n STIFFNESS=200000\n"
    assert refusal(both).startswith("9: there is smoothing too where the reaction unloads: 10 elements (first: 1)")


def test_suction_of_cohesion_and_of_explicit_laws() -> None:
    suction = made(
        LINEAR + "*SEABED SUCTION\n SET=Right\n COHESION=5000\n CYCLIC=0.5\n CUTOFF=0.1, 0.7\n"
    ).extras.suction
    assert suction is not None
    assert suction.elements.tolist() == [5, 6, 7, 8, 9]
    law = suction.law
    np.testing.assert_allclose(law.force_factor, 1.12 * 0.25 * 5000.0 / 0.25**0.18)
    np.testing.assert_allclose(law.depth_factor, 0.98 * 0.25)
    assert (law.first_corner[0], law.second_corner[0], law.cyclic[0]) == (0.1, 0.7, 0.5)
    assert law.regularisation[0] == 1e-3
    own = made(
        LINEAR + "*SEABED SUCTION\n SET=ALL\n COHESION=5000\n FORCE=70, 0.2\n REGULARISATION=0.01\n"
    ).extras.suction
    assert own is not None
    assert (own.law.force_factor[0], own.law.force_exponent[0], own.law.depth_exponent[0]) == (70.0, 0.2, 0.26)
    assert (own.law.first_corner[0], own.law.second_corner[0], own.law.regularisation[0]) == (0.2, 0.8, 0.01)
    assert (
        made("*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n*SEABED SUCTION\n SET=ALL\n COHESION=5\n").extras.suction
        is None
    )


@pytest.mark.parametrize(
    ("seabed", "message"),
    [
        (LINEAR + "*SEABED SUCTION\n SET=ALL\n FORCE=70, 0.2\n", "6: the suction law is incomplete"),
        (
            LINEAR + "*SEABED SUCTION\n SET=ALL\n COHESION=5\n CUTOFF=0.8, 0.2\n",
            "6: element 1: the corners of its suction",
        ),
        (LINEAR + " SUCTION=5, 1\n*SEABED SUCTION\n SET=ALL\n COHESION=5\n", "7: SUCTION= of *SEABED PROPERTIES holds"),
        (
            CURVE.replace("0.5, 4000", "0.5, -4000") + "*SEABED SUCTION\n SET=ALL\n COHESION=5\n",
            "10: the curve pulls too",
        ),
    ],
)
def test_suction_that_cannot_be_evaluated(seabed: str, message: str) -> None:
    assert refusal(seabed).startswith(message)


def test_user_units_have_no_defaults_of_suction() -> None:
    def told(lines: str) -> str:
        text = deck(METRIC, LINEAR + "*SEABED SUCTION\n SET=ALL\n" + lines)
        scene = resolve(load_bytes(text.encode(), "deck.keyx", units="user"))
        try:
            scene.contact()
        except DeckError as error:
            return error.diagnostics[0].message
        return ""

    assert told(" COHESION=5\n").startswith("COHESION= needs metric or imperial units")
    assert told(" FORCE=5, 0.2\n DEPTH=1, 0.3\n").startswith("REGULARISATION= has no default with user units")
    assert told(" FORCE=5, 0.2\n DEPTH=1, 0.3\n REGULARISATION=0.001\n") == ""


def test_suction_springs() -> None:
    springs = made(LINEAR + " SUCTION=500, 0.2\n").extras.suction_springs
    assert springs is not None
    assert (springs.stiffness[0], springs.extent[0]) == (500.0, 0.2)
    assert made(LINEAR + " SUCTION=500\n").extras.suction_springs is None


# friction, lateral, trench


def test_friction_of_properties_has_mobilisation_lengths() -> None:
    friction = made(LINEAR + " FRICTION=0.3, 0.5, , 0.02\n").extras.friction
    assert friction is not None
    assert friction.law.mobilisation[4].tolist() == [3.048, 0.02]
    assert friction.law.coefficients[4].tolist() == [0.3, 0.5]
    assert not friction.law.constant.any()
    assert np.isnan(friction.angle).all()
    surface = made("*ELASTIC SURFACE\n 50000, 0.3, 0.5, , , , 1.5, 2.5\n").extras.friction
    assert surface is not None
    assert surface.law.active.all()


def test_friction_of_the_keyword_replaces_that_of_properties_at_its_nodes() -> None:
    seabed = LINEAR + " FRICTION=0.3, 0.5\n*SEABED FRICTION\n SET=Right\n COEFFICIENTS=0.1, 0.2\n STIFFNESS=900\n"
    friction = made(seabed + " DIRECTIONS=30\n CRITERION=ELLIPSE\n").extras.friction
    assert friction is not None
    assert friction.law.constant[:, 0].tolist() == [False] * 5 + [True] * 6
    assert friction.law.stiffness[5].tolist() == [900.0, 900.0]
    assert friction.law.coefficients[5].tolist() == [0.1, 0.2]
    assert friction.law.ellipse.tolist() == [False] * 5 + [True] * 6
    assert friction.angle[5] == 30.0
    assert np.isnan(friction.angle[4])


def test_lateral_springs_take_the_transverse_coefficient_away() -> None:
    seabed = LINEAR + " FRICTION=0.3, 0.5\n SET=Left\n STIFFNESS=1\n FRICTION=0.3, 0.5\n LATERAL=70\n"
    extras = made(seabed).extras
    assert extras.lateral is not None
    assert extras.friction is not None
    assert extras.lateral[:5].tolist() == [70.0] * 5
    assert np.isnan(extras.lateral[5:]).all()
    assert extras.friction.law.coefficients[:, 1].tolist() == [0.0] * 6 + [0.5] * 5


def test_a_trench_counts_its_own_elements() -> None:
    seabed = (
        LINEAR + " FRICTION=0.3, 0.5\n*SEABED TRENCH\n SET=Right\n GEOMETRY=1, 2, 3\n PEAK=100\n CENTRELINE=0,0,9,9\n"
    )
    trench = made(seabed).extras.trench
    assert trench is not None
    assert np.isnan(trench.law.peak[:5]).all()
    assert trench.law.peak[5:].tolist() == [500.0, 1000.0, 1000.0, 1000.0, 1000.0, 500.0]
    assert (trench.law.bottom[5], trench.law.upper[5]) == (2.0, 3.0)
    assert trench.straight[7].tolist() == [0.0, 0.0, 9.0, 9.0]
    laid = made(seabed.replace("0,0,9,9", "LAID")).extras.trench
    assert laid is not None
    assert np.isnan(laid.straight).all()


@pytest.mark.parametrize(
    ("seabed", "message"),
    [
        (
            LINEAR + "*SEABED TRENCH\n SET=ALL\n GEOMETRY=1, 2, 3\n PEAK=1\n",
            "6: a trench needs a lateral friction spring",
        ),
        (LINEAR + "*SEABED TRENCH\n SET=ALL\n GEOMETRY=1, 3, 2\n PEAK=1\n", "7: the widths of the trench"),
        (
            LINEAR + "*SEABED TRENCH\n SET=ALL\n GEOMETRY=1, 2, 3\n PEAK=1\n CENTRELINE=1, 2, 1, 2\n",
            "9: the two points of the centreline are one",
        ),
        (LINEAR + "*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=90\n", "5: slope of plane 1 is 90 degrees"),
        (LINEAR + "*SEABED PROFILE\n TYPE=2D\n FILE=none.txt\n", "5: the bed is not known: 'none.txt' is not there"),
    ],
)
def test_what_cannot_be_evaluated_is_told_at_its_line(seabed: str, message: str) -> None:
    assert refusal(seabed).startswith(message)


# rigid beds, floors


def test_a_rigid_bed_restrains_nodes_along_its_normal() -> None:
    scene = scene_of(deck(METRIC, "*RIGID SURFACE\n 0.3, 0.4\n 1.0\n"))
    contact = scene.contact()
    assert contact.plan["friction"].why == "none on a rigid bed, whose reaction is that of a constraint: 10 elements"
    points = scene.coordinates.copy()
    points[:4, 0] = 5.0
    result = contact.evaluate(np.array([points, points + np.array([9.0, 0.0, 0.0])]))
    assert result.restrained is not None
    assert result.restrained[0].tolist() == [False] * 4 + [True] * 7
    assert not result.restrained[1].any()
    assert result.step(0).restrained is not None
    assert made(LINEAR).law.any()
    assert scene_of(deck(METRIC, LINEAR)).contact().evaluate().restrained is None


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
    path.write_text(deck(METRIC, LINEAR + f"*SEABED PROFILE\n {keyword}\n FILE=bed.txt\n"))
    contact = resolve(load_path(path)).contact()
    assert why in contact.plan["floor"].why
    assert np.isfinite(contact.evaluate().gap).any()


def test_a_surface_without_scipy_names_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.scene.contact_parts.floor.find_spec", lambda _: None)
    (tmp_path / "bed.txt").write_text("-1, -9, -9\n-1, 200, -9\n-1, 0, 99\n")
    path = tmp_path / "deck.keyxm"
    path.write_text(deck(METRIC, LINEAR + "*SEABED PROFILE\n TYPE=3D\n FILE=bed.txt\n"))
    with pytest.raises(DeckError, match=r"mudline\[study\]"):
        resolve(load_path(path)).contact()
