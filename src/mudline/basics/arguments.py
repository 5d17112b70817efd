"""Checks of the arguments of public functions: a bad one is refused with an error that names it."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.short_repr import cut


class ArgumentKindError(TypeError, ValueError):
    """Argument of another type than the expected one; callers may catch it as TypeError or as ValueError."""


class ArgumentRangeError(IndexError, ValueError):
    """Number of something that does not exist."""


def expect(value: object, name: str, kind: type | tuple[type, ...], expected: str) -> None:
    """Raise ArgumentKindError unless the value is of the type `kind`, which `expected` names in words."""
    if not isinstance(value, kind):
        raise ArgumentKindError(f"{name} must be {expected}, not {type(value).__name__}")


def expect_fields(holder: object, kinds: Mapping[str, tuple[Any, str]]) -> None:
    """Raise ArgumentKindError for an attribute of the wrong type; `kinds` has type and its words by attribute name."""
    for name, (kind, expected) in kinds.items():
        expect(getattr(holder, name), name, kind, expected)


def expect_word(value: object, name: str, allowed: Collection[str], expected: str = "") -> None:
    """Raise ValueError unless the value is one of the allowed words, which `expected` may list in another way."""
    if not isinstance(value, str) or value not in allowed:
        expected = expected or f"one of {', '.join(allowed)}"
        raise ValueError(f"{name} must be {expected}, not {cut(repr(value), 60)}")


def expect_number(value: object, name: str, *, or_zero: bool = False) -> None:
    """Raise ValueError unless the value is a positive number, or 0 with `or_zero`."""
    expect(value, name, (int, float), "a number")
    number = cast("float", value)
    if not (0.0 < number < math.inf or (or_zero and number == 0.0)):
        raise ValueError(f"{name} must be a number {'of 0 or more' if or_zero else 'above 0'}, not {value!r}")


def several(values: object, name: str, kind: type | tuple[type, ...], expected: str) -> list[Any]:
    """Return the values as a list; raises ArgumentKindError unless all are of a type. A str is not several letters."""
    items = list(values) if isinstance(values, Iterable) and not isinstance(values, str | bytes) else None
    if items is None or not all(isinstance(each, kind) for each in items):
        raise ArgumentKindError(f"{name} must be {expected}, not {cut(repr(values), 60)}")
    return items


def as_array(values: ArrayLike, name: str) -> NDArray[Any]:
    """Return the values as an array; raises ValueError for rows of different lengths."""
    try:
        return np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name} must be an array: {error}") from error


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """Return a view of an array through which the array cannot be changed."""
    view = array.view()
    view.flags.writeable = False
    return view


_KEYWORD = re.compile(r"\s*[$*][A-Z][A-Z &/-]*\s*", re.IGNORECASE)
_SECTION = re.compile(r"^\s*\$[A-Z]", re.IGNORECASE | re.MULTILINE)
_YAML = re.compile(r"^(?:%YAML|---|(?:format|source|units|sections)\s*:)", re.MULTILINE)


def given_path(given: object, advice: str = "use mudline.{}(text)", *, name: str = "path") -> Path:
    """Return the argument as a path; raises ValueError for the text of a deck, TypeError for anything but a path."""
    path = os.fspath(given) if isinstance(given, os.PathLike) else given
    text = bytes(path).decode("utf-8-sig", "replace") if isinstance(path, bytes | bytearray) else path
    function = _function_for(text.lstrip("\ufeff")) if isinstance(text, str) else None
    if function and not os.path.exists(str(text)):  # noqa: PTH110 - Path raises for names that are too long
        raise ValueError(f"expected a path, found the text of a deck: {advice.format(function)}")
    if isinstance(path, str) and (not path or "\0" in path):
        raise ValueError(f"{name} must be the name of a file, not {path!r}")
    if not isinstance(path, str):
        raise ArgumentKindError(f"{name} must be a str or os.PathLike, not {type(path).__name__}")
    return Path(path)


def _function_for(text: str) -> str | None:
    """Return the name of the function that reads a text, or None for a text that may be a path."""
    several = any(end in text for end in "\r\n")
    if text.lstrip().startswith("{"):
        return "from_json" if several or text.rstrip().endswith("}") else None
    if several:
        return "from_yaml" if _YAML.search(text) and not _SECTION.search(text) else "from_keyword"
    return "from_keyword" if _KEYWORD.fullmatch(text) else None
