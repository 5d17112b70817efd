"""What came out not finite, or must not be: who, at which step, and why."""

from __future__ import annotations

import math
from typing import NoReturn

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IdArray
from mudline.contact.errors import ElementError, PositionError
from mudline.contact.result import ContactResult
from mudline.contact.tables import Tables


def is_finite(part: ContactResult, speed: FloatArray | None) -> bool:
    """Whether nothing needs to be looked at: every value of a batch is finite.

    A sum of finite values may overflow, and values are NaN where there is no position; then this is False too.
    """
    at_nodes = part.normal_force if part.friction is None and part.normal.strides[1] == 0 else part.reaction
    every = [part.ratio, part.slope, part.stiffness, at_nodes, *([] if speed is None else [speed])]
    return math.isfinite(sum(float(values.sum()) for values in every))


def refuse(part: ContactResult, speed: FloatArray | None, first_step: int, tables: Tables) -> None:
    """Raise for the first step of a batch with a value that must not be, if there is one.

    Raises:
        PositionError: the velocity or the distance of a node, or the reaction there, is not finite.
        ElementError: the embedment, the force, its derivatives or the reaction of an element overflow, or its curve
            pulls where suction acts too.
    """
    for step in range(len(part.depth)):
        _refuse_step(part.step(step), None if speed is None else speed[step], first_step + step, tables)
        refuse_pulling(part.steps(step, step + 1), first_step + step, tables)


def _refuse_step(part: ContactResult, speed: FloatArray | None, step: int, tables: Tables) -> None:
    given = tables.given
    _refuse_node(np.isinf(part.gap), given.node_ids, step, "its distance to the seabed overflows")
    if speed is not None:
        here = ~np.isnan(part.gap)
        _refuse_node(~np.isfinite(speed) & here, given.node_ids, step, "its velocity is not finite")
    infinite = np.isinf(part.ratio) | np.isinf(part.depth)
    _refuse_element(infinite, given.element_ids, step, "its embedment ratio overflows")
    known = ~np.isnan(part.depth)
    unbounded = ~np.isfinite(part.force) & known
    if unbounded.any():
        element = int(np.flatnonzero(unbounded)[0])
        _refuse_force(part, element, step, tables)
    for what, values in (("slope", part.slope), ("stiffness", part.stiffness)):
        _refuse_element(np.isinf(values), given.element_ids, step, f"its {what} overflows")
    loads = np.zeros(len(given.node_ids))
    with np.errstate(all="ignore"):
        load = np.where(known, part.force * tables.half, 0.0)
        for end in (tables.line.first, tables.line.second):
            np.add.at(loads, end, load)
    at_node = ~(np.isfinite(loads[tables.line.first]) & np.isfinite(loads[tables.line.second]))
    _refuse_element(at_node & known, given.element_ids, step, "the reaction at its nodes overflows")
    wrong = ~np.isfinite(part.reaction).all(axis=-1) & part.present
    _refuse_node(wrong, given.node_ids, step, "the reaction there overflows")


def refuse_pulling(part: ContactResult, first_step: int, tables: Tables) -> None:
    """Raise where the curve of an element with suction pulls, if it does.

    Raises:
        ElementError: it does so, and is neither cut nor without suction.
    """
    if tables.pulling is None:
        return
    elements = tables.pulling
    pulls = part.contact[:, elements] & (part.force[:, elements] < 0.0)
    if pulls.any():
        step, column = np.argwhere(pulls)[0].tolist()
        element, step = int(tables.given.element_ids[elements[column]]), first_step + step
        what = "its curve pulls there, and suction acts on it too; cut the curve with tension cut, or mend it"
        raise ElementError(f"element {element} at step {step}: {what}", element, step)


def _refuse_force(part: ContactResult, element: int, step: int, tables: Tables) -> NoReturn:
    number, why = int(tables.given.element_ids[element]), "its force overflows"
    index = int(tables.given.curve_index[element])
    if index >= 0 and part.contact[element]:
        ratio = float(part.ratio[element])
        if math.isinf(_force(tables, index, ratio)):
            why = f"no force at ratio {ratio!r}: the force there overflows"
    raise ElementError(f"element {number} at step {step}: {why}", number, step)


def _force(tables: Tables, index: int, ratio: float) -> float:
    force, slope = np.empty(1), np.empty(1)
    with np.errstate(all="ignore"):
        tables.given.curves[index].fill(np.array([ratio]), force, slope)
    return math.inf if not math.isfinite(force[0]) else float(force[0])


def _refuse_node(wrong: BoolArray, ids: IdArray, step: int, what: str) -> None:
    if wrong.any():
        node = int(ids[np.flatnonzero(wrong)[0]])
        raise PositionError(f"node {node} at step {step}: {what}", node, step)


def _refuse_element(wrong: BoolArray, ids: IdArray, step: int, what: str) -> None:
    if wrong.any():
        element = int(ids[np.flatnonzero(wrong)[0]])
        raise ElementError(f"element {element} at step {step}: {what}", element, step)
