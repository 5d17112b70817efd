"""The worst results of each of many decks, over all lines and steps, as a row; the order of rows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Annotated, BinaryIO, Literal, get_type_hints

from mudline.basics.quantities import Quantity, finite
from mudline.basics.units import UNITS
from mudline.model.results.extremes import PeakValue
from mudline.model.results.series import SeriesSummary
from mudline.model.results.warnings import ContactWarning


@dataclass(frozen=True, slots=True)
class CaseSummary:
    """A deck among many: extremes over all lines and steps; None for a value that does not exist.

    The fields are annotated as a `Quantity`: meaning, unit, heading in the table for people, which has those with one.
    """

    deck: Annotated[str, "the file, as it was given or found"]
    verdict: Annotated[Literal["evaluated", "failed"], "`evaluated` or `failed`"]
    reason: Annotated[str | None, "why it failed"] = None
    units: Annotated[str | None, "`metric`, `imperial` or `user`"] = None
    positions: Annotated[str | None, "`deck`, `file` or `rest shape`"] = None
    steps: Annotated[int | None, "number of time steps; 1 for one state"] = None
    elements: Annotated[int | None, "number of elements that were evaluated"] = None
    in_contact: Annotated[int | None, "largest number of elements in contact", "", "in\ncontact"] = None
    touchdown_from: Annotated[float | None, "least and largest arc length of a touchdown point", "L", "TDP\nat"] = None
    touchdown_to: Annotated[float | None, "least and largest arc length of a touchdown point", "L"] = None
    contact_length: Annotated[float | None, "largest length below the seabed", "L", "contact\nlength"] = None
    largest_force: Annotated[
        float | None, "largest push of the seabed on an element, per unit length", "F/L", "largest\nforce"
    ] = None
    largest_force_element: Annotated[int | None, "the element", "", "element"] = None
    largest_force_time: Annotated[float | None, "when; `null` for one state"] = None
    largest_uplift: Annotated[
        float | None, "largest pull, negative, by suction or a curve", "F/L", "largest\nuplift"
    ] = None
    largest_uplift_element: Annotated[int | None, "the element", "", "element"] = None
    largest_uplift_time: Annotated[float | None, "when; `null` for one state"] = None
    reaction: Annotated[
        float | None, "largest total normal force on all nodes; `null` on a rigid seabed", "F", "total\nreaction"
    ] = None
    submerged_weight: Annotated[
        float | None,
        "of the elements in contact at that step",
        "F",
        "subm.\nweight",
    ] = None
    empty_weight: Annotated[float | None, "the same without contents", "F", "weight,\nempty"] = None
    contents_case: Annotated[
        int | None,
        "load case, from 1, whose contents the weight has; `null` if all have the same",
        "",
        "contents of\nload case",
    ] = None
    ratio: Annotated[float | None, "this reaction / this weight", "", "ratio"] = None
    warnings: Annotated[int | None, "number of warnings about the results", "", "warn-\nings"] = None
    warning_codes: Annotated[str | None, "their codes, separated by spaces"] = None
    result: Annotated[str | None, "the file with its results, below the folder of `-o`"] = None

    @property
    def failed(self) -> bool:
        """True if the deck could not be evaluated."""
        return self.verdict == "failed"

    def row(self) -> dict[str, str | int | float | None]:
        """Return the values by name."""
        return asdict(self)


CASES = {
    name: Quantity(name, *hint.__metadata__) for name, hint in get_type_hints(CaseSummary, include_extras=True).items()
}
"""Columns of a deck among many, in order."""


def worst_first(rows: Iterable[CaseSummary]) -> list[CaseSummary]:
    """Return the failed decks in their order, then the others with the largest force first."""

    def rank(row: CaseSummary) -> tuple[bool, float]:
        force = -math.inf if row.largest_force is None else row.largest_force
        return not row.failed, 0.0 if row.failed else -force * UNITS[row.units or "user"].size("F/L")

    return sorted(rows, key=rank)


def case_summary(
    series: SeriesSummary, deck: str, warnings: Sequence[ContactWarning], result: str | None
) -> CaseSummary:
    """Return the row of the deck `deck` with the result file `result`, from its table "case"."""
    evaluation, times = series.evaluation, series.evaluation.time
    pushed, pulled = series.of("case", "largest_force").largest.peak(), series.of("case", "largest_uplift").least.peak()
    reaction, of_empty = (series.of("case", name).largest.peak() for name in ("reaction", "reaction_empty"))
    return CaseSummary(
        deck=deck,
        verdict="evaluated",
        units=evaluation.scene.units,
        positions=evaluation.source,
        steps=evaluation.steps,
        elements=len(evaluation.elements),
        in_contact=int(_value(series.of("case", "in_contact").largest.peak()) or 0),
        touchdown_from=_value(series.of("case", "touchdown_from").least.peak()),
        touchdown_to=_value(series.of("case", "touchdown_to").largest.peak()),
        contact_length=_value(series.of("case", "contact_length").largest.peak() or PeakValue(0.0, 0)),
        largest_force=_value(pushed),
        largest_force_element=series.number(pushed),
        largest_force_time=None if pushed is None or times is None else float(times[pushed.step]),
        largest_uplift=_value(pulled),
        largest_uplift_element=series.number(pulled),
        largest_uplift_time=None if pulled is None or times is None else float(times[pulled.step]),
        reaction=_value(reaction),
        submerged_weight=None if reaction is None else finite(reaction.at),
        empty_weight=None if of_empty is None else finite(of_empty.at),
        contents_case=evaluation.contents_case,
        ratio=finite(reaction.value / reaction.at) if reaction is not None and reaction.at > 0.0 else None,
        warnings=len(warnings),
        warning_codes=" ".join(sorted({warning.diagnostic.code for warning in warnings})),
        result=result,
    )


def _value(peak: PeakValue | None) -> float | None:
    return None if peak is None else finite(peak.value)


def write_parquet(rows: Sequence[CaseSummary], stream: BinaryIO) -> None:
    """Write rows as a table in Parquet. Raises OSError, ImportError without pyarrow.

    Characters that UTF-8 cannot encode, as in some file names, are escaped.
    """
    import pyarrow as pa  # noqa: PLC0415 - the extra `frames`
    import pyarrow.parquet as pq  # noqa: PLC0415 - as above

    types = {int | None: pa.int64(), float | None: pa.float64()}
    schema = pa.schema([(name, types.get(hint, pa.string())) for name, hint in get_type_hints(CaseSummary).items()])
    plain = [{name: _escaped(value) for name, value in row.row().items()} for row in rows]
    pq.write_table(pa.Table.from_pylist(plain, schema), stream)


def _escaped(value: object) -> object:
    return value.encode("utf-8", "backslashreplace").decode() if isinstance(value, str) else value
