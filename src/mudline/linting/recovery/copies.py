"""Blocks that stand in the model twice."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mudline.codes.references import REF007
from mudline.diagnostics import Blocks as Blocking
from mudline.diagnostics import Code, Problem, Severity, Span
from mudline.keywords import catalogue
from mudline.linting.recovery.blocks import Blocks, Correction, data_of, line_at, recovers_from, whole
from mudline.linting.rules.references import REF016
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import trimmed
from mudline.syntax.tree import RawBlock

_CODES = {"nodes": REF007, "elements": REF007, "sets": REF016}
"""What is said of a thing that is defined twice."""


def defines(keyword: str) -> Code | None:
    """What is said of a thing that two blocks of a keyword define; None where they define none."""
    return _CODES.get(catalogue.facts_of(keyword).defines)


@recovers_from(REF007, REF016, always=True)
def copies(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:  # noqa: ARG001 - looks at the text
    """Blocks of the model that stand there once more, word for word: without the copies."""
    model = [block for name, block in blocks.blocks if name == "MODEL"]
    names = [block.name for block in model if defines(block.name)]
    if len(set(names)) == len(names):
        return
    unified = blocks.text.source.unified
    known: dict[str, RawBlock] = {}
    runs: list[list[tuple[RawBlock, RawBlock]]] = [[]]
    for block in model:
        written = unified[slice(*whole(block))].strip()
        if written in known:
            runs[-1].append((block, known[written]))
        elif runs[-1]:
            runs.append([])
        known.setdefault(written, block)
    for run in runs:
        defining = next((block for block, _ in run if defines(block.name) and block.leaves), None)
        if defining is not None and (code := defines(defining.name)):
            yield _without(blocks, run, defining, code)


def _without(blocks: Blocks, run: list[tuple[RawBlock, RawBlock]], defining: RawBlock, code: Code) -> Correction:
    """The text without a run of copies; `defining` is the first of them that defines something."""
    text = blocks.text
    first, last = whole(run[0][0]), whole(run[-1][0])
    begin, end = (text.source.position(at)[0] for at in (first.start, last.end - 1))
    original = run[0][1].head.span.start
    message = f"lines {begin} to {end} repeat the lines from {text.source.position(original)[0]} on word for word"
    severity = None if blocks.section_at(original) == blocks.section_at(first.start) else Severity.WARNING
    rows = next(iter(data_of(defining.leaves)), defining.leaves[0])
    place = trimmed(text.source.unified, *line_at(text, rows.span.start))
    cause = Problem(code, f"{message}: remove them", place, severity, blocks=Blocking.NEVER)
    edits = tuple(TextEdit(whole(block), "") for block, _ in run)
    return Correction(cause, edits, Span(first.start, last.end), certain=True)
