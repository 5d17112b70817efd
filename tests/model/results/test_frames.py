"""Results as tables of pandas, Arrow and polars, and as data sets of xarray."""

from __future__ import annotations

import sys

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

import mudline
from mudline.basics.quantities import ELEMENTS, LINES, NODES, Quantity
from mudline.model.contact import ContactInput, ContactModel, ContactResult, Tension
from mudline.model.contact.result import TableName
from mudline.model.contact.touchdown import line_summaries
from tests.helpers.builders.decks import CLEAN, PULLING

SUCKED = CLEAN + "*SEABED SUCTION\n SET=Pipe\n COHESION=4000.0\n"


def model(text: str = CLEAN, tension: Tension = "keep") -> ContactModel:
    return mudline.from_keyword(text).scene().contact(tension)


def series(contact: ContactModel, steps: int = 4, *, timed: bool = True) -> ContactResult:
    positions = np.repeat(contact.input.coordinates[np.newaxis], steps, axis=0)
    positions[:, :, 0] += 0.02 * np.arange(steps)[:, np.newaxis]
    return contact.evaluate(positions, times=0.5 * np.arange(steps) if timed else None)


def names(quantities: dict[str, Quantity], *leading: str) -> list[str]:
    flat = [each.name + axis for each in quantities.values() for axis in (("_x", "_y", "_z") if each.vector else ("",))]
    return [*leading, *flat]


def test_tables_have_the_columns_of_files() -> None:
    contact = model()
    state, timed, counted = contact.evaluate(), series(contact), series(contact, timed=False)
    for table, quantities, rows in (("elements", ELEMENTS, 2), ("nodes", NODES, 3), ("summary", LINES, 1)):
        which: TableName = table  # type: ignore[assignment] # one of its words
        for result, leading, steps in ((state, (), 1), (timed, ("time",), 4), (counted, ("step",), 4)):
            frame, arrow = result.to_dataframe(which), result.to_arrow(which)
            assert list(frame) == arrow.column_names == names(quantities, *leading)
            assert len(frame) == len(arrow) == steps * rows
    assert timed.to_dataframe()["time"].tolist() == [0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.5, 1.5]
    assert counted.to_dataframe("nodes")["step"].tolist() == np.repeat(range(4), 3).tolist()
    assert timed.step(2).to_dataframe()["time"].tolist() == [1.0, 1.0]
    with pytest.raises(ValueError, match="table must be one of elements, nodes, summary, not 'rows'"):
        state.to_dataframe("rows")  # type: ignore[arg-type]


def test_values_are_those_of_the_result() -> None:
    result = series(model(SUCKED))
    frame = result.to_dataframe()
    for name in ("depth", "ratio", "force", "slope", "stiffness", "contact"):
        assert np.array_equal(frame[name].to_numpy(), getattr(result, name).ravel(), equal_nan=True), name
        assert np.array_equal(result.to_arrow()[name].to_numpy(), frame[name].to_numpy(), equal_nan=True), name
    assert frame["law"].tolist() == ["curve:Clay"] * 8
    assert frame["state"].astype(object).tolist() == result.to_arrow()["state"].to_pylist()
    nodes = result.to_dataframe("nodes")
    assert np.array_equal(nodes[["reaction_x", "reaction_y", "reaction_z"]].to_numpy(), result.reaction.reshape(-1, 3))
    assert nodes["axial_state"].isna().all()
    lines = result.to_dataframe("summary")
    assert lines["reaction"].tolist() == [one.reaction for one in line_summaries(result)]
    assert lines["largest_force_element"].tolist() == [1, 1, 1, 1]
    far = model().evaluate([[9.0, 0.0, 0.0], [9.0, 10.0, 0.0], [9.0, 20.0, 0.0]])
    assert far.to_dataframe("summary")["largest_force_element"].isna().all()


def test_cut_elements_have_their_law() -> None:
    result = model(PULLING, "cut").evaluate()
    assert result.to_dataframe()["law"].tolist() == ["curve-cut", "curve:Clay"]


def test_units_are_metadata() -> None:
    result = series(model())
    assert result.to_dataframe().attrs["units"] == "metric"
    assert result.to_dataframe().attrs["unit"]["stiffness"] == "N/m2"
    table = result.to_arrow("nodes")
    assert table.schema.metadata == {b"mudline.format": b"mudline-result/2", b"mudline.units": b"metric"}
    assert table.schema.field("reaction_x").metadata == {b"unit": b"N"}
    assert table.schema.field("time").metadata == {b"unit": b"s"}
    assert table.schema.field("node").metadata is None


def test_who_takes_arrow_streams_takes_results() -> None:
    result = series(model())
    assert pa.table(result).equals(result.to_arrow())
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame(result)
    assert frame.shape == (8, len(ELEMENTS) + 1)
    assert frame["force"].to_list() == result.force.ravel().tolist()


def test_data_sets() -> None:
    pytest.importorskip("xarray")
    contact = model(SUCKED)
    result, state = series(contact), contact.evaluate()
    found, single = result.to_xarray(), state.to_xarray()
    assert dict(found.sizes) == {"time": 4, "element": 2, "node": 3, "axis": 3}
    assert dict(single.sizes) == {"element": 2, "node": 3, "axis": 3}
    assert "time" not in single.coords
    assert float(result.step(1).to_xarray()["time"]) == 0.5
    assert "time" not in series(model(), timed=False).to_xarray().coords
    for one, expected in ((found, result), (single, state)):
        for name in ("force", "depth", "contact"):
            assert np.array_equal(one[name], getattr(expected, name)), name
        assert np.array_equal(one["reaction"], expected.reaction)
        assert one["normal"].shape == expected.normal.shape
        for name in ("set", "law", "arc_length", "line", "node_arc_length", "diameter"):
            assert name in one.coords, name
        assert one.attrs == {"units": "metric", "format": "mudline-result/2"}
    assert found["force"].attrs == {"units": "N/m"}
    assert found["time"].attrs == {"units": "s"}
    assert found["force"].sel(time=0.5, element=1).item() == result.force[1, 0]
    assert found["law"].values.tolist() == ["curve:Clay", "curve:Clay"]


def test_only_what_has_positions_has_rows() -> None:
    contact = model()
    result = contact.evaluate(present=np.array([True, True, False]))
    assert result.to_dataframe()["element"].tolist() == [1]
    assert result.to_dataframe("nodes")["node"].tolist() == [1, 2]
    assert isinstance(result.to_dataframe(), pd.DataFrame)


def test_without_a_library_or_what_was_evaluated(monkeypatch: pytest.MonkeyPatch) -> None:
    result = model().evaluate()
    for library, make in (
        ("pandas", result.to_dataframe),
        ("pyarrow", result.to_arrow),
        ("pyarrow", result.__arrow_c_stream__),
        ("xarray", result.to_xarray),
    ):
        with monkeypatch.context() as patched:
            patched.setitem(sys.modules, library, None)
            with pytest.raises(
                ImportError, match=r'not installed: python -m pip install "mudline\[frames\]"'
            ) as caught:
                make()
            assert caught.value.name == library
    bare = ContactInput(
        node_ids=np.array([1, 2]),
        coordinates=np.zeros((2, 3)),
        element_ids=np.array([1]),
        element_nodes=np.array([[0, 1]]),
        length=np.ones(1),
        diameter=np.ones(1),
    )
    unnamed = ContactModel(bare).evaluate()
    assert unnamed.to_dataframe()["law"].tolist() == ["none"]
    assert "unit" in unnamed.to_dataframe().attrs
    object.__setattr__(unnamed, "given", None)
    with pytest.raises(ValueError, match="does not know its nodes and elements"):
        unnamed.to_dataframe()
