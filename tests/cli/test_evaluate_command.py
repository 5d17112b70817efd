"""`mudline evaluate`: at the deck's own coordinates."""

from __future__ import annotations

import csv
import re

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Json, assert_fits, run
from tests.helpers.builders.decks import CLEAN, LINEAR, PULLING

RIGID = CLEAN.partition("*SEABED PROPERTIES")[0] + "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
FRICTION = CLEAN.replace(" STIFFNESS=Clay\n", " STIFFNESS=Clay\n FRICTION=0.3, 0.5\n")
STAGES = [
    "seabed surface",
    "normal law",
    "smoothing",
    "unloading",
    "suction",
    "friction",
    "lateral",
    "trench",
    "assembly",
]
LENGTH = (0.4**2 + 10**2) ** 0.5


def evaluate(deck: str, *options: str) -> Json:
    outcome = run(
        "evaluate", "-", "--stdin-filename", "deck.keyxm", "--output-format", "json", *options, stdin=deck.encode()
    )
    assert outcome.code == 0
    assert_fits(outcome.json(), "evaluate")
    return outcome.json()


def test_json() -> None:
    found = evaluate(CLEAN)
    assert found["units"] == "metric"
    assert [stage["stage"] for stage in found["plan"]] == STAGES
    first, second = found["elements"]
    assert (first["force"], first["law"], first["state"], first["contact"]) == (1500.0, "curve:Clay", None, True)
    assert second["depth"] == pytest.approx(-0.1)
    assert (second["contact"], second["force"], second["stiffness"]) == (False, 0.0, 0.0)
    assert second["length"] == pytest.approx(LENGTH)
    assert [node["reaction"] for node in found["nodes"]] == [[7500.0, 0.0, 0.0], [7500.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    (line,) = found["summary"]
    (point,) = line.pop("touchdown")
    assert point == pytest.approx(
        {"arc_length": 10.0 + 0.25 * LENGTH, "x": 0.0, "y": 12.5, "z": 0.0, "contact": "before"}
    )
    place = {"force": 1500.0, "element": 1, "arc_length": 5.0, "x": -0.1, "y": 5.0, "z": 0.0}
    assert line["largest_force"] == place
    assert line["largest_uplift"] is None
    assert line["contact_length"] == pytest.approx(10.0 + 0.25 * LENGTH)
    assert (line["time"], line["line"], line["first_element"], line["last_element"]) == (None, 1, 1, 2)
    assert (line["length"], line["reaction"]) == (pytest.approx(10.0 + LENGTH), 15000.0)
    assert line["ratio"] == pytest.approx(15000.0 / line["submerged_weight"])


def test_nulls() -> None:
    deck = LINEAR.partition("*GEOMETRIC SETS")[0] + "*SEABED PROPERTIES" + LINEAR.partition("*SEABED PROPERTIES")[2]
    first, _ = evaluate(deck)["elements"]
    assert first["diameter"] is None
    assert first["ratio"] is None
    assert first["slope"] is None
    assert first["force"] == 2000.0
    free = evaluate(CLEAN.partition("*SEABED PROPERTIES")[0])["elements"][0]
    assert (free["law"], free["set"], free["force"], free["contact"]) == ("none", None, 0.0, True)


def test_tension_is_kept_or_cut() -> None:
    force = -500.0 + 0.2 * 400.0 / 0.3
    kept, cut = (evaluate(PULLING, "--tension", tension)["elements"][0] for tension in ("keep", "cut"))
    assert kept["force"] == pytest.approx(force)
    assert kept["law"] == "curve:Clay"
    assert (cut["force"], cut["slope"], cut["stiffness"]) == (0.0, 0.0, 0.0)
    assert (cut["law"], cut["contact"]) == ("curve-cut", True)
    assert evaluate(PULLING)["elements"][0] == kept


def test_text_of_nodes(place: Place) -> None:
    assert run("evaluate", place(), "--table", "nodes").out.endswith(
        "Nodes in contact\n"
        "         gap  reaction X  reaction Y  reaction Z\n"
        "  node   [m]         [N]         [N]         [N]\n"
        "────────────────────────────────────────────────\n"
        "1 to 2  -0.1        7500           0           0\n"
        "\n"
    )


def test_like_elements_are_told_together(place: Place) -> None:
    nodes = "".join(f" {n}, {-0.1 - 0.002 * (n > 60) * n}, {n}.0\n" for n in range(1, 122))
    elements = "".join(f" {n}, {n}, {n + 1}\n" for n in range(1, 121))
    rest = CLEAN.partition("*ELEMENT SETS")[2].replace(" 1, 2\n", " GEN=1, 120\n")
    deck = f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{elements}*ELEMENT SETS{rest}"
    lines = run("evaluate", place(deck)).out.splitlines()
    assert sum(line.startswith("1 to 59 ") for line in lines) == 1
    assert "22 more lines, farther from touchdown: --table elements shows all, -o writes all" in lines
    for option in (["-v"], ["--table", "elements"]):
        every = run("evaluate", place(deck), *option).out.partition("Elements in contact")[2].splitlines()
        assert sum("curve:Clay" in line for line in every) == 120
        assert not any(" to " in line for line in every)


def test_of_many_rows_those_near_touchdown_are_shown(place: Place) -> None:
    """Elements in contact that all differ, up to a touchdown point far from the first; rounding is one row."""
    nodes = "".join(
        f" {n}, {-0.2 - 1e-9 * n if n <= 60 else -0.2 + 0.0021 * (n - 60):.12f}, {n}.0\n" for n in range(1, 171)
    )
    elements = "".join(f" {n}, {n}, {n + 1}\n" for n in range(1, 170))
    rest = CLEAN.partition("*ELEMENT SETS")[2].replace(" 1, 2\n", " GEN=1, 169\n")
    name = place(f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{elements}*ELEMENT SETS{rest}")
    table = run("evaluate", name).out.partition("Elements in contact")[2].splitlines()
    first = [line.split()[0] for line in table if "curve:Clay" in line]
    assert first == [str(element) for element in range(115, 155)]  # node 155 is the last one below 0
    assert any("56 more lines, farther" in line for line in table)  # elements 1 to 59 in one, 60 to 114


def test_rows_that_differ_little_are_one_with_the_largest_numbers(place: Place) -> None:
    """Embedments that grow by two thousandths of the largest from node to node: three elements share a row."""
    nodes = "".join(f" {n}, {-0.1 + 2e-4 * (n < 13) * n:.4f}, {n}.0\n" for n in range(1, 31))
    elements = "".join(f" {n}, {n}, {n + 1}\n" for n in range(1, 30))
    rest = CLEAN.partition("*ELEMENT SETS")[2].replace(" 1, 2\n", " GEN=1, 29\n")
    table = run("evaluate", place(f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{elements}*ELEMENT SETS{rest}")).out.splitlines()
    rows = [re.split(r" {2,}", line.strip()) for line in table if "curve:Clay" in line][1:]
    assert [row[0] for row in rows] == ["1 to 3", "4 to 6", "7 to 9", "10 to 11", "12", "13 to 29"]
    assert rows[0][2:5] == ["0.0997", "0.1994", "1497"]
    assert rows[-1][2:5] == ["0.1", "0.2", "1500"]


def test_numbers_that_do_not_follow_each_other_are_told_apart(place: Place) -> None:
    deck = (
        CLEAN.replace(" 2, 2, 3\n", " 5, 2, 3\n").replace(" 1, 2\n*GEO", " 1, 5\n*GEO").replace(" 3, 0.3,", " 3, -0.1,")
    )
    lines = run("evaluate", place(deck)).out.splitlines()
    assert [line.split()[0] for line in lines[-3:-1]] == ["1", "5"]


CSV = {
    "elements": (
        (
            "element,set,arc_length,x,y,z,diameter,length,depth,ratio,contact,force,slope,stiffness,law,state,"
            "line,node1,node2,units"
        ),
        "1,Pipe,5.0,-0.1,5.0,0.0,0.5,10.0,0.1,0.2,true,1500.0,5000.0,10000.0,curve:Clay,,1,1,2,metric",
    ),
    "nodes": (
        (
            "node,arc_length,x,y,z,gap,normal_x,normal_y,normal_z,reaction_x,reaction_y,reaction_z,normal_force,axial_force,"
            "lateral_force,axial_state,lateral_state,line,units"
        ),
        "1,0.0,-0.1,0.0,0.0,-0.1,1.0,0.0,0.0,7500.0,0.0,0.0,7500.0,0.0,0.0,,,1,metric",
    ),
}


@pytest.mark.parametrize("table", CSV)
def test_csv(place: Place, table: str) -> None:
    outcome = run("evaluate", place(), "--output-format", "csv", "--table", table)
    assert (outcome.code, tuple(outcome.out.splitlines()[:2])) == (0, CSV[table])


def test_plan_in_json_and_csv(place: Place) -> None:
    found = run("evaluate", place(FRICTION), "--plan", "--output-format", "json").json()
    assert_fits(found, "evaluate")
    assert set(found) == {"units", "plan"}
    assert [stage["stage"] for stage in found["plan"]] == STAGES
    friction = next(stage for stage in found["plan"] if stage["stage"] == "friction")
    assert friction["active"]
    assert "mobilisation length" in friction["why"]
    rows = list(csv.DictReader(run("evaluate", place(), "--plan", "--output-format", "csv").out.splitlines()))
    assert [row["stage"] for row in rows if row["active"] == "true"] == ["seabed surface", "normal law", "assembly"]
    assert {row["active"] for row in rows} == {"true", "false"}


def test_deck_without_elements(place: Place) -> None:
    outcome = run("evaluate", place("$MODEL\n*OCEAN\n 1, 2, 3\n"))
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err == "deck.keyxm:1:1: error: RUN001 the deck has no elements to evaluate\n"
    outcome = run("evaluate", SAMPLES / "lines-deck.keyxm")
    assert outcome.code == 1
    assert "no elements to evaluate: *LINES may make them, and is not read; give them to `" in outcome.err
    deck = "$MODEL\n*LINE LOCATIONS\n LINE=Riser\n Arch, 20\n*LINES\n LINE=Riser\n SECTION=Riser, 100\n"
    assert "no elements to evaluate: *LINES may make them" in run("evaluate", place(deck)).err
    assert "to export: those of *LINES are" in run("export", place(deck), "--to", "orcaflex", "-o", "out").err
    outcome = run("evaluate", place("$MODEL\n*NODE,,,\n1,0,0,\n*ELEMENT,,,\n1,1,2,\n"))
    assert "no elements to evaluate: 2 unknown keywords, `mudline lint` names them" in outcome.err


def test_elements_at_nodes_that_are_not_known(place: Place) -> None:
    deck = CLEAN.replace(" 2, 2, 3\n", " 2, 2, 33\n") + "*LINES\n LINE=Riser\n"
    outcome = run("evaluate", place(deck))
    assert outcome.code == 1
    assert ":10:" in outcome.err
    assert "REF006 element 2 ends at node 33, which is not defined: define it; *LINES" in outcome.err
    outcome = run("evaluate", place(deck.replace("33", "{End}")))
    assert outcome.code == 1
    assert "RUN001 an element ends at nodes that are not known: *LINES may make them" in outcome.err


def test_value_that_overflows_names_the_line_of_the_element(place: Place) -> None:
    deck = CLEAN.replace("-0.1,", "-1.0E150,").replace("3000.0", "3.0E160")
    outcome = run("evaluate", place(deck))
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith("deck.keyxm:9:")
    assert "RUN001 element 1" in outcome.err
    assert "overflows" in outcome.err
