"""A deck's line made as long as is wanted: its own elements over and over, joined in a chain."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from mudline.contact.arrays import IndexArray
from mudline.contact.extras import ElementSuction, Extras, NodeFriction, NodeTrench
from mudline.contact.inputs import ContactInput

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Part = TypeVar("Part", bound="DataclassInstance")


def tiled(inputs: ContactInput, nodes: int) -> ContactInput:
    """An input with this many nodes, in one chain; each copy lies where the deck's own line lies.

    With fewer nodes than the deck has, elements are picked evenly. Raises ValueError without elements or for less
    than two nodes.
    """
    own = len(inputs.element_ids)
    if not own or nodes < 2:
        raise ValueError("a line needs an element and two nodes")
    elements = nodes - 1
    picked: IndexArray = np.arange(elements) % own if elements >= own else np.arange(elements) * own // elements
    origin = np.append(inputs.element_nodes[picked, 0], inputs.element_nodes[picked[-1], 1])
    return replace(
        inputs,
        node_ids=np.arange(1, nodes + 1),
        coordinates=inputs.coordinates[origin],
        element_ids=np.arange(1, nodes),
        element_nodes=chain(nodes),
        length=inputs.length[picked],
        diameter=inputs.diameter[picked],
        law=inputs.law[picked],
        curve_index=inputs.curve_index[picked],
        linear_stiffness=inputs.linear_stiffness[picked],
        extras=_extras(inputs.extras, picked, origin, own),
    )


def chain(nodes: int) -> IndexArray:
    """The nodes (m, 2) of elements that follow each other."""
    found: IndexArray = np.column_stack([np.arange(nodes - 1), np.arange(1, nodes)])
    return found


def _extras(extras: Extras, picked: IndexArray, origin: IndexArray, own: int) -> Extras:
    friction, trench = extras.friction, extras.trench
    return Extras(
        smoothing=None if extras.smoothing is None else _rows(extras.smoothing, picked),
        nodal=None if extras.nodal is None else _rows(extras.nodal, origin),
        unloading=None if extras.unloading is None else extras.unloading[picked],
        suction_springs=None if extras.suction_springs is None else _rows(extras.suction_springs, picked),
        suction=None if extras.suction is None else _suction(extras.suction, picked, own),
        friction=None if friction is None else NodeFriction(_rows(friction.law, origin), friction.angle[origin]),
        lateral=None if extras.lateral is None else extras.lateral[picked],
        trench=None if trench is None else NodeTrench(_rows(trench.law, origin), trench.straight[origin]),
    )


def _suction(suction: ElementSuction, picked: IndexArray, own: int) -> ElementSuction:
    row = np.full(own, -1, np.intp)
    row[suction.elements] = np.arange(len(suction.elements))
    held: IndexArray = np.flatnonzero(row[picked] >= 0)
    rows = row[picked[held]]
    return ElementSuction(held, type(suction.law)(*(values[rows] for values in suction.law)))


def _rows(part: Part, rows: IndexArray) -> Part:
    """Those rows of all arrays of a dataclass."""
    return type(part)(*(getattr(part, field.name)[rows] for field in fields(part)))
