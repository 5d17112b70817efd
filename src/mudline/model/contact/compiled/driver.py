"""The laws driven by compiled loops (numba, the extra `mudline[fast]`): same bits as the numpy driver, but faster.

A loop is compiled for the laws of a scene, kept in numba's cache on disk, and run over all elements, then over all
nodes, on several threads if there is enough work. Positions are given, so elements are independent of each other, and
so are nodes.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from importlib import import_module
from inspect import isfunction
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

import numba
import numpy as np
from numba.extending import overload

from mudline.model.contact import vectors
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.compiled import (
    beside,
    between,
    breakout_table,
    element_tables,
    features_of,
    formulas,
    functions,
    node_tables,
    plain,
    read_only,
    suction_table,
    trench_tables,
)
from mudline.model.contact.compiled.functions import Loop, edition
from mudline.model.contact.compiled.loops import whole_loop
from mudline.model.contact.laws import MODULES, PathLaw, every, where
from mudline.model.contact.result import ContactResult
from mudline.model.contact.seabed import FlatSeabed, Seabed
from mudline.model.contact.tables import IN_PLACE, ContactState, LawTables, NormalRows, StepBatch, arrays_of

_BATCH = 3 * 2**19
"""Largest number of nodes times steps at a time."""
_STEPS = 64
_NO_SPEED = np.empty((0, 0))
_WORTH_THREADS = 60_000
"""Number of nodes times steps of a batch above which several threads are worth their start."""


Function = TypeVar("Function", bound=Callable[..., Any])


def _pick(condition: bool, value: float, otherwise: float) -> float:  # noqa: FBT001 - as `where` is called
    """Return one of two numbers, see `where`."""
    return value if condition else otherwise


_INNER: Any = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True, "forceinline": True}
"""Options of functions that only loops call: no contraction of products and sums, divisions as in numpy."""

overload(where, jit_options=_INNER, strict=False)(lambda *_: _pick)
overload(every, jit_options=_INNER, strict=False)(lambda _: lambda condition: condition)


@cache
def callable_in_loops(function: Function) -> Function:
    """Make a function callable in compiled loops, and return it."""
    overload(function, jit_options=_INNER, strict=False)(lambda *_: function)
    return function


for _module in (functions, vectors, *(import_module(f"mudline.model.contact.laws.{name}") for name in MODULES)):
    for _function in vars(_module).values():
        if isfunction(_function) and _function.__module__ == _module.__name__:
            callable_in_loops(_function)


@cache
def _loop(make: Callable[..., Loop], *options: Any) -> Loop:
    """Return the loop for some options, made once; it is compiled at its first call, or loaded from the cache."""
    always: Any = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
    loop: Any = make(*options)
    try:
        compiled: Loop = numba.njit(cache=True, **always)(loop)
    except RuntimeError:  # numba has no place to write its cache
        compiled = numba.njit(**always)(loop)
    return compiled


_Job = tuple[Any, ...]
"""Arguments of the loop for a batch, after the ranges."""


_NO_LOOP: type[Exception] = getattr(numba.core.errors, "UnsupportedBytecodeError", numba.core.errors.NumbaError)
"""Error that numba raises for Python that it cannot compile; `NumbaError` in older versions."""


class CompiledDriver:
    """Evaluator of batches of steps. Holds no state of a series; may be shared by threads."""

    def __init__(self, tables: LawTables, seabed: Seabed, threads: int) -> None:
        """Prepare the tables of the loops, and the loops, which are compiled at their first call."""
        given = tables.given
        self._tables, self._threads = tables, threads
        self._pool: ThreadPoolExecutor | None = None
        self._normal = None if seabed.same_normal is None else read_only(seabed.same_normal.reshape(1, 1, 3))
        self._nodes, self._elements = len(given.node_ids), len(given.element_ids)
        has = features_of(tables, flat=isinstance(seabed, FlatSeabed))
        self._has = has
        normal = formulas(tables)
        slopes = tuple((_as_reaction(rows.law.steepest), len(rows.law.parameters)) for rows in normal if has.steepens)
        sources = edition(tuple(rows.law for rows in (*tables.normal, *tables.nodal)))
        paths = tuple(rows.law for rows in normal if isinstance(rows.law, PathLaw))
        self._loop = _loop(
            whole_loop,
            callable_in_loops,
            (has, _equations(normal), paths, slopes, sources),
            (has, _equations(tables.nodal), sources),
        )
        given_damping = tables.damping, tables.nodal_damping
        damping, of_nodes = (read_only(np.empty(0) if each is None else each) for each in given_damping)
        line = tables.line
        of_line = line.elements.astype(np.uint32), line.senses, tables.half
        of_elements = element_tables(tables)
        self._fixed = (
            (*of_elements, suction_table(tables), damping),
            (
                between(line.start), *map(read_only, of_line), of_elements[0], *node_tables(tables), of_nodes,
                trench_tables(tables), breakout_table(tables),
            ),
        )  # fmt: skip
        self._made: WeakKeyDictionary[ContactResult | ContactState, tuple[Any, ...]] = WeakKeyDictionary()
        ends, elements_at = (line.ends, line.beside) if has.trench else (np.empty((0, 2)), np.empty((0, 2)))
        self._beside = beside(ends, elements_at)
        self.steps = max(1, min(_BATCH // max(self._nodes, 1), _STEPS))
        """Number of steps at a time that is fastest."""
        self._whole = _ranges(elements=(0, self._elements), nodes=(0, self._nodes))
        self._shares = (
            [_ranges(elements=share) for share in _shared(self._elements, threads)],
            [_ranges(nodes=share) for share in _shared(self._nodes, threads)],
        )
        """Ranges of each thread, of elements and then of nodes."""
        self.broken = False
        """True after a law failed to compile."""

    def run(self, batch: StepBatch, part: ContactResult, state: ContactState, after: ContactState) -> bool:
        """Write a batch to `part` except gaps and normals, which are there already, and the new state to `after`.

        Return False if a value is not finite: the numpy driver then raises the error.
        """
        speed = batch.speed
        after.remember(state, IN_PLACE)
        points, arrays = self._arrays(part, batch.points)
        job = (
            *self._fixed, points, _NO_SPEED if speed is None else speed,
            self._laid_tables(batch.laid, complete=batch.complete),
            self._work(len(points)),
            arrays, self._remembered(state), self._remembered(after),
        )  # fmt: skip
        try:
            return not self._run(job, together=self._threads > 1 and len(points) * self._nodes >= _WORTH_THREADS)
        except (numba.core.errors.NumbaError, _NO_LOOP) as error:
            first = str(error).strip().splitlines()[0]
            warnings.warn(f"the laws cannot be compiled and are evaluated with numpy: {first}", RuntimeWarning, 3)
            self.broken = True
            return False

    def _run(self, job: _Job, *, together: bool) -> int:
        """Write all elements and nodes, on one or several threads; return the number of values that are not finite."""
        if not together:
            return self._loop(self._whole, *job)
        if self._pool is None:
            self._pool = ThreadPoolExecutor(self._threads)
        pool = self._pool
        return sum(sum(pool.map(lambda ranges: self._loop(ranges, *job), shares)) for shares in self._shares)

    def _work(self, steps: int) -> tuple[Any, ...]:
        """Return the arrays for directions and lateral forces of elements, which nodes need."""
        components = 2 if self._has.flat else 3
        shape, none = (steps, self._elements, components), (0, 0, components)
        return np.empty(shape if self._has.slides else none), np.empty(shape if self._has.lateral else none)

    def _arrays(self, part: ContactResult, points: FloatArray) -> tuple[Any, ...]:
        """Return positions and the arrays of a result as the loops take them; made once for each result."""
        arrays = self._made.get(part)
        if arrays is not None and arrays[0].base is points:
            return arrays
        none = np.zeros((0, 0), np.int8)
        of_elements = (
            (part.depth, part.ratio, part.contact, part.force, part.slope, part.stiffness),
            part.cut if part.cut.flags.writeable else none > 0,
            none if part.state is None else part.state,
            none > 0 if part.regularised is None else part.regularised,
        )
        of_nodes = (
            part.normal_force,
            part.reaction,
            np.empty((0, 0, 2)) if part.friction is None else part.friction,
            np.zeros((0, 0, 2), np.int8) if part.friction_state is None else part.friction_state,
        )
        normals = read_only(part.normal) if self._normal is None else self._normal
        arrays = self._made[part] = read_only(points), (part.gap, normals, of_elements, of_nodes)
        return arrays

    def _remembered(self, state: ContactState) -> tuple[Any, ...]:
        """Return the histories of elements and of nodes as the loops take them; made once for each state."""
        if (histories := self._made.get(state)) is not None:
            return histories
        lines, pulls, friction = state.unloading, state.suction, state.friction
        histories = self._made[state] = (
            (
                (np.empty(0),) * 4 if lines is None else tuple(map(plain, arrays_of(lines))),
                (np.empty(0),) * 5 if pulls is None else tuple(map(plain, arrays_of(pulls))),
                np.empty((3, 0)) if state.touchdown is None else plain(state.touchdown.T),
                np.empty((0, 0)) if state.paths is None else plain(state.paths),
            ),
            (
                np.empty((3, 0)) if friction is None else plain(friction.stick_points.T),
                np.zeros((2, 0), np.int8) if friction is None else plain(friction.states.T),
                np.empty((5, 0)) if state.breakout is None else plain(state.breakout),
            ),
        )
        return histories

    def _laid_tables(self, laid: FloatArray, *, complete: bool) -> tuple[Any, ...]:
        if self._tables.trench is None or complete:
            return read_only(laid), self._beside
        line = self._tables.laid_line(laid)  # without elements at a node without a position
        return read_only(laid), beside(line.ends, line.elements_at)


def _shared(count: int, threads: int) -> list[tuple[int, int]]:
    """Return the begin and the end of each thread's part of `count` rows."""
    return [(count * thread // threads, count * (thread + 1) // threads) for thread in range(threads)]


def _ranges(*, elements: tuple[int, int] = (0, 0), nodes: tuple[int, int] = (0, 0)) -> Any:
    """Return ranges of elements and of nodes as the compiled loop takes them."""
    return read_only(np.array([*elements, *nodes], np.uint64))


def _equations(laws: Iterable[NormalRows]) -> tuple[tuple[Callable[..., Any], int], ...]:
    """Return the reaction of each law and its number of parameters."""
    return tuple((rows.law.reaction, len(rows.law.parameters)) for rows in laws)


@cache
def _as_reaction(steepest: Callable[..., Any]) -> Callable[..., tuple[float, float]]:
    """Return the steepest slope of a law in the form of a reaction."""
    inner = callable_in_loops(steepest)

    def slope(z: float, diameter: float, *parameters: float) -> tuple[float, float]:
        return inner(z, diameter, *parameters), 0.0

    return slope
