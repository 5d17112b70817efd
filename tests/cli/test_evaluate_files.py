"""`mudline evaluate` with positions and elements from files, and results to files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mudline.cli.evaluate_inputs import read_headings
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Json, Outcome, assert_fits, run
from tests.helpers.builders.decks import STEPS_WARNING

STEPS = """\
time,node,x,y,z
0.0,1,-0.1,0.0,0.0
0.0,2,-0.1,10.0,0.0
0.0,3,0.3,20.0,0.0
2.5,1,-0.05,0.0,0.0
2.5,2,-0.05,10.0,0.0
2.5,3,-0.05,20.0,0.0
"""
SCR = SAMPLES / "scr-touchdown.keyxm"
LINES = (SAMPLES / "lines-deck.keyxm", "--elements", SAMPLES / "elements.csv")


@pytest.fixture
def steps(folder: Path) -> str:
    (folder / "steps.csv").write_text(STEPS, encoding="utf-8")
    return "steps.csv"


def test_steps(place: Place, steps: str) -> None:
    outcome = run("evaluate", place(), "--positions", steps, "--output-format", "json")
    found = outcome.json()
    assert (outcome.code, outcome.err) == (0, STEPS_WARNING)
    assert_fits(found, "evaluate")
    assert set(found) == {"format", "units", "plan", "steps", "summary", "positions", "contents_case", "warnings"}
    assert [step["time"] for step in found["steps"]] == [0.0, 2.5]
    first, second = found["steps"]
    single = run("evaluate", place(), "--output-format", "json").json()
    assert (first["elements"], first["nodes"]) == (single["elements"], single["nodes"])
    assert [element["ratio"] for element in second["elements"]] == [0.1, 0.1]
    assert [element["force"] for element in second["elements"]] == [1000.0, 1000.0]


def test_text_of_many_steps(place: Place, folder: Path) -> None:
    rest = np.repeat(np.array([[[9.0, 0, 0], [9.0, 10, 0], [9.0, 20, 0]]]), 50, axis=0)
    np.save(folder / "steps.npy", rest)
    lines = run("evaluate", place(), "--positions", "steps.npy").out.splitlines()
    assert "10 more steps: -v shows all, -o writes all" in lines
    assert lines[5].split() == ["0", "0", "-9", "0"]
    assert len(run("evaluate", place(), "--positions", "steps.npy", "-v").out.splitlines()) == 71


def test_written_csv_has_tables_of_nodes_and_lines_beside_it(place: Place, steps: str, folder: Path) -> None:
    outcome = run("evaluate", place(), "--positions", steps, "-o", "out.csv")
    assert (outcome.code, outcome.out) == (0, "")
    assert outcome.err == (
        f"{STEPS_WARNING}mudline: nodes -> out-nodes.csv\nmudline: summary -> out-summary.csv\n"
        "mudline: deck.keyxm -> out.csv\n"
    )
    given = ("evaluate", place(), "--positions", steps)
    for table in ("elements", "nodes", "summary"):
        printed = run(*given, "--output-format", "csv", "--table", table)
        name = "out.csv" if table == "elements" else f"out-{table}.csv"
        assert (folder / name).read_bytes() == printed.output
    assert run(*given, "-o", "out.json", "-q").err == ""
    assert (folder / "out.json").read_bytes() == run(*given, "--output-format", "json").output


def test_nodes_of_steps_are_shown(place: Place, steps: str) -> None:
    outcome = run("evaluate", place(), "--positions", steps, "--table", "nodes")
    table = outcome.out.split("\n\n")[0].splitlines()
    assert table[1].split() == ["smallest", "largest", "total"]
    assert table[2].split() == ["time", "in", "first", "last", "gap", "on", "a", "node", "reaction"]
    first, second = (line.split() for line in table[5:7])
    assert first == ["0", "2", "1", "2", "-0.1", "7500", "15000"]
    assert (second[0], second[2:4]) == ("2.5", ["1", "3"])
    assert run("evaluate", place(), "--positions", steps).out.split("\n\n")[0] != outcome.out.split("\n\n")[0]


def test_positions_of_some_nodes(folder: Path) -> None:
    outcome = run("evaluate", SCR, "--positions", SAMPLES / "positions.csv", "--output-format", "json")
    assert outcome.code == 0
    assert "RUN007 no positions for 140 nodes: 140 elements (first: 1) are left out\n" in outcome.err
    found = outcome.json()
    assert_fits(found, "evaluate")
    assert {len(step["elements"]) for step in found["steps"]} == {60}
    assert {len(step["nodes"]) for step in found["steps"]} == {61}
    assert run("evaluate", SCR, "--positions", SAMPLES / "positions.csv", "-o", "out.npz", "-q").code == 0
    with np.load(folder / "out.npz", allow_pickle=False) as archive:
        assert archive["force"].shape == (8, 60)
        assert archive["reaction"].shape == (8, 61, 3)
        assert not np.isnan(archive["force"]).any()
        expected = [[element["force"] for element in step["elements"]] for step in found["steps"]]
        assert np.array_equal(archive["force"], expected)
    lines = run("evaluate", SCR, "--positions", SAMPLES / "positions.csv", "--output-format", "csv").out.splitlines()
    assert len(lines) == 1 + 8 * 60


def test_positions_of_one_node_leave_nothing_to_evaluate(place: Place, folder: Path) -> None:
    (folder / "p.csv").write_text("time,node,x,y,z\n0,2,-0.1,0,0\n", encoding="utf-8")
    outcome = run("evaluate", place(), "--positions", "p.csv")
    assert outcome.code == 0
    assert outcome.err == (
        "mudline: warning: deck.keyxm:1: RUN007 no positions for 2 nodes: 2 elements (first: 1) are left out\n"
    )
    assert outcome.out.splitlines()[5].split() == ["0", "0", "0"]
    found = run("evaluate", place(), "--positions", "p.csv", "--output-format", "json").json()
    assert found["steps"][0]["elements"] == []
    (folder / "p.csv").write_text("node,x,y,z\n2,-0.1,0,0\n", encoding="utf-8")
    outcome = run("evaluate", place(), "--positions", "p.csv")
    assert (outcome.code, outcome.out.splitlines()[5:7]) == (0, ["", "No elements in contact"])


def test_elements_from_a_file_without_lengths(folder: Path) -> None:
    lines = (SAMPLES / "elements.csv").read_text(encoding="utf-8").splitlines()
    rows = [[*line.split(",")[:4], line.split(",")[5]] for line in lines]
    (folder / "bare.csv").write_text("".join(",".join(row) + "\n" for row in rows), encoding="utf-8")
    options = ("--elements", "bare.csv", "--positions", SAMPLES / "lines-positions.csv")
    outcome = run("evaluate", SAMPLES / "lines-deck.keyxm", *options)
    assert outcome.code == 0
    assert "mudline: the length of 80 elements comes from the first positions\n" in outcome.err

    plan = run("evaluate", SAMPLES / "lines-deck.keyxm", "--elements", "bare.csv", "--plan")
    assert (plan.code, plan.err) == (0, "")
    assert "80 elements on 1 force-embedment curve" in plan.out


def test_elements_from_a_file_have_no_coordinates() -> None:
    outcome = run("evaluate", *LINES)
    assert (outcome.code, outcome.out) == (1, "")
    assert "RUN001 81 nodes have no coordinates, node 1 is one: give them with --positions" in outcome.err


@pytest.mark.parametrize("option", ["--positions", "--elements"])
def test_file_with_a_fault(place: Place, folder: Path, option: str) -> None:
    (folder / "bad.csv").write_text("node,x,y\n1,2,3\n", encoding="utf-8")
    outcome = run("evaluate", place(), option, "bad.csv")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith("bad.csv:1:1: error: DAT001 the header lacks ")


# --------------------------------------------------------- positions from a CSV of another program, by its own headings


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


def test_headings_are_read_with_commas_and_equals_signs() -> None:
    assert read_headings([" X = a, b , node=c=d", 'y="e,z=f"']) == {"x": "a, b", "node": "c=d", "y": "e,z=f"}
