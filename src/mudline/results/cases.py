"""Many decks: what is worst in the results of each, over all lines and steps, as a row; and the order of rows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from typing import BinaryIO, Literal

import numpy as np

from mudline.contact.input import LawKind
from mudline.contact.result import Part
from mudline.contact.touchdown import Touchdown
from mudline.quantities import finite
from mudline.results.evaluation import Evaluation
from mudline.results.warnings import ContactWarning
from mudline.scene.deck_values import FOOT, POUND
from mudline.scene.numbering import Floats

_PER_LENGTH = {"imperial": POUND / FOOT}
"""N/m of a force per unit length in a unit system; 1 in the others."""


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
    ratio: float | None = None
    warnings: int | None = None
    warning_codes: str | None = None
    result: str | None = None

    @property
    def failed(self) -> bool:
        """Whether the deck could not be evaluated."""
        return self.verdict == "failed"

    def row(self) -> dict[str, str | int | float | None]:
        """The values by name."""
        return asdict(self)


def worst_first(rows: Iterable[CaseSummary]) -> list[CaseSummary]:
    """The decks that failed in their order, then the others with the largest force first."""

    def rank(row: CaseSummary) -> tuple[bool, float]:
        force = -math.inf if row.largest_force is None else row.largest_force
        return not row.failed, 0.0 if row.failed else -force * _PER_LENGTH.get(row.units or "", 1.0)

    return sorted(rows, key=rank)


class _Worst:
    """A force of an element that is largest in a direction, and when that was."""

    def __init__(self, sign: float) -> None:
        self._sign = sign
        self.force: float | None = None
        self.element = -1
        self.time: float | None = None

    def take(self, forces: Floats, elements: Sequence[int], times: Floats | None) -> None:
        """Look at the forces of some steps, NaN for none."""
        ranked = np.nan_to_num(forces * self._sign, nan=-np.inf, posinf=np.inf)
        step = int(ranked.argmax())
        if ranked[step] <= 0.0 or (self.force is not None and ranked[step] <= self.force * self._sign):
            return
        self.force, self.element = float(forces[step]), int(elements[step])
        self.time = None if times is None else float(times[step])


class CaseWatch:
    """Takes the results of a deck a few steps at a time, and keeps what its row needs."""

    def __init__(self, evaluation: Evaluation) -> None:
        self._evaluation = evaluation
        self._finder = Touchdown(evaluation.model.input)
        lying = evaluation.model.input.law != LawKind.NONE
        self._lying = {line for line, each in enumerate(self._finder.lines.elements) if lying[each].any()}
        self._touching = 0
        self._from, self._to, self._length = math.inf, -math.inf, 0.0
        self._force, self._uplift = _Worst(1.0), _Worst(-1.0)
        self._reaction, self._weight = -math.inf, math.nan

    def take(self, part: Part) -> None:
        """Look at some steps."""
        result, lines = part.result, self._finder.series(part)
        lines = [line for line in lines if line.number in self._lying] or lines  # others may be held in soil
        self._touching = max(self._touching, int(result.contact[:, self._evaluation.elements].sum(axis=1).max()))
        if not lines:
            return
        for line in lines:
            self._from = float(np.fmin(self._from, np.fmin.reduce(line.first)))
            self._to = float(np.fmax(self._to, np.fmax.reduce(line.last)))
            self._force.take(line.force, line.force_at.tolist(), result.times)
            self._uplift.take(line.uplift, line.uplift_at.tolist(), result.times)
        with np.errstate(over="ignore", invalid="ignore"):
            length, reaction, weight = (
                np.sum([getattr(line, name) for line in lines], axis=0)
                for name in ("contact_length", "reaction", "weight")
            )
        self._length = max(self._length, float(length.max()))
        step = int(reaction.argmax())
        if np.isnan(reaction[step]) or reaction[step] > self._reaction:
            self._reaction, self._weight = float(reaction[step]), float(weight[step])

    def summary(self, deck: str, warnings: Sequence[ContactWarning], result: str | None) -> CaseSummary:
        """The row of a deck, called `deck`, whose results are in the file `result`."""
        evaluation = self._evaluation
        codes = sorted({one.diagnostic.code for one in warnings})
        return CaseSummary(
            deck=deck,
            verdict="evaluated",
            units=evaluation.scene.units,
            positions="deck" if evaluation.own_positions else "file",
            steps=evaluation.steps,
            elements=len(evaluation.elements),
            in_contact=self._touching,
            touchdown_from=finite(self._from),
            touchdown_to=finite(self._to),
            contact_length=finite(self._length),
            largest_force=finite(self._force.force),
            largest_force_element=self._number(self._force),
            largest_force_time=self._force.time,
            largest_uplift=finite(self._uplift.force),
            largest_uplift_element=self._number(self._uplift),
            largest_uplift_time=self._uplift.time,
            reaction=finite(self._reaction),
            ratio=finite(self._reaction / self._weight) if self._weight > 0.0 else None,
            warnings=len(warnings),
            warning_codes=" ".join(codes),
            result=result,
        )

    def _number(self, worst: _Worst) -> int | None:
        return None if worst.force is None else int(self._evaluation.scene.element_ids[worst.element])


def write_parquet(rows: Sequence[CaseSummary], stream: BinaryIO) -> None:
    """Write rows as a table in Parquet. Raises OSError, ImportError without pyarrow.

    What UTF-8 cannot hold, as file names may, is escaped.
    """
    import pyarrow as pa  # noqa: PLC0415 - the extra `parquet`
    import pyarrow.parquet as pq  # noqa: PLC0415 - as above

    types = {"str": pa.string(), "int": pa.int64(), "float": pa.float64()}
    schema = pa.schema(
        [(field.name, types.get(str(field.type).partition(" ")[0], pa.string())) for field in fields(CaseSummary)]
    )
    plain = [{name: _escaped(value) for name, value in row.row().items()} for row in rows]
    pq.write_table(pa.Table.from_pylist(plain, schema), stream)


def _escaped(value: object) -> object:
    return value.encode("utf-8", "backslashreplace").decode() if isinstance(value, str) else value
