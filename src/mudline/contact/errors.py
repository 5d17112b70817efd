"""What can be wrong with an input or a position, named by node or element."""

from __future__ import annotations


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
