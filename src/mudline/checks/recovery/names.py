"""Names of keywords, sections and settings, and words of settings, that are misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import chain

from mudline.checks.recovery.blocks import (
    Blocks,
    Correction,
    also_in,
    recovers_from,
    start_of,
)
from mudline.language.codes.lines import SYN004, SYN005, SYN008, SYN009, SYN010
from mudline.language.diagnostics import Problem
from mudline.language.syntax.edits import TextEdit

_DIGITS = re.compile(r"[0-9]+")


@recovers_from(SYN004, SYN005, SYN008, SYN009, SYN010)
def misspelt(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Names for which another one was meant; one that is misspelt several times is corrected everywhere."""
    alike: dict[tuple[str, str], list[Problem]] = {}
    for problem in problems:
        if problem.repair is not None:
            alike.setdefault((problem.code.code, problem.message), []).append(problem)
    text = blocks.text
    for found in alike.values():
        problem = min(found, key=lambda one: start_of(text, one))
        repairs = [one.repair.edits for one in found if one.repair is not None]
        edits = tuple(TextEdit(span, written) for span, written in sorted(chain.from_iterable(repairs)))
        first = edits[0].span
        region = blocks.section_at(first.start) if problem.code is SYN010 else blocks.block_at(first.start)
        others = [one for one in found if one is not problem]
        message = f"{problem.message}; {also_in(text, others)}" if others else ""
        does = problem.repair.message if problem.repair else ""
        if all(_differs(text.source.unified[slice(*edit.span)], edit.text) for edit in edits):
            yield Correction(problem, edits, region, message, does, joins=edits[0].text.startswith("C "))


def _differs(written: str, meant: str) -> bool:
    """Whether a name differs in more than its digits from the one that was meant: they tell things of a kind apart."""
    return _DIGITS.sub("", meant).casefold() != _DIGITS.sub("", written).casefold()
