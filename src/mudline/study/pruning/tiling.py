"""A deck's line made as long as is wanted: its own elements over and over, joined in a chain."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mudline.contact.arrays import IndexArray
from mudline.contact.input import AssignedLaw, ContactInput, LawAssignment


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
        laws=tuple(
            _tiled(given, origin if given.law.acts_on == "nodes" else picked) for given in inputs.assigned.values()
        ),
        weight=None if inputs.weight is None else inputs.weight[picked],
    )


def chain(nodes: int) -> IndexArray:
    """The nodes (m, 2) of elements that follow each other."""
    found: IndexArray = np.column_stack([np.arange(nodes - 1), np.arange(1, nodes)])
    return found


def _tiled(given: AssignedLaw, origin: IndexArray) -> LawAssignment:
    """A law on copies of elements or nodes, whose origins are given."""
    place = np.minimum(np.searchsorted(given.rows, origin), len(given.rows) - 1)
    held: IndexArray = np.flatnonzero(given.rows[place] == origin)
    parameters = {name: values[place[held]] for name, values in given.parameters.items()}
    return LawAssignment(given.law.name, held, parameters)
