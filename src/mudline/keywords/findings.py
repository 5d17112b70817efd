"""What is noticed while one block is read: problems, what is incomplete because of them, and what got lost."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from mudline.diagnostics import Code, Problem, Span
from mudline.keywords.places import Path, Places

MOST_TOLD = 1000
"""Problems of one code told one by one in a block; more of them are counted."""


@dataclass(slots=True)
class Findings:
    """Problems of a block. `lost` counts lines and names that could not be used: what they define is unknown."""

    places: Places
    problems: list[Problem] = field(default_factory=list)
    lost: int = 0
    counts: Counter[Code] = field(default_factory=Counter)
    latest: dict[Code, Span] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """Whether everything could be read."""
        return not self.lost and not self.places.damaged

    def tell(self, problem: Problem) -> None:
        """Something that leaves the values complete."""
        self.counts[problem.code] += 1
        if self.counts[problem.code] <= MOST_TOLD:
            self.problems.append(problem)
        elif problem.span:
            self.latest[problem.code] = problem.span

    def damage(self, path: Path, problem: Problem | None = None) -> None:
        """A value that could not be read: the record at `path` is not complete."""
        self.places.damaged.add(path)
        if problem:
            self.tell(problem)

    def lose(self, problem: Problem | None = None) -> None:
        """A line or name that could not be used at all."""
        self.lost += 1
        if problem:
            self.tell(problem)

    def finish(self) -> list[Problem]:
        """All problems; those beyond the most told are one more, at the last of them."""
        for code, span in self.latest.items():
            more = self.counts[code] - MOST_TOLD
            self.problems.append(
                Problem(code, f"{more} more like this above in the block: only the first are listed", span)
            )
        return self.problems
