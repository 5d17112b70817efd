"""Missing and misspelt `$SECTION` lines, and a block of lines that another keyword has."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mudline.codes.lines import SYN007, SYN008
from mudline.diagnostics import Problem, Severity, Span
from mudline.keywords import catalogue
from mudline.linting.recovery.blocks import Blocks, Correction, head_start, recovers_from, start_of
from mudline.syntax.edits import TextEdit


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


@recovers_from(SYN008)
def in_another_section(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Blocks that stand in a section where they do not belong: a `$SECTION` line in front of each run of them."""
    text = blocks.text
    elsewhere = {start_of(text, one): one for one in problems if one.weight is Severity.ERROR}
    for section in text.tree.sections:
        placed = [(head_start(text, block), block.name) for block in section.blocks]
        for begin, behind in _runs(placed, elsewhere):
            yield _moved(blocks, elsewhere[placed[begin][0]], section.name, placed[begin:behind], placed[behind:])


def _runs(placed: list[tuple[int, str]], elsewhere: dict[int, Problem]) -> Iterator[tuple[int, int]]:
    """Where runs of misplaced blocks that belong in one section begin and end, as indices in `placed`.

    Keywords of which the section is not known do not end a run.
    """
    number = 0
    while number < len(placed):
        head, keyword = placed[number]
        first = number
        number += 1
        if head not in elsewhere:
            continue
        behind = number
        target = _section_of(keyword)
        while number < len(placed):
            head, keyword = placed[number]
            if catalogue.sections_of(keyword) and not (head in elsewhere and _section_of(keyword) == target):
                break
            number += 1
            behind = number if head in elsewhere else behind
        yield first, behind if number < len(placed) else number


def _section_of(keyword: str) -> str:
    """The section where a keyword mostly stands."""
    return (catalogue.sections_of(keyword) or ("MODEL",))[0]


def _moved(
    blocks: Blocks, first: Problem, section: str, run: list[tuple[int, str]], behind: list[tuple[int, str]]
) -> Correction:
    """A run of blocks in a section of their own; the section goes on behind them."""
    edits, words = _section_lines(run, section)
    end = blocks.section_at(run[0][0]).end
    if behind:
        end = behind[0][0]
        edits = (*edits, TextEdit(Span(end, end), f"${section}\n"))
    others = len(run) - 1
    message = ""
    if others:
        nor = "nor does the keyword" if others == 1 else f"nor do the {others} keywords"
        message = (
            f"*{run[0][1]} does not belong in ${section}, {nor} below it: "
            f"the line {words} seems to be missing above this one"
        )
    return Correction(first, edits, Span(run[0][0], end), message, certain=True)


def _section_lines(run: list[tuple[int, str]], current: str) -> tuple[tuple[TextEdit, ...], str]:
    """A line in front of each keyword of a run that does not belong in the section of the one before; the first."""
    edits: list[TextEdit] = []
    for head, keyword in run:
        sections = catalogue.sections_of(keyword) or ((current,) if current else ("MODEL",))
        if current not in sections:
            current = sections[0]
            edits.append(TextEdit(Span(head, head), f"${current}\n"))
    return tuple(edits), edits[0].text.strip() if edits else ""
