"""Positions from files of MoorDyn and OrcaFlex, in the axes of the deck."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mudline.language.diagnostics import DeckError
from mudline.model.contact.arrays import Positions
from mudline.model.scene.numbering import Floats
from mudline.tools.exporting import moordyn
from mudline.tools.exporting.line_model import LineModel
from mudline.tools.exporting.returned import read_returned
from tests.cli.runner import run
from tests.tools.exporting.decks import model_of, text

TWO = text(
    sets="*ELEMENT SETS\n SET=First\n GEN=1, 4\n",
    sections=" OPTION=MOORING\n SET=ALL\n 1.0E8, 50.0, 0.1\n SET=First\n 1.0E8, 60.0, 0.1\n",
)


def lowered(places: Floats, by: float) -> Floats:
    found: Floats = places - np.array([0.0, 0.0, by])
    return found


def line_file(path: Path, places: Floats, times: tuple[float, ...] = (0.0, 0.5)) -> None:
    """A file as MoorDyn writes it, with tensions behind the places."""
    names = [f"Node{node}p{axis}" for node in range(len(places)) for axis in "xyz"]
    rows = ["  ".join(["Time", *names, "Seg1Te"]), "  ".join(["(s)", *["(m)"] * len(names), "(N)"])]
    rows += ["  ".join(f"{value:.7e}" for value in (time, *lowered(places, time).ravel(), 1e3)) for time in times]
    path.write_text("\n".join(rows) + "\n")


def straight(length: float, nodes: int, start: float = 0.0) -> Floats:
    return np.column_stack([np.linspace(start, start + length, nodes), np.full(nodes, 2.0), np.full(nodes, -100.01)])


def read(path: Path, model: LineModel) -> Positions:
    found = read_returned(path, model.scene)
    assert found is not None
    return found


def test_a_line_of_moordyn_in_the_axes_of_the_deck(tmp_path: Path) -> None:
    model = model_of(text())
    line_file(tmp_path / "run_Line1.out", straight(50.0, 11))
    found = read(tmp_path / "run_Line1.out", model)
    assert found.time is not None
    assert found.time.tolist() == [0.0, 0.5]
    assert found.present.all()
    order = np.argsort(model.scene.node_ids)
    expected = np.column_stack([np.full(11, -0.01), np.linspace(0.0, 50.0, 11), np.full(11, 2.0)])
    assert found.whole[0][order] == pytest.approx(expected, abs=1e-6)
    assert found.whole[1][order] == pytest.approx(expected - [0.5, 0.0, 0.0], abs=1e-6)


def test_other_nodes_are_taken_by_arc_length_in_feet(tmp_path: Path) -> None:
    model = model_of(text(), "deck.keyxi")
    line_file(tmp_path / "a_Line1.out", lowered(straight(50.0 * 0.3048, 4), 30.48 - 100.01))
    found = read(tmp_path / "a_Line1.out", model).whole[0]
    assert found[np.argsort(model.scene.node_ids), 1] == pytest.approx(np.linspace(0.0, 50.0, 11), abs=1e-5)
    assert found[:, 0] == pytest.approx(np.zeros(11), abs=1e-5)


def test_the_files_of_the_other_lines_are_read_too(tmp_path: Path) -> None:
    model = model_of(TWO)
    assert [len(part.lengths) for part in moordyn.pieces(model)[0]] == [4, 6]
    line_file(tmp_path / "run_Line1.out", straight(20.0, 5))
    assert read(tmp_path / "run_Line1.out", model).missing == 6
    line_file(tmp_path / "run_Line2.out", straight(30.0, 7, 20.0))
    found = read(tmp_path / "run_Line2.out", model)
    assert found.missing == 0
    assert np.sort(found.whole[0, :, 1]) == pytest.approx(np.linspace(0.0, 50.0, 11), abs=1e-5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda path: path.write_text(path.read_text().replace("5.0000000e-01", "soon")),
            "a row of numbers was expected",
        ),
        (lambda path: path.write_text(path.read_text() + "1.0 2.0\n"), "2 values, the header has 35"),
        (lambda path: path.write_text("\n".join(path.read_text().split("\n")[:2])), "no rows"),
    ],
)
def test_a_damaged_file_is_named_with_its_line(change: object, message: str, tmp_path: Path) -> None:
    path = tmp_path / "run_Line1.out"
    line_file(path, straight(50.0, 11))
    assert callable(change)
    change(path)
    with pytest.raises(DeckError, match=message):
        read(path, model_of(text()))


def test_files_that_do_not_go_together_are_refused(tmp_path: Path) -> None:
    line_file(tmp_path / "run_Line1.out", straight(20.0, 5))
    line_file(tmp_path / "run_Line2.out", straight(30.0, 7, 20.0), (0.0, 1.0))
    with pytest.raises(DeckError, match="other times than in the file of line 1"):
        read(tmp_path / "run_Line1.out", model_of(TWO))
    line_file(tmp_path / "run_Line3.out", straight(30.0, 7))
    with pytest.raises(DeckError, match="line 3: the deck is exported as 2 lines"):
        read(tmp_path / "run_Line3.out", model_of(TWO))
    line_file(tmp_path / "places.out", straight(30.0, 7))
    with pytest.raises(DeckError, match="ends in _Line and its number"):
        read(tmp_path / "places.out", model_of(TWO))


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("by", ["Node", "Arc Length (m)"])
def test_a_table_of_orcaflex(separator: str, by: str, tmp_path: Path) -> None:
    model = model_of(text())
    rows = [separator.join(["Time (s)", by, "X (m)", "Y (m)", "Z (m)", "Curvature (1/m)"])]
    for time in (0.0, 1.0):
        for node in range(11):
            at = node + 1 if by == "Node" else 5.0 * node
            rows.append(separator.join(map(str, (time, at, 5.0 * node, 1.0, -100.0 - 0.01 * time, 0.0))))
    (tmp_path / "table.csv").write_text("\n".join(rows))
    found = read(tmp_path / "table.csv", model)
    assert found.time is not None
    assert found.time.tolist() == [0.0, 1.0]
    places = found.whole[1][np.argsort(model.scene.node_ids)]
    assert places == pytest.approx(np.column_stack([np.full(11, -0.01), np.linspace(0, 50, 11), np.ones(11)]))


def table(path: Path, nodes: int) -> Path:
    rows = ["Node,X (m),Y (m),Z (m)", *(f"{node + 1},{node},0.0,-100.0" for node in range(nodes))]
    path.write_text("\n".join(rows))
    return path


def test_tables_that_fit_no_line_are_refused(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="7 nodes, the exported line has 11: give a table with the column Arc length"):
        read(table(tmp_path / "a.csv", 7), model_of(text()))
    held = text() + "".join(f" 6, {freedom}\n" for freedom in (1, 2, 3))
    with pytest.raises(DeckError, match="the deck has 2 lines, and the table does not say whose"):
        read(table(tmp_path / "a.csv", 11), model_of(held))
    (tmp_path / "a.csv").write_text("Time (s),Node,X (m),Y (m),Z (m)\n0,1,0,0,0\n0,2,1,0,0\n1,1,0,0,0\n")
    with pytest.raises(DeckError, match="each time must have a row for each node"):
        read(tmp_path / "a.csv", model_of(text()))
    (tmp_path / "a.csv").write_text("Node,X (m),Y (m),Z (m)\n")
    with pytest.raises(DeckError, match="each time must have a row for each node"):
        read(tmp_path / "a.csv", model_of(text()))


def test_evaluate_takes_such_a_file_and_columns_go_before(tmp_path: Path) -> None:
    deck, places = tmp_path / "deck.keyxm", tmp_path / "run_Line1.out"
    deck.write_text(text())
    line_file(places, straight(50.0, 11), (0.0,))
    outcome = run("evaluate", str(deck), "-q", "--positions", str(places), "--output-format", "json")
    assert outcome.code == 0
    (step,) = outcome.json()["steps"]
    assert [element["depth"] for element in step["elements"]] == pytest.approx([0.01] * 10, abs=1e-6)
    assert [element["force"] for element in step["elements"]] == pytest.approx([200.0] * 10, abs=0.1)
    other = table(tmp_path / "a.csv", 11)
    columns = "node=Node,x=Z (m),y=X (m),z=Y (m)"
    outcome = run(
        "evaluate", str(deck), "-q", "--positions", str(other), "--columns", columns, "--output-format", "json"
    )
    assert {element["depth"] for element in outcome.json()["elements"]} == {100.0}
