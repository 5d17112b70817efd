"""What is kept of the lines of an evaluation whose steps come and go: their first rows, all for JSON, their ranges."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mudline.contact.lines import LineSummary
from mudline.contact.result import Part
from mudline.contact.touchdown import LineSeries, Touchdown
from mudline.results.evaluation import Evaluation
from mudline.scene.numbering import Floats


class Extent(NamedTuple):
    """The least and the largest value of a figure of a line over all steps, and the steps where they were first."""

    least: float
    least_step: int
    largest: float
    largest_step: int


FOLLOWED = ("first", "last", "contact_length", "force", "uplift", "reaction")
"""Figures of `LineSeries` whose extents are kept."""


@dataclass
class LineWatch:
    """The first `most` rows of lines at steps (None: all), and the extents of their figures by line and name."""

    evaluation: Evaluation
    most: int | None
    rows: list[LineSummary] = field(default_factory=list)
    extents: dict[tuple[int, str], Extent] = field(default_factory=dict)
    left: int = 0
    """Rows that are not kept."""

    def __post_init__(self) -> None:
        self._finder = Touchdown(self.evaluation.model.input)

    def take(self, part: Part) -> None:
        """Look at some steps."""
        found = self._finder.series(part)
        total = part.count * len(found)
        kept = total if self.most is None else min(total, max(self.most - len(self.rows), 0))
        if kept:
            rows = self._finder.summaries(part, found)
            self.rows += [row for row, _ in zip(rows, range(kept), strict=False)]
        self.left += total - kept
        if self.evaluation.steps > 1:
            for line in found:
                self._extend(line, part.start)

    def _extend(self, line: LineSeries, start: int) -> None:
        for name in FOLLOWED:
            values: Floats = getattr(line, name)
            if np.isnan(values).all():
                continue
            low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
            here = Extent(float(values[low]), start + low, float(values[high]), start + high)
            before = self.extents.get((line.number, name), here)
            least = before[:2] if before.least <= here.least else here[:2]
            largest = before[2:] if before.largest >= here.largest else here[2:]
            self.extents[line.number, name] = Extent(*least, *largest)
