"""What a file of results holds: its tables as columns, checked one by one before they are put together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import FloatArray, IdArray
from mudline.contact.columns import Values
from mudline.diagnostics import DeckError
from mudline.quantities import QUANTITIES, RESULT_FORMAT, UNIT_SYSTEMS, Kind
from mudline.scene.csv_file import data_error
from mudline.short_repr import cut, short_repr

Key = Literal["element", "node"]
TABLES: Mapping[str, Key] = {"elements": "element", "nodes": "node"}
"""The tables that are read, and the column with the numbers of each."""

_KINDS: dict[Kind, tuple[str, frozenset[type]]] = {
    "number": ("a number", frozenset({float, int, type(None)})),
    "whole": ("a whole number", frozenset({int})),
    "text": ("a text", frozenset({str, type(None)})),
    "flag": ("true or false", frozenset({bool})),
}
"""How a message names a kind, and what its values may be."""


class Texts(NamedTuple):
    """Texts (rows,) as indices of the different ones; -1 is none."""

    codes: NDArray[np.int32]
    names: tuple[str, ...]


class Coder:
    """Makes `Texts` of texts that come in pieces."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}

    def coded(self, texts: Iterable[str | None]) -> NDArray[np.int32]:
        """The indices of some texts; None and "" are none."""
        numbers = self._numbers
        return np.array([numbers.setdefault(text, len(numbers)) if text else -1 for text in texts], np.int32)

    @property
    def names(self) -> tuple[str, ...]:
        """The different texts so far."""
        return tuple(self._numbers)


Stacked = Values | Texts


@dataclass(frozen=True, slots=True)
class StoredTable:
    """The rows of elements or nodes at all steps, by the flat names of their columns; `file` is its name in messages.

    `times` (rows,) is the time of each row, None without times.
    """

    file: str
    columns: Mapping[str, Stacked]
    times: FloatArray | None = None

    __repr__ = short_repr

    def numbers(self, name: str) -> FloatArray:
        """A column of numbers; NaN is none. Raises DeckError for an infinite one."""
        found = np.asarray(self.columns[name], np.float64)
        if np.isinf(found).any():
            raise self.fault(f"{name} holds {float(found[np.argmax(np.isinf(found))])!r}, expected finite numbers")
        return found

    def whole(self, name: str) -> IdArray:
        """A column of whole numbers."""
        return np.asarray(self.columns[name], np.int64)

    def flags(self, name: str) -> NDArray[np.bool_]:
        """A column of true and false."""
        return np.asarray(self.columns[name], np.bool_)

    def texts(self, name: str) -> Texts:
        """A column of texts."""
        found = self.columns[name]
        if not isinstance(found, Texts):
            raise TypeError(f"{name} holds no texts")
        return found

    def fault(self, message: str) -> DeckError:
        """The error about this table."""
        return data_error(self.file, message)


@dataclass(frozen=True, slots=True)
class Stored:
    """What a file holds."""

    units: str
    elements: StoredTable
    nodes: StoredTable

    __repr__ = short_repr


def flat_kinds(table: str) -> dict[str, Kind]:
    """The columns of "elements" or "nodes" and their kinds, three for a vector."""
    return {
        each.name + axis: each.kind
        for each in QUANTITIES[table].values()
        for axis in (("_x", "_y", "_z") if each.vector else ("",))
    }


def require_names(file: str, table: str, names: Iterable[str]) -> None:
    """Raise DeckError where a table lacks columns of results."""
    there = set(names)
    missing = [name for name in flat_kinds(table) if name not in there]
    if not missing:
        return
    if table == "elements" and TABLES["nodes"] in there and "gap" in there:
        raise data_error(file, "this is the table of nodes of a result: give the file of the elements")
    if len(missing) == len(flat_kinds(table)):
        raise data_error(file, f"not a file of results: none of the columns of {table} is there")
    more = f" and {len(missing) - 3} more" if len(missing) > 3 else ""
    what = f"the table of {table} lacks {', '.join(missing[:3])}{more}"
    raise data_error(file, f"{what}: expected the columns of {RESULT_FORMAT}; evaluate the deck again")


def checked_format(file: str, found: object) -> None:
    """Raise DeckError where the format that a file names is another one than ours, or none."""
    if found == RESULT_FORMAT:
        return
    if found is None:
        raise data_error(file, f"not a file of results: expected the format {RESULT_FORMAT}, found none")
    name = cut(str(found), 40)
    raise data_error(file, f"the format is {name!r}, expected {RESULT_FORMAT!r}: evaluate the deck again")


def checked_units(file: str, found: object) -> str:
    """The unit system that a file names; raises DeckError for another word."""
    if isinstance(found, str) and found in UNIT_SYSTEMS:
        return found
    expected = ", ".join(UNIT_SYSTEMS[:-1])
    raise data_error(file, f"units: expected {expected} or {UNIT_SYSTEMS[-1]}, found {cut(repr(found), 40)}")


def column_of(values: Sequence[object], kind: Kind, name: str, fault: Callable[[int, str], DeckError]) -> Stacked:
    """A column of the values of a kind; `fault` makes the error about one of them, by its place among the values."""
    expected, allowed = _KINDS[kind]
    if not set(map(type, values)) <= allowed:
        row = next(row for row, value in enumerate(values) if type(value) not in allowed)
        raise fault(row, f"{name}: expected {expected}, found {cut(repr(values[row]), 40)}")
    if kind == "text":
        coder = Coder()
        codes = coder.coded(values)  # type: ignore[arg-type] # all are texts or None
        return Texts(codes, coder.names)
    kept = [np.nan if value is None else value for value in values] if kind == "number" else values
    try:
        return np.array(kept, {"number": np.float64, "whole": np.int64, "flag": np.bool_}[kind])
    except OverflowError as error:
        row = next(row for row, value in enumerate(values) if isinstance(value, int) and abs(value) >= 2**63)
        raise fault(row, f"{name}: a whole number of {len(str(values[row]))} digits cannot be a result") from error


def array_column(array: Values, kind: Kind, name: str, fault: Callable[[str], DeckError]) -> Stacked:
    """A column of a flat array; raises what `fault` makes for one of another kind."""
    kinds = {"number": "fiu", "whole": "iu", "text": "U", "flag": "b"}[kind]
    if array.dtype.kind not in kinds:
        raise fault(f"{name} holds {array.dtype}, expected {_KINDS[kind][0]}")
    if kind == "text":
        names, codes = np.unique(array, return_inverse=True)
        blank = bool(names.size) and names[0] == ""
        return Texts(codes.ravel().astype(np.int32) - np.int32(blank), tuple(names[blank:].tolist()))
    return array.astype(np.float64) if kind == "number" else array
