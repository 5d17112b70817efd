"""Compiled steps for a model: from positions and states of its own kind to results and states."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.compiled.kernel import walk
from mudline.contact.compiled.memory import Memory, blank_memory, cleared, memory_of, out_of, state_of, work
from mudline.contact.compiled.tables import Tables, two_of_each
from mudline.contact.compiled.walk import Ground, Path
from mudline.contact.floors.base import Floor
from mudline.contact.floors.flat import FlatFloor
from mudline.contact.floors.sloping import SlopingFloor
from mudline.contact.result import ContactResult
from mudline.contact.state import ContactState


class Runner:
    """Goes through one series, a few steps at a time.

    Two memories take turns, so a state it returns is good until the next but one call.
    """

    def __init__(self, flat: Tables, floor: Floor, present: BoolArray) -> None:
        self._tables = flat
        self._floor = floor
        self._work = work(len(present), len(flat.elements.ends))
        self._spare: list[Memory] = []
        plain = 1 if isinstance(floor, FlatFloor) else 2 if isinstance(floor, SlopingFloor) else 0
        self._ground = Ground(plain, two_of_each(flat.elements.ends, present))

    def advance(
        self, points: FloatArray, rates: FloatArray, since: FloatArray, part: ContactResult, state: ContactState
    ) -> ContactState | None:
        """Write the steps of `points` (steps, n, 3) to `part`, behind `state`; return the state behind them.

        `rates` are the velocities (steps, n, 3) and `since` zeros (steps,), or `rates` the points again and `since` the
        times since the steps before: 0 for no velocity. None: something is not finite, and `part` is as it was.
        """
        before = memory_of(state)
        after = self._spare.pop(0) if len(self._spare) > 1 else blank_memory(before)
        same = self._floor.same_normal
        if self._ground.plain == 0:
            if same is None:
                self._floor.locate(points, part.gap, part.normal)
            else:
                self._floor.gaps(points, part.gap)
        laid = points[0] if state.laid is None else state.laid
        path = Path(
            _given(points),
            _given(rates),
            since,
            _given(points[0] if state.positions is None else state.positions),
            _given(laid),
            _given(part.normal if same is None else same.reshape(1, 1, 3)),
        )
        if walk(path, self._ground, self._tables, (before, after), self._work, out_of(part)) >= 0:
            cleared(part)
            return None
        self._spare.append(after)
        return state_of(after, state, points[-1], laid)


def _given(array: FloatArray) -> FloatArray:
    """The array as one that may not be written, without gaps."""
    view = np.ascontiguousarray(array).view()
    view.setflags(write=False)
    return view
