"""What compiled loops write: the arrays of a result, what elements and nodes remember, and work arrays."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, StateArray
from mudline.contact.result import ContactResult
from mudline.contact.state import ContactState


class Out(NamedTuple):
    """Arrays of a result, for elements (steps, m) and nodes (steps, n); without a step where a result has none."""

    depth: FloatArray
    ratio: FloatArray
    contact: BoolArray
    force: FloatArray
    slope: FloatArray
    stiffness: FloatArray
    cut: BoolArray
    state: StateArray
    gap: FloatArray
    normal_force: FloatArray
    reaction: FloatArray
    friction: FloatArray
    friction_state: StateArray


class Memory(NamedTuple):
    """The arrays of a `ContactState`, without rows where it has none."""

    stiffness: FloatArray
    z_max: FloatArray
    force_max: FloatArray
    z_p: FloatArray
    armed: BoolArray
    v_max: FloatArray
    state: StateArray
    anchors: FloatArray
    rubbing: StateArray
    touchdown: FloatArray


class Work(NamedTuple):
    """What loops tell each other.

    Attributes:
        along: (n,) pull-out velocities.
        tangent: (n, 3) sums of tangents of elements, then the directions u1 along the line.
        sideways: (n, 3) forces of lateral springs.
        height: (m,) uplift, from the trench bottom where there is one.
        compressed: (m,) elements below it, or in contact.
    """

    along: FloatArray
    tangent: FloatArray
    sideways: FloatArray
    height: FloatArray
    compressed: BoolArray


def out_of(part: ContactResult) -> Out:
    """The arrays of a result."""
    return Out(
        part.depth,
        part.ratio,
        part.contact,
        part.force,
        part.slope,
        part.stiffness,
        part.cut,
        np.empty((0, 0), np.int8) if part.state is None else part.state,
        part.gap,
        part.normal_force,
        part.reaction,
        np.empty((0, 0, 2)) if part.friction is None else part.friction,
        np.empty((0, 0, 2), np.int8) if part.friction_state is None else part.friction_state,
    )


def cleared(part: ContactResult) -> None:
    """Take back what was written, so that stages may begin anew."""
    for array in (part.force, part.slope, part.stiffness, part.cut, part.normal_force, part.reaction):
        array[...] = 0
    if part.friction is not None:
        part.friction[...] = 0.0
    for states in (part.state, part.friction_state):
        if states is not None:
            states[...] = -1


def memory_of(state: ContactState) -> Memory:
    """The arrays of a state."""
    lines, pulls, rubs = state.unloading, state.suction, state.friction
    none = np.empty(0)
    found = Memory(
        *((none,) * 4 if lines is None else (lines.stiffness, lines.z_max, lines.force_max, lines.z_p)),
        *((none > 0.0, none, none.astype(np.int8)) if pulls is None else (pulls.armed, pulls.v_max, pulls.state)),
        *((np.empty((0, 3)), np.empty((0, 2), np.int8)) if rubs is None else (rubs.anchors, rubs.states)),
        np.empty((0, 3)) if state.touchdown is None else state.touchdown,
    )
    return Memory._make(np.require(array, requirements=("C", "W")) for array in found)


def state_of(memory: Memory, before: ContactState, positions: FloatArray, laid: FloatArray) -> ContactState:
    """The state that has these arrays, where `before` has some."""
    return ContactState(
        positions=positions,
        laid=laid,
        unloading=before.unloading
        and replace(
            before.unloading,
            stiffness=memory.stiffness,
            z_max=memory.z_max,
            force_max=memory.force_max,
            z_p=memory.z_p,
        ),
        suction=before.suction and replace(before.suction, armed=memory.armed, v_max=memory.v_max, state=memory.state),
        friction=before.friction and replace(before.friction, anchors=memory.anchors, states=memory.rubbing),
        touchdown=None if before.touchdown is None else memory.touchdown,
    )


def blank_memory(memory: Memory) -> Memory:
    """Memory of the same sizes, not yet written."""
    blank = Memory._make(np.empty_like(array) for array in memory)
    blank.touchdown.fill(np.nan)  # elements without a lateral spring are not written
    return blank


def work(nodes: int, elements: int) -> Work:
    """Work arrays for so many nodes and elements."""
    at_nodes = (np.zeros(nodes), np.zeros((nodes, 3)), np.zeros((nodes, 3)))
    return Work(*at_nodes, np.zeros(elements), np.zeros(elements, np.bool_))
