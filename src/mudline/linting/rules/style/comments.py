"""Comments, and data that looks like one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.style.lines import first_told, is_setting, placed_leaves
from mudline.syntax.fields import first_key, trimmed
from mudline.syntax.tree import Kind

STY002 = Code("STY002", "lower-case-comment", Severity.WARNING)
STY008 = Code("STY008", "key-like-comment", Severity.INFO)
STY009 = Code("STY009", "indented-comment", Severity.WARNING)

_KEY_LIKE = re.compile(r"\n[Cc][A-Za-z]")
_INDENTED = re.compile(r"[ \t]++[Cc](?:[ \t]++[^ \t\r\n]|[-*=#_.~+]{2})")
_INDENTED_BELOW = re.compile(rf"\n{_INDENTED.pattern}")


@rule(STY002)
def lower_case_comment(context: LintContext) -> Iterator[Problem]:
    """A comment begins with a small c.

    The mark of a comment is a capital C in column 1. A small one is read as such here, but a program that goes by the
    letter takes the line for data. Write a capital C.

    Example:
         $MODEL
         *OCEAN
        -c Depth from the survey
        +C Depth from the survey
          500.0, 1025.0, 9.81

    Finds: 3:1
    """
    if context.text:
        source = context.text.source.unified
        if "\nc" in source or source.startswith("c"):
            yield from first_told(_lower_case(context.text))


def _lower_case(text: TextOrigin) -> Iterator[Problem]:
    source = text.source.unified
    for leaf, _, kept in placed_leaves(text):
        start = leaf.span.start
        if leaf.kind is Kind.COMMENT and source[start] == "c" and not kept:
            mark = Span(start, start + 1)
            repair = Repair("safe", "write a capital C", ((mark, "C"),))
            yield Problem(STY002, "the comment begins with a small c: write a capital C", mark, repair=repair)


@rule(STY008)
def key_like_comment(context: LintContext) -> Iterator[Problem]:
    """A setting such as CURVE= begins in column 1, where a C makes a comment.

    It is read as data here, since its keyword knows the setting. Programs that take any line with a C in column 1 for a
    comment drop it without a word, and with it the name of a curve or a whole group of values. Put a blank in front.

    Example:
         $MODEL
         *SEABED STIFFNESS
        -CURVE=Clay
        + CURVE=Clay
          0.0, 0.0
          0.5, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 3:1
    """
    if context.text and _KEY_LIKE.search(context.text.source.unified):
        yield from first_told(_key_like(context.text))


def _key_like(text: TextOrigin) -> Iterator[Problem]:
    source = text.source.unified
    for leaf, read, _ in placed_leaves(text):
        start = leaf.span.start
        if read is not None and source[start] in "Cc" and is_setting(source, leaf, read):
            key = first_key(source, leaf.span)
            message = f"{key}= begins with C in column 1, a comment to other programs: put a blank before it"
            repair = Repair("safe", "put a blank before it", ((Span(start, start), " "),))
            yield Problem(STY008, message, Span(start, source.index("=", start) + 1), repair=repair)


@rule(STY009)
def indented_comment(context: LintContext) -> Iterator[Problem]:
    """A line that looks like a comment is indented, and so it is data.

    Only a C in column 1 makes a comment; the manual says nothing else of any other (inferred). With a blank before it
    the line is read as values of its keyword, as the name of a set for instance, or cannot be read. If it is a comment,
    remove the blanks. Lines of blocks that are kept as they are do not count.

    Example:
         $MODEL
         *OCEAN
        -  C Depth from the survey
        +C Depth from the survey
          500.0, 1025.0, 9.81

    Finds: 3:3
    """
    if context.text:
        source = context.text.source.unified
        if _INDENTED_BELOW.search(source) or _INDENTED.match(source):
            yield from first_told(_indented(context.text))


def _indented(text: TextOrigin) -> Iterator[Problem]:
    source = text.source.unified
    for leaf, read, kept in placed_leaves(text):
        if kept or leaf.kind not in (Kind.TEXT, Kind.SETTING) or not _INDENTED.match(source, *leaf.span):
            continue
        if read is None or not is_setting(source, leaf, read):
            message = "an indented line is data, not a comment: if it is meant as one, put its C in column 1"
            yield Problem(STY009, message, trimmed(source, *leaf.span))
