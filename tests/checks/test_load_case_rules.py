"""WAV002, TIM003 to TIM005, CUR001, VES002, GEO007 to GEO012: load cases, and parts of a whole model."""

from __future__ import annotations

import pytest

from tests.checks.findings import found, messages
from tests.helpers.builders.decks import STEEL

OCEAN = "$MODEL\n*OCEAN\n 420.0, 1025.0, 9.81\n$LOAD CASE\n"
WAVE = "*WAVE-REGULAR\n 1.5, 10.0\n"


def run(span: str, more: str = WAVE) -> str:
    return f"{OCEAN}*TIME\n STEP=FIXED\n {span}\n{more}"


@pytest.mark.parametrize(
    ("wave", "count"),
    [
        ("*WAVE-REGULAR\n 5.5, 7.0\n", 1),  # 11 m of 76.5 m
        ("*WAVE-REGULAR\n 5.4, 7.0\n", 0),
        ("*WAVE-STOKES\n 11.0, 7.0\n", 1),
        ("*WAVE-STOKES\n 10.8, 7.0\n", 0),
        ("*WAVE-STOKES\n =[h], 7.0\n", 0),
        ("*WAVE-REGULAR\n OPTION=MANY\n 50.0, 5.0, 10.0, 3\n", 0),
    ],
)
def test_steep_waves(wave: str, count: int) -> None:
    assert len(found(OCEAN + wave, "WAV002")) == count


def test_steep_waves_take_the_gravity_of_the_deck_or_of_its_units() -> None:
    deck = OCEAN + "*WAVE-STOKES\n 11.0, 7.0\n"
    assert messages(deck, "WAV002") == [
        "a wave 11 high with a period of 7 is 0.144 of its length high, and breaks at 0.142: correct height or period"
    ]
    assert found(deck.replace("9.81", "32.2"), "WAV002") == []
    assert len(found("$LOAD CASE\n*WAVE-STOKES\n 11.0, 7.0\n", "WAV002")) == 1


@pytest.mark.parametrize(
    ("span", "count"),
    [("0, 100, 0.1, 10", 0), ("0, 100, 0.1, 9.9", 1), ("0, 100, 0.1, 100.1", 1), ("0, 100, 0.1, 0", 0)],
)
def test_ramps(span: str, count: int) -> None:
    assert len(found(run(span), "TIM003")) == count
    assert found(run("0, 100, 0.1, 5", WAVE + "*RESTART\n LAST=static\n"), "TIM003") == []
    assert found(run("100, 0, 0.1, 50"), "TIM003") == []  # TIM001 says what is wrong


@pytest.mark.parametrize(("step", "count"), [("0.5", 0), ("0.51", 1)])
def test_steps(step: str, count: int) -> None:
    assert len(found(run(f"0, 100, {step}"), "TIM004")) == count
    variable = f"{OCEAN}*TIME\n STEP=VARIABLE\n 0, 100\n 0.1, 0.05, {step}\n{WAVE}"
    assert len(found(variable, "TIM004")) == count
    assert found(run(f"0, 100, {step}", ""), "TIM004") == []


@pytest.mark.parametrize(("start", "expected"), [("99.9", []), ("100.0", [("TIM007", 10, 2)])])
def test_results_that_no_run_stores(start: str, expected: list[tuple[str, int, int]]) -> None:
    stored = f"*DATABASE\n TIME=SELECTED\n {start}, 0.5\n"
    assert found(run("0, 100, 0.1", stored), "TIM007") == expected
    assert found(f"{OCEAN}{stored}", "TIM007") == []


def test_a_wave_or_a_step_that_is_not_usual_is_told_once() -> None:
    """What is said of the step, the ramp and the height of such a wave follows from it."""
    unusual = ("UNT007", "TIM003", "TIM004", "WAV002")
    exchanged = run("0, 100, 0.1, 10", "*WAVE-STOKES\n 90.0, 0.5\n")
    assert [one[0] for one in found(exchanged, *unusual)] == ["UNT007"]
    assert [one[0] for one in found(run("0, 100, 10, 0.1"), *unusual)] == ["UNT007"]
    turned = run("0, 100, 1, 10", "*WAVE-STOKES\n 3.0, 10.0, 1800.0\n")  # its period is right
    assert [one[0] for one in found(turned, *unusual)] == ["TIM004", "UNT007"]


@pytest.mark.parametrize(
    ("profile", "expected"),
    [
        ("TYPE=PIECEWISE LINEAR\n 0, 1\n 420, 2\n", []),
        ("TYPE=PIECEWISE LINEAR\n 419.9, 1\n 0, 2\n", []),
        ("TYPE=PIECEWISE LINEAR\n 0, 1\n 300, 2\n", [("CUR001", 8, 2)]),
        ("TYPE=PIECEWISE LINEAR, OPTION=DESCEND\n 0, 1\n 300, 2\n", []),
        ("TYPE=PIECEWISE LINEAR, OPTION=DESCEND\n 300, 1\n 50, 2\n", [("CUR001", 8, 2)]),
        ("TYPE=UNIFORM\n 1.0\n", []),
    ],
)
def test_current_profiles(profile: str, expected: list[tuple[str, int, int]]) -> None:
    assert found(f"{OCEAN}*CURRENT\n {profile}", "CUR001") == expected


VESSELS = "$MODEL\n*VESSEL\n VESSEL=A\n INITIAL POSITION=0, 0, 0\n VESSEL=B\n INITIAL POSITION=0, 0, 0\n"
DYNAMIC = "$LOAD CASE\n*ANALYSIS TYPE\n TYPE=TIME DOMAIN\n"
RAO = "*RAO\n VESSEL=b\n HEADING=0\n 0.1\n 1, 0, 0, 0, 0, 0\n 0, 0, 0, 0, 0, 0\n"


def test_vessels_that_stand_still() -> None:
    assert found(VESSELS + DYNAMIC + WAVE + RAO, "VES002") == [("VES002", 3, 9)]
    assert len(found(VESSELS + DYNAMIC + "*WAVE-DEAN\n 1\n", "VES002")) == 2
    assert found(VESSELS + DYNAMIC, "VES002") == []
    assert found(VESSELS + DYNAMIC.replace("TIME DOMAIN", "STATIC") + WAVE, "VES002") == []
    assert found(VESSELS + "$LOAD CASE\n" + WAVE, "VES002") == []


def test_static_steps() -> None:
    steps = "*NON LINEAR STATIC\n 5\n"
    assert found(DYNAMIC + steps, "TIM005") == [("TIM005", 4, 1)]
    assert found(DYNAMIC.replace("TIME", "FREQUENCY") + steps, "TIM005") == []
    assert found("$LOAD CASE\n" + steps, "TIM005") == []


LINE = "$MODEL\n*NODE\n 1, 50.0, 0.0\n 4, 50.0, 30.0\n GEN=1, 4\n*ELEMENT\n 1, 1, 2\n GEN=1, 3\n"
SETS = "*ELEMENT SETS\n SET=Part\n 1, 2\n"
PARTS = LINE + SETS + STEEL.replace("SET=ALL", "SET=Part")
JOINT = "*TAPER\n SET=Joint\n 2.07E11, 7.96E10, 7850.0, 0.2731, 0.3239, 0.4064\n"
HELD = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n 4, 1\n"


def test_elements_without_a_section() -> None:
    assert found(PARTS + HELD, "GEO007") == [("GEO007", 8, 2)]
    for good in (
        PARTS,  # no load case: a part of a job
        HELD,
        LINE + HELD,  # none has a section
        PARTS + "*HINGE\n 3\n" + HELD,
        PARTS + "*DAMPER\n 3\n" + HELD,
        PARTS.replace("*GEO", " SET=Joint\n 3\n*GEO") + JOINT + HELD,
        PARTS + "*UNHEARD OF\n 3\n" + HELD,
        PARTS.replace("1, 2\n*GEO", "1, 2, 3\n*GEO") + HELD,
        PARTS + HELD + "*RESTART\n LAST=static\n",
    ):
        assert found(good, "GEO007") == []


def test_elements_without_hydrodynamic_properties() -> None:
    current = "*CURRENT\n TYPE=UNIFORM\n 0.5\n"
    some = LINE + SETS + "*HYDRODYNAMIC SETS\n SET=Part, TYPE=CONSTANT\n 1.0\n"
    assert found(some + HELD + current, "GEO008") == [("GEO008", 8, 2)]
    assert messages(LINE + HELD + current, "GEO008")[0].startswith("3 elements (first: 1) without coefficients")
    assert found(some + HELD, "GEO008") == []
    assert found(some.replace("1, 2\n*HYD", "1, 2, 3\n*HYD") + HELD + current, "GEO008") == []
    assert found(some.replace("CONSTANT", "REYNOLDS") + HELD + current, "GEO008") == []  # its lines are not read


def test_nodes_without_an_element() -> None:
    more = LINE.replace("*ELEMENT", " 8, 50.0, 40.0\n 9, 50.0, 50.0\n*ELEMENT")
    assert found(more + HELD, "GEO009") == [("GEO009", 6, 2)]
    assert messages(more + HELD, "GEO009")[0].startswith("2 nodes (first: 8) of no element")
    assert found(more, "GEO009") == []
    assert found(more + "*NODE SPRING\n 8, 1, 5.0\n" + HELD + " GEN=9, 9, 1, 2\n", "GEO009") == []


@pytest.mark.parametrize(
    ("case", "expected"),
    [
        (HELD, []),
        (HELD.replace(" 4, 1\n", ""), [("GEO010", 4, 2)]),
        ("$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n GEN=1, 4, 1\n", []),
        ("$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n TYPE=VESSEL\n 4, Semi\n", []),
        ("$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n NODE=4, 1\n TYPE=VESSEL\n 1, Semi\n 1, Semi\n", []),  # lost
        (HELD.replace(" 4, 1\n", "") + "*TOP TENSION\n 4, 1000.0\n", []),
        ("", []),
    ],
)
def test_ends_that_nothing_holds(case: str, expected: list[tuple[str, int, int]]) -> None:
    assert found(LINE + case, "GEO010") == expected


def test_cables() -> None:
    cable = "$MODEL\n*NODE\n 1, 0, 0\n 2, 30, 40\n*CABLE\n 1, 1, 2, {}\n*NODE,CURVILINEAR\n 5, 1, {}\n"
    assert found(cable.format(50.0, 50.0), "GEO011", "GEO012") == []
    assert found(cable.format(49.9, 10.0), "GEO011", "GEO012") == [("GEO011", 6, 11)]
    assert found(cable.format(60.0, 60.1), "GEO011", "GEO012") == [("GEO012", 8, 8)]
    assert found(cable.replace("1, 1, 2, {}", "1, 1, 9, {}").format(4.0, 1.0), "GEO011") == []


def test_operators_of_which_a_line_cannot_be_read_are_compared_without_it() -> None:
    lines = "=[a\n 0.0, 0.10, 0.9, 10.0, 0.4, 90.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.1, -80.0\n"
    text = f"$LOAD CASE\n*RAO\n VESSEL=FPSO\n LAYOUT=LINE\n{lines}"
    assert "DAT002" not in {code for code, _, _ in found(text)}
