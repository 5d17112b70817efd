"""`mudline curves`: the curves that a deck really gives."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from xml.parsers import expat

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, assert_fits, run
from tests.helpers.builders.decks import CLEAN, LINEAR, UNUSED

SEABED = "force-embedment curve"
AXES = [SEABED, "ratio [-]", "force [N/m]"]
OTHERS = (
    "*MOMENT-CURVATURE\n CURVE=Bend\n 5.0, 2.0\n 0.0, 0.0\n 4.0, 1.0\n"
    "*P-Y\n SET=Pipe\n DEPTH=1.0\n 0.0, 0.0\n 3.0, 2.0\n"
    "$LOAD CASE\n*CURRENT\n TYPE=PIECEWISE LINEAR\n 300.0, 0.9, 180.0\n 0.0, 0.1, 180.0\n"
)
"""Curves of other kinds than those of a seabed."""


def rows(text: str) -> list[list[str]]:
    return list(csv.reader(text.splitlines()))


CSV = {
    "points": (
        (),
        ["curve", "ratio", "force", "slope", "kind", "abscissa", "ordinate"],
        ["Clay", "0.5", "3000.0", "", *AXES],
        ["Sand", "0.0", "0.0", "30000.0", *AXES],
    ),
    "values": (
        ("--at", "0.6"),
        ["curve", "ratio", "force", "slope", "segment", "extrapolated", "kind", "abscissa", "ordinate"],
        ["Clay", "0.6", "3500.0", "5000.0", "1", "above", *AXES],
        ["Sand", "0.6", "18000.0", "30000.0", "0", "above", *AXES],
    ),
    "static embedment": (
        ("--weight", "1500"),
        ["curve", "ratio", "force", "slope", "segment", "extrapolated", "stable", "diameter", "depth", "stiffness"],
        ["Clay", "0.2", "1500.0", "5000.0", "1", "", "true", "0.5", "0.1", "10000.0"],
        ["Sand", "0.05", "1500.0", "30000.0", "0", "", "true", "", "", ""],
    ),
}


@pytest.mark.parametrize(("options", "head", "clay", "sand"), CSV.values(), ids=CSV)
def test_csv(place: Place, options: tuple[str, ...], head: list[str], clay: list[str], sand: list[str]) -> None:
    deck = UNUSED.replace(" CURVE=Sand\n 0.0, 0.0\n 0.1, 1.0\n", " CURVE=Sand\n 0.0, 0.0\n 0.1, 3000.0\n")
    found = rows(run("curves", place(deck), *options, "--output-format", "csv").out)
    assert (found[0], found.index(clay) + 1) == (head, found.index(sand))


def test_an_embedment_where_the_curve_softens_is_unstable(place: Place) -> None:
    deck = place(CLEAN.replace(" 0.5, 3000.0", " 0.3, 500.0\n 0.5, 3000.0"))
    outcome = run("curves", deck, "--weight", "800")
    table = outcome.out.partition("static embedment")[2].splitlines()
    assert [line.split()[-1] for line in table[4:7]] == ["20000", "unstable", "25000"]
    assert "unstable: the curve softens there" in outcome.out
    found = run("curves", deck, "--weight", "800", "--output-format", "json").json()
    assert_fits(found, "curves")
    assert [one["stable"] for one in found[0]["static"]] == [True, False, True]
    assert "unstable" not in run("curves", deck, "--weight", "400").out


def test_diameters_of_lines_come_from_their_sections(place: Place) -> None:
    lines = (SAMPLES / "lines-deck.keyxm").read_text(encoding="utf-8")
    outcome = run("curves", place(lines), "--weight", "135")
    assert "curve Clay: 8 points, diameters of *GEOMETRIC SETS\n" in outcome.out
    assert "D=0.168" in outcome.out
    section = " SET=Dynamic Section\n 12.0E3, 12.0E3, 8.0E3, 250.0E6, 36.5, 0.12, 0.0, 0.2, 0.2, 0.2\n"
    two = lines.replace("C\n*HYDRODYNAMIC SETS", f"{section}C\n*HYDRODYNAMIC SETS")
    assert "D=0.2\n" in run("curves", place(two)).out
    other = two.replace(" SET=Dynamic Section\n STIFFNESS=Clay", " SET=Static Section\n STIFFNESS=Clay")
    both = run("curves", place(other)).out
    assert "D=0.168" in both
    assert "D=0.2" in both


def test_stiffness_that_overflows_is_null(place: Place) -> None:
    deck = CLEAN.replace(" 0.5, 3000.0", " 0.5, 6.0E307").replace("0.5, 0.46, 7850.0", "0.05, 0.046, 7850.0")
    found = run("curves", place(deck), "--weight", "1.0E307", "--output-format", "json").json()
    assert_fits(found, "curves")
    assert found[0]["static"][0]["stiffness"][0]["stiffness"] is None
    assert "inf" in run("curves", place(deck)).out


# ----------------------------------------------------------------------- mudline curves --plot: a picture of the curves


SVG_TEXT = re.compile(r"<!-- (.*?) -->")


def drawn(place: Place, deck: str, *options: str) -> str:
    """The texts of the picture, and that it is well-formed."""
    outcome = run("curves", place(deck), "--plot", "out.svg", "--output-format", "json", *options)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.json()
    picture = Path("out.svg").read_text(encoding="utf-8")
    expat.ParserCreate().Parse(picture, True)
    return "\n".join(SVG_TEXT.findall(picture))


def test_axes_have_units_and_curves_names(place: Place) -> None:
    texts = drawn(place, UNUSED)
    assert "embedment ratio, depth / diameter [-]" in texts
    assert "per unit length [N/m]" in texts
    assert "Clay" in texts
    assert "Sand" in texts
    assert "beyond the points" in texts
    assert "static embedment" not in texts


def test_what_was_asked_for_is_marked(place: Place) -> None:
    texts = drawn(place, CLEAN, "--at", "2", "--at", "-0.2", "--weight", "700")
    assert "values asked for" in texts
    assert "static embedment" in texts


def test_curves_of_every_kind_are_listed(place: Place) -> None:
    name = place(CLEAN + OTHERS)
    outcome = run("curves", name, "--at", "1.5", "--output-format", "json")
    found = outcome.json()
    assert_fits(found, "curves")
    assert [(row["kind"], row["keyword"], row["name"], row["axes"]) for row in found] == [
        (SEABED, "SEABED STIFFNESS", "Clay", ["ratio", "force"]),
        ("current profile", "CURRENT", "PIECEWISE LINEAR", ["elevation", "velocity"]),
        ("moment-curvature curve", "MOMENT-CURVATURE", "Bend", ["curvature", "moment"]),
        ("soil spring curve", "P-Y", "Pipe, DEPTH=1.0", ["displacement", "resistance"]),
    ]
    assert found[2]["points"] == [[0.0, 0.0], [1.0, 4.0], [2.0, 5.0]]
    assert found[2]["at"] == [{"ratio": 1.5, "force": 4.5, "slope": 1.0, "segment": 1, "extrapolated": None}]
    text = run("curves", name, "--weight", "700").out
    assert "moment-curvature curve Bend (*MOMENT-CURVATURE): 3 points, no page says what it is beyond them\n" in text
    assert text.count("static embedment") == 1
    assert len(rows(run("curves", name, "--weight", "700", "--output-format", "csv").out)) == 2
    assert {tuple(row[-3:]) for row in rows(run("curves", name, "--output-format", "csv").out)[1:]} == {
        tuple(AXES),
        ("current profile", "elevation [m]", "velocity [m/s]"),
        ("moment-curvature curve", "curvature [1/m]", "moment [N m]"),
        ("soil spring curve", "displacement [m]", "resistance [N/m]"),
    }


def values_beyond(place: Place, deck: str, at: str) -> list[tuple[str, float | None, str | None]]:
    outcome = run("curves", place(deck), "--at", at, "--output-format", "json")
    assert_fits(outcome.json(), "curves")
    return [(row["name"], row["at"][0]["force"], row["at"][0]["extrapolated"]) for row in outcome.json()[1:]]


def test_ends_are_continued_only_where_a_page_says_so(place: Place) -> None:
    deck = CLEAN + OTHERS.replace(" 3.0, 2.0\n", " 3.0, 2.0\n 4.0, 3.0\n")
    assert values_beyond(place, deck, "400") == [
        ("PIECEWISE LINEAR", None, "above"),  # 100 m above its last point
        ("Bend", None, "above"),
        ("Pipe, DEPTH=1.0", 4.0, "above"),  # a soil yields
    ]
    assert values_beyond(place, deck, "-1") == [
        ("PIECEWISE LINEAR", None, "below"),
        ("Bend", None, "below"),
        ("Pipe, DEPTH=1.0", None, "below"),
    ]
    text = run("curves", place(LINEAR + OTHERS)).out
    assert "beyond the last it keeps its value (inferred)" in text
    assert "with the slope of its end segment" not in text
    assert "[m/s per m]" in text


@pytest.mark.parametrize(
    ("option", "points", "inside", "above"),
    [
        ("", " 0.0, 0.1\n 2000.0, 2.1\n", "1000", "1300"),
        (",OPTION=DESCEND", " -800.0, 2.1\n 1200.0, 0.1\n", "200", "-9"),
    ],
)
def test_a_current_ends_at_the_surface(place: Place, option: str, points: str, inside: str, above: str) -> None:
    water = "*OCEAN\n 1200.0, 1025.0, 9.81\n"
    deck = f"{CLEAN}{water}$LOAD CASE\n*CURRENT\n TYPE=PIECEWISE LINEAR{option}\n{points}"
    ((name, velocity, side),) = values_beyond(place, deck, inside)
    assert (name, side) == ("PIECEWISE LINEAR", None)
    assert velocity == pytest.approx(1.1)
    assert values_beyond(place, deck, above)[0][1] is None
    assert "above the surface" in run("curves", place(deck)).out


def test_every_kind_has_axes_of_its_own(place: Place) -> None:
    texts = drawn(place, CLEAN + OTHERS)
    for words in (
        "Force-embedment curves",
        "Moment-curvature curves (*MOMENT-CURVATURE)",
        "curvature",
        "moment",
        "Bend",
        "Clay",
    ):
        assert words in texts


def test_many_diameters(place: Place) -> None:
    count = 5
    nodes = "".join(f" {n}, 0.0, {n}.0\n" for n in range(1, count + 2))
    elements = "".join(f" {n}, {n}, {n + 1}\n" for n in range(1, count + 1))
    sets = "".join(f" SET=S{n}\n {n}\n" for n in range(1, count + 1))
    sections = "".join(f" SET=S{n}\n 2.0E11, 8.0E10, {n}.5, 0.1, 7850.0\n" for n in range(1, count + 1))
    deck = (
        f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{elements}*ELEMENT SETS\n{sets}*GEOMETRIC SETS\n OPTION=RIGID\n{sections}"
        "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n*SEABED STIFFNESS\n CURVE=Clay\n 0, 0\n 1, 9\n"
    )
    outcome = run("curves", place(deck))
    assert "D=1.5" in outcome.out
    assert "D=5.5" in outcome.out
    assert "D=2.5" not in outcome.out
    assert "5 diameters follow this curve: -v shows all\n" in outcome.out
    assert "D=2.5" in run("curves", place(deck), "-v").out


@pytest.mark.parametrize("option", ["--at", "--weight"])
@pytest.mark.parametrize("value", ["nan", "inf", "1e400"])
def test_value_that_is_no_number(place: Place, option: str, value: str) -> None:
    outcome = run("curves", place(), option, value)
    assert (outcome.code, outcome.out) == (2, "")
    assert ("mudline: no " if option == "--at" else "greater than 0 and finite") in outcome.err
