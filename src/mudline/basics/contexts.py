"""Context variables that have a value until a block ends."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

T = TypeVar("T")


@contextmanager
def holding(variable: ContextVar[T | None], value: T) -> Iterator[T]:
    """Give the variable a value until the block ends."""
    token = variable.set(value)
    try:
        yield value
    finally:
        variable.reset(token)
