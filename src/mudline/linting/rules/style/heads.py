"""Lines that begin a section or a keyword."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.keywords import catalogue
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.style.lines import first_told
from mudline.syntax.fields import trimmed
from mudline.syntax.tree import canonical_name

STY005 = Code("STY005", "indented-keyword", Severity.WARNING)
STY006 = Code("STY006", "keyword-case", Severity.INFO)

_SMALL = re.compile(r"[a-z]")
_INDENTED_HEAD = re.compile(r"[ \t]++[*$]")
_INDENTED_BELOW = re.compile(rf"\n{_INDENTED_HEAD.pattern}")
_SMALL_HEAD = re.compile(r"[ \t]*+[*$][^\na-z]*+[a-z]")
_SMALL_BELOW = re.compile(rf"\n{_SMALL_HEAD.pattern}")
_UPPER = {code: code - 32 for code in range(ord("a"), ord("z") + 1)}


@rule(STY005)
def indented_keyword(context: LintContext) -> Iterator[Problem]:
    """A keyword or a section does not begin in column 1.

    Blanks before the `*` or the `$` are read over here, but a program that looks for the mark in column 1 takes the
    line for data, and the block for a part of the one above. Remove the blanks.

    Example:
         $MODEL
        -  *OCEAN
        +*OCEAN
          500.0, 1025.0, 9.81

    Finds: 2:3
    """
    if context.text:
        source = context.text.source.unified
        if _INDENTED_BELOW.search(source) or _INDENTED_HEAD.match(source):
            yield from first_told(_indented(context.text))


def _indented(text: TextOrigin) -> Iterator[Problem]:
    source = text.source.unified
    for start, head in _heads(text):
        if start < head.start:
            mark = source[head.start]
            what = "section" if mark == "$" else "keyword"
            message = f"the {what} is indented: put its {mark} in column 1"
            repair = Repair("safe", "remove what stands before it", ((Span(start, head.start), ""),))
            yield Problem(STY005, message, head, repair=repair)


@rule(STY006)
def keyword_case(context: LintContext) -> Iterator[Problem]:
    """The name of a keyword or a section is not in upper case.

    Case does not count here. Manuals and other decks have these names in upper case, though, and who searches many
    decks for a keyword finds it only there. Write it in upper case.

    Example:
         $MODEL
        -*Ocean
        +*OCEAN
          500.0, 1025.0, 9.81

    Finds: 2:1
    """
    if context.text:
        source = context.text.source.unified
        if _SMALL_BELOW.search(source) or _SMALL_HEAD.match(source):
            yield from first_told(_small(context.text))


def _small(text: TextOrigin) -> Iterator[Problem]:
    source = text.source.unified
    for _, head in _heads(text):
        written = source[slice(*head)]
        if _SMALL.search(written) and _known(written):
            what = "section" if written[0] == "$" else "keyword"
            repair = Repair("safe", "write it in upper case", ((head, written.translate(_UPPER)),))
            yield Problem(STY006, f"the {what} is not in upper case: write it so", head, repair=repair)


def _known(head: str) -> bool:
    """Whether a head names a known section or keyword: what stands behind a name may be a remark."""
    return canonical_name(head) in (catalogue.SECTIONS if head[0] == "$" else catalogue.keywords())


def _heads(text: TextOrigin) -> Iterator[tuple[int, Span]]:
    """The start of every line that begins a section or a keyword, and its text without blanks around it."""
    source = text.source.unified
    for section in (text.tree.preamble, *text.tree.sections):
        for head in (section.head, *(block.head for block in section.blocks)):
            if head is not None:
                yield head.span.start, trimmed(source, *head.span)
