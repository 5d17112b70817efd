"""The worst results of each of many decks, over all lines and steps, as a row; the order of rows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from typing import BinaryIO, Literal

from mudline.basics.quantities import finite
from mudline.model.results.series import PeakValue, SeriesSummary
from mudline.model.results.warnings import ContactWarning
from mudline.model.scene.deck_values import FOOT, POUND

_PER_LENGTH = {"imperial": POUND / FOOT}
"""N/m of a force per unit length, by unit system; 1 in the other systems."""


@dataclass(frozen=True, slots=True)
class CaseSummary:
    """A deck among many; the fields are those of `quantities.CASES`."""

    deck: str
    verdict: Literal["evaluated", "failed"]
    reason: str | None = None
    units: str | None = None
    positions: str | None = None
    steps: int | None = None
    elements: int | None = None
    in_contact: int | None = None
    touchdown_from: float | None = None
    touchdown_to: float | None = None
    contact_length: float | None = None
    largest_force: float | None = None
    largest_force_element: int | None = None
    largest_force_time: float | None = None
    largest_uplift: float | None = None
    largest_uplift_element: int | None = None
    largest_uplift_time: float | None = None
    reaction: float | None = None
    submerged_weight: float | None = None
    empty_weight: float | None = None
    contents_case: int | None = None
    ratio: float | None = None
    warnings: int | None = None
    warning_codes: str | None = None
    result: str | None = None

    @property
    def failed(self) -> bool:
        """True if the deck could not be evaluated."""
        return self.verdict == "failed"

    def row(self) -> dict[str, str | int | float | None]:
        """Return the values by name."""
        return asdict(self)


def worst_first(rows: Iterable[CaseSummary]) -> list[CaseSummary]:
    """Return the failed decks in their order, then the others with the largest force first."""

    def rank(row: CaseSummary) -> tuple[bool, float]:
        force = -math.inf if row.largest_force is None else row.largest_force
        return not row.failed, 0.0 if row.failed else -force * _PER_LENGTH.get(row.units or "", 1.0)

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

    types = {"int": pa.int64(), "float": pa.float64()}
    kinds = [(field.name, str(field.type).partition(" ")[0]) for field in fields(CaseSummary)]
    schema = pa.schema([(name, types.get(kind, pa.string())) for name, kind in kinds])
    plain = [{name: _escaped(value) for name, value in row.row().items()} for row in rows]
    pq.write_table(pa.Table.from_pylist(plain, schema), stream)


def _escaped(value: object) -> object:
    return value.encode("utf-8", "backslashreplace").decode() if isinstance(value, str) else value
