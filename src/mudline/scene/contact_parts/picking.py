"""Values of the blocks of a keyword, for elements and for nodes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mudline.scene.numbering import Floats, Indices, Mask


def picked(values: Iterable[float], index: Indices) -> Floats:
    """The value of each index; NaN for -1."""
    found: Floats = np.array([*values, np.nan], dtype=np.float64)[index]
    return found


def marked(flags: Iterable[bool], index: Indices) -> Mask:
    """The flag of each index; False for -1."""
    found: Mask = np.array([*flags, False], dtype=np.bool_)[index]
    return found


def at_nodes(of_element: Indices, element_nodes: Indices, nodes: int) -> Indices:
    """For each node the last block, by the order of the file, that one of its elements follows; -1 for none."""
    found = np.full(nodes, -1, dtype=np.intp)
    for end in element_nodes.T:
        np.maximum.at(found, end, of_element)
    return found


def summed(values: Floats, element_nodes: Indices, nodes: int) -> Floats:
    """The sum of the values (m,) of each node's elements."""
    total = np.zeros(nodes)
    for end in element_nodes.T:
        np.add.at(total, end, values)
    return total


def touched(elements: Mask, element_nodes: Indices, nodes: int) -> Mask:
    """The nodes of which an element is marked."""
    found = np.zeros(nodes, dtype=np.bool_)
    found[element_nodes[elements].ravel()] = True
    return found
