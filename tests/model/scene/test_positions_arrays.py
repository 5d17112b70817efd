"""Positions of nodes from NPY and NPZ."""

from __future__ import annotations

import io
import os
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from mudline.language.diagnostics import DeckError
from mudline.model.scene.given_positions import require_order
from mudline.model.scene.positions import StepFile, read_positions
from tests.helpers.builders.scenes import legal_scene
from tests.model.results.test_warnings import pipe
from tests.model.scene.file_nodes import NODES, assert_same, refusal

STATE = np.arange(9, dtype=np.float64).reshape(3, 3)
SERIES = np.arange(36, dtype=np.float64).reshape(4, 3, 3)


def saved(tmp_path: Path, **arrays: NDArray[Any]) -> Path:
    np.savez(tmp_path / "p.npz", **arrays)  # type: ignore[arg-type]
    return tmp_path / "p.npz"


def one(tmp_path: Path, array: NDArray[Any]) -> Path:
    np.save(tmp_path / "p.npy", array, allow_pickle=True)
    return tmp_path / "p.npy"


# ----------------------------------------------------------------------------------------------------------------- NPY


def test_series_is_read_when_it_is_asked_for(tmp_path: Path) -> None:
    found = read_positions(one(tmp_path, SERIES), NODES)
    assert isinstance(found.values, StepFile)
    assert_same(found, SERIES)
    assert np.array_equal(found.values[1:3], SERIES[1:3])
    assert np.array_equal(found.values[2], SERIES[2])
    assert found.values[4:9].shape == (0, 3, 3)
    assert found.time is not None
    assert found.time.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert found.missing == 0


def test_a_file_that_becomes_shorter_is_refused(tmp_path: Path) -> None:
    path = one(tmp_path, SERIES)
    found = read_positions(path, NODES)
    os.truncate(path, path.stat().st_size - 100)
    assert np.array_equal(found.values[0:2], SERIES[:2])
    with pytest.raises(DeckError, match="has become shorter while it was read: wait until it is written"):
        found.values[2:4]


@pytest.mark.parametrize("kind", ["f4", "f8", ">f8", "i4", "u2"])
def test_kinds_of_numbers(tmp_path: Path, kind: str) -> None:
    found = read_positions(one(tmp_path, STATE.astype(kind)), NODES)
    assert found.values.dtype.kind == "f"
    assert np.array_equal(found.values[0], STATE)


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros((2, 3)), "positions has the shape (2, 3), expected (steps, 3, 3) or (3, 3)"),
        (np.zeros((4, 2, 3)), "positions has the shape (4, 2, 3), expected (steps, 3, 3) or (3, 3)"),
        (np.zeros((3, 2)), "positions has the shape (3, 2), expected (steps, 3, 3) or (3, 3)"),
        (np.zeros(9), "positions has the shape (9,), expected (steps, 3, 3) or (3, 3)"),
        (np.zeros(()), "positions has the shape (), expected (steps, 3, 3) or (3, 3)"),
        (np.zeros((0, 3, 3)), "positions holds no time step"),
        (np.zeros((3, 3), dtype=np.complex128), "positions holds complex128, expected numbers"),
        (np.zeros((3, 3), dtype=np.bool_), "positions holds bool, expected numbers"),
        (np.full((3, 3), "x"), "positions holds <U1, expected numbers"),
    ],
)
def test_array_that_does_not_fit(tmp_path: Path, array: NDArray[Any], message: str) -> None:
    assert refusal(one(tmp_path, array)).message == message


def test_objects_are_refused(tmp_path: Path) -> None:
    found = refusal(one(tmp_path, np.array([[{}, 1], [2, 3]], dtype=object)))
    assert found.message.startswith("not an NPY array: ")


def test_array_that_python_2_wrote(tmp_path: Path) -> None:
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (3L, 3L), }\n"
    data = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + STATE.tobytes()
    (tmp_path / "p.npy").write_bytes(data)
    assert_same(read_positions(tmp_path / "p.npy", NODES), STATE[np.newaxis])


def test_array_that_claims_too_much(tmp_path: Path) -> None:
    path = one(tmp_path, STATE)
    data = path.read_bytes().replace(b"(3, 3), }" + b" " * 20, b"(3, 3, 99999999999999), }    ")
    path.write_bytes(data)
    assert refusal(path).message.startswith("not an NPY array: ")


# ----------------------------------------------------------------------------------------------------------------- NPZ


def test_archive_of_all_nodes(tmp_path: Path) -> None:
    found = read_positions(saved(tmp_path, positions=SERIES), NODES)
    assert_same(found, SERIES)
    assert found.time is not None
    assert found.time.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert found.velocities is None


def test_archive_of_one_state_at_a_time(tmp_path: Path) -> None:
    found = read_positions(saved(tmp_path, positions=STATE, time=np.array(2.5)), NODES)
    assert found.time is not None
    assert found.time.tolist() == [2.5]


def test_archive_of_some_nodes_in_its_own_order(tmp_path: Path) -> None:
    given_nodes, times = np.array([30, 10]), np.array([0.0, 0.5, 1.5, 2.0])
    path = saved(tmp_path, positions=SERIES[:, :2], node=given_nodes, time=times, velocities=-SERIES[:, :2])
    found = read_positions(path, NODES)
    assert found.present.tolist() == [True, False, True]
    assert found.time is not None
    assert found.time.tolist() == times.tolist()
    assert np.array_equal(found.whole[:, 2], SERIES[:, 0])
    assert np.array_equal(found.whole[:, 0], SERIES[:, 1])
    assert np.isnan(found.whole[:, 1]).all()
    assert found.velocities is not None
    assert np.array_equal(found.velocities[:, 2], -SERIES[:, 0])


ARCHIVES = {
    "nothing": ({}, "no array named positions, only nothing"),
    "other names": ({"x": STATE}, "no array named positions, only x"),
    "unknown": (
        {"positions": STATE, "colour": STATE},
        "unknown arrays: colour; expected node, positions, time, velocities",
    ),
    "shape": ({"positions": SERIES[:, :2]}, "positions has the shape (4, 2, 3), expected (steps, 3, 3) or (3, 3)"),
    "few nodes": (
        {"positions": SERIES, "node": np.array([10, 20])},
        "positions has the shape (4, 3, 3), expected (steps, 2, 3) or (2, 3)",
    ),
    "unknown node": (
        {"positions": SERIES, "node": np.array([10, 20, 31])},
        "node 31 is not defined in the deck",
    ),
    "node twice": ({"positions": SERIES, "node": np.array([10, 20, 10])}, "a node is listed twice in the array node"),
    "no node number": (
        {"positions": SERIES, "node": np.array([10, 20, 30.5])},
        "node: 30.5 is not a whole number up to 2^53",
    ),
    "node nan": ({"positions": SERIES, "node": np.array([10, 20, np.nan])}, "node holds nan, expected finite numbers"),
    "node text": ({"positions": SERIES, "node": np.array(["a", "b", "c"])}, "node holds <U1, expected numbers"),
    "times": ({"positions": SERIES, "time": np.zeros(3)}, "time has the shape (3,), expected (4,)"),
    "times in a column": (
        {"positions": SERIES, "time": np.zeros((4, 1))},
        "time has the shape (4, 1), expected (4,)",
    ),
    "one time of many steps": ({"positions": SERIES, "time": np.array(1.0)}, "time has the shape (), expected (4,)"),
    "nodes in a column": (
        {"positions": SERIES, "node": np.array([[10], [20], [30]])},
        "node has the shape (3, 1), expected one axis",
    ),
    "one node": ({"positions": SERIES, "node": np.array(10)}, "node has the shape (), expected one axis"),
    "time inf": ({"positions": SERIES, "time": np.array([0, 1, 2, np.inf])}, "time holds inf, expected finite numbers"),
    "velocities": (
        {"positions": SERIES, "velocities": STATE},
        "velocities has the shape (3, 3), expected (4, 3, 3)",
    ),
    "no step": ({"positions": SERIES[:0]}, "positions holds no time step"),
}


@pytest.mark.parametrize(("arrays", "message"), ARCHIVES.values(), ids=ARCHIVES)
def test_archive_that_does_not_fit(tmp_path: Path, arrays: dict[str, NDArray[Any]], message: str) -> None:
    assert refusal(saved(tmp_path, **arrays)).message == message


def test_objects_in_an_archive_are_refused(tmp_path: Path) -> None:
    found = refusal(saved(tmp_path, positions=np.array([{}], dtype=object)))
    assert found.message.startswith("not an NPZ archive: Object arrays cannot be loaded")


def test_member_that_is_no_array(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "p.npz", "w") as archive:
        archive.writestr("positions.npy", b"no array")
    assert refusal(tmp_path / "p.npz").message.startswith("not an NPZ archive: ")


def archive_bytes(*, compressed: bool) -> bytes:
    stream = io.BytesIO()
    save = np.savez_compressed if compressed else np.savez
    save(stream, positions=SERIES, time=np.arange(4.0), node=np.array([10, 20, 30]))
    return stream.getvalue()


WHOLE = [archive_bytes(compressed=True), archive_bytes(compressed=False)]


@given(data=st.data())
def test_damaged_archive_is_read_or_refused(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    body = bytearray(data.draw(st.sampled_from(WHOLE)))
    for _ in range(data.draw(st.integers(1, 5))):
        body[data.draw(st.integers(0, len(body) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.getbasetemp() / "any.npz"
    path.write_bytes(body[: data.draw(st.integers(0, len(body)))] if data.draw(st.booleans()) else body)
    try:
        found = read_positions(path, NODES)
    except (DeckError, OSError) as error:
        assert str(error)  # noqa: PT017 - either outcome is right
    else:
        assert found.values.shape[1:] == (3, 3)


def test_an_array_that_promises_more_than_there_is(tmp_path: Path) -> None:
    """A small archive must not make the program take memory for numbers that it does not hold."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": "<f8", "fortran_order": False, "shape": (10**6, 10**6, 3)})
    with zipfile.ZipFile(tmp_path / "p.npz", "w") as archive:
        archive.writestr("positions.npy", head.getvalue() + bytes(80))
    assert "the array positions of 24000000000000 bytes has only" in refusal(tmp_path / "p.npz").message


# --------------------------------------------------------------------------------------------------------------- order


@pytest.mark.parametrize("form", ["npy", "npz", "series"])
def test_without_numbers_nodes_are_in_ascending_order_of_them(tmp_path: Path, form: str) -> None:
    scene = legal_scene(pipe(""))
    assert scene.node_ids.tolist() == [1, 11, *range(2, 11)]
    ascending = scene.coordinates[np.argsort(scene.node_ids)]
    given_steps = np.stack([ascending, ascending + 1.0])
    if form == "npz":
        path = saved(tmp_path, positions=given_steps, velocities=given_steps)
    else:
        path = one(tmp_path, given_steps if form == "series" else ascending)
    found = require_order(read_positions(path, scene.nodes), scene, path.as_posix())
    assert np.array_equal(found.values[0], scene.coordinates)
    assert np.array_equal(found.values[len(found.values) - 1], scene.coordinates + (form != "npy"))
    if form == "npz":
        assert found.velocities is not None
        assert np.array_equal(found.velocities[1], scene.coordinates + 1.0)


def test_another_order_is_refused_by_its_name(tmp_path: Path) -> None:
    scene = legal_scene(pipe(""))
    path = one(tmp_path, scene.coordinates)
    with pytest.raises(DeckError) as refused:
        require_order(read_positions(path, scene.nodes), scene, path.as_posix())
    assert refused.value.diagnostics[0].message == (
        "the positions are not in ascending order of the node numbers: nodes 1 and 2 of element 1 are 100 apart, and "
        "its length is 10 (2 of 10 elements differ by over 1.5 times); sort them, or give their numbers in a CSV, or "
        "in the array node of an NPZ"
    )
    numbered = saved(tmp_path, positions=scene.coordinates, node=scene.node_ids)
    assert require_order(read_positions(numbered, scene.nodes), scene, "").numbered
