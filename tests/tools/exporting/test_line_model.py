"""The one description of the lines, and what every target says of a deck."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest

from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Where
from mudline.model.contact.input import LawKind
from mudline.model.scene.model import resolve
from mudline.tools.exporting import moordyn, orcaflex
from mudline.tools.exporting.line_model import build
from mudline.tools.exporting.report import Outcome
from mudline.tools.exporting.soil import report_stiffness
from tests.tools.exporting.decks import BOTH, ELASTIC, EXPORTABLE, PIPE, WEIGHT, model_of, sample, text

TARGETS = (moordyn, orcaflex)
CURVE = (
    "*SEABED STIFFNESS\n CURVE=Soft\n 0.0, 0.0\n 0.1, 200.0\n 0.3, 600.0\n 0.5, 700.0\n"
    "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Soft\n"
)


def test_a_line_has_the_lengths_places_and_ends_of_the_deck() -> None:
    model = model_of(text())
    (line,) = model.lines
    (stretch,) = line.stretches(line.kinds)
    assert stretch.lengths.tolist() == [5.0] * 10
    assert model.places[0].tolist() == [0.0, 0.0, -100.0]
    assert model.places[1].tolist() == [50.0, 0.0, -100.0]
    assert [(end.node, sorted(end.held), end.vessel) for end in model.ends] == [
        (0, [1, 2, 3], False),
        (1, [1, 2, 3], False),
    ]
    (section,) = model.sections
    assert (section.mass, section.axial, section.bending, section.diameter) == (50.0, 1e8, 0.0, 0.1)


def test_a_deck_in_feet_and_pounds_is_written_in_metres_and_newtons() -> None:
    model = model_of(text(), "deck.keyxi")
    assert model.depth == pytest.approx(30.48)
    assert model.sections[0].mass == pytest.approx(50.0 * 14.593903 / 0.3048, rel=1e-6)
    assert model.sections[0].axial == pytest.approx(4.4482216e8)
    (soil,) = model.soils
    assert soil.stiffness == pytest.approx(20000.0 * 47.880259, rel=1e-6)


def test_drag_and_added_mass_are_those_of_the_deck() -> None:
    sets = "*HYDRODYNAMIC SETS\n SET=ALL\n 1.5, 0.1, 2.0, 0.8, 0.05\n"
    model = model_of(text(bed=ELASTIC + sets))
    (section,) = model.sections
    assert (section.drag, section.axial_drag, section.added, section.axial_added) == (1.5, 0.1, 0.8, 0.05)
    row = next(line for line in moordyn.write(model, "a.txt")["a.txt"].splitlines() if line.startswith("ALL "))
    assert row.split()[6:] == ["1.5", "0.8", "0.1", "0.05"]
    content = orcaflex.write(model_of(text(bed=ELASTIC + sets)), "a.yml")["a.yml"]
    assert "Ca: [0.8, ~, 0.05]" in content
    assert "Cd: [1.5, ~, 0.1]" in content
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*HYDRODYNAMIC SETS")
    assert (entry.status, entry.effect) == (
        Outcome.APPROXIMATED,
        "drag along as it is written, on an area that the manual does not show",
    )


def test_coefficients_that_the_deck_does_not_give_are_listed_with_their_section() -> None:
    half = "*ELEMENT SETS\n SET=Left\n GEN=1, 5\n"
    for water in ("", "*HYDRODYNAMIC SETS\n SET=Left\n 1.5, , 2.0\n"):
        for target in TARGETS:
            model = model_of(text(sets=half, bed=ELASTIC + water))
            target.write(model, "a.txt")
            (entry,) = (entry for entry in model.report.lost if "drag 1.2 and added mass 1" in entry.effect)
            assert (entry.keyword, entry.target) == ("*GEOMETRIC SETS", "Cd, Ca of the line type")


def test_the_load_case_of_the_contents_is_named_where_others_have_others() -> None:
    wall = " OPTION=RIGID\n SET=ALL\n 2.0E11, 8.0E10, 0.2, 0.16, 7850.0\n"
    fluid = "*INTERNAL FLUID\n SET=ALL\n 300.0, {}\n"
    held = BOTH + fluid.format(900.0) + "$LOAD CASE\n" + fluid.format(700.0)
    model = model_of(text(sections=wall, held=held))
    moordyn.write(model, "a.txt")
    effects = {entry.effect for entry in model.report.entries if entry.keyword == "*INTERNAL FLUID"}
    assert effects == {"its mass at rest in load case 2; pressure and flow are not written"}


def test_the_mass_and_the_weight_on_the_seabed_have_the_contents() -> None:
    wall = " OPTION=RIGID\n SET=ALL\n 2.0E11, 8.0E10, 0.2, 0.16, 7850.0\n"
    empty, full = (
        model_of(text(sections=wall, bed=CURVE, held=BOTH + fluid))
        for fluid in ("", "*INTERNAL FLUID\n SET=ALL\n 300.0, 850.0\n")
    )
    fluid = 850.0 * np.pi / 4 * 0.16**2
    assert full.sections[0].mass - empty.sections[0].mass == pytest.approx(fluid)
    assert full.soils[0].weight - empty.soils[0].weight == pytest.approx(10.0 * fluid)
    moordyn.write(full, "a.txt")
    (entry,) = (entry for entry in full.report.entries if entry.keyword == "*INTERNAL FLUID")
    assert entry.target == "mass of each line type"


def test_the_one_stiffness_is_that_around_touchdown_with_the_range_over_the_line() -> None:
    """20 m of soft seabed carry the pipe and 15 m of stiff, on which it touches down."""
    sets = "*ELEMENT SETS\n SET=Soft\n GEN=1, 4\n SET=Stiff\n GEN=5, 10\n"
    bed = ELASTIC.replace("ALL", "Soft").replace("20000.0", "5000.0") + " SET=Stiff\n STIFFNESS=40000.0\n"
    scene = resolve(load_bytes(text(sets=sets, bed=bed).encode(), "deck.keyxm")).require_evaluable()
    lying = np.array(scene.coordinates)
    order = np.argsort(lying[:, 1])
    lying[order, 0] = [-0.01] * 8 + [0.2, 0.5, 1.0]
    model = build(scene, lying)
    assert model.soil.stiffness == 40000.0
    moordyn.write(model, "a.txt")
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED PROPERTIES range")
    assert entry.target == "one stiffness, 40 kN/m2"
    assert entry.effect == "that of the elements around touchdown; over the line 5 to 40 kN/m2"
    lying[order, 0] = -0.01  # no touchdown: that of most of the pipe
    assert (flat := build(scene, lying)).soil.stiffness == 40000.0
    assert not flat.at_touchdown


def test_a_rigid_section_has_the_stiffness_of_its_wall() -> None:
    model = model_of(text(sections=" OPTION=RIGID\n SET=ALL\n 2.0E11, 8.0E10, 0.2, 0.16, 7850.0\n"))
    area, second = np.pi / 4 * (0.04 - 0.0256), np.pi / 64 * (0.2**4 - 0.16**4)
    (pipe,) = model.sections
    assert (pipe.axial, pipe.bending, pipe.torsion) == pytest.approx((2e11 * area, 2e11 * second, 1.6e11 * second))


def test_curves_of_stiffness_have_their_slope_at_0() -> None:
    flowline, straked, touchdown = sorted(sample("scr-vessel.keyxm").sections, key=lambda each: each.name)
    assert touchdown.name == "Touchdown"
    assert touchdown.bending == pytest.approx(4.0e5 / 0.0126)
    assert touchdown.axial == pytest.approx(8.2e6 / 0.002)
    assert touchdown.torsion == pytest.approx(4.9e5 / 0.0201)
    assert {flowline.buoyancy, straked.buoyancy, touchdown.diameter} == {0.27305}


def test_a_law_without_a_known_stiffness_is_left_out() -> None:
    """No deck gives one: it is as of a kind that is new."""
    model = model_of(text())
    report_stiffness(model.report, [model.soil._replace(law="new", kind=LawKind.OTHER)], "kBot", [0.0])
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED PROPERTIES")
    assert (entry.status, entry.target) == (Outcome.LEFT_OUT, "none")
    assert entry.effect == "no stiffness is known of the law new"


def test_a_curve_is_its_secant_where_it_carries_the_weight() -> None:
    (soil,) = model_of(text(bed=CURVE)).soils
    ratio = 0.1 + (WEIGHT - 200.0) / 2000.0
    assert soil.kind is LawKind.CURVE
    assert soil.penetration == pytest.approx(ratio * 0.1)
    assert soil.stiffness == pytest.approx(WEIGHT / (ratio * 0.1))
    assert soil.tangent == pytest.approx(2000.0 / 0.1)
    assert soil.says().startswith("curve 'Soft': secant 20 kN/m2 at W (21.1 mm), tangent there 20 kN/m2")


def test_a_buoyant_pipe_has_the_secant_of_the_first_loaded_point() -> None:
    light = PIPE.replace("50.0", "5.0")
    (soil,) = model_of(text(bed=CURVE, sections=light)).soils
    assert soil.stiffness == pytest.approx(200.0 / 0.01)
    assert "W is not above 0" in soil.says()


def test_a_hysteretic_soil_is_its_secant_on_first_penetration() -> None:
    bed = ELASTIC + "*SEABED SOIL\n SET=ALL\n STRENGTH=2000.0, 1000.0\n BUOYANCY=1.5, 6000.0\n"
    model = model_of(text(bed=bed))
    (soil,) = model.soils
    places = model.scene.coordinates.copy()
    places[:, 0] = -soil.penetration
    result = model.scene.contact().evaluate(places)
    assert result.force == pytest.approx(np.full(10, WEIGHT))
    assert result.stiffness == pytest.approx(np.full(10, soil.tangent))


def test_rigid_and_nodal_seabeds_have_a_stiffness_per_length() -> None:
    rigid = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
    (soil,) = model_of(text(bed=rigid)).soils
    assert soil.penetration == pytest.approx(1e-4)
    nodal = ELASTIC + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=60000.0\n SMOOTHING=NONE\n"
    (soil,) = model_of(text(bed=nodal)).soils
    assert soil.stiffness == pytest.approx(12000.0)


def test_springs_below_friction_are_those_of_the_mobilisation_lengths_or_of_the_nodes() -> None:
    (soil,) = model_of(text()).soils
    assert (soil.axial, soil.lateral) == (0.3, 0.5)
    assert (soil.axial_spring, soil.lateral_spring) == pytest.approx((0.3 * WEIGHT / 0.01, 0.5 * WEIGHT / 0.02))
    own = ELASTIC + "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.2, 0.4\n STIFFNESS=10000.0\n"
    (soil,) = model_of(text(bed=own)).soils
    assert (soil.axial, soil.lateral, soil.axial_spring, soil.lateral_spring) == (0.2, 0.4, 2000.0, 2000.0)


FLEXIBLE = " OPTION=FLEXIBLE\n SET=ALL\n , , , , 50.0, 0.1, 0.0, 0.1, 0.1\n"
HALF = "*ELEMENT SETS\n SET=Half\n GEN=1, 5\n"
OF_LINES = "$MODEL\n*OCEAN\n 100.0\n*LINES\n LINE=A\n SECTION=B, 5.0\n"
RING = text().replace("*GEOMETRIC", "*NODE\n 12, 0.0, 25.0, 20.0\n*ELEMENT\n 11, 11, 12\n 12, 12, 1\n*GEOMETRIC")


@pytest.mark.parametrize(
    ("deck", "units", "message"),
    [
        (text(held=" 1, 1\n"), "m", "6: node 11 ends a line, and nothing in *BOUNDARY holds it"),
        (text(held=" 1, 4\n 11, 1\n"), "m", "5: node 1 ends a line"),
        (text().partition("$LOAD CASE")[0], "m", "5: node 1 ends a line"),
        (text(sections=FLEXIBLE), "m", "12: the section has no axial"),
        (text().replace("*OCEAN\n 100.0, 1000.0, 10.0\n", ""), "m", "1: a model for another program needs *OCEAN"),
        (text(sets=HALF, sections=PIPE.replace("ALL", "Half")), "m", "10: the element has no section"),
        (OF_LINES, "m", "4: the deck has no elements to export: those of *LINES"),
        (text().replace("10.0\n", "7.0\n"), "", "give --units metric"),
        (RING, "m", "the line of this node is closed"),
        (text(sections=PIPE.replace("1.0E8", "1.0E308")), "i", "not finite in SI units"),
    ],
)
def test_what_no_target_can_hold_is_refused_with_its_line(deck: str, units: str, message: str) -> None:
    with pytest.raises(DeckError) as caught:
        model_of(deck, f"deck.keyx{units}")
    (found,) = caught.value.diagnostics
    assert message in f"{found.line}: {found.message}"


def test_an_inner_node_that_is_held_divides_the_line() -> None:
    held = BOTH + "".join(f" 6, {freedom}\n" for freedom in (1, 2, 3)) + " GEN=3, 4, 3\n"
    model = model_of(text(held=held))
    assert [len(line.lengths) for line in model.lines] == [5, 5]
    assert [model.ends[line.begin].node for line in model.lines] == [0, 6]
    inside = [entry.effect for entry in model.report.entries if "inside" in entry.effect]
    assert inside == ["inside of a line: free here (nodes: 2, the first 3)"]


def test_lines_that_join_share_an_end() -> None:
    deck = text().replace("*GEOMETRIC", "*NODE\n 12, 0.0, 25.0, 20.0\n*ELEMENT\n 11, 6, 12\n*GEOMETRIC")
    deck += " 12, 1\n 12, 2\n 12, 3\n"
    model = model_of(deck)
    joined = next(end for end in model.ends if end.joins)
    assert (len(model.lines), len(model.ends), int(model.scene.node_ids[joined.node])) == (3, 4, 6)
    rows = moordyn.write(model, "a.txt")["a.txt"].splitlines()
    assert sum(" Free 25.0 0.0 -100.0" in row for row in rows) == 1
    with pytest.raises(DeckError, match="lines join at this node"):
        orcaflex.write(model_of(deck), "a.yml")


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.__name__.rpartition(".")[2])
@pytest.mark.parametrize("name", EXPORTABLE)
def test_every_block_of_every_sample_is_in_the_report(name: str, target: ModuleType) -> None:
    model = sample(name)
    files = target.write(model, "out.txt")
    assert all(content.isascii() and content.endswith("\n") for content in files.values())
    said = {(entry.keyword.split()[0], entry.line) for entry in model.report.entries}
    for i, section in enumerate(model.scene.deck.sections):
        for j, block in enumerate(section.blocks):
            line = model.scene.line_of(Where(i, j))
            assert any(at >= line and keyword == f"*{block.keyword}".split()[0] for keyword, at in said), block.keyword
    assert all(entry.effect for entry in model.report.lost)
    assert not model.report.is_exact


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.__name__.rpartition(".")[2])
def test_what_is_carried_whole_is_exact(target: ModuleType) -> None:
    frictionless = ELASTIC.replace(" FRICTION=0.3, 0.5, 0.01, 0.02\n", "")
    water = "*HYDRODYNAMIC SETS\n SET=ALL\n 1.5, 0.0, 2.0, 0.8\n"
    model = model_of(text(bed=frictionless + water))
    target.write(model, "out.txt")
    assert [entry for entry in model.report.lost if entry.keyword != "*ELEMENT lengths"] == []


def test_settings_beside_stiffness_and_friction_are_listed() -> None:
    bed = ELASTIC + " LATERAL=500.0\n SUCTION=100.0, 0.5\n*SEABED UNLOADING\n SET=ALL\n STIFFNESS=50000.0\n"
    for target in TARGETS:
        model = model_of(text(bed=bed, held=BOTH + " 11, 5\n 1, 1, 0.5\n"))
        target.write(model, "out.txt")
        lost = {entry.keyword: entry.status for entry in model.report.lost}
        for keyword in ("*SEABED PROPERTIES LATERAL=", "*SEABED PROPERTIES SUCTION=", "*SEABED UNLOADING"):
            assert lost[keyword] is Outcome.LEFT_OUT
        assert lost["*BOUNDARY displacement 0.5"] is Outcome.LEFT_OUT


def test_a_motion_of_another_type_holds_and_is_listed() -> None:
    model = model_of(text(held=BOTH + " TYPE=SINUSOIDAL\n 11, 1, 0.5, 10.0\n"))
    moordyn.write(model, "a.txt")
    assert any(entry.keyword == "*BOUNDARY TYPE=SINUSOIDAL" for entry in model.report.lost)


def test_laws_and_curves_that_no_element_follows_are_listed() -> None:
    bed = CURVE.replace("*SEABED PROPERTIES", " CURVE=Spare\n 0.0, 0.0\n 0.1, 90.0\n*SEABED PROPERTIES")
    model = model_of(text(bed=bed.replace(" SET=ALL\n", " SET=ALL\n STIFFNESS=9000.0\n SET=ALL\n")))
    orcaflex.write(model, "a.yml")
    unused = [
        (entry.keyword, entry.line) for entry in model.report.lost if entry.effect.startswith("no element follows")
    ]
    assert [keyword for keyword, _ in unused] == ["*SEABED STIFFNESS", "*SEABED PROPERTIES"]
