"""Positions of nodes from CSV."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.language.diagnostics import DeckError
from mudline.model.scene.positions import read_positions
from tests.model.scene.file_nodes import NODES, assert_same, numbered, refusal

NAN = float("nan")
ONE = "node,x,y,z\n30,7,8,9\n10,1,2,3\n20,4,5,6\n"
SERIES = "time,node,x,y,z\n0.5,10,1,2,3\n0.0,10,4,5,6\n0.5,20,7,8,9\n0.0,20,10,11,12\n"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "positions.csv"


def write(file: Path, text: str) -> Path:
    file.write_bytes(text.encode("utf-8"))
    return file


def test_one_state_in_the_order_of_the_deck(file: Path) -> None:
    found = read_positions(write(file, ONE), NODES)
    assert_same(found, np.array([[[1.0, 2, 3], [4, 5, 6], [7, 8, 9]]]))
    assert found.present.tolist() == [True, True, True]
    assert (found.time, found.velocities, found.missing) == (None, None, 0)


def test_series_is_sorted_by_time_and_may_lack_nodes(file: Path) -> None:
    found = read_positions(write(file, SERIES), NODES)
    none = [NAN, NAN, NAN]
    assert_same(found, np.array([[[4.0, 5, 6], [10, 11, 12], none], [[1, 2, 3], [7, 8, 9], none]]))
    assert found.time is not None
    assert found.time.tolist() == [0.0, 0.5]
    assert found.present.tolist() == [True, True, False]
    assert found.missing == 1


SPELLINGS = {
    "plain": ONE,
    "windows": ONE.replace("\n", "\r\n"),
    "mark": "\ufeff" + ONE,
    "no last end": ONE.rstrip("\n"),
    "blanks": ONE.replace(",", " , "),
    "columns": "z,Y,x,NODE\n9,8,7,30\n3,2,1,10\n6,5,4,20\n",
    "quotes": ONE.replace("4", '"4"').replace("node", '"node"'),
    "exponents": ONE.replace("7,8,9", "+7.,.8E1,9.0e+00"),
    "empty lines": ONE.replace("10,", "\n\n10,") + "\n\n,,,\n",
}


@pytest.mark.parametrize("text", SPELLINGS.values(), ids=SPELLINGS)
def test_spelling_does_not_matter(file: Path, text: str) -> None:
    assert_same(read_positions(write(file, text), NODES), np.array([[[1.0, 2, 3], [4, 5, 6], [7, 8, 9]]]))


FAULTS = {
    "empty": ("", 1, "the header lacks node, x, y, z: expected time,node,x,y,z,vx,vy,vz"),
    "header": ("node,x,y\n", 1, "the header lacks z: expected time,node,x,y,z,vx,vy,vz"),
    "unknown column": ("node,x,y,z,w\n", 1, "the header has 'w': expected time,node,x,y,z,vx,vy,vz"),
    "column twice": ("node,x,y,z,X\n", 1, "the header has x twice"),
    "no row": ("node,x,y,z\n\n", 2, "no row below the header"),
    "no number": ("node,x,y,z\n10,1,two,3\n", 2, "y: 'two' is not a number"),
    "nan": ("node,x,y,z\n10,1,nan,3\n", 2, "y: 'nan' is not a number"),
    "too large": ("node,x,y,z\n10,1,2,3\n20,1e400,2,3\n", 3, "x: '1e400' is not a number"),
    "empty field": ("node,x,y,z\n10,1,,3\n", 2, "y: '' is not a number"),
    "few fields": ("node,x,y,z\n\n10,1,2\n", 3, "3 fields, the header has 4"),
    "many fields": ("node,x,y,z\n10,1,2,3,4\n", 2, "5 fields, the header has 4"),
    "no node number": ("node,x,y,z\n10,1,2,3\n1.5,1,2,3\n", 3, "node: 1.5 is not a whole number up to 2^53"),
    "large node number": ("node,x,y,z\n1e300,1,2,3\n", 2, "node: 1e+300 is not a whole number up to 2^53"),
    "unknown node": ("node,x,y,z\n10,1,2,3\n11,1,2,3\n", 3, "node 11 is not defined in the deck"),
    "node twice": (ONE + "10,0,0,0\n", 5, "node 10 is given twice"),
    "node twice at a time": (SERIES + "0.5,10,0,0,0\n", 6, "node 10 is given twice at time 0.5"),
    "node missing": (SERIES + "0.5,30,0,0,0\n", 1, "node 30 is missing at time 0.0"),
    "last node missing": (SERIES + "0.0,30,0,0,0\n", 1, "node 30 is missing at time 0.5"),
    "velocities": ("node,x,y,z,vx,vy\n10,1,2,3,4,5\n", 1, "velocities need all of vx, vy and vz"),
    "not utf-8": ("node,x,y,z\n10,1,2,3\n\udcff", 1, "not a UTF-8 text file (invalid start byte at byte 20)"),
}


@pytest.mark.parametrize(("text", "line", "message"), FAULTS.values(), ids=FAULTS)
def test_fault_names_its_line(file: Path, text: str, line: int, message: str) -> None:
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    found = refusal(file)
    assert (found.message, found.line) == (message, line)


@pytest.mark.parametrize(
    ("text", "column"),
    [
        ("node,x,y,z\n10,1,two,3\n", 6),
        ("node,x,y,z\n10, 1,  two,3\n", 9),
        ("node,x,y,z\n10,1,2,\n", 8),
        ('node,x,y,z\n10,"1",two,3\n', 8),
        ('node,x,y,z\n10,"1,5",2,3\n', 1),
    ],
)
def test_fault_in_a_field_names_its_column(file: Path, text: str, column: int) -> None:
    found = refusal(write(file, text))
    assert (found.line, found.column) == (2, column)


def test_unknown_nodes_are_named_up_to_ten(file: Path) -> None:
    rows = "".join(f"{n},0,0,0\n" for n in range(112, 100, -1))
    found = refusal(write(file, f"node,x,y,z\n10,0,0,0\n{rows}"))
    named = "nodes 101, 102, 103, 104, 105, 106, 107, 108, 109, 110 and 2 more are not defined in the deck"
    assert (found.message, found.line) == (named, 3)


def test_sparse_series_does_not_fill_the_memory(file: Path) -> None:
    count = 3000
    rows = "".join(f"{n}.0,{n},0,0,0\n" for n in range(1, count + 1))
    tracemalloc.start()
    found = refusal(write(file, f"time,node,x,y,z\n{rows}"), numbered(list(range(1, count + 1))))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found.message == "node 2 is missing at time 1.0"
    assert peak < 20e6


ALPHABET = st.sampled_from([*"0123456789.,-+eE \n\r\t\"';xyz", "\x00", "\ufeff", "\u00e4", "node,x,y,z\n", "10,"])


@given(text=st.lists(ALPHABET, max_size=60).map("".join))
def test_any_text_is_read_or_refused(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    file = write(tmp_path_factory.getbasetemp() / "any.csv", "node,x,y,z\n" + text)
    try:
        found = read_positions(file, NODES)
    except DeckError as error:
        assert error.diagnostics[0].line >= 1  # noqa: PT017 - either outcome is right
    else:
        assert np.isfinite(found.whole[:, found.present]).all()
