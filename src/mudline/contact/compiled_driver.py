"""The laws driven by compiled loops (numba, the extra `mudline[fast]`): the same bits as the numpy driver, sooner.

A loop is compiled for the laws that a scene has, kept in numba's cache on disk, and run over ranges of elements and of
nodes, on several threads where there is enough to do. Positions are given, so ranges do not depend on each other but
for the sums at nodes, which come after the elements.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

import numba
import numpy as np
from numba.extending import overload

from mudline.contact import kernels
from mudline.contact.arrays import FloatArray
from mudline.contact.choice import Choice
from mudline.contact.laws import NormalLaw, base
from mudline.contact.numpy_driver import Batch
from mudline.contact.result import ContactResult
from mudline.contact.seabed.base import FlatSeabed, Seabed
from mudline.contact.state import ContactState
from mudline.contact.tables import Tables

_BATCH = 2**20
"""Nodes times steps at a time, at most."""
_RANGE = 1024
"""Elements or nodes in a range: what they read and write over a few steps stays in the second-level cache."""
_STEPS = 64
_WORTH_THREADS = 60_000
"""Nodes times steps of a batch from which on several threads are worth their start."""

if TYPE_CHECKING:
    from mudline.curves import ForceCurve

Function = TypeVar("Function", bound=Callable[..., Any])


def _pick(condition: bool, one: float, other: float) -> float:  # noqa: FBT001 - as `where` is called
    """Return one of two numbers, see `where`."""
    return one if condition else other


_INNER: Any = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True, "forceinline": True}
"""For what only loops call: no contraction of products and sums, divisions as numpy does them."""

overload(base.where, jit_options=_INNER, strict=False)(lambda *_: _pick)


@cache
def callable_in_loops(function: Function) -> Function:
    """Make a plain function one that compiled loops can call, and return it."""
    overload(function, jit_options=_INNER, strict=False)(lambda *_: function)
    return function


for _shared in kernels.SHARED:
    callable_in_loops(_shared)


def _compiled(loop: kernels.Loop) -> kernels.Loop:
    options: Any = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
    try:
        made = numba.njit(cache=True, **options)(loop)
    except RuntimeError:  # there is no place where numba may write
        made = numba.njit(**options)(loop)
    return cast("kernels.Loop", made)


@cache
def _loop(name: str, *options: Any) -> kernels.Loop:
    """The loop of a name for options, each made once."""
    return _compiled(getattr(kernels, name)(*options))


class _Job(NamedTuple):
    """A batch as the loops want it."""

    points: FloatArray
    gap: FloatArray
    speed: FloatArray
    normals: FloatArray
    states: tuple[Any, ...]
    laid: tuple[Any, ...]
    elements: tuple[Any, ...]
    extra: tuple[Any, ...]
    nodes: tuple[Any, ...]
    slips: tuple[Any, ...]
    work: tuple[Any, ...]


class CompiledDriver:
    """Evaluates batches of steps. Holds no state of a series; may be shared by threads."""

    def __init__(self, tables: Tables, seabed: Seabed, choice: Choice) -> None:
        """Prepare the tables of the loops, and the loops, which are compiled when they are first called."""
        given = tables.given
        self._tables, self._choice, self._threads = tables, choice, choice.threads
        self._noted = False
        self._pool: ThreadPoolExecutor | None = None
        self._normal = None if seabed.same_normal is None else _given(seabed.same_normal.reshape(1, 1, 3))
        self._nodes, self._elements = len(given.node_ids), len(given.element_ids)
        has = kernels.what_there_is(tables, flat=isinstance(seabed, FlatSeabed))
        self._has = has
        laws = tuple(_with_equation(rows.law) for rows in tables.normal if rows.curve < 0)
        slopes = tuple(_steepest(rows.law) for rows in tables.normal if rows.curve < 0) if has.steepens else ()
        sources = kernels.edition(tuple(rows.law for rows in (*tables.normal, *tables.nodal)))
        self._element_loop = _loop("elements_loop", callable_in_loops, has, laws, _choice(slopes), sources)
        self._index, self._numbers, self._knots = _element_tables(tables)
        self._pulls = _suction_table(tables)
        self._node_loop = _loop(
            "nodes_loop", callable_in_loops, has, tuple(_with_equation(rows.law) for rows in tables.nodal), sources
        )
        self._node_index, self._node_numbers = _node_tables(tables)
        self._ditch = _ditch_tables(tables)
        line = tables.line
        self._line = tuple(
            _given(array) for array in (line.start.astype(np.int32), line.elements, line.senses, tables.half)
        )
        self._sequence = _tasks(tables, range(len(range(0, self._elements, _RANGE))))
        self._groups = _groups(tables, self._elements, self._threads, self._sequence)
        self._laid: tuple[FloatArray, tuple[Any, ...]] | None = None
        self.broken = False
        """Whether a law turned out not to compile."""
        self.steps = max(1, min(_BATCH // max(self._nodes, 1), _STEPS))
        """How many steps at a time are fastest."""

    def run(self, batch: Batch, part: ContactResult, state: ContactState) -> ContactState | None:
        """Write a batch to `part`, but for gaps and normals, which are there; return the state behind it.

        None: something is not finite, and the numpy driver has to say what.
        """
        speed = batch.speed
        if speed is not None and not (np.isfinite(speed.sum()) or (np.isfinite(speed) | np.isnan(part.gap)).all()):
            return None
        after = state.copied()
        job = self._job(batch, part, after)
        try:
            wrong = self._run(batch, job)
        except (numba.core.errors.NumbaError, numba.core.errors.UnsupportedBytecodeError) as error:
            first = str(error).strip().splitlines()[0]
            warnings.warn(f"the laws cannot be compiled and are evaluated with numpy: {first}", RuntimeWarning, 3)
            self.broken = True
            return None
        if not self._noted:
            self._noted = True
            self._choice.note_compiled()
        return None if wrong else after

    def _run(self, batch: Batch, job: _Job) -> int:
        """Write all ranges; return how many values are not finite."""
        groups = self._groups
        if len(groups.together) > 1 and len(batch.points) * self._nodes >= _WORTH_THREADS:
            pool = self._threaded()
            wrong = sum(pool.map(lambda tasks: self._run_tasks(tasks, job), groups.together))
            return wrong + sum(pool.map(lambda tasks: self._run_tasks(tasks, job), groups.behind))
        return self._run_tasks(self._sequence, job)

    def _run_tasks(self, tasks: list[tuple[bool, int, int]], job: _Job) -> int:
        """Write ranges of elements and of nodes in this order; return how many values are not finite."""
        return sum((self._run_nodes if nodes else self._run_elements)(begin, end, job) for nodes, begin, end in tasks)

    def _threaded(self) -> ThreadPoolExecutor:
        if self._pool is None:
            self._pool = ThreadPoolExecutor(self._threads)
        return self._pool

    def _run_elements(self, begin: int, end: int, job: _Job) -> int:
        """Write a range of elements; return how many values are not finite."""
        return self._element_loop(
            begin, end, self._index, self._numbers, self._pulls, job.points, job.gap, job.speed, job.normals,
            self._knots, job.states[:4], job.elements, job.extra, job.work,
        )  # fmt: skip

    def _run_nodes(self, begin: int, end: int, job: _Job) -> int:
        """Write a range of nodes; return how many values are not finite."""
        return self._node_loop(
            begin, end, *self._line, self._node_index, self._node_numbers, job.points, job.gap, job.normals,
            job.elements[3], job.work, (*self._ditch, *job.laid), job.states[4:], job.nodes, job.slips,
        )  # fmt: skip

    def _job(self, batch: Batch, part: ContactResult, after: ContactState) -> _Job:
        steps, has = len(batch.points), self._has
        components = 2 if has.flat else 3
        shape = (steps, self._elements, components)
        work = (
            np.empty(shape) if has.slides else np.empty((0, 0, components)),
            np.empty(shape) if has.lateral else np.empty((0, 0, components)),
        )
        none = np.zeros((0, 0), np.int8)
        unloading, suction, friction = after.unloading, after.suction, after.friction
        states = (
            np.empty((4, 0)) if unloading is None else unloading.numbers,
            np.zeros((2, 0), np.int8) if suction is None else suction.flags,
            np.empty((3, 0)) if suction is None else suction.numbers,
            _columns(np.empty((0, 3)) if after.touchdown is None else after.touchdown),
            _columns(np.empty((0, 3)) if friction is None else friction.stick_points),
            _columns(np.zeros((0, 2), np.int8) if friction is None else friction.states),
        )
        cut = part.cut if part.cut.flags.writeable else none > 0
        return _Job(
            _given(batch.points),
            part.gap,
            np.empty((0, 0)) if batch.speed is None else batch.speed,
            _given(part.normal) if self._normal is None else self._normal,
            states,
            self._laid_tables(batch.laid),
            (part.depth, part.ratio, part.contact, part.force, part.slope, part.stiffness),
            (
                cut,
                none if part.state is None else part.state,
                none > 0 if part.regularised is None else part.regularised,
            ),
            (part.normal_force, part.reaction),
            (
                np.empty((0, 0, 2)) if part.friction is None else part.friction,
                np.zeros((0, 0, 2), np.int8) if part.friction_state is None else part.friction_state,
            ),
            work,
        )

    def _laid_tables(self, laid: FloatArray) -> tuple[Any, ...]:
        """The line as it was `laid`, prepared once: the states of a run share that array."""
        if self._tables.trench is None:
            return _NO_LINE
        kept = self._laid
        if kept is None or kept[0] is not laid:
            from mudline.contact.trenches import LaidCentreline  # noqa: PLC0415 - most friction has no trench

            line = LaidCentreline(laid, self._tables.line)
            pieces = np.concatenate([line.start, line.span, line.inverse[None]])
            self._laid = kept = (laid, (_given(pieces), (_given(line.ends), _given(line.elements_at))))
        return kept[1]


_Task = tuple[bool, int, int]
"""A range to be written: whether it is one of nodes, its begin and its end."""


class _Groups(NamedTuple):
    """Tasks for threads: `together` first, each group in its order, then `behind`."""

    together: list[list[_Task]]
    behind: list[list[_Task]]


def _tasks(tables: Tables, held: range) -> list[_Task]:
    """The ranges of elements `held`, each followed by the ranges of nodes whose elements are all written by then.

    Ranges of nodes that have elements elsewhere are left out, and those without elements come first.
    """
    line, elements, nodes = tables.line, len(tables.half), len(tables.given.node_ids)
    found: dict[int, list[_Task]] = {number: [] for number in range(held.start - 1, held.stop)}
    for begin in range(0, nodes, _RANGE):
        end = min(begin + _RANGE, nodes)
        there = line.elements[line.start[begin] : line.start[end]] // _RANGE
        first, last = int(there.min(initial=held.stop)), int(there.max(initial=-1))
        if not there.size and held.start == 0:
            found[held.start - 1].append((True, begin, end))
        elif there.size and first >= held.start and last < held.stop:
            found[last].append((True, begin, end))
    tasks = list(found[held.start - 1])
    for number in held:
        tasks.append((False, number * _RANGE, min((number + 1) * _RANGE, elements)))
        tasks += found[number]
    return tasks


def _groups(tables: Tables, elements: int, threads: int, sequence: list[_Task]) -> _Groups:
    """The tasks of each thread, with the ranges of nodes between two threads behind."""
    ranges = len(range(0, elements, _RANGE))
    count = min(threads, ranges)
    bounds = [ranges * group // max(count, 1) for group in range(count + 1)]
    together = (
        [_tasks(tables, range(low, high)) for low, high in itertools.pairwise(bounds)] if count > 1 else [sequence]
    )
    done = {task for tasks in together for task in tasks}
    return _Groups(together, [[task] for task in sequence if task not in done])


def _with_equation(law: NormalLaw) -> tuple[Callable[..., Any], int]:
    """The reaction of a law and how many parameters it has."""
    if law.reaction is None:
        raise TypeError(f"the law {law.name!r} has no equation")
    return law.reaction, len(law.parameters)


@cache
def _steepest(law: NormalLaw) -> tuple[Callable[..., Any], int]:
    """The steepest slope of a law in the form of a reaction."""
    if law.steepest is None:
        raise TypeError(f"the law {law.name!r} does not know its steepest slope")
    steepest = callable_in_loops(law.steepest)

    def slope(z: float, diameter: float, *parameters: float) -> tuple[float, float]:
        return steepest(z, diameter, *parameters), 0.0

    return slope, len(law.parameters)


@cache
def _choice(slopes: tuple[tuple[Callable[..., Any], int], ...]) -> Callable[..., Any]:
    return kernels.one_of(callable_in_loops, slopes, kernels.LAW)


def _element_tables(tables: Tables) -> tuple[Any, Any, Any]:
    """Indices (m, c) and numbers (m, c) of the elements, and all curves.

    Curves are (4, k): ratios, forces, slopes behind the points, and the steepest slopes up to there.
    """
    given, count = tables.given, len(tables.half)
    formulas = [rows for rows in tables.normal if rows.curve < 0]
    most = max((len(rows.columns) for rows in formulas), default=0)
    index, numbers = np.full((count, kernels.INDICES), -1, np.int32), np.zeros((count, kernels.LAW + most))
    index[:, kernels.FIRST], index[:, kernels.SECOND] = tables.line.first, tables.line.second
    index[:, kernels.KIND] = kernels.NO_LAW
    numbers[:, kernels.DIAMETER] = given.diameter
    numbers[:, kernels.ONSET] = 0.0 if tables.onset is None else tables.onset
    for kind, rows in enumerate(formulas, kernels.FIRST_LAW):
        index[rows.rows, kernels.KIND] = kind
        for column, values in enumerate(rows.columns, kernels.LAW):
            numbers[rows.rows, column] = values
    knots = [np.empty((4, 0))]
    start = 0
    for rows in tables.normal:
        if rows.curve >= 0:
            curve = given.curves[rows.curve]
            knots.append(_knots(curve))
            index[rows.rows, kernels.KIND] = kernels.ON_CURVE
            index[rows.rows, kernels.CURVE_START], index[rows.rows, kernels.CURVE_END] = (
                start,
                start + len(curve.ratios),
            )
            start += len(curve.ratios)
    places = (
        (tables.unloading, kernels.UNLOADS),
        (tables.suction, kernels.PULLS),
        (tables.lateral, kernels.SPRINGS_BACK),
    )
    for some, column in places:
        if some is not None:
            index[some.rows, column] = np.arange(len(some.rows))
    columns = (
        (tables.unloading, (kernels.LINE,)), (tables.springs, (kernels.SPRING, kernels.EXTENT)), (tables.lateral, (kernels.LATERAL,)),
    )  # fmt: skip
    for some, names in columns:
        if some is not None:
            for column, values in zip(names, some.columns, strict=True):
                numbers[some.rows, column] = values
    return _given(index), _given(numbers), _given(np.concatenate(knots, axis=1))


def _knots(curve: ForceCurve) -> FloatArray:
    from mudline.contact.laws.curve import steepest_slopes  # noqa: PLC0415 - only now is it needed

    steepest, slopes = steepest_slopes(curve), curve.slopes
    return np.stack([curve.ratios, curve.forces, np.append(slopes, slopes[-1]), np.append(steepest, steepest[-1])])


def _suction_table(tables: Tables) -> Any:
    """Suction laws (k, c)."""
    if tables.suction is None:
        return _given(np.empty((0, kernels.SUCTION_COLUMNS)))
    from mudline.contact.laws.suction import SuctionLaw  # noqa: PLC0415 - only now is it needed

    law = SuctionLaw(*tables.suction.columns)
    return _given(np.column_stack([*law, law.factor_per_cycle, np.nan_to_num(law.cyclic_floor), law.least_depth]))


def _node_tables(tables: Tables) -> tuple[Any, Any]:
    """Indices (n, c) and numbers (n, c) of the nodes."""
    count = len(tables.given.node_ids)
    most = max((len(rows.columns) for rows in tables.nodal), default=0)
    index, numbers = np.full((count, kernels.NODE_INDICES), -1, np.int32), np.zeros((count, kernels.NODE_LAW + most))
    numbers[:, kernels.COSINE] = np.nan
    for kind, rows in enumerate(tables.nodal):
        index[rows.rows, kernels.NODE_KIND] = kind
        numbers[rows.rows, kernels.NODE_ONSET] = rows.law.onset(*rows.columns)
        for column, values in enumerate(rows.columns, kernels.NODE_LAW):
            numbers[rows.rows, column] = values
    friction = tables.friction
    if friction is not None:
        index[:, kernels.ACTIVE], index[:, kernels.ELLIPTIC] = friction.active, friction.elliptic
        pairs = (
            (kernels.MU_1, friction.coefficients),
            (kernels.CONSTANT_1, friction.constant),
            (kernels.RISING_1, friction.rising),
        )
        for column, values in pairs:
            numbers[:, column], numbers[:, column + 1] = values
        numbers[friction.turned, kernels.COSINE], numbers[friction.turned, kernels.SINE] = (
            friction.cosine,
            friction.sine,
        )
    return _given(index), _given(numbers)


def _ditch_tables(tables: Tables) -> tuple[Any, ...]:
    """Trenches of the nodes: where those of each node start, indices, numbers, straight lines, and rows of all tables."""
    trench = tables.trench
    if trench is None:
        return tuple(
            _given(array)
            for array in (
                np.zeros(0, np.int32), np.zeros((0, kernels.TRENCH_INDICES), np.int32),
                np.empty((0, kernels.TRENCH_NUMBERS)), np.empty((0, 4)), np.empty((3, 0)),
            )
        )  # fmt: skip
    from mudline.contact.laws.trench import table_rows  # noqa: PLC0415 - most friction has no trench

    rows = [np.stack(table_rows(table)) for table in tables.given.tables]
    starts = np.append(0, np.cumsum([table.shape[1] for table in rows])).astype(np.int32)
    index = np.full((len(trench.nodes), kernels.TRENCH_INDICES), -1, np.int32)
    index[:, kernels.TRENCH_KIND], index[:, kernels.CENTRELINE] = trench.kind, trench.line
    tabled = trench.table >= 0
    index[tabled, kernels.TABLE_START] = starts[trench.table[tabled]]
    index[tabled, kernels.TABLE_END] = starts[trench.table[tabled] + 1]
    numbers = np.column_stack([trench.inner, trench.outer, trench.steepness, trench.amount])
    every = np.concatenate([np.empty((3, 0)), *rows], axis=1)
    return tuple(_given(array) for array in (trench.start.astype(np.int32), index, numbers, trench.lines, every))


def _given(array: Any) -> Any:
    """The array as one that may not be written, without gaps: one type to compile for."""
    view = np.ascontiguousarray(array).view()
    view.setflags(write=False)
    return view


def _columns(array: Any) -> Any:
    """Components (k, c), each in one piece of memory."""
    return array if array.flags.f_contiguous and array.flags.writeable else np.array(array, order="F")


_NO_LINE = (_given(np.empty((7, 0))), (_given(np.empty((0, 2), np.intp)), _given(np.empty((0, 2), np.intp))))
