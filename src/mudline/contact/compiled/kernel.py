"""The compiled walk; importing this loads numba and compiles, or finds what an earlier process compiled."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import compiled, edition
from mudline.contact.compiled.memory import blank_memory, memory_of, out_of, work
from mudline.contact.compiled.tables import tables, two_of_each
from mudline.contact.compiled.walk import Ground, Path, walk_for
from mudline.contact.extras import Extras
from mudline.contact.inputs import ContactInput
from mudline.contact.result import blank_result
from mudline.contact.state import ContactState


def _example() -> tuple[object, ...]:
    """Arguments of the types that there are: of an input without elements and nodes."""
    whole, real, yes, law = np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.bool_), np.zeros(0, np.int8)
    inputs = ContactInput(whole, np.zeros((0, 3)), whole, np.zeros((0, 2), np.int64), real, real, law, whole, (), real)
    flat = tables(inputs, real)
    part = blank_result(1, yes, yes, Extras(), np.zeros(3))
    memory = memory_of(ContactState())
    path = Path(_given(3), _given(3), np.zeros(1), _given(2), _given(2), _given(3))
    ground = Ground(1, two_of_each(flat.elements.ends, yes))
    return path, ground, flat, (memory, blank_memory(memory)), work(0, 0), out_of(part)


def _given(axes: int) -> FloatArray:
    """An array of the type of those that may not be written."""
    array = np.zeros((1,) * axes)
    array.setflags(write=False)
    return array


walk = compiled(walk_for(edition()), _example())
