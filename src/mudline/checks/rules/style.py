"""Style: comments and keywords that are hard to recognise, and separators, blanks and spellings of numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.basics.limits import MOST_COLUMNS
from mudline.checks.context import LintContext
from mudline.checks.suppression import STY010, suppressions
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.reader import ReadBlock, all_keys
from mudline.language.rules import rule
from mudline.language.syntax.fields import FieldGroup, first_key, read_line, trimmed
from mudline.language.syntax.rows import blank_separated, row_fields
from mudline.language.syntax.tree import Leaf, LeafKind, canonical_name

STY002 = Code("STY002", "lower-case-comment", Severity.WARNING)
STY005 = Code("STY005", "indented-keyword", Severity.WARNING)
STY006 = Code("STY006", "keyword-case", Severity.INFO)
STY008 = Code("STY008", "key-like-comment", Severity.INFO)
STY009 = Code("STY009", "indented-comment", Severity.WARNING)
STY001 = Code("STY001", "tab-character", Severity.INFO)
STY003 = Code("STY003", "fortran-exponent", Severity.WARNING)
STY004 = Code("STY004", "blank-separated", Severity.INFO)
STY007 = Code("STY007", "trailing-blank", Severity.INFO)


_DATA = (LeafKind.RUN, LeafKind.SETTING, LeafKind.TEXT)

INDENTED_COMMENT = re.compile(r"[ \t]++[Cc](?:[ \t]++[^ \t\r\n]|[-*=#_.~+]{2})")
_SMALL = re.compile(r"[a-z]")
_UPPER = {code: code - 32 for code in range(ord("a"), ord("z") + 1)}


def placed_leaves(context: LintContext) -> list[tuple[Leaf, ReadBlock | None, bool]]:
    """Return every line, or run of lines, except those of keywords and sections. Rules call `context.once`.

    Each comes with its block, if that has a model, and True if it stands in a block without one.
    """
    text = context.text
    spots = [(spot, text.read.get(spot.where[:2])) for spot in text.tree.spots] if text else []
    return [
        (leaf, read, read is None and spot.block is not None and spot.where.section >= 0)
        for spot, read in spots
        for leaf in spot.part.leaves
    ]


def data_blocks(context: LintContext) -> list[tuple[ReadBlock, list[Leaf]]]:
    """Return the blocks that have a model, with their lines that have values. Rules call `context.once`."""
    text, source = context.text, context.source.unified
    blocks = [(read, text.tree.sections[i].blocks[j].leaves) for (i, j), read in text.read.items()] if text else []
    return [
        (read, [leaf for leaf in leaves if leaf.kind in _DATA or is_setting(source, leaf, read)])
        for read, leaves in blocks
    ]


def is_setting(source: str, leaf: Leaf, read: ReadBlock) -> bool:
    """Return True if a line is a KEY= that the keyword knows."""
    known = leaf.kind in (LeafKind.SETTING, LeafKind.UNDECIDED)
    return known and first_key(source, leaf.span) in all_keys(type(read.model))


def first_of_lines(pattern: re.Pattern[str], source: str, span: Span) -> Iterator[re.Match[str]]:
    """Yield the first match of a pattern on each line of a span."""
    at = span.start
    while at < span.end and (match := pattern.search(source, at, span.end)):
        yield match
        at = source.find("\n", match.end(), span.end) + 1 or span.end


@rule(STY002)
def lower_case_comment(context: LintContext) -> Iterator[Problem]:
    """A comment begins with a lower-case c.

    The mark of a comment is a capital C in column 1. A lower-case c is accepted here, but stricter programs read the
    line as data. Write a capital C.

    Example on ocean:
         *OCEAN
        -c Depth from the survey
        +C Depth from the survey

    Finds: 3:1
    """
    source = context.source.unified
    for leaf, _, kept in context.once(placed_leaves):
        start = leaf.span.start
        if leaf.kind is LeafKind.COMMENT and source[start] == "c" and not kept:
            mark = Span(start, start + 1)
            repair = Repair("safe", "write a capital C", ((mark, "C"),))
            yield Problem(STY002, "the comment begins with a lower-case c: write a capital C", mark, repair=repair)


@rule(STY008)
def key_like_comment(context: LintContext) -> Iterator[Problem]:
    """A setting such as CURVE= begins in column 1, where a C makes a comment.

    It is read as data here, since its keyword knows the setting. Programs that read any line with a C in column 1 as a
    comment skip it without a warning, and with it the name of a curve or a whole group of values. Put a space in front.

    Example on clay:
        -CURVE=Clay
        + CURVE=Clay

    Finds: 3:1
    """
    source = context.source.unified
    for leaf, read, _ in context.once(placed_leaves):
        start = leaf.span.start
        if read is not None and source[start] in "Cc" and is_setting(source, leaf, read):
            key = first_key(source, leaf.span)
            message = f"{key}= begins with C in column 1, a comment to other programs: put a space before it"
            repair = Repair("safe", "put a space before it", ((Span(start, start), " "),))
            yield Problem(STY008, message, Span(start, source.index("=", start) + 1), repair=repair)


@rule(STY009)
def indented_comment(context: LintContext) -> Iterator[Problem]:
    """A line that looks like a comment is indented, so it is read as data.

    Only a C in column 1 makes a comment; the manual mentions no other (inferred). With a space before it the line is
    read as values of its keyword, as the name of a set for instance, or cannot be read. If it is a comment, remove the
    spaces. Lines of blocks that are passed through unchanged are not checked.

    Example on ocean:
         *OCEAN
        -  C Depth from the survey
        +C Depth from the survey

    Finds: 3:3
    """
    source = context.source.unified
    for leaf, read, kept in context.once(placed_leaves):
        if kept or leaf.kind not in (LeafKind.TEXT, LeafKind.SETTING) or not INDENTED_COMMENT.match(source, *leaf.span):
            continue
        if read is None or not is_setting(source, leaf, read):
            message = "an indented line is data, not a comment: if it is meant as one, put its C in column 1"
            yield Problem(STY009, message, trimmed(source, *leaf.span))


@rule(STY005)
def indented_keyword(context: LintContext) -> Iterator[Problem]:
    """A keyword or a section does not begin in column 1.

    Spaces before the `*` or the `$` are ignored here, but a program that expects the mark in column 1 reads the line as
    data of the block above. Remove the spaces.

    Example on ocean:
        -  *OCEAN
        +*OCEAN

    Finds: 2:3
    """
    source = context.source.unified
    for line in head_lines(context):
        if source[line.start] in " \t":
            head = trimmed(source, *line)
            mark = source[head.start]
            what = "section" if mark == "$" else "keyword"
            message = f"the {what} is indented: put its {mark} in column 1"
            repair = Repair("safe", "remove the indentation", ((Span(line.start, head.start), ""),))
            yield Problem(STY005, message, head, repair=repair)


@rule(STY006)
def keyword_case(context: LintContext) -> Iterator[Problem]:
    """The name of a keyword or a section is not in upper case.

    Case is ignored here. Manuals and other decks write these names in upper case, though, and a search of many decks
    for a keyword may miss others. Write it in upper case.

    Example on ocean:
        -*Ocean
        +*OCEAN

    Finds: 2:1
    """
    source = context.source.unified
    for head in (trimmed(source, *line) for line in head_lines(context) if _SMALL.search(source, *line)):
        written = source[slice(*head)]
        # The text after the name may be a remark.
        if canonical_name(written) in (catalogue.SECTIONS if written[0] == "$" else catalogue.keywords()):
            what = "section" if written[0] == "$" else "keyword"
            repair = Repair("safe", "write it in upper case", ((head, written.translate(_UPPER)),))
            message = f"the {what} is not in upper case: write it in upper case"
            yield Problem(STY006, message, head, repair=repair)


def head_lines(context: LintContext) -> Iterator[Span]:
    """Return every line that begins a section or a keyword."""
    spots = context.text.tree.spots if context.text else ()
    return (spot.part.head.span for spot in spots if spot.part.head)


@rule(STY010)
def unused_suppression(context: LintContext) -> Iterator[Problem]:
    """A suppression comment suppresses nothing.

    It was written for a finding that is no longer there, or names no rule. The next fault of that kind would be hidden
    before anyone has seen it. Only rules that run are judged: with `--ignore CRV005` a comment for CRV005 is not
    unused. The fix removes the code, or the comment when it names nothing else.

    Example on clay:
          0.5, 4200.0
        -C mudline: ignore CRV0O5 -- remoulded, see the survey
        +C mudline: ignore CRV005 -- remoulded, see the survey
        | 0.7, 3900.0
        | 1.0, 6000.0

    Finds: 7:19
    """
    known = context.once(suppressions)
    if known is not None:
        yield from known.unknown()


# --------------------------------------------------------------------------------------- separators, blanks and numbers

_TABS = re.compile(r"\t\t*")  # a pattern that begins with a letter is sought many times as fast
_NUMERALS = r"[-+.0-9][-+.0-9eEdD]*+"
_ROW = rf"{_NUMERALS}[ \t]++{_NUMERALS}[-+.0-9eEdD \t\r]*+(?![^\n])"
_BLANK_SEPARATED = re.compile(rf"^[ \t]*+{_ROW}", re.MULTILINE)
_BEHIND_KEY = re.compile(rf"=[ \t]*+(?={_ROW})")
_GAP = re.compile(r"(?<=[^ \t])(?=[ \t]+[^ \t])")
_TRAILING = re.compile(r"[ \t]++(?=\r?(?:\n|(?![^\n])))")
_SEEN = re.compile(r"[0-9.][dD][-+]?+[0-9]")
_NUMBER = re.compile(r"(?<![^ \t\n,=])[-+]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)[dD][-+]?[0-9]++(?![^ \t\r\n,])")
_TO_E = str.maketrans("dD", "eE")


@rule(STY001)
def tab_character(context: LintContext) -> Iterator[Problem]:
    r"""A data line contains a TAB.

    Programs treat it differently: as one space, as the spaces that an editor shows, as a character of a name, or as an
    error. Write spaces. The fix fills up to the next multiple of 8 columns, and removes TABs at the end of a line; a
    TAB inside a name or an equation is left to you.

    Example on clay:
        - 0.0,\t0.0
        + 0.0, 0.0

    Finds: 4:6
    """
    source = context.source.unified
    for read, leaves in context.once(data_blocks):
        for match in (match for leaf in leaves for match in first_of_lines(_TABS, source, leaf.span)):
            repair = _spread(source, context.source.line_around(match.start()), read)
            yield Problem(STY001, "a TAB in a data line: write spaces", Span(*match.span()), repair=repair)


def _spread(source: str, line: Span, read: ReadBlock) -> Repair | None:
    """Return a repair that replaces tabs by spaces and removes those at the end; None if a tab is inside a value."""
    groups = read_line(source, line, slashes=type(read.model).slashes).groups
    if any(_holds_tab(source, group) for group in groups):
        return None
    body = source[slice(*line)].rstrip("\r")
    inked = len(body.rstrip(" \t"))
    first, last = body.index("\t"), body.rindex("\t") + 1
    start, end = min(first, inked), last if last <= inked else len(body)
    new = body[: min(last, inked)].expandtabs(8)[start:]
    message = "replace it by spaces" if new else "remove it"
    return Repair("safe", message, ((Span(line.start + start, line.start + end), new),))


def _holds_tab(source: str, group: FieldGroup) -> bool:
    """Return True if a tab is part of a value of a group, or of its key."""
    within = any("\t" in field.text for field in group.fields)
    if group.key:
        return within or "\t" in source[group.span.start : source.index("=", group.span.start)].strip()
    return within and not (len(group.fields) == 1 and blank_separated(group.fields[0].text))


@rule(STY004)
def blank_separated_row(context: LintContext) -> Iterator[Problem]:
    """The numbers of a row are separated only by spaces.

    They are read as if there were commas between them. But the language separates fields by commas, and an empty field
    cannot be seen among spaces. Use commas.

    Example on clay:
        - 0.0   0.0
        + 0.0, 0.0

    Finds: 4:2
    """
    source = context.source.unified
    for read, leaves in context.once(data_blocks):
        beside_keys = any(leaf.kind is not LeafKind.RUN and _BEHIND_KEY.search(source, *leaf.span) for leaf in leaves)
        values = set(read.places.spans.values()) if beside_keys else set[Span]()
        rows = ((leaf, row) for leaf in leaves for row in _rows(source, leaf))
        for leaf, row in rows:
            written = source[slice(*row)]
            if blank_separated(written) and (leaf.kind is LeafKind.RUN or row not in values):  # else it is a name
                repair = Repair("safe", "put commas between the numbers", ((row, _GAP.sub(",", written)),))
                message = "the numbers are separated only by spaces: put commas between them"
                yield Problem(STY004, message, row, repair=repair)


def _rows(source: str, leaf: Leaf) -> Iterator[Span]:
    """Yield the lines of a run, or the text after a KEY=, of numbers and spaces only."""
    if leaf.kind is LeafKind.RUN:
        yield from (trimmed(source, *match.span()) for match in first_of_lines(_BLANK_SEPARATED, source, leaf.span))
    elif match := _BEHIND_KEY.search(source, *leaf.span):
        yield trimmed(source, match.end(), leaf.span.end)


@rule(STY007, off=True)
def trailing_blank(context: LintContext) -> Iterator[Problem]:
    """A line ends with spaces or TABs.

    They are invisible, and an editor that removes them changes lines in the history of the deck. Remove them. Lines of
    blocks that are passed through unchanged are not checked. This rule is off unless it is selected.

    Example on ocean:
        -*OCEAN \x20
        +*OCEAN

    Finds: 2:7
    """  # noqa: D301 - a blank that an editor cannot take away
    source = context.source.unified
    for span in sorted(_own_lines(context)):
        for match in first_of_lines(_TRAILING, source, span):
            blanks = Span(*match.span())
            repair = Repair("safe", "remove them", ((blanks, ""),))
            yield Problem(STY007, "spaces or TABs at the end of the line: remove them", blanks, repair=repair)


def _own_lines(context: LintContext) -> Iterator[Span]:
    """Yield all lines except the data of blocks without a model, and data outside of blocks."""
    yield from head_lines(context)
    for leaf, read, kept in context.once(placed_leaves):
        if not kept and (read is not None or leaf.kind in (LeafKind.COMMENT, LeafKind.BLANK)):
            yield leaf.span


@rule(STY003)
def fortran_exponent(context: LintContext) -> Iterator[Problem]:
    """A number has the exponent D of Fortran's double precision.

    It is read as E here, but the language has only E, and other programs stop at the D or read the number without its
    exponent. Write E. A name such as `2D4` is not reported.

    Example on seabed:
        - STIFFNESS=5.0D4
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    source = context.source.unified
    for read, leaves in context.once(data_blocks):
        lettered = (leaf.span for leaf in leaves for letter in "dD" if source.find(letter, *leaf.span) >= 0)
        if not any(_SEEN.search(source, *span) for span in lettered):
            continue
        tables = {run.start for runs in read.places.runs.values() for _, run in runs}
        paths = {span: path for path, span in read.places.spans.items()}
        matches = ((leaf, match) for leaf in leaves for match in first_of_lines(_SEEN, source, leaf.span))
        for leaf, match in matches:
            line = context.source.line_around(match.start())
            if leaf.span.start in tables or line.start in tables:
                fields = row_fields(source, line, MOST_COLUMNS)
                numbers = [field.span for field in fields if _NUMBER.fullmatch(field.text)]
            else:
                spans = (Span(*match.span()) for match in _NUMBER.finditer(source, *line))
                values = ((span, read.model.at(paths[span])[1]) for span in spans if span in paths)
                numbers = [span for span, value in values if isinstance(value, int | float)]
            if numbers:
                new = [source[slice(*span)].translate(_TO_E) for span in numbers]
                more = f" (and {len(numbers) - 1} more on this line)" if len(numbers) > 1 else ""
                message = f"the exponent D is Fortran's: write {new[0]}{more}"
                repair = Repair("safe", "write E", tuple(zip(numbers, new, strict=True)))
                yield Problem(STY003, message, numbers[0], repair=repair)
