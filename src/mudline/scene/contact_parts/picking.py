"""Values of the blocks of a keyword, for elements and for nodes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mudline.diagnostics import Where
from mudline.scene.contact_parts.refused import RefusedError
from mudline.scene.extensions import Extension
from mudline.scene.numbering import Floats, Ids, Indices, Mask


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


def refuse(extension: Extension, elements: Mask, ids: Ids, what: str, *key: str) -> None:
    """Refuse the block that the first of the marked elements follows, or its value `key`, if there is one."""
    at = np.flatnonzero(elements)
    if at.size:
        message = f"{what}: {_named(ids[at])}; this cannot be evaluated"
        where = extension.places[int(extension.of_element[at[0]])]
        raise RefusedError(message, where._replace(path=(*where.path, *key)))


def refuse_entry(where: Where, key: str | int, what: str) -> None:
    """Refuse a value of a block."""
    raise RefusedError(f"{what}; this cannot be evaluated", where._replace(path=(*where.path, key)))


def _named(ids: Ids) -> str:
    return f"element {ids[0]}" if ids.size == 1 else f"{ids.size} elements (first: {ids[0]})"
