"""What can be wrong with an input or a position, named by node or element."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import BoolArray, IdArray


class PositionError(ValueError):
    """A node's position or velocity is not finite, or what follows from it there overflows.

    Attributes:
        node: the node's id.
        step: the time step, from 0.
    """

    def __init__(self, message: str, node: int, step: int) -> None:
        super().__init__(message)
        self.node = node
        self.step = step

    def __reduce__(self) -> tuple[type[PositionError], tuple[str, int, int]]:
        return type(self), (str(self), self.node, self.step)


class ElementError(ValueError):
    """An element has no usable law, or a value of it overflows.

    Attributes:
        element: the element's id.
        step: the time step, from 0; None when it is the input that is wrong.
    """

    def __init__(self, message: str, element: int, step: int | None = None) -> None:
        super().__init__(message)
        self.element = element
        self.step = step

    def __reduce__(self) -> tuple[type[ElementError], tuple[str, int, int | None]]:
        return type(self), (str(self), self.element, self.step)


def refuse_elements(wrong: BoolArray, ids: IdArray, first_step: int, what: str) -> None:
    """Raise ElementError for the first of the elements (steps, m) that are `wrong`, if there is one."""
    if wrong.any():
        row, column = np.argwhere(wrong)[0].tolist()
        element, step = int(ids[column]), first_step + row
        raise ElementError(f"element {element} at step {step}: {what}", element, step)


def refuse_nodes(wrong: BoolArray, ids: IdArray, first_step: int, what: str) -> None:
    """Raise PositionError for the first of the nodes (steps, n) that are `wrong`, if there is one."""
    if wrong.any():
        row, column = np.argwhere(wrong)[0].tolist()
        node, step = int(ids[column]), first_step + row
        raise PositionError(f"node {node} at step {step}: {what}", node, step)
