"""Results of an evaluation, and the errors for values that are refused: element or node, step, reason."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from importlib import import_module
from operator import attrgetter
from types import NoneType
from typing import TYPE_CHECKING, Any, Literal, NoReturn, overload

import numpy as np
from numpy.typing import NDArray

from mudline.basics.arguments import ArgumentRangeError, expect, several
from mudline.basics.installed import install_hint
from mudline.basics.short_repr import counted, outline, short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, IdArray, IndexArray, StateArray, summed
from mudline.model.contact.input import ContactInput, ElementError, PositionError
from mudline.model.contact.tables import LawTables

if TYPE_CHECKING:  # each is imported when it is asked for
    import pandas as pd
    import pyarrow as pa
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mudline.model.contact.lines import LineSummary

TableName = Literal["elements", "nodes", "summary"]


@dataclass(frozen=True, slots=True, eq=False, repr=False, weakref_slot=True)
class ContactResult:
    """Arrays over elements (m) and nodes (n); over (steps, m) and (steps, n) for a series of positions.

    NaN means "no value": `ratio` and `slope` of an element without diameter, and every value of elements and nodes
    without a position.

    Attributes:
        depth: mean depth of the element's two nodes below the seabed; negative above it.
        ratio: embedment ratio, depth / diameter.
        contact: depth > 0, or > -h in a centred zone.
        force: normal force per unit length, positive out of the seabed.
        slope: d force / d ratio, per unit length.
        stiffness: d force / d penetration, per unit length.
        cut: elements with a curve cut in tension; they are in contact with force, slope and stiffness 0.
        gap: distance of the node above the seabed, along its normal.
        normal: (..., n, 3) unit normal of the seabed at the node, out of the soil; may be a read-only view.
        reaction: (..., n, 3) total force of the seabed on the node.
        normal_force: the reaction along the normal, positive out of the seabed.
        state: (..., m) `SuctionState` of the elements, -1 without suction; None if no element has suction.
        regularised: (..., m) elements with suction at a velocity below v_r, where the force is less than the power law
            gives; None if no element has suction.
        friction: (..., n, 2) force of friction and lateral springs on the pipe along u1 and u2; None without any.
        friction_state: (..., n, 2) `FrictionState` of the nodes; None without friction.
        evaluated: (m,) elements whose two nodes have positions.
        present: (n,) nodes that have a position.
        rigid: (n,) nodes of elements on a rigid seabed, which is a constraint and no force; None without any.
        given: the input: nodes, elements, laws and names.
        positions: (..., n, 3) evaluated positions, of any type of number; for a series the caller's own array.
        times: (steps,) the times of a series, () for one of its steps; None without times.
    """

    depth: FloatArray
    ratio: FloatArray
    contact: BoolArray
    force: FloatArray
    slope: FloatArray
    stiffness: FloatArray
    cut: BoolArray
    gap: FloatArray
    normal: FloatArray
    reaction: FloatArray
    normal_force: FloatArray
    evaluated: BoolArray
    present: BoolArray
    state: StateArray | None = None
    regularised: BoolArray | None = None
    friction: FloatArray | None = None
    friction_state: StateArray | None = None
    rigid: BoolArray | None = None
    given: ContactInput | None = None
    positions: NDArray[Any] | None = None
    times: FloatArray | None = None

    def __repr__(self) -> str:
        optional = ("state", "regularised", "friction", "friction_state", "rigid")
        present = ", ".join(name for name in optional if getattr(self, name) is not None)
        shapes = f"elements {self.depth.shape}, nodes {self.gap.shape}"
        return outline("ContactResult", shapes, f"with {present}" if present else "")

    def _repr_html_(self) -> str:
        """Return size and touchdown of the lines at the first steps as HTML, for notebooks."""
        page: str = import_module("mudline.model.contact.frames").html(self)
        return page

    @property
    def restrained(self) -> BoolArray | None:
        """Nodes (..., n) at or below a rigid seabed, which restrains them along their `normal`; None without any."""
        return None if self.rigid is None else self.rigid & (self.gap <= 0.0)

    def friction_state_of(self, side: int) -> StateArray:
        """Return the states (..., n) along u1 (0) or u2 (1); -1 without friction."""
        if _whole(side, "side") not in (0, 1):
            raise ValueError(f"side must be 0 or 1, not {side!r}")
        if self.friction_state is None:
            return np.full(self.gap.shape, -1, np.int8)
        return self.friction_state[..., side]

    def step(self, index: int) -> ContactResult:
        """Return one step of a series, as views; IndexError where it has no such step."""
        return self._cut(_whole(index, "index"))

    def to_dataframe(self, table: TableName = "elements") -> pd.DataFrame:
        """Return the elements, nodes or lines ("summary") as a pandas frame, a row for each at each step.

        The columns are those of result files after `time`, or after `step` for a series without times. `attrs` has
        `units`, the unit system, and `unit`, the unit of each column that has one. A missing value is NaN, NA or None.

        Raises:
            ImportError: pandas is not installed; the extra `frames` brings it.
            ValueError: the table does not exist, or the result has no input.
        """
        return import_module("mudline.model.contact.frames").dataframe(self, table)

    def to_arrow(self, table: TableName = "elements") -> pa.Table:
        """Return the elements, nodes or lines ("summary") as a pyarrow table with the columns of `to_dataframe`.

        The metadata of a field has its `unit`, that of the table `mudline.format` and `mudline.units`; a missing value
        is null. Raises the exceptions of `to_dataframe`, ImportError without pyarrow.
        """
        return import_module("mudline.model.contact.frames").arrow_table(self, table)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """Return the elements as an Arrow stream: `polars.DataFrame(result)`, DuckDB, `pyarrow.table(result)`.

        Raises the exceptions of `to_arrow`.
        """
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def to_xarray(self) -> xr.Dataset:
        """Return all elements and nodes as an xarray data set with the dimensions `time`, `element` and `node`.

        Variables have the names of the arrays in NPZ files: nodes have `node_` before a name that elements have too.
        Vectors have a dimension `axis`. Numbers, sets, laws, lines and arc lengths are coordinates; the attribute
        `units` is the unit of a variable. A single state has no dimension `time`, and a scalar `time` if it is a step
        of a series.

        Raises the exceptions of `to_dataframe`, ImportError without xarray.
        """
        data: xr.Dataset = import_module("mudline.model.contact.frames").dataset(self)
        return data

    @property
    def known(self) -> ContactInput:
        """The input of the result.

        Raises ValueError for a result without an input.
        """
        if self.given is None:
            raise ValueError("the result does not know its nodes and elements: evaluate them with a ContactModel")
        return self.given

    def as_series(self) -> ContactResult:
        """Return a single state as a series of one step, as views; return a series unchanged."""
        return self if self.depth.ndim == 2 else self._each(lambda values: np.asarray(values)[None])

    def steps(self, start: int, stop: int) -> ContactResult:
        """Return the steps start <= step < stop of a series, as views."""
        return self._cut(slice(_whole(start, "start"), _whole(stop, "stop")))

    @overload
    def plot(self, path: str | os.PathLike[str] | None = None, *, elements: Sequence[int] = ()) -> Figure: ...
    @overload
    def plot(self, *, elements: Sequence[int] = (), ax: Axes, panel: str = "force") -> Axes: ...
    def plot(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        elements: Sequence[int] = (),
        ax: Axes | None = None,
        panel: str = "force",
    ) -> Figure | Axes:
        """Return a figure of the results, as `mudline evaluate --plot` draws it, or one panel of it in axes `ax`.

        Args:
            path: a file to write, .png, .svg or .pdf by its suffix.
            elements: numbers of elements whose force over penetration is drawn.
            ax: axes to draw into; they are returned.
            panel: what is drawn there: "line", "force", "touchdown", "reaction", "suction", "friction", "embedment",
                "stiffness", "curves" or "loop", as far as the results have it.

        Raises:
            ValueError: the suffix, an element or the panel is unknown, or the results do not know what was evaluated.
            OSError: the file cannot be written.
            ImportError: matplotlib is not installed.
        """
        expect(path, "path", (str, os.PathLike, NoneType), "a path")
        expect(panel, "panel", str, "the name of a panel")
        elements = several(elements, "elements", (int, np.integer), "several numbers of elements")
        try:
            plots = import_module("mudline.model.results.plots")
        except ImportError as error:
            raise ImportError(f"a plot needs matplotlib: {install_hint('plot')}") from error
        if ax is not None and not hasattr(ax, "plot"):
            raise ValueError("ax must be axes of matplotlib")
        drawn: Figure | Axes = (
            plots.plot_result(self, path, elements=elements)
            if ax is None
            else plots.plot_panel(self, ax, panel, elements=elements)
        )
        return drawn

    def summary(self) -> list[LineSummary]:
        """Return each line at each step: touchdown points, length in contact, largest forces, total reaction.

        Raises ValueError for a result without an input.
        """
        lines: list[LineSummary] = import_module("mudline.model.contact.touchdown").line_summaries(self)
        return lines

    def _cut(self, key: int | slice) -> ContactResult:
        if self.depth.ndim != 2:
            raise ValueError("a single state has no steps")
        if isinstance(key, int) and not -len(self.depth) <= key < len(self.depth):
            raise ArgumentRangeError(f"index {key} is out of range: the series has {counted(len(self.depth), 'step')}")
        return self._each(lambda values: values[key])

    def _each(self, cut: Callable[[NDArray[Any]], NDArray[Any]]) -> ContactResult:
        arrays: list[Any] = [None if values is None else cut(values) for values in _get_by_step(self)]
        return ContactResult(**dict(zip((*_BY_STEP, *_OF_ALL_STEPS), (*arrays, *_get_rest(self)), strict=True)))


def _whole(value: int, name: str) -> int:
    expect(value, name, (int, np.integer), "a whole number")
    return int(value)


@dataclass(frozen=True, slots=True, repr=False)
class ResultPart:
    """Steps `start` and on of a series, with their results (steps, ...)."""

    start: int
    result: ContactResult

    __repr__ = short_repr

    @property
    def count(self) -> int:
        """Number of steps."""
        return len(self.result.depth)

    @property
    def steps(self) -> slice:
        """Range of the steps among all steps."""
        return slice(self.start, self.start + self.count)


def total_normal_force(result: ContactResult, nodes: IndexArray | BoolArray) -> FloatArray:
    """Return the total normal force (...) on some nodes; NaN if a rigid seabed may restrain one of these nodes.

    The force of a rigid seabed follows from the equilibrium of the line, which is not known here. A node without a
    position adds 0.
    """
    if result.rigid is not None and result.rigid[nodes].any():
        return np.full(result.gap.shape[:-1], np.nan)
    return np.asarray(np.nansum(result.normal_force[..., nodes], axis=-1))


_OF_ALL_STEPS = ("evaluated", "present", "rigid", "given")
_BY_STEP = tuple(each.name for each in fields(ContactResult) if each.name not in _OF_ALL_STEPS)
_get_by_step, _get_rest = attrgetter(*_BY_STEP), attrgetter(*_OF_ALL_STEPS)


def blank_result(
    positions: NDArray[Any],
    present: BoolArray,
    tables: LawTables,
    same_normal: FloatArray | None,
    times: FloatArray | None,
) -> ContactResult:
    """Return empty results for a series of positions (steps, n, 3).

    Arrays of absent laws are None. If all points of the seabed share a normal, `normal` is a view; so is `cut` if no
    curve is cut.
    """
    evaluated = present[tables.line.first] & present[tables.line.second]
    on_elements, on_nodes = (len(positions), len(evaluated)), (len(positions), len(present))
    slides = tables.friction is not None or tables.lateral is not None
    return ContactResult(
        depth=np.empty(on_elements),
        ratio=np.empty(on_elements),
        contact=np.empty(on_elements, np.bool_),
        force=np.empty(on_elements),
        slope=np.empty(on_elements),
        stiffness=np.empty(on_elements),
        cut=np.zeros(on_elements, np.bool_) if tables.cuts else _repeated(np.zeros((), np.bool_), on_elements),
        gap=np.empty(on_nodes),
        normal=np.empty((*on_nodes, 3)) if same_normal is None else _repeated(same_normal, on_nodes),
        reaction=np.empty((*on_nodes, 3)),
        normal_force=np.empty(on_nodes),
        evaluated=evaluated,
        present=present,
        state=None if tables.suction is None else np.full(on_elements, -1, np.int8),
        regularised=None if tables.suction is None else np.zeros(on_elements, np.bool_),
        friction=np.empty((*on_nodes, 2)) if slides else None,
        friction_state=None if tables.friction is None else np.empty((*on_nodes, 2), np.int8),
        rigid=tables.rigid,
        given=tables.given,
        positions=positions,
        times=times,
    )


def blank_absent(part: ContactResult) -> None:
    """Set values without a position to NaN; depth, ratio and gap are NaN already."""
    for on_elements in (part.force, part.slope, part.stiffness):
        on_elements[:, ~part.evaluated] = np.nan
    part.normal_force[:, ~part.present] = np.nan
    part.reaction[:, ~part.present] = np.nan
    if part.friction is not None:
        part.friction[:, ~part.present] = np.nan


def _repeated(values: NDArray[Any], shape: tuple[int, int]) -> NDArray[Any]:
    """Return equal values everywhere as a read-only view; faster than np.broadcast_to."""
    view: NDArray[Any] = np.ndarray((*shape, *values.shape), values.dtype, values.data, 0, (0, 0, *values.strides))
    view.setflags(write=False)
    return view


def is_finite(part: ContactResult, speed: FloatArray | None) -> bool:
    """Return True if every value of a batch is finite.

    Return False also if a sum of finite values overflows, or if a value is NaN for want of a position.
    """
    at_nodes = part.normal_force if part.friction is None and part.normal.strides[1] == 0 else part.reaction
    every = [part.ratio, part.slope, part.stiffness, at_nodes, *([] if speed is None else [speed])]
    return math.isfinite(sum(float(values.sum()) for values in every))


def refuse(part: ContactResult, speed: FloatArray | None, first_step: int, tables: LawTables) -> None:
    """Raise an error for the first step of a batch with a value that is not finite, if any.

    Raises:
        PositionError: the velocity or the distance of a node, or the reaction there, is not finite.
        ElementError: the embedment, the force, its derivatives or the reaction of an element overflow, or its curve
            pulls where suction acts too.
    """
    for step in range(len(part.depth)):
        _refuse_step(part.step(step), None if speed is None else speed[step], first_step + step, tables)
        refuse_pulling(part.steps(step, step + 1), first_step + step, tables)


def _refuse_step(part: ContactResult, speed: FloatArray | None, step: int, tables: LawTables) -> None:
    given = tables.given
    _refuse_node(np.isinf(part.gap), given.node_ids, step, "its distance to the seabed overflows")
    if speed is not None:
        here = ~np.isnan(part.gap)
        _refuse_node(~np.isfinite(speed) & here, given.node_ids, step, "its velocity is not finite")
    infinite = np.isinf(part.ratio) | np.isinf(part.depth)
    _refuse_element(infinite, given.element_ids, step, "its embedment ratio overflows")
    known = ~np.isnan(part.depth)
    unbounded = ~np.isfinite(part.force) & known
    if unbounded.any():
        _refuse_force(part, int(np.argmax(unbounded)), step, tables)
    for what, values in (("slope", part.slope), ("stiffness", part.stiffness)):
        _refuse_element(np.isinf(values), given.element_ids, step, f"its {what} overflows")
    with np.errstate(all="ignore"):
        load = np.where(known, part.force * tables.half, 0.0)
        loads = summed(load, given.element_nodes, len(given.node_ids))
    at_node = ~(np.isfinite(loads[tables.line.first]) & np.isfinite(loads[tables.line.second]))
    _refuse_element(at_node & known, given.element_ids, step, "the reaction at its nodes overflows")
    wrong = ~np.isfinite(part.reaction).all(axis=-1) & part.present
    _refuse_node(wrong, given.node_ids, step, "the reaction there overflows")


def refuse_pulling(part: ContactResult, first_step: int, tables: LawTables) -> None:
    """Raise ElementError for the first element with suction whose curve pulls, uncut, if any."""
    if tables.pulling is None:
        return
    elements = tables.pulling
    pulls = part.contact[:, elements] & (part.force[:, elements] < 0.0)
    if pulls.any():
        step, column = np.argwhere(pulls)[0].tolist()
        element, step = int(tables.given.element_ids[elements[column]]), first_step + step
        what = "its curve pulls there, and suction acts on it too; cut the curve with tension cut, or correct it"
        raise ElementError(f"element {element} at step {step}: {what}", element, step)


def _refuse_force(part: ContactResult, element: int, step: int, tables: LawTables) -> NoReturn:
    number, why = int(tables.given.element_ids[element]), "its force overflows"
    index = int(tables.given.curve_index[element])
    if index >= 0 and part.contact[element]:
        ratio, force, slope = part.ratio[element : element + 1], np.empty(1), np.empty(1)
        with np.errstate(all="ignore"):
            tables.given.curves[index].fill(ratio, force, slope)
        if not math.isfinite(force[0]):
            why = f"no force at ratio {float(ratio[0])!r}: the force there overflows"
    raise ElementError(f"element {number} at step {step}: {why}", number, step)


def _refuse_node(wrong: BoolArray, ids: IdArray, step: int, what: str) -> None:
    if wrong.any():
        node = int(ids[np.argmax(wrong)])
        raise PositionError(f"node {node} at step {step}: {what}", node, step)


def _refuse_element(wrong: BoolArray, ids: IdArray, step: int, what: str) -> None:
    if wrong.any():
        element = int(ids[np.argmax(wrong)])
        raise ElementError(f"element {element} at step {step}: {what}", element, step)
