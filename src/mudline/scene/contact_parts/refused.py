"""What a deck says and the evaluator cannot use."""

from __future__ import annotations

from mudline.diagnostics import Where


class RefusedError(ValueError):
    """A deck cannot be evaluated: the text says why, `where` is the place."""

    def __init__(self, message: str, where: Where) -> None:
        super().__init__(message)
        self.where = where
