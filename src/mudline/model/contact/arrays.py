"""Array types of the contact model, and positions over time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.arguments import as_array
from mudline.basics.short_repr import short_repr

BoolArray = NDArray[np.bool_]
FloatArray = NDArray[np.float64]
IdArray = NDArray[np.int64]
IndexArray = NDArray[np.intp]
SmallIndexArray = NDArray[np.int32]
StateArray = NDArray[np.int8]
RealArray = NDArray[np.floating[Any] | np.integer[Any]]
Picked = IndexArray | slice
Item = TypeVar("Item", bound=np.generic)


class StepReader(ABC):
    """A series (steps, nodes, 3) of real numbers that is not in memory.

    Attributes:
        shape, dtype, ndim: as of a numpy array with the same values.
    """

    shape: tuple[int, ...]
    dtype: np.dtype[np.floating]
    ndim: int

    @abstractmethod
    def __len__(self) -> int:
        """The number of steps."""

    @abstractmethod
    def __getitem__(self, steps: slice | int) -> NDArray[np.floating]:
        """Return some steps (steps, nodes, 3), or a single step (nodes, 3)."""


@dataclass(frozen=True, slots=True, repr=False)
class Positions:
    """Positions (steps, nodes, 3) in the order of the scene's nodes, NaN for nodes that the file lacks.

    Attributes:
        values: the positions.
        present: (nodes,) nodes that have a position in the file.
        time: (steps,) times, or the numbers of the steps; None for a single state without a time.
        velocities: velocities of the shape of the positions, if the file has any.
        timed: whether the file has times.
        numbered: whether the file has the numbers of the nodes; else they are in ascending order.
    """

    values: NDArray[np.floating] | StepReader
    present: BoolArray
    time: FloatArray | None
    velocities: NDArray[np.floating] | None = None
    timed: bool = True
    numbered: bool = True

    __repr__ = short_repr

    @property
    def whole(self) -> NDArray[np.floating]:
        """All steps in memory. Raises OSError, DeckError."""
        return self.values[:]

    @property
    def missing(self) -> int:
        """Number of nodes without a position."""
        return int((~self.present).sum())


def taken(values: NDArray[Item], at: Picked) -> NDArray[Item]:
    """Return columns of values (steps, k); a view if `at` is a slice."""
    return values[:, at] if isinstance(at, slice) else values.take(at, axis=1)


def as_range(indices: IndexArray) -> Picked:
    """Return consecutive indices as a slice, which picks a view; other indices unchanged."""
    if not len(indices):
        return slice(0, 0)
    first, last = int(indices[0]), int(indices[-1])
    if last - first + 1 == len(indices) and (np.diff(indices) == 1).all():
        return slice(first, last + 1)
    return indices


def summed(values: FloatArray, element_nodes: IndexArray, nodes: int) -> FloatArray:
    """Return the sum of the values (m,) of each node's elements."""
    total = np.zeros(nodes)
    for end in element_nodes.T:
        np.add.at(total, end, values)
    return total


def as_velocities(velocities: ArrayLike | None, shape: tuple[int, ...]) -> RealArray | None:
    """Return velocities as (steps, nodes, 3), neither copied nor converted; None stays None.

    Raises:
        ValueError: the velocities are not real numbers of the shape of the positions.
    """
    if velocities is None:
        return None
    array: RealArray = as_array(velocities, "velocities")
    same = array.shape == shape or (shape[0] == 1 and array.shape == shape[1:])
    if array.dtype.kind not in "iuf" or not same:
        actual = f"{array.shape} of {array.dtype}"
        raise ValueError(f"velocities must be real numbers of the shape of the positions, {shape}, not {actual}")
    return array.reshape(shape)


def as_times(times: ArrayLike | None, steps: int) -> FloatArray | None:
    """Return times as (steps,) float64; None stays None.

    Raises:
        ValueError: the times are not one finite number for each step, each later than the one before.
    """
    if times is None:
        return None
    array = as_array(times, "times")
    if array.dtype.kind not in "iuf":
        raise ValueError(f"times must be real numbers, not {array.dtype}")
    array = array.astype(np.float64)
    if array.shape != (steps,) or not np.isfinite(array).all() or not (np.diff(array) > 0.0).all():
        raise ValueError(f"times must be {steps} finite numbers, each later than the one before")
    return array
