"""docs/keywords.md: every known keyword, with a link to its page where it has one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mudline.language.keywords import catalogue
from mudline.language.keywords.names_only import NAMES
from tests.docs.keyword_page import models, page_name, sections_of, title
from tests.docs.keyword_rules import Declared
from tests.docs.marking import MADE, marked

_PAGE = """{made}

# Keywords

[language.md](language.md) describes how lines, fields, comments, names and equations are written,
[numerics.md](numerics.md) what is evaluated.

## Keywords with a model

mudline reads every field of these, checks it, and writes it back.

{models}

## Keywords whose lines are kept

The format of these is not public. Their lines are kept unchanged; the names in them are read, so that what they define
is not reported as missing.

| keyword | section | holds |
| --- | --- | --- |
{kept}

## Keywords that pass through

These are known by name, and their lines are kept unchanged. In another section such a keyword is reported by
[SYN008](rules/SYN008.md). A keyword that is not on this page is kept as well and reported by [SYN009](rules/SYN009.md).

| section | keywords |
| --- | --- |
{passing}

They were looked for once more on 2026-11-28, in stored copies of the manual's public pages: by the name that the page
of each would have (`kwd_loadcase_temperature` and the like), and by what it would say:

| outcome | keywords |
| --- | --- |
{looked_up}

## Formats

In the formats of the pages `[ ]` may be left out, `|` separates alternatives, and `...` means that a line, with the
deeper lines below it, or a value may be repeated. The indentation of a deck is free. If the first setting of a line is
left out, the next one is on a separate line. [SBD010](rules/SBD010.md) checks the ranges of the fields. *Inferred* is
our reading of what the language leaves open; each page ends with a list.
"""


LOOKED_UP = {
    "page found, with the form of its lines; not read yet": ("SLUGS",),
    "page found; its lines are requests of plots, from which nothing is computed here": (
        *("SPECTRUM", "RAO", "TIMETRACE"),  # of postprocessing, and of a load case
    ),
    "named by pages about theory, without the form of their lines": (
        *("COATINGS", "DAMPING", "EQUIVALENT", "FLOATING BODY", "HOT SPOT SETS", "IDENTIFY", "MOORED VESSEL"),
        *("OUTPUT FILES", "PARA ANGLE TENSION", "PLOT", "POISSON", "REGULAR WAVE EQUIVALENT", "SNAPSHOT"),
        *("STANDARD OUTPUT", "STATISTICS", "STIFFENER", "STRESS/STRAIN", "WAVE-PIERSON-MOSKOWITZ", "WIND"),
    ),
    "nothing found": (
        *("DAMPER", "FLEX JOINTS", "GUIDE", "PANEL SECTIONS,AUXILIARY", "RAO FORMAT", "TEMPERATURE", "TENSIONER"),
    ),
    "no page of the manual, but a public reader of `.das` decks": (
        *("DIRECTORY", "DRIFT-OFF LIMITS", "DRILLING MUD", "TIME,DISCONNECT", "TOP TENSION", "WAVE"),
    ),
}
"""What a search for the pages of the keywords that pass through has shown."""


def keyword_index() -> str:
    """The whole page."""
    return _PAGE.format(
        made=MADE,
        models=_by_subject(),
        kept=_rows(catalogue.opaque_keywords()),
        passing="\n".join(_passing()),
        looked_up="\n".join(f"| {what} | {_listed(keywords)} |" for what, keywords in LOOKED_UP.items()),
    )


_TABLE = """### {subject}

| keyword | section | holds |
| --- | --- | --- |
{rows}
"""


def _by_subject() -> str:
    """A table for each subject, in which the keywords stand by section."""
    found: dict[str, list[Declared]] = {}
    for block in models():
        found.setdefault(block.subject, []).append(block)
    tables = (_TABLE.format(subject=subject.capitalize(), rows=_rows(own)) for subject, own in found.items())
    return "\n".join(tables).rstrip()


def _rows(declared: Sequence[Declared]) -> str:
    return "\n".join(
        f"| [`{title(each)}`](keywords/{page_name(each)}.md) | {sections_of(each)} | {marked(each.summary)} |"
        for each in declared
    )


def _listed(keywords: Iterable[str]) -> str:
    return ", ".join(f"`*{keyword}`" for keyword in keywords)


def _passing() -> Iterator[str]:
    """The keywords that are known by name only, by section."""
    by_section: dict[str, list[str]] = {}
    for keyword, sections in sorted(NAMES.items()):
        for section in sections or ("",):
            by_section.setdefault(section, []).append(f"`*{keyword}`")
    for name in (*catalogue.SECTIONS, ""):
        if name in by_section:
            yield f"| {f'`${name}`' if name else 'not confirmed'} | {', '.join(by_section[name])} |"
