"""Derivatives of a step of friction, for tangents."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.friction.return_mapping import ExtraLimit, FrictionForce, Moved, PreparedLaw, gauge


class _Change(NamedTuple):
    """Derivatives of the springs' forces (n, 2): by position (n, 2, 2), by offset (n, 2), by normal force (n, 2)."""

    by_position: FloatArray
    by_offset: FloatArray
    by_compression: FloatArray


class _Given(NamedTuple):
    """What the derivatives are made of, (n, 2) each: springs, trials, limits and derivatives of the last two."""

    stiffness: FloatArray
    trial: FloatArray
    trial_by_compression: FloatArray
    limit: FloatArray
    limit_by_compression: FloatArray
    limit_by_offset: FloatArray


def with_derivatives(held: PreparedLaw, moved: Moved, extra: ExtraLimit | None) -> FrictionForce:
    """The step with its derivatives; `extra` is what the limits of the step had."""
    by_offset = np.zeros(moved.force.shape)
    if extra is not None and moved.limits.against is not None:
        by_offset[:, 1] = np.where(moved.limits.against, extra.slope, 0.0)
    rising = held.rising * moved.springs.elongation
    given = _Given(
        moved.springs.stiffness, moved.springs.trial, rising, moved.limits.force, held.coefficients, by_offset
    )
    change = _box(given, moved.slips)
    curved = held.curved[moved.closed[held.curved]]
    if curved.size:
        ellipses = _ellipse(_Given(*(values[curved] for values in given)))
        for whole, values in zip(change, ellipses, strict=True):
            whole[curved] = values
    drag = moved.force * moved.moved
    return FrictionForce(
        moved.force,
        _on_pipe(change.by_position, moved.anchored),  # where it touches down there is no force, wherever that is
        _on_pipe(change.by_offset, moved.closed),
        _on_pipe(change.by_compression, moved.closed),
        moved.springs.elongation,
        np.where(moved.closed, 0.0 - (drag[:, 0] + drag[:, 1]), 0.0),
        moved.history,
    )


def _box(given: _Given, slips: BoolArray) -> _Change:
    """Each direction for itself."""
    side = np.sign(given.trial)
    by_position = np.zeros((*slips.shape, 2))
    for axis in range(2):
        by_position[:, axis, axis] = np.where(slips[:, axis], 0.0, given.stiffness[:, axis])
    by_offset = np.where(slips, side * given.limit_by_offset, 0.0)
    by_compression = np.where(slips, side * given.limit_by_compression, given.trial_by_compression)
    return _Change(by_position, by_offset, by_compression)


def _ellipse(given: _Given) -> _Change:
    """Both directions together."""
    able, trial, share, slides, size = gauge(given.trial, given.limit)
    scale = size[:, None]
    force = trial / scale
    unit = np.where(slides[:, None] & able, share / scale, 0.0)
    # relative change of the gauge with a trial force and, falling, with a limit
    by_trial = np.divide(unit, given.limit * scale, out=np.zeros_like(trial), where=able)
    by_limit = np.divide(unit * unit, given.limit, out=np.zeros_like(trial), where=able)
    stiffness = np.where(able, given.stiffness, 0.0)
    growth_by_position = by_trial * stiffness
    growth_by_offset = 0.0 - (by_limit * given.limit_by_offset).sum(axis=1)
    trial_by_n = np.where(able, given.trial_by_compression, 0.0)
    growth_by_n = (by_trial * trial_by_n - by_limit * given.limit_by_compression).sum(axis=1)
    by_position = -force[:, :, None] * growth_by_position[:, None, :]
    for axis in range(2):
        by_position[:, axis, axis] += stiffness[:, axis] / scale[:, 0]
    by_offset = 0.0 - force * growth_by_offset[:, None]
    return _Change(by_position, by_offset, trial_by_n / scale - force * growth_by_n[:, None])


def _on_pipe(values: FloatArray, closed: BoolArray) -> FloatArray:
    """The reaction to what the springs feel; nothing where a node is open, and no -0."""
    shape = (-1,) + (1,) * (values.ndim - 1)
    return np.where(closed.reshape(shape), 0.0 - values, 0.0)
