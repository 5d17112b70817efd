"""What an evaluation warns of: the figures, the place and the reason of each warning."""

from __future__ import annotations

import numpy as np
import pytest

from mudline import ContactWarning
from mudline.model.contact.arrays import Positions
from mudline.model.contact.result import ResultPart
from mudline.model.results.evaluation import Evaluation, evaluate_scene
from mudline.model.results.warnings import ContactWatch, contact_warnings, seabed_warnings
from mudline.model.scene.numbering import Floats
from tests.helpers.builders.scenes import legal_scene, scene_of

LINE = 21
"""The first line of what `pipe` puts behind the model."""
LAW = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000.0\n"
CLAY = "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.5, 4200.0\n"
ON_CLAY = CLAY + LAW.replace("50000.0", "Clay")
SURFACE = "*ELASTIC SURFACE\n 20000.0\n*EMBEDMENT\n SET=West\n 0.0, 0.0\n 0.5, 4200.0\n"
WEIGHT = np.pi / 4 * 9.81 * (7850.0 * (0.3239**2 - 0.2889**2) - 1025.0 * 0.3239**2) * 100.0
"""Submerged weight of the pipe: 46870 N."""


def pipe(body: str, first: str = "-0.02, 0.0, 0.0", last: str = "-0.02, 0.0, 100.0", di: float = 0.2889) -> str:
    """A deck with 100 m of pipe, in ten elements between two points; West and East are its halves."""
    return f"""\
$MODEL
*OCEAN
 500.0, 1025.0, 9.81
*NODE
 1, {first}
 11, {last}
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
*ELEMENT SETS
 SET=None
 SET=West
 GEN=1, 5
 SET=East
 GEN=6, 10
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3239, {di}, 7850.0
{body}"""


def watched(text: str, positions: Floats | None = None) -> tuple[list[ContactWarning], str]:
    """The warnings of a deck and the note: at its own coordinates, or at steps (steps, nodes, 3) at times 0, 1, 2."""
    scene = legal_scene(text)
    given = None
    if positions is not None:
        given = Positions(positions, np.ones(len(scene.nodes), dtype=bool), np.arange(float(len(positions))))
    evaluation = evaluate_scene(scene, given)
    watch = ContactWatch(evaluation)
    for part in evaluation.parts():
        watch.take(part)
    return watch.warnings(), watch.note()


def brief(text: str) -> list[tuple[str, int, int, int | None]]:
    """Code, line, number of elements and first element of each warning."""
    rows = (one.row() for one in watched(text)[0])
    return [(row["code"], row["line"], row["elements"], row["first"]) for row in rows]  # type: ignore[misc]


def message(text: str, code: str) -> str:
    (found,) = [one.diagnostic.message for one in watched(text)[0] if one.diagnostic.code == code]
    return found


def heights(*steps: float) -> Floats:
    """The pipe at a height for each step; the deck gives the nodes 1 and 11 first, then those between."""
    places = np.zeros((len(steps), 11, 3))
    places[..., 0] = np.array(steps)[:, np.newaxis]
    places[..., 2] = [0.0, 100.0, *range(10, 100, 10)]
    return places


# ------------------------------------------------------------------------------------------------------- without a law


def test_misspelt_keyword_is_the_reason_of_zeros() -> None:
    text = pipe(LAW.replace("PROPERTIES", "PROPERTEIS"))
    assert brief(text) == [("SYN009", LINE, 10, 1)]
    assert message(text, "SYN009") == (
        "keyword *SEABED PROPERTEIS is not known (did you mean *SEABED PROPERTIES?), and 10 elements (first: 1) are in "
        "contact without a seabed law: correct the name"
    )


def test_misspelt_keyword_of_other_elements() -> None:
    rest = LAW.replace("ALL", "East").replace("PROPERTIES", "PROPERTYS")
    assert brief(pipe(LAW.replace("ALL", "West").replace("50000", "30000") + rest)) == [("SYN009", LINE + 4, 5, 6)]


def test_unknown_keyword_of_something_else_is_not_the_reason() -> None:
    assert brief(pipe("*WIDGETS\n 1, 2\n")) == [("SBD006", 9, 10, 1)]


def test_block_that_gives_no_stiffness() -> None:
    text = pipe(LAW.replace("50000", "30000") + " SET=East\n FRICTION=0.3, 0.5\n")
    assert brief(text) == [("SBD006", LINE + 4, 5, 6)]
    assert message(text, "SBD006") == (
        "5 elements (first: 6) are in contact and get no stiffness from this block, which overrides earlier ones as a "
        "whole: give STIFFNESS= here too"
    )


@pytest.mark.parametrize("keyword", ["*P-Y\n SET=ALL\n FILE=py.txt\n", "*T-Z\n SET=ALL\n FILE=tz.txt\n"])
def test_soil_holds_what_lies_in_it(keyword: str) -> None:
    assert brief(pipe(keyword)) == []


def test_pipe_in_a_pipe_needs_no_law() -> None:
    half = LAW.replace("ALL", "West").replace("50000", "30000")
    assert brief(pipe(half)) == [("SBD006", LINE, 5, 6)]
    assert brief(pipe(f"{half}*PIP CONNECTION\n 1, 2\n")) == []
    assert brief(pipe("*PIP CONNECTION\n 1, 2\n")) == [("SBD006", 9, 10, 1)]


def test_contact_at_a_late_step_counts() -> None:
    found, note = watched(pipe(""), heights(0.5, 0.1, -0.01, 0.3))
    assert [(one.diagnostic.code, one.elements, one.first) for one in found] == [("SBD006", 10, 1)]
    assert note == ""


# -------------------------------------------------------------------------------------------------- nothing in contact


def test_smallest_clearance_of_all_steps() -> None:
    places = heights(0.5, 0.3, 0.4)
    places[1, 6, 0] = 0.25
    (found,), _ = watched(pipe(LAW), places)
    assert (found.diagnostic.code, found.elements, found.first) == ("GEO005", 10, 1)
    assert found.diagnostic.message == (
        "nothing is in contact: the smallest clearance is 0.25 m, of node 6 at time 1; correct the datum of X, which "
        "is 0 at the mudline"
    )


def test_a_line_that_touches_the_seabed_has_its_datum() -> None:
    found = message(pipe(LAW, "0.0, 0.0, 0.0", "0.0, 0.0, 100.0"), "GEO005")
    assert "the smallest clearance is 0 m, of node 1; lower the line until it penetrates, or give" in found


def test_own_coordinates_above_the_seabed() -> None:
    text = pipe(LAW, "20.0, 0.0, 0.0", "25.0, 0.0, 100.0")
    assert brief(text) == [("GEO005", 5, 10, 1)]
    assert "20 m, of node 1; correct the datum of X, which is 0 at the mudline, or give a solved" in message(
        text, "GEO005"
    )


def test_node_in_the_seabed_whose_elements_are_not() -> None:
    found = message(pipe(LAW, "-0.1, 0.0, 0.0", "10.0, 0.0, 100.0"), "GEO005")
    assert found.startswith("no element is in contact in the mean of its nodes, though node 1 lies 0.1 m deep; correct")


@pytest.mark.parametrize(
    ("first", "last", "hint"),
    [
        ("0.0, 0.0, -0.02", "100.0, 0.0, -0.02", "10 elements run along X at Z = -0.02: X is up here"),
        ("10.0, 0.0, 0.0", "10.0, 0.0, 500.0", "X is the same at all nodes and Z goes from 0 to 500: X is up here"),
        ("0.0, 0.0, 0.0", "900.0, 0.0, 0.0", "10 elements run along X at Z = 0: X is up here"),
    ],
)
def test_height_as_the_last_coordinate(first: str, last: str, hint: str) -> None:
    assert hint in message(pipe(LAW, first, last), "GEO005")


def test_vertical_riser_is_no_line_with_its_height_as_z() -> None:
    assert "X is up here" not in message(pipe(LAW, "1.0, 0.0, 0.0", "500.0, 0.0, 0.0"), "GEO005")
    assert "X is up here" not in message(pipe(LAW, "1.0, 0.0, 0.0", "500.0, 0.0, -10.0"), "GEO005")


def test_rigid_seabed_touches_at_no_depth() -> None:
    rigid = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
    assert brief(pipe(rigid, "0.0, 0.0, 0.0", "0.0, 0.0, 100.0")) == [("RUN005", LINE + 2, 10, 1)]
    assert brief(pipe(rigid, "0.1, 0.0, 0.0", "0.1, 0.0, 100.0")) == [("GEO005", 5, 10, 1)]


def test_nothing_under_the_line() -> None:
    planes = "*SEABED PLANES\n PLANE=Far\n POINT=0, 0, 0\n SLOPE=0\n DIRECTION=0\n BOUNDS=-1, 1, 500, 600\n"
    assert "the line lies outside the seabed" in message(pipe(planes + LAW), "GEO005")


def test_line_that_leaves_the_surveyed_seabed_at_one_step() -> None:
    planes = "*SEABED PLANES\n PLANE=Near\n POINT=0, 0, 0\n SLOPE=0\n DIRECTION=0\n BOUNDS=-1, 1, -1, 101\n"
    places = heights(-0.02, -0.02, -0.02)
    places[1:, 9:, 1] = 3.0
    (found,) = watched(pipe(planes + LAW), places)[0]
    assert found.diagnostic.code == "GEO017"
    assert (found.diagnostic.line, found.elements, found.first) == (7, 3, 8)  # the nodes 9 and 10 are generated
    assert found.diagnostic.message.startswith(
        "2 nodes (first: 9) lie outside of the bounds of all planes of the seabed, from time 1 on: no seabed holds"
    )
    (again,) = contact_warnings(scene := legal_scene(pipe(planes + LAW)), scene.contact().evaluate(places), places)
    assert again.diagnostic.code == "GEO017"
    assert watched(pipe(planes + LAW), places[:1])[0] == []


# --------------------------------------------------------------------------------------------------------- equilibrium


def test_own_positions_near_equilibrium_are_a_note() -> None:
    found, note = watched(pipe(LAW.replace("50000", "30000")))
    assert found == []
    ratio = 0.02 * 30000.0 * 100.0 / WEIGHT
    assert note == (
        "the positions are the deck's own coordinates, not a solved shape: total reaction 60000 N on 10 elements in "
        f"contact, their submerged weight {WEIGHT:.6g} N, ratio {ratio:.3g}; --rest-shape gives a shape of the line's "
        "own weight"
    )


@pytest.mark.parametrize(("stiffness", "warned"), [(7000, True), (9000, False), (69000, False), (72000, True)])
def test_far_from_equilibrium_is_a_third_or_three_times_the_weight(stiffness: int, warned: bool) -> None:
    ratio = 0.02 * stiffness * 100.0 / WEIGHT
    assert (ratio < 1 / 3 or ratio > 3) is warned
    found, note = watched(pipe(LAW.replace("50000.0", str(stiffness))))
    assert [one.diagnostic.code for one in found] == ["RUN003"] * warned
    assert (note == "") is warned
    if warned:
        assert f"{2.0 * stiffness:.6g} N on 10 elements in contact" in found[0].diagnostic.message
        assert found[0].brief == f"reaction / submerged weight {ratio:.3g}"


def test_weight_with_coatings_is_not_known() -> None:
    found, note = watched(pipe(LAW.replace("50000", "90000") + "*COATINGS\n 1\n"))
    assert found == []
    assert "N without *COATINGS, ratio 3.84" in note


def test_positions_of_a_file_are_judged_in_the_mean_of_their_steps() -> None:
    """Embedments of 0.02 and 0.04 m are 1.5 and 3 times the weight at 35,000 N/m2: 2.24 in the mean."""
    law = LAW.replace("50000", "35000")
    assert watched(pipe(law), heights(-0.02, -0.04)) == ([], "")
    (found,), note = watched(pipe(law), heights(-0.2, -0.3))
    assert (found.diagnostic.code, note) == ("RUN003", "")
    ratio = 0.25 * 35000.0 * 100.0 / WEIGHT
    assert found.diagnostic.message == (
        "the positions are in the mean of all steps far from equilibrium: total reaction 875000 N on 10 elements in "
        f"contact, their submerged weight {WEIGHT:.6g} N, ratio {ratio:.3g}; check their datum and units, and the "
        "weights"
    )


def test_floating_pipe() -> None:
    text = pipe(LAW, di=0.3139)
    assert brief(text) == [("RUN004", 18, 10, 1)]
    weight = np.pi / 4 * 9.81 * (7850.0 * (0.3239**2 - 0.3139**2) - 1025.0 * 0.3239**2)
    assert f"10 elements (first: 1) float: submerged weight {weight:.6g} N/m without" in message(text, "RUN004")
    filled = text + "$LOAD CASE\n*INTERNAL FLUID\n 30.0, 900.0\n"
    assert "RUN004" not in [code for code, *_ in brief(filled)]


def test_a_pipe_that_floats_in_one_load_case_only() -> None:
    """It is filled with gas first, and with oil then."""
    cases = "$LOAD CASE\n*INTERNAL FLUID\n 30.0, 50.0\n$LOAD CASE\n*INTERNAL FLUID\n 30.0, 900.0\n"
    text = pipe(LAW.replace("50000", "30000"), di=0.3139) + cases
    assert [code for code, *_ in brief(text)] == ["RUN004"]
    bore = np.pi / 4 * 0.3139**2
    weight = 9.81 * (np.pi / 4 * (7850.0 * (0.3239**2 - 0.3139**2) - 1025.0 * 0.3239**2) + 50.0 * bore)
    line = text.count("\n", 0, text.index("$LOAD CASE")) + 1
    assert f"submerged weight {weight:.6g} N/m with the contents of load case 1 (line {line});" in message(
        text, "RUN004"
    )


def test_contents_above_their_level_do_not_weigh() -> None:
    """The oil stands 1 m below the line: it is empty, and floats."""
    text = pipe(LAW, di=0.3139) + "$LOAD CASE\n*INTERNAL FLUID\n -1.0, 900.0\n"
    assert [code for code, *_ in brief(text)] == ["RUN004"]


def test_what_springs_of_the_soil_hold_may_float() -> None:
    """Half of the line is in the soil, without a law of the seabed; the other half floats."""
    springs = "*P-Y\n SET=East\n DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n"
    text = pipe(LAW.replace("ALL", "West") + springs, di=0.3139)
    assert brief(text) == [("RUN004", 18, 5, 1)]


@pytest.mark.parametrize(("height", "found"), [("-0.02", [("RUN004", 24, 5, 6)]), ("30.0", [])])
def test_what_floats_far_above_is_no_concern(height: str, found: list[object]) -> None:
    light = " SET=East\n 207.0E9, 79.6E9, 0.3239, 0.3139, 7850.0\n"
    text = pipe(light + LAW.replace("50000", "30000"))
    nodes = f" 6, -0.02, 0.0, 50.0\n GEN=1, 6\n 7, {height}, 0.0, 60.0\n 11, {height}, 0.0, 100.0\n GEN=7, 11\n"
    text = text.replace(" 11, -0.02, 0.0, 100.0\n GEN=1, 11\n", nodes)
    assert [each for each in brief(text) if each[0] == "RUN004"] == found


# -------------------------------------------------------------------------------------------------------- rigid seabed

RIGID = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"


def test_the_reaction_of_a_rigid_seabed_is_not_known() -> None:
    text = pipe(RIGID, last="0.5, 0.0, 100.0")
    assert brief(text) == [("RUN005", LINE + 2, 1, 1)]
    assert message(text, "RUN005") == (
        "element 1 is held by a rigid seabed, a constraint: its force is not known, nor is the total reaction"
    )
    scene = legal_scene(pipe(RIGID))
    (found,) = scene.contact().evaluate(scene.coordinates).summary()
    assert (found.reaction, found.ratio) == (None, None)
    assert found.submerged_weight == pytest.approx(WEIGHT)
    _, note = watched(pipe(RIGID))
    assert f"total reaction not known on 10 elements in contact, their submerged weight {WEIGHT:.6g} N" in note


# -------------------------------------------------------------------------------------------------------------- curves


@pytest.mark.parametrize(
    ("body", "line", "code", "reason"),
    [
        (
            ON_CLAY + LAW.replace("50000.0", "30000.0"),
            LINE + 1,
            "SBD025",
            "curve 'Clay' has no effect: line 32 gives all elements of SET='ALL' a number, 30000",
        ),
        (
            SURFACE + ON_CLAY,
            LINE + 3,
            "SBD025",
            "curve of *EMBEDMENT for SET='West' has no effect: line 34 gives all elements of SET='West' curve 'Clay'",
        ),
        (
            CLAY + LAW.replace("50000", "30000"),
            LINE + 1,
            "REF003",
            "curve 'Clay' has no effect: no STIFFNESS= names it",
        ),
        (
            CLAY + CLAY.replace("Clay", "Sand").partition("\n")[2] + LAW.replace("50000", "30000"),
            LINE + 1,
            "REF003",
            "2 curves have no effect, as no STIFFNESS= names them: 'Clay', 'Sand'",
        ),
        (
            CLAY + CLAY.replace("4200", "5200").partition("\n")[2] + LAW.replace("50000.0", "Clay"),
            LINE + 4,
            "REF004",
            "curve 'Clay' is already defined: the later one is used (inferred); keep one of them",
        ),
        (
            CLAY.replace("Clay", "20000") + LAW.replace("50000.0", "20000"),
            LINE + 1,
            "SBD017",
            "name of this curve reads as a number, and STIFFNESS= takes the number: choose another name",
        ),
    ],
)
def test_curve_without_effect(body: str, line: int, code: str, reason: str) -> None:
    assert brief(pipe(body)) == [(code, line, 0, None)]
    assert message(pipe(body), code).removeprefix("the ") == reason


def test_several_later_definitions() -> None:
    halves = LAW.replace("50000", "30000").replace("ALL", "West") + " SET=East\n STIFFNESS=31000.0\n"
    assert message(pipe(ON_CLAY + halves), "SBD025").endswith("lines 32, 34 override it for all elements of SET='ALL'")


def test_nodal_stiffness_in_place_of_a_curve() -> None:
    contact = "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=30000.0\n"
    assert "*SEABED CONTACT gives the nodes of SET='ALL' a stiffness" in message(pipe(ON_CLAY + contact), "SBD025")


def test_curve_that_a_parameter_chooses() -> None:
    chosen = f"$PREPROCESSOR\n*PARAMETERS\n k, 30000\n{pipe(CLAY + LAW.replace('50000.0', '=[k]'))}"
    assert brief(chosen) == []


# ---------------------------------------------------------------------------------------------------- ways to the same


def test_pieces_give_what_the_whole_series_gives() -> None:
    scene, places = legal_scene(pipe("")), heights(0.5, 0.2, -0.01, 0.1)
    result = scene.contact().evaluate(places)
    watch = ContactWatch(Evaluation(scene, scene.contact(), places, result.present))
    for start in range(4):
        watch.take(ResultPart(start, result.steps(start, start + 1)))
    assert watch.warnings() == contact_warnings(scene, result, places)
    assert [one.elements for one in watch.warnings()] == [10]


def test_from_python_without_positions_are_the_decks_own() -> None:
    scene = legal_scene(pipe(LAW.replace("50000", "90000")))
    result = scene.contact().evaluate()
    assert [one.diagnostic.code for one in contact_warnings(scene, result)] == ["RUN003"]
    (given,) = contact_warnings(scene, result, scene.coordinates)
    assert given.diagnostic.message.startswith("the positions are far from equilibrium: total reaction 180000 N")


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        (pipe(LAW), []),
        (pipe(LAW, "20.0, 0.0, 0.0", "25.0, 0.0, 100.0"), []),
        (pipe("*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n"), ["SBD006"]),
        (pipe(LAW, "0.0, 0.0, -0.02", "100.0, 0.0, -0.02"), ["GEO005"]),
        (pipe("", "20.0, 0.0, 0.0", "25.0, 0.0, 100.0"), []),
        (pipe("").replace(" 1, 1, 2\n", " 1, 1, 99\n"), []),
    ],
)
def test_what_a_deck_lacks_whatever_its_shape(text: str, codes: list[str]) -> None:
    assert [one.diagnostic.code for one in seabed_warnings(scene_of(text))] == codes
