"""Stretch of a line cut out of an input: some elements with their laws normal to the seabed, on a flat seabed."""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.input import ContactInput, LawAssignment

_ACROSS = ("normal law", "unloading", "suction")
"""Stages of the laws that act normal to the seabed."""


def cut_out(given: ContactInput, elements: IndexArray, nodes: IndexArray, parts: int = 1) -> ContactInput:
    """Return a stretch of a line with its laws normal to the flat seabed, each element cut into equal parts.

    `elements` (m,) and `nodes` (m + 1,) are indices, from left to right.
    """
    count = len(elements)
    place, here = np.full(len(given.element_ids), -1), np.full(len(given.node_ids), -1)
    place[elements], here[nodes] = np.arange(count), np.arange(count + 1) * parts
    lengths = np.repeat(given.length[elements] / parts, parts)
    laws = []
    for law in given.assigned.values():
        name = law.law.name
        if law.law.stage not in _ACROSS:
            continue
        if law.law.acts_on == "nodes":
            kept = here[law.rows] >= 0
            rows = here[law.rows[kept]]
            columns = {key: value[kept] for key, value in law.parameters.items()}
            if parts > 1:
                rows, columns = _between(rows, columns, parts)
        else:
            kept = place[law.rows] >= 0
            rows = (place[law.rows[kept]][:, None] * parts + np.arange(parts)).ravel()
            columns = {key: np.repeat(value[kept], parts) for key, value in law.parameters.items()}
        if len(rows):
            laws.append(LawAssignment(name, rows, columns))
    x = np.append(0.0, np.cumsum(lengths))
    size = len(lengths)
    return ContactInput(
        node_ids=np.arange(size + 1),
        coordinates=np.column_stack([np.zeros(size + 1), x, np.zeros(size + 1)]),
        element_ids=np.arange(size),
        element_nodes=np.column_stack([np.arange(size), np.arange(1, size + 1)]),
        length=lengths,
        diameter=np.repeat(given.diameter[elements], parts),
        laws=tuple(laws),
        curves=given.curves,
        tension=given.tension,
        weight=np.repeat(given.weight[elements], parts) if given.weight is not None else None,
    )


def _between(rows: IndexArray, columns: dict[str, FloatArray], parts: int) -> tuple[IndexArray, dict[str, FloatArray]]:
    """Return nodal springs spread over the new nodes between their nodes, each with its share."""
    order = np.argsort(rows)
    rows, columns = rows[order], {name: value[order] for name, value in columns.items()}
    nodes = np.arange(rows[0], rows[-1] + 1) if len(rows) else rows
    nearest = np.clip(np.searchsorted(rows, nodes, side="right") - 1, 0, max(len(rows) - 1, 0))
    shared = ("stiffness", "damping")
    return nodes, {name: value[nearest] / (parts if name in shared else 1) for name, value in columns.items()}
