"""What people are told of an evaluation, gathered as the steps come."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.results.evaluation import Evaluation, Part
from mudline.results.totals import StepTotal, step_totals
from mudline.results.traces import Peaks


@dataclass
class Digest:
    """The first step, the figures of the first `most` steps (None: of all), and the largest of all steps."""

    evaluation: Evaluation
    most: int | None
    first: Part | None = None
    steps: list[StepTotal] = field(default_factory=list)
    peaks: Peaks = field(init=False)

    def __post_init__(self) -> None:
        self.peaks = Peaks(self.evaluation)

    def take(self, part: Part) -> None:
        """Look at some steps."""
        if self.first is None:
            self.first = Part(part.start, part.result.steps(0, 1))
        left = part.count if self.most is None else min(part.count, self.most - len(self.steps))
        if self.evaluation.time is not None and left > 0:
            self.steps += step_totals(self.evaluation, Part(part.start, part.result.steps(0, left)))
        if self.evaluation.time is not None:
            self.peaks.take(part)
