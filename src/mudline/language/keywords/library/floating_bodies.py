"""Floating bodies of a coupled analysis: added mass, radiation damping, coefficients of wind and current."""

from typing import Annotated, Literal, Self

from mudline.basics.short_repr import counted
from mudline.language.keywords.common import *

Body = Annotated[Name, setting("FLOATING BODY", "floating body", names=Names.BODY)]

_LINES = "a matrix is six lines of six numbers"
_SIX = 6


class MatrixRow(Row):
    """Line of a 6x6 matrix."""

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
    """Matrix at a frequency."""

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
    def _whole(self) -> Self:
        """Raise ValueError unless the matrix has six lines."""
        _require_six(self.matrix)
        return self


class MatrixType(Record):
    """Constant matrix, matrices by frequency, or matrix beyond the largest frequency."""

    rule = "matrix_type"
    type_: Annotated[
        Literal["CONSTANT", "FREQUENCY", "CUTOFF"],
        setting("TYPE", "constant, by frequency, or (last) beyond the frequencies"),
    ] = Field(alias="type")
    matrix: Annotated[Table | None, rows(MatrixRow, "of CONSTANT and CUTOFF: matrix of 6 lines", inferred=_LINES)] = (
        None
    )
    frequencies: Records[FrequencyMatrix] = Records()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the matrices are those of the type."""
        require_one(self, "frequencies" if self.type_ == "FREQUENCY" else "matrix")
        require_one(self, "frequencies", "matrix")
        _require_six(self.matrix)
        return self


class BodyMatrices(Record):
    """Matrices of a body."""

    rule = "body_matrices"
    body: Body
    file: Annotated[
        Name | None,
        setting("FILE", "file with the matrices, instead of lines", names=Names.FILE, holds=DataFile.NUMBERS),
    ] = None
    types: Records[MatrixType] = Records()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless a body has either a file or matrices."""
        require_one(self, "file", "types")
        return self


class AddedMass(Block):
    """Matrices of bodies."""

    rule = "added_mass"
    subject = "vessels"
    page = "kwd_model_addedmass"
    summary = "Added mass of floating bodies in a coupled analysis: a file, a constant matrix, or one per frequency."
    tabular = True
    example = (
        "*ADDED MASS\n FLOATING BODY=Buoy\n TYPE=CONSTANT\n"
        " 9.0E4, 0.0, 0.0, 0.0, 0.0, 0.0\n 0.0, 5.0E4, 0.0, 0.0, 0.0, 0.0\n 0.0, 0.0, 5.0E4, 0.0, 0.0, 0.0\n"
        " 0.0, 0.0, 0.0, 2.0E4, 0.0, 0.0\n 0.0, 0.0, 0.0, 0.0, 3.0E4, 0.0\n 0.0, 0.0, 0.0, 0.0, 0.0, 3.0E4\n"
    )

    keyword: Literal["ADDED MASS"] = "ADDED MASS"
    bodies: Records[BodyMatrices] = Records()


class RadiationDamping(Block):
    """Matrices of bodies."""

    rule = "radiation_damping"
    subject = "vessels"
    page = "kwd_model_radiationdamping"
    summary = (
        "Radiation damping of floating bodies in a coupled analysis: a file, a constant matrix, or one per frequency."
    )
    tabular = True
    example = (
        "*RADIATION DAMPING\n FLOATING BODY=Buoy\n TYPE=CONSTANT\n"
        " 9.0E4, 0.0, 0.0, 0.0, 0.0, 0.0\n 0.0, 5.0E4, 0.0, 0.0, 0.0, 0.0\n 0.0, 0.0, 5.0E4, 0.0, 0.0, 0.0\n"
        " 0.0, 0.0, 0.0, 2.0E4, 0.0, 0.0\n 0.0, 0.0, 0.0, 0.0, 3.0E4, 0.0\n 0.0, 0.0, 0.0, 0.0, 0.0, 3.0E4\n"
    )

    keyword: Literal["RADIATION DAMPING"] = "RADIATION DAMPING"
    bodies: Records[BodyMatrices] = Records()


class BodyDrag(Record):
    """Matrix of a body."""

    rule = "body_drag"
    body: Body
    type_: Annotated[Literal["MATRIX"], setting("TYPE", "the coefficients are a matrix")] = Field(alias="type")
    option: Annotated[
        Literal["ABSOLUTE", "RELATIVE"] | None,
        setting("OPTION", "velocity of the body, or relative to the water", default="ABSOLUTE"),
    ] = None
    matrix: Matrix

    @model_validator(mode="after")
    def _whole(self) -> Self:
        """Raise ValueError unless the matrix has six lines."""
        _require_six(self.matrix)
        return self


class ViscousDrag(Block):
    """Drag of bodies."""

    rule = "viscous_drag"
    subject = "vessels"
    page = "kwd_model_viscousdrag"
    summary = "Viscous drag of floating bodies in a coupled analysis: one matrix per body."
    tabular = True
    example = (
        "*VISCOUS DRAG\n FLOATING BODY=Buoy\n TYPE=MATRIX\n OPTION=RELATIVE\n"
        " 9.0E4, 0.0, 0.0, 0.0, 0.0, 0.0\n 0.0, 5.0E4, 0.0, 0.0, 0.0, 0.0\n 0.0, 0.0, 5.0E4, 0.0, 0.0, 0.0\n"
        " 0.0, 0.0, 0.0, 2.0E4, 0.0, 0.0\n 0.0, 0.0, 0.0, 0.0, 3.0E4, 0.0\n 0.0, 0.0, 0.0, 0.0, 0.0, 3.0E4\n"
    )

    keyword: Literal["VISCOUS DRAG"] = "VISCOUS DRAG"
    bodies: Records[BodyDrag] = Records()


COEFFICIENTS = "coefficients by heading"
TAG = "a line of this word alone: the block is that of a mooring analysis, which has one vessel"


class Coefficients(Row):
    """Coefficients at a heading."""

    heading: Annotated[Real, about("heading", unit="deg", usual=DIRECTION)]
    surge: Annotated[Real, about("coefficient in surge", usual=ANY)]
    sway: Annotated[Real, about("coefficient in sway", usual=ANY)]
    yaw: Annotated[Real, about("coefficient in yaw", usual=ANY)]


class BodyCoefficients(Record):
    """Coefficients of a floating body."""

    rule = "body_coefficients"
    body: Body
    file: Annotated[
        Name | None,
        setting("FILE", "file with the coefficients, instead of rows", names=Names.FILE, holds=DataFile.NUMBERS),
    ] = None
    headings: Annotated[Table | None, rows(Coefficients, COEFFICIENTS)] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless a body has either a file or rows."""
        require_one(self, "file", "headings")
        return self


class VesselCoefficients(Record):
    """Coefficients of the moored vessel."""

    rule = "vessel_coefficients"
    tag: Annotated[Literal["MOORED VESSEL"], about(TAG)]
    file: Annotated[
        Name | None,
        setting("FILE", "file with the coefficients, instead of rows", names=Names.FILE, holds=DataFile.NUMBERS),
    ] = None
    headings: Annotated[Table | None, rows(Coefficients, COEFFICIENTS)] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of a row: the first line is the tag."""
        return "tag" if number == 0 else "headings"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the vessel has either a file or rows."""
        require_one(self, "file", "headings")
        return self


class CoefficientBlock(Block):
    """Coefficients of floating bodies, or of the moored vessel."""

    bodies: Records[BodyCoefficients | VesselCoefficients] = Records()

    @model_validator(mode="after")
    def _alone(self) -> Self:
        """Raise ValueError for other bodies beside a moored vessel."""
        if len(self.bodies) > 1 and any(isinstance(body, VesselCoefficients) for body in self.bodies):
            raise ValueError("MOORED VESSEL stands alone: remove the other bodies")
        return self


class CurrentCoefficients(CoefficientBlock):
    """Coefficients of the current."""

    rule = "current_coeff"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_currentcoeff"
    summary = "Coefficients of the current on floating bodies or a moored vessel, by heading, from rows or a file."
    example = "*CURRENT COEFF\n FLOATING BODY=Buoy\n 0.0, 1200.0, 0.0, 0.0\n 90.0, 0.0, 1500.0, 300.0\n"

    keyword: Literal["CURRENT COEFF"] = "CURRENT COEFF"


class WindCoefficients(CoefficientBlock):
    """Coefficients of the wind."""

    rule = "wind_coeff"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_windcoeff"
    summary = "Coefficients of the wind on floating bodies or a moored vessel, by heading, from rows or a file."
    example = "*WIND COEFF\n FLOATING BODY=Buoy\n 0.0, 1200.0, 0.0, 0.0\n 90.0, 0.0, 1500.0, 300.0\n"

    keyword: Literal["WIND COEFF"] = "WIND COEFF"
