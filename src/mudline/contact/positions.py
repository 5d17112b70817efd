"""Positions of the nodes: what is accepted, and reading them a few steps at a time."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.contact.arrays import BoolArray, FloatArray, IdArray
from mudline.contact.errors import PositionError

RealArray = NDArray[np.floating[Any] | np.integer[Any]]


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


def as_series(positions: ArrayLike, nodes: int) -> RealArray:
    """Return (nodes, 3) or (steps, nodes, 3) positions as (steps, nodes, 3), neither copied nor converted.

    Raises:
        ValueError: the shape or the kind of number is not one of these.
    """
    given: RealArray = np.asarray(positions)
    if given.dtype.kind not in "iuf":
        raise ValueError(f"positions must be real numbers, not {given.dtype}")
    if given.ndim not in {2, 3} or given.shape[-2:] != (nodes, 3):
        expected = f"({nodes}, 3) or (steps, {nodes}, 3)"
        raise ValueError(f"positions must have the shape {expected}, not {given.shape}")
    return given if given.ndim == 3 else given[np.newaxis]


def as_mask(present: ArrayLike | None, nodes: int) -> BoolArray:
    """Return which nodes have a position; None means all of them.

    Raises:
        ValueError: `present` is no array (nodes,) of booleans.
    """
    if present is None:
        return np.ones(nodes, np.bool_)
    mask = np.array(present)
    if mask.dtype != np.bool_ or mask.shape != (nodes,):
        raise ValueError(f"present must be booleans of shape ({nodes},), not {mask.dtype} of shape {mask.shape}")
    return mask


def read_steps(series: RealArray, steps: range, node_ids: IdArray, present: BoolArray) -> FloatArray:
    """Return the positions (steps, nodes, 3) of a few steps as float64, NaN for the nodes that are not present.

    Raises:
        PositionError: a position of a node that is present is NaN, infinite or too large for a float64.
    """
    points = np.asarray(series[steps.start : steps.stop], dtype=np.float64)
    # a finite sum has finite terms only, and is sooner had than a look at each of them
    if not np.isfinite(points.sum()) and (bad := np.argwhere(~np.isfinite(points).all(axis=2) & present)).size:
        row, column = bad[0].tolist()
        step, node = steps.start + row, int(node_ids[column])
        place = tuple(points[row, column].tolist())
        raise PositionError(f"node {node} at step {step}: its position {place} is not finite", node, step)
    return points if present.all() else np.where(present[:, np.newaxis], points, np.nan)


def as_velocities(velocities: ArrayLike | None, shape: tuple[int, ...]) -> RealArray | None:
    """Return velocities as (steps, nodes, 3), neither copied nor converted; None where there are none.

    Raises:
        ValueError: they are no real numbers of the shape of the positions.
    """
    if velocities is None:
        return None
    given: RealArray = np.asarray(velocities)
    same = given.shape == shape or (shape[0] == 1 and given.shape == shape[1:])
    if given.dtype.kind not in "iuf" or not same:
        raise ValueError(f"velocities must be real numbers of the shape of the positions, {shape}, not {given.shape}")
    return given.reshape(shape)


def as_times(times: ArrayLike | None, steps: int) -> FloatArray | None:
    """Return times as (steps,) float64; None where there are none.

    Raises:
        ValueError: they are not as many finite numbers as there are steps, each later than the one before.
    """
    if times is None:
        return None
    given = np.asarray(times, dtype=np.float64)
    if given.shape != (steps,) or not np.isfinite(given).all() or not (np.diff(given) > 0.0).all():
        raise ValueError(f"times must be {steps} finite numbers, each later than the one before")
    return given
