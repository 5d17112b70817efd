"""Elements from a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError
from mudline.model.scene.csv_file import ExternalElements, read_external
from mudline.model.scene.model import resolve

HEADER = "element,node1,node2,diameter,length,sets"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "elements.csv"


def read(file: Path, text: str) -> ExternalElements:
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    return read_external(file)


def test_all_columns(file: Path) -> None:
    found = read(file, f"{HEADER}\n1,10,11,0.5,2.0,Riser;Upper Part\n3,11,12,,,Riser\n2,12,13,0.4,1.5,\n")
    assert found.file == file.as_posix()
    assert found.ids.tolist() == [1, 3, 2]
    assert found.nodes.tolist() == [[10, 11], [11, 12], [12, 13]]
    assert np.array_equal(found.diameter, [0.5, np.nan, 0.4], equal_nan=True)
    assert np.array_equal(found.length, [2.0, np.nan, 1.5], equal_nan=True)
    assert {name: ids.tolist() for name, ids in found.sets.items()} == {"Riser": [1, 3], "Upper Part": [1]}


def test_needed_columns_only(file: Path) -> None:
    found = read(file, "\ufeffnode2, Node1,DIAMETER,element\r\n2,1,0.5,7\r\n\r\n")
    assert found.ids.tolist() == [7]
    assert found.nodes.tolist() == [[1, 2]]
    assert np.isnan(found.length).all()
    assert found.sets == {}


def test_names_of_sets(file: Path) -> None:
    found = read(file, f'{HEADER}\n1,1,2,0.5,1," A ; ;B,C; "\n')
    assert list(found.sets) == ["A", "B,C"]


FAULTS = {
    "empty": ("", 1, "the header lacks element, node1, node2, diameter: expected " + HEADER),
    "header": ("element,node1,node2,Do\n", 1, "the header lacks diameter: expected " + HEADER),
    "unknown column": (HEADER + ",mass\n", 1, "the header has 'mass': expected " + HEADER),
    "column twice": ("element,node1,node2,diameter,node1\n", 1, "the header has node1 twice"),
    "no row": (HEADER + "\n", 2, "no row below the header"),
    "no number": (HEADER + "\n1,a,2,0.5,,\n", 2, "node1: 'a' is not a number"),
    "no whole number": (HEADER + "\n1,1,2,0.5,,\n2,1,2.5,0.5,,\n", 3, "node2: 2.5 is not a whole number up to 2^53"),
    "empty number": (HEADER + "\n,1,2,0.5,,\n", 2, "element: '' is not a number"),
    "large number": (HEADER + "\n1e300,1,2,0.5,,\n", 2, "element: 1e+300 is not a whole number up to 2^53"),
    "twice": (HEADER + "\n1,1,2,0.5,,\n\n1,2,3,0.5,,\n", 4, "element 1 is given twice"),
    "diameter": (HEADER + "\n1,1,2,0.0,,\n", 2, "diameter is 0.0: it must be greater than 0"),
    "length": (HEADER + "\n1,1,2,0.5,-1,\n", 2, "length is -1.0: it must be greater than 0"),
    "infinite": (HEADER + "\n1,1,2,inf,,\n", 2, "diameter: 'inf' is not a number"),
    "fields": (HEADER + "\n1,1,2\n", 2, "3 fields, the header has 6"),
    "not utf-8": (HEADER + "\n\udce4", 1, "not a UTF-8 text file (unexpected end of data at byte 41)"),
}


@pytest.mark.parametrize(("text", "line", "message"), FAULTS.values(), ids=FAULTS)
def test_fault_names_its_line(file: Path, text: str, line: int, message: str) -> None:
    with pytest.raises(DeckError) as caught:
        read(file, text)
    (found,) = caught.value.diagnostics
    assert (found.code, found.message, found.line) == ("DAT001", message, line)


def test_scene_takes_the_elements(file: Path) -> None:
    deck = load_bytes(
        b"$MODEL\n*LINES\n LINE=Riser\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Upper\n STIFFNESS=1000.0\n", "d.keyxm"
    )
    scene = resolve(deck, read(file, f"{HEADER}\n1,10,11,0.5,2.0,Riser\n2,11,12,0.4,3.0,Upper\n")).require()
    assert scene.element_ids.tolist() == [1, 2]
    assert scene.node_ids.tolist() == [10, 11, 12]
    assert scene.length.tolist() == [2.0, 3.0]
    assert scene.diameter.tolist() == [0.5, 0.4]
    assert scene.law_names == ["none", "linear"]
    assert np.isnan(scene.coordinates).all()


ALPHABET = st.sampled_from([*"0123456789.,-;eE \n\r\"'AB", "\x00", "\u00e4", "1,1,2,0.5,1,A\n"])


@example(text="\r\r0 1,1,2,0.5,1,A\n")
@given(text=st.lists(ALPHABET, max_size=60).map("".join))
def test_any_text_is_read_or_refused(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    try:
        found = read(tmp_path_factory.getbasetemp() / "any.csv", f"{HEADER}\n{text}")
    except DeckError as error:
        assert error.diagnostics[0].line >= 1  # noqa: PT017 - either outcome is right
    else:
        assert len(found.ids) == len(found.nodes) == len(found.diameter) > 0
