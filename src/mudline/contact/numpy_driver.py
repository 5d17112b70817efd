"""The laws driven by numpy: ranges of elements and of nodes, batches of steps at a time.

Positions are given, so all that knows no history is computed for a batch of steps at once; only the states of suction,
stick points and touchdown points go from step to step. Nothing is checked here: `contact.checks` says whether
everything came out finite, and what did not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.numpy_elements import Elements
from mudline.contact.numpy_nodes import Nodes
from mudline.contact.result import ContactResult
from mudline.contact.seabed.base import FlatSeabed, Seabed
from mudline.contact.state import ContactState
from mudline.contact.tables import Tables

if TYPE_CHECKING:
    from mudline.contact.trenches import LaidCentreline

BLOCK = 32768
"""Elements or nodes, times steps, at a time."""
_WIDTH = 4096
"""Elements or nodes in a range of a long line, at least: over a few steps their parameters and states stay in caches."""
_MOST = 2**20
"""Nodes times steps of a batch, at most."""


class Batch(NamedTuple):
    """Steps to be evaluated.

    Attributes:
        points: (steps, n, 3) positions, NaN for nodes without one.
        speed: (steps, n) velocities along the normals; None where nothing asks for them.
        laid: (n, 3) positions of the first step of the series.
    """

    points: FloatArray
    speed: FloatArray | None
    laid: FloatArray


class Work(NamedTuple):
    """What elements leave for nodes: values (steps, m + 2), between two columns of zeros.

    Attributes:
        planes: three (steps, n) coordinates; none where nothing moves sideways.
        load: half of the force of each element.
        tangent: components of the unit direction of each element, those in the plane of a horizontal seabed alone.
        lateral: the same of the lateral force on each of its nodes.
    """

    planes: list[FloatArray]
    load: FloatArray
    tangent: list[FloatArray]
    lateral: list[FloatArray]


class NumpyDriver:
    """Evaluates batches of steps. Holds no state of a series; may be shared by threads."""

    def __init__(self, tables: Tables, seabed: Seabed) -> None:
        _keep_freed_memory()
        self._tables, self._seabed = tables, seabed
        elements, nodes = len(tables.half), len(tables.given.node_ids)
        longest = max(elements, nodes, 1)
        narrow = min(_WIDTH if tables.history else BLOCK, longest)
        self.steps = max(1, min(BLOCK // narrow, _MOST // longest))
        """How many steps at a time are fastest."""
        width = BLOCK // self.steps
        flat = isinstance(seabed, FlatSeabed)
        slides = tables.friction is not None or tables.lateral is not None
        self._components = (2 if flat else 3) if slides else 0
        starts = range(0, elements, width)
        self._elements = [Elements(tables, start, min(start + width, elements), flat=flat) for start in starts]
        starts = range(0, nodes, width)
        self._nodes = [Nodes(tables, start, min(start + width, nodes), flat=flat) for start in starts]
        self._laid: tuple[FloatArray, LaidCentreline] | None = None

    def locate(self, points: FloatArray, part: ContactResult) -> None:
        """Write gaps and normals of `part` (steps, n)."""
        if self._seabed.same_normal is None:
            self._seabed.locate(points, part.gap, part.normal)
        else:
            self._seabed.gaps(points, part.gap)

    def run(self, batch: Batch, part: ContactResult, state: ContactState) -> None:
        """Write a batch to `part`, but for gaps and normals, which are there; `state` is moved on in place."""
        steps, elements = len(batch.points), len(self._tables.half)
        lateral = self._components if self._tables.lateral is not None else 0
        work = Work(
            [np.ascontiguousarray(batch.points[..., axis]) for axis in range(3 if self._components else 0)],
            _padded(steps, elements),
            [_padded(steps, elements) for _ in range(self._components)],
            [_padded(steps, elements) for _ in range(lateral)],
        )
        for some in self._elements:
            some.run(batch, part, state, work)
        laid = None if self._tables.trench is None else self._laid_line(batch.laid)
        for some_nodes in self._nodes:
            some_nodes.run(part, state, work, laid)

    def _laid_line(self, laid: FloatArray) -> LaidCentreline:
        """The line as it was `laid`, prepared once: the states of a run share that array."""
        from mudline.contact.trenches import LaidCentreline  # noqa: PLC0415 - only now is it needed

        kept = self._laid
        if kept is None or kept[0] is not laid:
            # in one assignment, so that threads which share the driver see pairs that belong together
            self._laid = kept = (laid, LaidCentreline(laid, self._tables.line))
        return kept[1]


def _padded(steps: int, columns: int) -> FloatArray:
    found = np.empty((steps, columns + 2))
    found[:, 0] = found[:, -1] = 0.0
    return found


def _keep_freed_memory() -> None:
    """Have the C library keep the arrays of a batch for those of the next.

    That of GNU gives a large array back to the system as soon as it is freed, and touching new memory costs more than
    what is computed in it. How large that is follows the largest array that was freed so far, up to 32 MiB; one that
    is never touched costs nothing.
    """
    np.empty(31 * 2**20, np.int8)
