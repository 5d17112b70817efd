"""Elements cut out of an input, on a flat seabed: a stretch of a line with its laws, static embedments of elements."""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import FloatArray, IndexArray, summed
from mudline.model.contact.input import ContactInput, ElementError, LawAssignment
from mudline.model.contact.model import ContactModel

_ACROSS = ("normal law", "unloading", "suction")
"""Stages of the laws that act normal to the seabed."""
_DEPTHS = np.geomspace(1e-7, 1e4, 160)
"""Trial depths, in diameters."""
_HALVINGS = 60


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
        if law.law.stage not in _ACROSS:
            continue
        if law.law.acts_on == "nodes":
            rows, columns = law.at(here)
            if parts > 1:
                rows, columns = _between(rows, columns, parts)
        else:
            rows, columns = law.at(place)
            rows = (rows[:, None] * parts + np.arange(parts)).ravel()
            columns = {key: np.repeat(value, parts) for key, value in columns.items()}
        if len(rows):
            laws.append(LawAssignment(law.law.name, rows, columns))
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


def static_depth(given: ContactInput, elements: IndexArray, weight: FloatArray) -> FloatArray:
    """Return the least depths (k,) at which the laws of elements carry weights per length (k,), each element alone.

    The depth is 0 without a law or on a rigid seabed, and NaN if no depth carries the weight.
    """
    single = _apart(given, elements)
    model, count = ContactModel(single, backend="numpy"), len(elements)
    rigid = np.isin(np.arange(count), single.assigned["rigid"].rows) if "rigid" in single.assigned else np.zeros(count)
    size = np.where(np.isfinite(single.diameter), single.diameter, 1.0)

    def force(depth: FloatArray) -> FloatArray:
        points = single.coordinates.copy()
        points[:, 0] = -np.repeat(depth, 2)
        try:
            with np.errstate(all="ignore"):
                pushed = model.evaluate(points).normal_force
        except ElementError:  # a force that overflows carries any weight
            return np.full(count, np.inf)
        forces: FloatArray = pushed.reshape(-1, 2).sum(axis=1) / np.where(single.length > 0.0, single.length, 1.0)
        return forces

    low, high = np.zeros(count), np.full(count, np.nan)
    for share in _DEPTHS:
        reached = force(share * size) >= weight
        new = reached & np.isnan(high)
        high[new] = share * size[new]
        low[np.isnan(high)] = share * size[np.isnan(high)]
    bounds = low, np.where(np.isnan(high), low, high)
    for _ in range(_HALVINGS):
        middle = 0.5 * (bounds[0] + bounds[1])
        over = force(middle) >= weight
        bounds = np.where(over, bounds[0], middle), np.where(over, middle, bounds[1])
    bare = (single.law == 0) | (rigid > 0)
    return np.where(bare, 0.0, np.where(np.isnan(high), np.nan, bounds[1]))


def _apart(given: ContactInput, elements: IndexArray) -> ContactInput:
    """Return the normal laws of elements with nodes of their own, each with its share of the springs at the nodes."""
    count = len(elements)
    ends, length = given.element_nodes[elements], given.length[elements]
    carried = summed(given.length, given.element_nodes, len(given.node_ids))
    place = np.full(len(given.element_ids), -1)
    place[elements] = np.arange(count)
    laws = []
    for law in given.assigned.values():
        if law.law.name == "rigid" or law in given.normal_laws:
            laws.append(LawAssignment(law.law.name, *law.at(place)))
        elif law in given.nodal_laws:
            at = np.full(len(given.node_ids), -1)
            at[law.rows] = np.arange(len(law.rows))
            source = at[ends.ravel()]
            rows = np.flatnonzero(source >= 0)
            columns = {name: value[source[rows]] for name, value in law.parameters.items()}
            columns["stiffness"] = columns["stiffness"] * (np.repeat(length, 2) / carried[ends.ravel()])[rows]
            laws.append(LawAssignment(law.law.name, rows, columns))
    return ContactInput(
        node_ids=np.arange(2 * count),
        coordinates=np.zeros((2 * count, 3)),
        element_ids=np.arange(count),
        element_nodes=np.arange(2 * count).reshape(count, 2),
        length=length,
        diameter=given.diameter[elements],
        laws=tuple(each for each in laws if len(each.rows)),
        curves=given.curves,
        tension=given.tension,
    )
