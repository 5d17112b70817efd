"""What the keywords of matrices share: constant ones, or one for each frequency, of floating bodies."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.basics.short_repr import counted
from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Record, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, Usual
from mudline.language.keywords.values import Contents, Name, Names, Real
from mudline.language.keywords.vessels import Body

_LINES = "a matrix is six lines of six numbers"
_SIX = 6


class MatrixRow(Row):
    """A line of a 6x6 matrix."""

    heave: Annotated[Real, about("column of heave", usual=ANY)]
    surge: Annotated[Real, about("column of surge", usual=ANY)]
    sway: Annotated[Real, about("column of sway", usual=ANY)]
    yaw: Annotated[Real, about("column of yaw", usual=ANY)]
    roll: Annotated[Real, about("column of roll", usual=ANY)]
    pitch: Annotated[Real, about("column of pitch", usual=ANY)]


Matrix = Annotated[Table, rows(MatrixRow, "matrix of 6 lines and 6 columns", inferred=_LINES)]


def _require_six(matrix: Table | None) -> None:
    if matrix is not None and len(matrix) not in (0, _SIX):
        raise ValueError(f"the matrix has {counted(len(matrix), 'line')}: expected {_SIX}")


class FrequencyMatrix(Record):
    """The matrix at a frequency."""

    rule = "frequency_matrix"
    frequency: Annotated[
        Real,
        setting(
            "FREQ",
            "frequency",
            unit="Hz",
            at_least=0,
            inferred="its unit, as of waves",
            usual=Usual(1e-6, 20.0, "a frequency in Hz or rad/s", remark=True),
        ),
    ]
    matrix: Matrix

    @model_validator(mode="after")
    def _whole(self) -> FrequencyMatrix:
        """Six lines."""
        _require_six(self.matrix)
        return self


class MatrixType(Record):
    """A constant matrix, those by frequency, or that beyond the largest frequency."""

    rule = "matrix_type"
    type_: Annotated[
        Literal["CONSTANT", "FREQUENCY", "CUTOFF"],
        setting("TYPE", "constant, by frequency, or (last) beyond the frequencies"),
    ] = Field(alias="type")
    matrix: Annotated[Table | None, rows(MatrixRow, "of CONSTANT and CUTOFF: matrix of 6 lines", inferred=_LINES)] = (
        None
    )
    frequencies: list[FrequencyMatrix] = []

    @model_validator(mode="after")
    def _fits(self) -> MatrixType:
        """What its type has."""
        require_one(self, "frequencies" if self.type_ == "FREQUENCY" else "matrix")
        require_one(self, "frequencies", "matrix")
        _require_six(self.matrix)
        return self


class BodyMatrices(Record):
    """The matrices of a body."""

    rule = "body_matrices"
    body: Body
    file: Annotated[
        Name | None,
        setting("FILE", "file with the matrices, instead of them", names=Names.FILE, holds=Contents.NUMBERS),
    ] = None
    types: list[MatrixType] = []

    @model_validator(mode="after")
    def _fits(self) -> BodyMatrices:
        """A file, or matrices."""
        require_one(self, "file", "types")
        return self
