"""What a reader of results should know, on standard error."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from mudline.cli.evaluate_outputs import beside, result_file
from mudline.cli.terminal import tell
from mudline.contact import LawKind
from mudline.results.against import Comparison
from mudline.results.evaluation import Evaluation, Part

_MOST_NAMED = 10


def tell_before(evaluation: Evaluation, comparison: Comparison | None) -> None:
    """What is left out, and what is guessed."""
    missing = len(evaluation.present) - len(evaluation.nodes)
    if missing:
        tell(f"no positions for {_count(missing, 'node')}: {_count(evaluation.skipped, 'element')} left out")
    if evaluation.lengths_from_positions:
        tell(f"the length of {_count(evaluation.lengths_from_positions, 'element')} comes from the first positions")
    if rigid := int((evaluation.scene.law == LawKind.RIGID).sum()):
        tell(f"{_count(rigid, 'element')} on a rigid bed: a constraint, whose reaction is not evaluated")
    for stage, why in evaluation.model.input.left_out.items():
        tell(f"{stage}: {why}")
    if comparison is not None:
        _tell_unmatched(comparison)


class SlowSuction:
    """Counts the steps at which suction is pulled at velocities below REGULARISATION."""

    def __init__(self) -> None:
        self.steps = 0
        self.element: int | None = None

    def take(self, part: Part) -> None:
        """Look at some steps."""
        slow = part.result.regularised
        if slow is None or not slow.any():
            return
        self.steps += int(slow.any(axis=1).sum())
        if self.element is None:
            self.element = int(np.argwhere(slow)[0, 1])


def tell_behind(evaluation: Evaluation, slow: SlowSuction, written: Path | None) -> None:
    """Where suction is less than its power law gives, and which files were written."""
    if slow.element is not None:
        number = int(evaluation.scene.element_ids[slow.element])
        when = f"at {slow.steps} of {_count(evaluation.steps, 'step')}, element {number} first"
        tell(f"suction is pulled slower than REGULARISATION {when}: the force there is less than alpha v^n")
    if written is None:
        return
    if result_file(written.suffix.lower().removeprefix(".")).BESIDE:
        tell(f"nodes -> {beside(written).as_posix()}")
    tell(f"{evaluation.scene.deck.file} -> {written.as_posix()}")


def _tell_unmatched(comparison: Comparison) -> None:
    """What one side has and the other has not."""
    file = comparison.reference.file
    for numbers, thing, where in (
        (comparison.reference.unknown.tolist(), "element", f"of {file} not in the deck"),
        (comparison.missing.tolist(), "evaluated element", f"not in {file}"),
        (comparison.reference.lost_times.tolist(), "time", f"of {file} not evaluated"),
        (comparison.reference.missing_times.tolist(), "evaluated time", f"not in {file}"),
    ):
        if numbers:
            tell(f"{_count(len(numbers), thing)} {where}: {_named(numbers)}")


def _named(numbers: Sequence[float]) -> str:
    more = f" and {len(numbers) - _MOST_NAMED} more" if len(numbers) > _MOST_NAMED else ""
    return ", ".join(map(repr, numbers[:_MOST_NAMED])) + more


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'s' * (number != 1)}"
