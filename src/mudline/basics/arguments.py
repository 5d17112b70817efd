"""What public functions are given: what cannot be used is refused with an error that names the argument."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.short_repr import cut


class ArgumentKindError(TypeError, ValueError):
    """An argument is not of the kind that is expected: for callers that catch either."""


class ArgumentRangeError(IndexError, ValueError):
    """A number of something that is not there."""


def expect(value: object, name: str, kind: type | tuple[type, ...], expected: str) -> None:
    """Raise ArgumentKindError for an argument that is not of a kind, which `expected` says in words."""
    if not isinstance(value, kind):
        raise ArgumentKindError(f"{name} must be {expected}, not {type(value).__name__}")


def expect_fields(holder: object, kinds: Mapping[str, tuple[Any, str]]) -> None:
    """Raise ArgumentKindError for a field that is not of its kind, given with words for it by the field's name."""
    for name, (kind, expected) in kinds.items():
        expect(getattr(holder, name), name, kind, expected)


def expect_word(value: object, name: str, allowed: tuple[str, ...], expected: str) -> None:
    """Raise ValueError for an argument that is not one of the allowed words, which `expected` lists."""
    if not isinstance(value, str) or value not in allowed:
        raise ValueError(f"{name} must be {expected}, not {cut(repr(value), 60)}")


def expect_number(value: object, name: str, *, or_zero: bool = False) -> None:
    """Raise ValueError for an argument that is not a number above 0, or 0 where it may be."""
    expect(value, name, (int, float), "a number")
    number = cast("float", value)
    if not (0.0 < number < math.inf or (or_zero and number == 0.0)):
        raise ValueError(f"{name} must be a number {'of 0 or more' if or_zero else 'above 0'}, not {value!r}")


def several(values: object, name: str, kind: type | tuple[type, ...], expected: str) -> list[Any]:
    """An argument as a list. Raises ArgumentKindError for what is not several of a kind: one str is not its letters."""
    found = list(values) if isinstance(values, Iterable) and not isinstance(values, str | bytes) else None
    if found is None or not all(isinstance(each, kind) for each in found):
        raise ArgumentKindError(f"{name} must be {expected}, not {cut(repr(values), 60)}")
    return found


def as_array(values: ArrayLike, name: str) -> NDArray[Any]:
    """An argument as an array. Raises ValueError for rows of different lengths."""
    try:
        return np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name} must be an array: {error}") from error


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A view of an array that others hold too, through which it cannot be changed."""
    view = array.view()
    view.flags.writeable = False
    return view


_KEYWORD = re.compile(r"\s*[$*][A-Z][A-Z &/-]*\s*", re.IGNORECASE)
_SECTION = re.compile(r"^\s*\$[A-Z]", re.IGNORECASE | re.MULTILINE)
_YAML = re.compile(r"^(?:%YAML|---|(?:format|source|units|sections)\s*:)", re.MULTILINE)


def given_path(given: object, advice: str = "use mudline.{}(text)", *, name: str = "path") -> Path:
    """The path that is given; raises ValueError for the text of a deck, TypeError for what is not a path."""
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
    """Name of the function that reads a text; None for what may be a path."""
    several = any(end in text for end in "\r\n")
    if text.lstrip().startswith("{"):
        return "from_json" if several or text.rstrip().endswith("}") else None
    if several:
        return "from_yaml" if _YAML.search(text) and not _SECTION.search(text) else "from_keyword"
    return "from_keyword" if _KEYWORD.fullmatch(text) else None
