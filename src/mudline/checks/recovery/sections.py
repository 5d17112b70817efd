"""Missing `$SECTION` lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mudline.checks.recovery.blocks import Blocks, Correction, head_start, recovers_from, start_of
from mudline.language.codes.lines import SYN007
from mudline.language.diagnostics import Problem, Span
from mudline.language.keywords import catalogue
from mudline.language.syntax.edits import TextEdit


@recovers_from(SYN007)
def before_sections(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Blocks that stand before any section: a `$SECTION` line in front of them."""
    text = blocks.text
    tree = text.tree
    outside = {start_of(text, one): one for one in problems}
    run = [(head_start(text, block), block.name) for block in tree.preamble.blocks]
    if not run or any(head not in outside for head, _ in run):  # a deck of another program is reported once
        return
    end = tree.sections[0].head.span.start if tree.sections and tree.sections[0].head else blocks.end
    start, name = run[0]
    if name in catalogue.SECTIONS:
        message = f"*{name} is no keyword: write ${name}"
        yield Correction(
            outside[start], (TextEdit(Span(start, start + 1), "$"),), Span(start, end), message, certain=True
        )
        return
    edits, words = _section_lines(run, "")
    message = ""
    if len(run) > 1:
        message = f"the line {words} is missing above this one: *{name} stands before any $SECTION"
    yield Correction(outside[start], edits, Span(start, end), message, certain=True)


def _section_lines(run: list[tuple[int, str]], current: str) -> tuple[tuple[TextEdit, ...], str]:
    """A line in front of each keyword of a run that does not belong in the section of the one before; the first."""
    edits: list[TextEdit] = []
    for head, keyword in run:
        sections = catalogue.sections_of(keyword) or ((current,) if current else ("MODEL",))
        if current not in sections:
            current = sections[0]
            edits.append(TextEdit(Span(head, head), f"${current}\n"))
    return tuple(edits), edits[0].text.strip() if edits else ""
