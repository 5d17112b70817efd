"""`--columns`: positions from a CSV of another program, by its own headings."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.cli.evaluate_inputs import read_headings
from tests.cli.conftest import Place
from tests.cli.runner import Json, Outcome, run

OWN = "time,node,x,y,z\n0.0,1,-0.1,0.0,0.0\n0.0,2,-0.2,10.0,1.0\n0.0,3,0.3,20.0,2.0\n"
LONG = """\
Time [s],Node Number,"Position, X [m]",Position Y,Position Z,Remark
0.0,1,-0.1,0.0,0.0,anchor
0.0,2,-0.2,10.0,1.0,
0.0,3,0.3,20.0,2.0,
"""
MAPPED = 'time="Time [s]",node=node number,x="Position, X [m]",y=Position Y,z=Position Z'


def evaluated(deck: str, text: str, *columns: str) -> Outcome:
    Path("p.csv").write_text(text, encoding="utf-8")
    given = [word for one in columns for word in ("--columns", one)]
    return run("evaluate", deck, "--positions", "p.csv", *given, "-q", "--output-format", "json")


@pytest.fixture
def own(place: Place) -> Json:
    """What the same positions give under the names that are asked for."""
    return evaluated(place(), OWN).json()


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        (LONG, [MAPPED]),
        (LONG, ["time=Time [s],node=Node Number", "x=Position, X [m]", "y=Position Y,z=Position Z"]),
        (LONG.replace(",", ";").replace("n; X", "n, X"), [MAPPED]),
        (LONG.replace('"', "").replace("n, X", "n X").replace(",", "\t"), [MAPPED.replace("n, X", "n X")]),
        (OWN.replace("node", "Punkt").replace("time", "Time"), ["node=Punkt"]),
        ("\ufeff" + LONG, [MAPPED]),
        (LONG.replace("\n", "\r\n"), [MAPPED]),
        ("t,n,Z,X,Y\n0.0,1,-0.1,0.0,0.0\n0.0,2,-0.2,10.0,1.0\n0.0,3,0.3,20.0,2.0\n", ["time=t,node=n,x=Z,y=X,z=Y"]),
    ],
    ids=["quoted", "repeated", "semicolons", "tabs", "one", "mark", "windows", "axes"],
)
def test_other_headings(own: Json, place: Place, text: str, columns: list[str]) -> None:
    outcome = evaluated(place(), text, *columns)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.json() == own


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ("tme=T", "--columns: 'tme' is not a column of positions: use time, node, x, y, z, vx, vy or vz"),
        ("node", "--columns 'node': expected NAME=HEADING"),
        ("node=", "--columns 'node=': expected NAME=HEADING"),
        ("", "--columns '': expected NAME=HEADING"),
        ("x=A,x=B", "--columns gives x twice"),
    ],
)
def test_columns_that_are_misspelt(place: Place, columns: str, message: str) -> None:
    outcome = evaluated(place(), LONG, columns)
    assert (outcome.code, outcome.out) == (2, "")
    assert f"mudline: {message}" in outcome.err


@pytest.mark.parametrize(
    ("text", "columns", "message"),
    [
        (
            LONG,
            MAPPED.replace("node number", "Node"),
            "p.csv:1:1: error: DAT001 the header lacks 'Node' for node: it has 'Time [s]', 'Node Number', 'Position, X",
        ),
        (OWN, "node=node,x=y", "p.csv:1:1: error: DAT001 the column 'y' is taken for x and for y"),
        (OWN.replace("time", "z"), "node=node", "p.csv:1:1: error: DAT001 the header has 'z' twice"),
        (
            LONG.replace("Position Z", "z").replace("-0.2,10.0", "-0;2,10.0"),
            MAPPED.replace("Position Z", "z"),
            "p.csv:3:7: error: DAT001 x: '-0;2' is not a number",
        ),
        ("", "node=n", "p.csv:1:1: error: DAT001 the header lacks 'n' for node: it has nothing"),
    ],
)
def test_headings_that_the_file_lacks(place: Place, text: str, columns: str, message: str) -> None:
    outcome = evaluated(place(), text, columns)
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith(message)


def test_long_headers_are_cut_in_messages(place: Place) -> None:
    header = ",".join(f"c{number}" for number in range(20))
    assert "'c9' and 10 more" in evaluated(place(), f"{header}\n", "node=n").err


def test_columns_are_for_positions_from_csv(place: Place) -> None:
    outcome = run("evaluate", place(), "--columns", "node=n")
    assert outcome.code == 2
    assert "--columns is for positions from a CSV: give --positions too" in outcome.err
    outcome = run("evaluate", place(), "--columns", "node=n", "--positions", "p.npz")
    assert outcome.code == 2
    assert "--columns is for CSV: the arrays of p.npz have names already" in outcome.err


def test_columns_of_many_decks(place: Place) -> None:
    Path("p.csv").write_text(LONG, encoding="utf-8")
    decks = [place(name=name) for name in ("a.keyxm", "b.keyxm")]
    found = run(
        "batch", *decks, "-o", "out", "--positions", "p.csv", "--columns", MAPPED, "-q", "--output-format", "json"
    )
    assert [row["reason"] for row in found.json()] == [None, None]


def test_headings_are_read_with_commas_and_equals_signs() -> None:
    assert read_headings([" X = a, b , node=c=d", 'y="e,z=f"']) == {"x": "a, b", "node": "c=d", "y": "e,z=f"}
