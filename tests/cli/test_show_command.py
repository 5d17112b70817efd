"""`mudline show`: a deck in figures."""

from __future__ import annotations

import re

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.helpers.builders.decks import CLEAN, ILLEGAL, LINEAR


def test_json(place: Place) -> None:
    outcome = run("show", place(), "--output-format", "json")
    found = outcome.json()
    assert_fits(found, "show")
    assert found["file"] == "deck.keyxm"
    assert (found["units"], found["nodes"], found["elements"]) == ("metric", 3, 2)
    assert found["length"] == pytest.approx(10 + (0.4**2 + 10**2) ** 0.5)
    (section,) = found["sections"]
    assert section["name"] == "MODEL"
    assert section["keywords"][0] == {"keyword": "OCEAN", "read": True, "partly": False}
    assert found["keywords"] == {"total": 7, "read": 7, "partly": {}, "unread": {}}
    assert [(entry["name"], entry["elements"], entry["open"]) for entry in found["sets"]] == [
        ("ALL", 2, False),
        ("Pipe", 2, False),
    ]
    assert found["curves"] == [
        {
            "name": "Clay",
            "keyword": "SEABED STIFFNESS",
            "points": 3,
            "ratios": [0.0, 0.5],
            "forces": [0.0, 3000.0],
            "elements": 2,
            "open": False,
        }
    ]
    assert found["diameters"] == [{"diameter": 0.5, "elements": 2}]
    assert found["laws"] == [{"law": "curve:Clay", "set": "Pipe", "elements": 2, "stiffness": None}]
    assert found["seabed"] == ["elastic"]


def test_springs_of_nodes_replace_the_law_of_their_set(place: Place) -> None:
    """Element 2 has a spring at each of its nodes; it follows the curve no more."""
    halves = CLEAN.replace(" 1, 2\n*GEO", " 1, 2\n SET=Rock\n 2\n*GEO")
    found = run(
        "show", place(f"{halves}*SEABED CONTACT\n SET=Rock\n NODAL STIFFNESS=250000\n"), "--output-format", "json"
    ).json()
    assert found["laws"] == [
        {"law": "curve:Clay", "set": "Pipe", "elements": 1, "stiffness": None},
        {"law": "nodal", "set": "Rock", "elements": 1, "stiffness": None},
    ]
    assert [curve["elements"] for curve in found["curves"]] == [1]


def test_what_a_plus_means_is_said(place: Place) -> None:
    name = place(LINEAR + "*LINES\n LINE=Riser\n")
    outcome = run("show", name)
    assert "ALL          2+  20.008\n" in outcome.out
    assert "+ a block that is not read may add elements to this set\n" in outcome.out
    assert "    passed through unchanged: *LINES\n" in outcome.out
    sets = run("show", name, "--output-format", "json").json()["sets"]
    assert {entry["name"]: entry["open"] for entry in sets} == {"ALL": True, "Pipe": False, "Riser": True}


def test_deck_with_errors_is_shown_as_far_as_it_goes(place: Place) -> None:
    outcome = run("show", place(ILLEGAL))
    assert outcome.code == 1
    assert "3 nodes, 2 elements" in outcome.out
    assert outcome.err == "mudline: deck.keyxm has 1 error: see mudline lint\n"


def test_length_is_that_of_the_elements_whose_nodes_are_known(place: Place) -> None:
    outcome = run("show", place(CLEAN.replace(" 3, 0.3, 20.0\n", "")), "--output-format", "json")
    assert outcome.json()["length"] == 10.0


def test_length_that_overflows_is_null(place: Place) -> None:
    deck = CLEAN.replace(" 2, -0.1, 10.0", " 2, -0.1, 1.0E308").replace(" 3, 0.3, 20.0", " 3, 0.3, -1.0E308")
    outcome = run("show", place(deck), "--output-format", "json")
    assert outcome.json()["length"] is None
    assert outcome.err == ""


def test_many_diameters_are_shown_when_asked_for(place: Place) -> None:
    sections = "".join(f" SET=S{n}\n 2.0E11, 8.0E10, {n}.5, 0.1, 7850.0\n" for n in range(1, 43))
    nodes = "".join(f" {n}, 0.0, {n}.0\n" for n in range(1, 44))
    elements = "".join(f" {n}, {n}, {n + 1}\n" for n in range(1, 43))
    sets = "".join(f" SET=S{n}\n {n}\n" for n in range(1, 43))
    deck = f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{elements}*ELEMENT SETS\n{sets}*GEOMETRIC SETS\n OPTION=RIGID\n{sections}"
    text = run("show", place(deck)).out
    assert "2 more diameters: -v shows all\n" in text
    assert "    42.5         1" not in text
    assert "    42.5         1" in run("show", place(deck), "-v").out


def test_the_bed_and_what_it_gives(place: Place) -> None:
    laws = " FRICTION=0.3, , 0.05\n SUCTION=500, 0.2\n LATERAL=40\n"
    more = "*SEABED TRENCH\n SET=Pipe\n GEOMETRY=0.5, 1, 2\n PEAK=100\n*SEABED PLANES\n PLANE=a\n PLANE=b\n"
    shown = run("show", place(CLEAN.replace(" STIFFNESS=Clay\n", f" STIFFNESS=Clay\n{laws}") + more)).out
    assert "elastic seabed, 2 planes\n" in shown
    assert re.search(r"^Pipe +2 +0\.3, - +0\.05, - +40 +500 +0\.2$", shown, re.MULTILINE)
    assert re.search(r"^\*SEABED TRENCH +Pipe +2$", shown, re.MULTILINE)


@pytest.mark.parametrize(
    ("profile", "words"),
    [
        ("TYPE=SLOPING\n DIRECTION=30\n SLOPE=2.5", ", sloping 2.5 degrees, turned by 30 degrees\n"),
        ("TYPE=2D\n FILE=bed.txt", ", 2D profile of bed.txt: 2 points\n"),
        ("TYPE=3D\n FILE=bed.fcsbd", ", 3D surface of bed.fcsbd: not known\n"),
    ],
)
def test_the_shape_of_the_bed(profile: str, words: str, place: Place) -> None:
    place("0, 0\n10, 1\n", "bed.txt")
    name = place(CLEAN + f"*SEABED PROFILE\n {profile}\n")
    assert words in run("show", name).out
    assert_fits(run("show", name, "--output-format", "json").json(), "show")


def test_a_weight_beyond_the_curve_is_told(place: Place) -> None:
    soft = CLEAN.replace(" 0.5, 3000.0", " 0.5, 30.0").replace(" 0.1, 1000.0", " 0.1, 1.0")
    assert soft != CLEAN
    out = run("show", place(soft)).out
    static = out.partition("Static embedment")[2].partition("Sheet")[0]
    assert "extrapolated" in static
    assert static.rstrip().endswith("above")
