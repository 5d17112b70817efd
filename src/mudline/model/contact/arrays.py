"""Names for the array types of this package; positions over time."""

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
        shape, dtype, ndim: those of the array that it stands for.
    """

    shape: tuple[int, ...]
    dtype: np.dtype[np.floating]
    ndim: int

    @abstractmethod
    def __len__(self) -> int:
        """The number of steps."""

    @abstractmethod
    def __getitem__(self, wanted: slice | int) -> NDArray[np.floating]:
        """Some steps (steps, nodes, 3), or one (nodes, 3)."""


@dataclass(frozen=True, slots=True, repr=False)
class Positions:
    """Positions (steps, nodes, 3) in the order of the scene's nodes, NaN for those that the file has not.

    `present` (nodes,) says which nodes the file has; `time` (steps,) is None for a single state without a time.
    `velocities`, where the file has them, are as the positions; `timed` says whether the file has times, else `time`
    counts the steps; `numbered` whether it has the numbers of the nodes, else they are in ascending order.
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
        """All steps at once, those of a file read into memory. Raises OSError, DeckError."""
        return self.values[:]

    @property
    def missing(self) -> int:
        """Number of nodes without a position."""
        return int((~self.present).sum())


def taken(values: NDArray[Item], at: Picked) -> NDArray[Item]:
    """Return columns of values (steps, k); a view where they follow each other."""
    return values[:, at] if isinstance(at, slice) else values.take(at, axis=1)


def put_at(values: NDArray[Item], at: Picked, new: NDArray[Item] | float) -> None:
    """Write columns of values (steps, k); those of one step sooner than `values[:, at] = new`."""
    if len(values) == 1:
        values[0][at] = new if isinstance(new, float) else new[0]
    else:
        values[:, at] = new


def add_at(values: FloatArray, at: Picked, more: FloatArray) -> None:
    """Add to columns of values (steps, k), in place; sooner than `values[:, at] += more`."""
    put_at(values, at, taken(values, at) + more)


def each_at(values: NDArray[Item], steps: IndexArray, at: IndexArray) -> NDArray[Item]:
    """Return `values[steps, at]`; of one step sooner."""
    return values[0].take(at) if len(values) == 1 else values[steps, at]


def add_each(values: FloatArray, steps: IndexArray, at: IndexArray, more: FloatArray) -> None:
    """Add to values at different places, in place."""
    if len(values) == 1:
        values[0][at] += more
    else:
        values[steps, at] += more


def as_range(indices: IndexArray) -> Picked:
    """A slice where the indices follow each other one by one: what it picks is a view and no copy."""
    if not len(indices):
        return slice(0, 0)
    first, last = int(indices[0]), int(indices[-1])
    if last - first + 1 == len(indices) and (np.diff(indices) == 1).all():
        return slice(first, last + 1)
    return indices


def zero_outside(inside: BoolArray, *values: FloatArray) -> None:
    """Set values to 0 but for those inside, whatever they are."""
    if inside.all():
        return
    mask = inside.astype(np.int64)
    np.negative(mask, out=mask)
    for array in values:
        bits = array.view(np.int64)
        np.bitwise_and(bits, mask, out=bits)


def as_velocities(velocities: ArrayLike | None, shape: tuple[int, ...]) -> RealArray | None:
    """Return velocities as (steps, nodes, 3), neither copied nor converted; None where there are none.

    Raises:
        ValueError: they are no real numbers of the shape of the positions.
    """
    if velocities is None:
        return None
    given: RealArray = as_array(velocities, "velocities")
    same = given.shape == shape or (shape[0] == 1 and given.shape == shape[1:])
    if given.dtype.kind not in "iuf" or not same:
        found = f"{given.shape} of {given.dtype}"
        raise ValueError(f"velocities must be real numbers of the shape of the positions, {shape}, not {found}")
    return given.reshape(shape)


def as_times(times: ArrayLike | None, steps: int) -> FloatArray | None:
    """Return times as (steps,) float64; None where there are none.

    Raises:
        ValueError: they are not as many finite numbers as there are steps, each later than the one before.
    """
    if times is None:
        return None
    given = as_array(times, "times")
    if given.dtype.kind not in "iuf":
        raise ValueError(f"times must be real numbers, not {given.dtype}")
    given = given.astype(np.float64)
    if given.shape != (steps,) or not np.isfinite(given).all() or not (np.diff(given) > 0.0).all():
        raise ValueError(f"times must be {steps} finite numbers, each later than the one before")
    return given
