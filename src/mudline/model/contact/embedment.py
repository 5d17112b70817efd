"""Static embedment: the depth at which the normal law of an element, of any kind, carries a weight."""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.input import ContactInput, ElementError, LawAssignment
from mudline.model.contact.model import ContactModel

_DEPTHS = np.geomspace(1e-7, 1e4, 160)
"""Trial depths, in diameters."""
_HALVINGS = 60


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
    carried = np.zeros(len(given.node_ids))
    for end in given.element_nodes.T:
        np.add.at(carried, end, given.length)
    place = np.full(len(given.element_ids), -1)
    place[elements] = np.arange(count)
    laws = []
    for law in given.assigned.values():
        if law.law.name == "rigid" or law in given.normal_laws:
            kept = place[law.rows] >= 0
            columns = {name: value[kept] for name, value in law.parameters.items()}
            laws.append(LawAssignment(law.law.name, place[law.rows[kept]], columns))
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
