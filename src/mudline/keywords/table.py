"""Tables of rows as arrays, with the few fields that are no numbers beside them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.keywords.values import Equation, Kind, Label, unbraced_label

Cell = float | int | str | None
Word = Equation | Label | None


class Column(NamedTuple):
    """What a column holds."""

    label: str
    kind: Kind
    required: bool
    meaning: str = ""

    @property
    def whole(self) -> bool:
        """Whether its numbers are whole."""
        return self.kind in (Kind.WHOLE, Kind.IDENT)

    @property
    def word_type(self) -> type[Equation | Label]:
        """What may stand here instead of a number."""
        return Label if self.kind is Kind.IDENT else Equation

    def label_in(self, word: str) -> Label | None:
        """The label that a text without braces stands for, where labels may stand; None when it is no likely one."""
        return unbraced_label(word) if self.word_type is Label else None


class Table:
    """Rows of a fixed number of columns.

    `values` (rows, columns) float64 holds NaN where there is no number; `words` says what stands there instead: an
    equation, a label, or None for an empty field. A NaN without a word is a field that could not be read, or one
    beyond the row's end. `lengths` (rows,) counts the fields given in each row.
    """

    __slots__ = ("lengths", "values", "words")

    def __init__(
        self,
        values: NDArray[np.float64],
        lengths: NDArray[np.intp] | None = None,
        words: dict[tuple[int, int], Word] | None = None,
    ) -> None:
        self.values = values
        self.lengths = np.full(len(values), values.shape[1], dtype=np.intp) if lengths is None else lengths
        self.words = words or {}

    __hash__ = None  # type: ignore[assignment]  # its arrays may change

    def __len__(self) -> int:
        return len(self.values)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Table):
            return NotImplemented
        return (
            np.array_equal(self.lengths, other.lengths)
            and self.words == other.words
            and self.values.shape == other.values.shape
            and self.values.tobytes() == other.values.tobytes()
        )

    def __repr__(self) -> str:
        return f"Table({len(self)} rows of {self.values.shape[1]})"

    @property
    def equations(self) -> bool:
        """Whether any field is an equation."""
        return any(isinstance(word, Equation) for word in self.words.values())

    def column(self, index: int, default: float = math.nan) -> NDArray[np.float64]:
        """One column as an array (rows,); `default` where the row ends before it or the field is empty."""
        if index >= self.values.shape[1]:
            return np.full(len(self), default)
        values = self.values[:, index].copy()
        if not math.isnan(default):
            values[self.lengths <= index] = default
            for (row, column), word in self.words.items():
                if column == index and word is None:
                    values[row] = default
        return values

    def rows(self, columns: Sequence[Column]) -> list[list[Cell]]:
        """The rows as lists: whole numbers as int, equations and labels as text, None where there is no value."""
        width = self.values.shape[1]
        whole = [column.whole for column in columns[:width]]
        found: list[list[Cell]] = self.values.tolist() if not any(whole) else self._with_whole(whole)
        for row, column in np.argwhere(np.isnan(self.values)).tolist():
            word = self.words.get((row, column))
            found[row][column] = None if word is None else str(word)
        for row in np.flatnonzero(self.lengths != width).tolist():
            del found[row][self.lengths[row] :]
        return found

    def _with_whole(self, whole: Sequence[bool]) -> list[list[Cell]]:
        """The rows with the numbers of whole columns as int; what is no number is put in afterwards."""
        lists: list[list[Cell]] = []
        for index, is_whole in enumerate(whole):
            values = self.values[:, index]
            lists.append((np.nan_to_num(values).astype(np.int64) if is_whole else values).tolist())
        return [list(row) for row in zip(*lists, strict=True)]
