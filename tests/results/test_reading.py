"""Results written in every form and read again without their deck."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import mudline
from mudline.contact import ContactResult
from mudline.contact.columns import Column, ElementTable, NodeTable
from mudline.contact.result import Part
from mudline.results.evaluation import Evaluation, evaluate_scene
from mudline.results.forms import Output, form_module, form_names, table_path
from mudline.scene.positions import Positions
from tests.builders.decks import CLEAN, PULLING
from tests.samples import SAMPLES

EXTENSIONS = (
    "*SEABED FRICTION\n SET=Pipe\n COEFFICIENTS=0.5, 0.5\n STIFFNESS=1.0E5\n"
    "*SEABED SUCTION\n SET=Pipe\n COHESION=4000.0\n"
)
RIGID = CLEAN.partition("*SEABED PROPERTIES")[0] + "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
HOSTILE = CLEAN.replace("SET=Pipe", 'SET=@1+1 "x"').replace("Clay", "+Löss <b>")
BED = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000\n"
FORMS = form_names()
_NOT_KEPT = frozenset({"given", "regularised", "times"})


def scene_of(text: str) -> mudline.Scene:
    return mudline.from_keyword(text).scene()


def moved(scene: mudline.Scene, steps: int, present: tuple[int, ...] | None = None) -> Positions:
    """A line that goes up and down by odd amounts; `present` are the indices of the nodes that have positions."""
    values = np.repeat(scene.coordinates[np.newaxis], steps, axis=0)
    values[:, :, 0] += 0.1 * np.sin(1.7 * np.arange(steps))[:, np.newaxis] / 3.0
    mask = np.ones(len(scene.node_ids), np.bool_)
    if present is not None:
        mask[:] = False
        mask[list(present)] = True
        values[:, ~mask] = np.nan
    return Positions(values, mask, np.cumsum(np.linspace(0.1, 0.7, steps)))


def written(evaluation: Evaluation, path: Path) -> Path:
    """Write an evaluation in the form of the suffix, as the command does."""
    form = form_module(path.suffix[1:])
    streams = [one.open("wb") for one in (path, *(table_path(path, table) for table in form.BESIDE))]
    try:
        with form.opened(Output(evaluation, evaluation.element_table(), streams, path.parent)) as sink:
            for part in evaluation.parts():
                sink.take(part)
            sink.finish({})
    finally:
        for stream in streams:
            stream.close()
    return path


def whole(evaluation: Evaluation) -> ContactResult:
    """All steps of an evaluation in one result."""
    parts = [part.result for part in evaluation.parts()]
    assert len(parts) == 1
    return parts[0] if evaluation.time is not None else parts[0].step(0)


def columns(result: ContactResult) -> dict[str, NDArray[Any]]:
    """The columns of elements and nodes of a result; texts as lists."""
    assert result.given is not None
    elements = ElementTable(result.given, np.flatnonzero(result.evaluated))
    nodes = NodeTable(result.given, np.flatnonzero(result.present))
    part = Part(0, result.as_series())
    found = {
        f"{name}.{one.name}": one for name, table in (("e", elements), ("n", nodes)) for one in table.columns(part)
    }
    return {name: spelled(one, part.count) for name, one in found.items()}


def spelled(column: Column, steps: int) -> NDArray[Any]:
    values = column.cut(0, steps)
    return np.array(column.names, object)[values] if column.names else values


def assert_same(found: ContactResult, expected: ContactResult) -> None:
    """All that a file holds is equal to the last bit."""
    assert found.depth.ndim == expected.depth.ndim
    if expected.times is None or found.times is None:
        assert found.times is expected.times
    else:
        assert np.array_equal(found.times, expected.times)
    ours, theirs = columns(found), columns(expected)
    assert list(ours) == list(theirs)
    for name, values in theirs.items():
        assert ours[name].dtype.kind == values.dtype.kind, name
        if values.dtype.kind == "f":
            assert np.array_equal(np.isnan(ours[name]), np.isnan(values)), name
            assert ours[name][~np.isnan(values)].tobytes() == values[~np.isnan(values)].tobytes(), name
        else:
            assert (ours[name] == values).all(), name


CASES: dict[str, Callable[[], Evaluation]] = {
    "state": lambda: evaluate_scene(scene_of(CLEAN)),
    "series": lambda: evaluate_scene(scene := scene_of(CLEAN + EXTENSIONS), moved(scene, 5)),
    "cut": lambda: evaluate_scene(scene := scene_of(PULLING), moved(scene, 3), "cut"),
    "rigid": lambda: evaluate_scene(scene_of(RIGID)),
    "names": lambda: evaluate_scene(scene_of(HOSTILE)),
    "part": lambda: evaluate_scene(scene := scene_of(CLEAN), moved(scene, 2, (1, 2))),
    "no elements": lambda: evaluate_scene(scene := scene_of(CLEAN), moved(scene, 2, (1,))),
    "slope": lambda: evaluate_scene(mudline.read(SAMPLES / "slope-friction.keyxm").scene()),
    "imperial": lambda: evaluate_scene(mudline.read(SAMPLES / "imperial-riser.keyxi").scene()),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("case", CASES)
def test_what_is_written_is_read(case: str, form: str, tmp_path: Path) -> None:
    evaluation = CASES[case]()
    found = mudline.read_result(written(evaluation, tmp_path / f"out.{form}"))
    expected = whole(evaluation)
    assert_same(found, expected)
    assert found.known.units == evaluation.scene.units
    for each in fields(ContactResult):
        if each.name not in _NOT_KEPT and expected.present.all():
            value = getattr(expected, each.name)
            assert (getattr(found, each.name) is None) == (value is None), each.name
            if value is not None:
                assert np.array_equal(getattr(found, each.name), value, equal_nan=value.dtype.kind == "f"), each.name


def test_lines_of_a_part_keep_their_arc_lengths(tmp_path: Path) -> None:
    """Node 4 of a line of 8 has no position, and a branch leaves at node 2, whose first element has none either."""
    nodes = "".join(f" {number}, {0.05 * (number - 6.5)}, {10.0 * number}\n" for number in range(1, 9))
    elements = "".join(f" {number}, {number}, {number + 1}\n" for number in range(1, 8))
    branch = " 20, 0.2, 20.0, 10.0\n", " 20, 20, 2\n"
    text = f"$MODEL\n*NODE\n{nodes}{branch[0]}*ELEMENT\n{elements}{branch[1]}{BED}"
    scene = scene_of(text)
    present = tuple(index for index, number in enumerate(scene.node_ids.tolist()) if number not in {1, 4})
    evaluation = evaluate_scene(scene, moved(scene, 2, present))
    found, expected = mudline.read_result(written(evaluation, tmp_path / "out.npz")), whole(evaluation)
    rows, own = found.to_dataframe(), expected.to_dataframe()
    assert (own["line"].tolist(), rows["line"].tolist()) == ([2, 2, 2, 2, 3] * 2, [2, 4, 4, 4, 3] * 2)
    assert rows.drop(columns="line").equals(own.drop(columns="line"))
    assert rows["arc_length"].tolist() == own["arc_length"].tolist()
    ends = found.to_dataframe("summary")
    for which in ("first_touchdown", "first_touchdown_y"):
        theirs = sorted(expected.to_dataframe("summary")[which].dropna())
        assert sorted(ends[which].dropna()) == pytest.approx(theirs, rel=1e-12)
    total = ends.groupby("time")["reaction"].sum().tolist()
    assert total == pytest.approx(expected.to_dataframe("summary").groupby("time")["reaction"].sum().tolist())


@pytest.fixture(params=FORMS)
def path(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A series of three steps in each form."""
    scene = scene_of(CLEAN)
    return written(evaluate_scene(scene, moved(scene, 3)), tmp_path / f"out.{request.param}")


def refused(path: Path) -> str:
    with pytest.raises(mudline.DeckError) as caught:
        mudline.read_result(path)
    (one,) = caught.value.diagnostics
    assert (one.code, one.file.rpartition("/")[2][:3]) == ("DAT001", "out")
    return one.message


def test_a_truncated_file_is_refused(path: Path) -> None:
    data = path.read_bytes()
    for left in (0, 1, 40, len(data) // 2, len(data) - 20):
        path.write_bytes(data[:left])
        assert refused(path)


def test_what_is_no_result_is_refused(path: Path) -> None:
    for garbage in (b"\x00" * 100, b"PK\x03\x04 nothing", b"[" * 100_000, b"{}", b"PAR1" * 8, b"a,b\n1,2\n"):
        path.write_bytes(garbage)
        assert refused(path)


@pytest.mark.untraced
def test_damaged_bytes_are_refused_or_read(path: Path) -> None:
    data, random = bytearray(path.read_bytes()), np.random.default_rng(15)
    for _ in range(60):
        damaged = data.copy()
        for place in random.integers(0, len(data), 3).tolist():
            damaged[place] = int(random.integers(0, 256))
        path.write_bytes(damaged)
        with suppress(mudline.DeckError):
            mudline.read_result(path)


def test_files_that_are_not_there(tmp_path: Path) -> None:
    for form in FORMS:
        with pytest.raises(FileNotFoundError):
            mudline.read_result(tmp_path / f"out.{form}")
    with pytest.raises(ValueError, match=r"results are in files \.csv, \.json, \.npz, \.parquet, \.xlsx, not \.txt"):
        mudline.read_result(tmp_path / "out.txt")


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_nodes_that_are_missing_or_of_another_run(form: str, tmp_path: Path) -> None:
    scene = scene_of(CLEAN)
    path = written(evaluate_scene(scene, moved(scene, 3)), tmp_path / f"out.{form}")
    other = written(evaluate_scene(scene, moved(scene, 2)), tmp_path / f"other.{form}")
    nodes = table_path(path, "nodes")
    nodes.write_bytes(table_path(other, "nodes").read_bytes())
    assert (
        refused(path)
        == f"its steps are not those of {nodes.as_posix()}: the two are of different runs; write them again"
    )
    nodes.unlink()
    assert refused(path) == f"the nodes are missing: expected them in out-nodes.{form} beside it"
    nodes.write_bytes(path.read_bytes())
    assert refused(path).startswith("the table of nodes lacks node")
    path.write_bytes(table_path(other, "nodes").read_bytes())
    assert refused(path) == "this is the table of nodes of a result: give the file of the elements"


def edited(tmp_path: Path, old: str, new: str, table: str = "") -> str:
    """Why a CSV of a series is refused after an edit of one of its tables."""
    scene = scene_of(CLEAN)
    path = written(evaluate_scene(scene, moved(scene, 3)), tmp_path / "out.csv")
    changed = table_path(path, table) if table else path
    text = changed.read_text(encoding="utf-8")
    assert old in text
    changed.write_text(text.replace(old, new), encoding="utf-8")
    return refused(path)


def test_edited_tables(tmp_path: Path) -> None:
    assert edited(tmp_path, "0.1,1,", "0.9,1,") == "time: expected one finite time for all rows of a step"
    assert edited(tmp_path, "\n0.1,", "\n0.9,") == "times must rise: 0.5 follows 0.9"
    assert edited(tmp_path, "true", "yes") == "contact: 'yes' is not true or false"
    assert edited(tmp_path, "10.0", "1e999").endswith("expected finite numbers")
    assert edited(tmp_path, "10.0", "1-0") == "length: '1-0' is not a number"
    assert edited(tmp_path, "10.0", "nan") == "length: 'nan' is not a number"
    assert edited(tmp_path, ",2,metric", ",99999999999999999999,metric").endswith(" is not a whole number")
    assert edited(tmp_path, ",metric", ",parsecs") == "units: expected metric, imperial or user, found 'parsecs'"
    assert edited(tmp_path, "time,", "moment,") == "element 1 is given 3 times: expected a column time"
    assert edited(tmp_path, "node2", "nod2") == (
        "the table of elements lacks node2: expected the columns of mudline-result/2; evaluate the deck again"
    )
    assert edited(tmp_path, ",2,metric", ",7,metric") == (
        f"no row for node 7, where elements end: it does not belong to {(tmp_path / 'out.csv').as_posix()}"
    )
    assert edited(tmp_path, ",10.0,", ",11.0,", "nodes").startswith("element 1 is not where its nodes are, by ")
    assert edited(tmp_path, "\n0.1,3", "\n0.1,4", "nodes") == (
        "the nodes of step 1 are not those of step 0: the file is damaged or edited"
    )


def test_other_versions(tmp_path: Path) -> None:
    path = written(evaluate_scene(scene_of(CLEAN)), tmp_path / "out.json")
    held = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps(held | {"format": "mudline-result/3"}), encoding="utf-8")
    assert refused(path) == "the format is 'mudline-result/3', expected 'mudline-result/2': evaluate the deck again"
    del held["format"]
    path.write_text(json.dumps(held), encoding="utf-8")
    assert refused(path) == "not a file of results: expected the format mudline-result/2, found none"
    archive = tmp_path / "out.npz"
    np.savez(archive, force=np.zeros(2))
    assert refused(archive) == "not a file of results: expected the format mudline-result/2, found none"
    np.savez(archive, format="mudline-result/2", units="metric", force=np.zeros(2))
    assert refused(archive) == "no array element: expected those of mudline-result/2; evaluate the deck again"


def test_counts_that_no_memory_holds(tmp_path: Path) -> None:
    path = written(evaluate_scene(scene_of(CLEAN)), tmp_path / "out.npz")
    held = dict(np.load(path, allow_pickle=False))
    np.savez(path, **held)
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    shape = b"'shape': (2,), }"
    huge = b"'shape': (999999999999999,), }"
    header = members["force.npy"].replace(shape + b" " * (len(huge) - len(shape)), huge)
    assert header != members["force.npy"]
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in (members | {"force.npy": header}).items():
            archive.writestr(name, data)
    assert refused(path).startswith("not an NPZ archive: ")
