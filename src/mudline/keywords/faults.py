"""Faults of values in our own words and at exact places, for pydantic to hand on."""

from __future__ import annotations

from collections.abc import Sequence

from pydantic import ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError


def told(message: str) -> PydanticCustomError:
    """A fault in our own words."""
    return PydanticCustomError("told", "{message}", {"message": message})


def at_places(faults: Sequence[tuple[tuple[int | str, ...], str]]) -> ValidationError:
    """Faults by their places inside a value."""
    details = [InitErrorDetails(type=told(message), loc=place, input=None) for place, message in faults]
    return ValidationError.from_exception_data("value", details)


def by_index(error: ValidationError, names: Sequence[str]) -> ValidationError:
    """The faults of a row that is written as a list: the index of a field is its place, not its name."""
    faults = [((names.index(str(fault["loc"][0])),), fault["msg"]) for fault in error.errors(include_url=False)]
    return at_places(faults)
