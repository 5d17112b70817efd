"""Blanks, tabs and exponents."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.basics.limits import MOST_COLUMNS
from mudline.checks.rules.style_lines import (
    data_leaves,
    first_of_lines,
    head_lines,
    line_around,
    placed_leaves,
    rule_of_text,
)
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.language.keywords.model import Path
from mudline.language.keywords.reader import ReadBlock
from mudline.language.syntax.fields import FieldGroup, read_line, trimmed
from mudline.language.syntax.rows import blank_separated, row_fields
from mudline.language.syntax.tree import Kind, Leaf

STY001 = Code("STY001", "tab-character", Severity.INFO)
STY003 = Code("STY003", "fortran-exponent", Severity.WARNING)
STY004 = Code("STY004", "blank-separated", Severity.INFO)
STY007 = Code("STY007", "trailing-blank", Severity.INFO)

_TAB_WIDTH = 8
_TABS = re.compile(r"\t+")
_NUMERALS = r"[-+.0-9][-+.0-9eEdD]*+"
_ROW = rf"{_NUMERALS}[ \t]++{_NUMERALS}[-+.0-9eEdD \t\r]*+(?![^\n])"
_BLANK_SEPARATED = re.compile(rf"^[ \t]*+{_ROW}", re.MULTILINE)
_GATE = re.compile(rf"\n[ \t]*+{_ROW}")
_BEHIND_KEY = re.compile(rf"=[ \t]*+(?={_ROW})")
_GAP = re.compile(r"(?<=[^ \t])(?=[ \t]+[^ \t])")
_TRAILING = re.compile(r"[ \t]++(?=\r?(?:\n|(?![^\n])))")
_ENDINGS = (" \n", "\t\n", " \r", "\t\r")

_EXPONENT = r"(?<=[0-9.]{0})[-+]?+[0-9]"
_GATES = (re.compile("D" + _EXPONENT.format("D")), re.compile("d" + _EXPONENT.format("d")))
"""Two patterns that begin with one letter each: the search is many times as fast as for both letters in one pattern."""

_SEEN = re.compile(r"[0-9.][dD][-+]?+[0-9]")
_NUMBER = re.compile(r"(?<![^ \t\n,=])[-+]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)[dD][-+]?[0-9]++(?![^ \t\r\n,])")
_TO_E = str.maketrans("dD", "eE")


@rule_of_text(STY001, lambda source: "\t" in source)
def tab_character(text: TextOrigin, source: str) -> Iterator[Problem]:
    r"""A data line contains a TAB.

    Programs treat it differently: as one space, as the spaces that an editor shows, as a character of a name, or as an
    error. Write spaces. The fix fills up to the next multiple of 8 columns, and removes TABs at the end of a line; a
    TAB inside a name or an equation is left to you.

    Example on clay:
        - 0.0,\t0.0
        + 0.0, 0.0

    Finds: 4:6
    """
    for leaf, read in data_leaves(text):
        for match in first_of_lines(_TABS, source, leaf.span):
            line = line_around(source, match.start())
            yield Problem(
                STY001, "a TAB in a data line: write spaces", Span(*match.span()), repair=_spread(source, line, read)
            )


def _spread(source: str, line: Span, read: ReadBlock) -> Repair | None:
    """Return a repair that replaces tabs by spaces and removes those at the end; None if a tab is inside a value."""
    groups = read_line(source, line, slashes=type(read.model).slashes).groups
    if any(_holds_tab(source, group) for group in groups):
        return None
    body = source[slice(*line)].rstrip("\r")
    inked = len(body.rstrip(" \t"))
    first, last = body.index("\t"), body.rindex("\t") + 1
    start, end = min(first, inked), last if last <= inked else len(body)
    new = body[: min(last, inked)].expandtabs(_TAB_WIDTH)[start:]
    message = "replace it by spaces" if new else "remove it"
    return Repair("safe", message, ((Span(line.start + start, line.start + end), new),))


def _holds_tab(source: str, group: FieldGroup) -> bool:
    """Return True if a tab is part of a value of a group, or of its key."""
    within = any("\t" in field.text for field in group.fields)
    if group.key:
        return within or "\t" in source[group.span.start : source.index("=", group.span.start)].strip()
    return within and not (len(group.fields) == 1 and blank_separated(group.fields[0].text))


@rule_of_text(STY004, lambda source: _GATE.search(source) or _BEHIND_KEY.search(source))
def blank_separated_row(text: TextOrigin, source: str) -> Iterator[Problem]:
    """The numbers of a row are separated only by spaces.

    They are read as if there were commas between them. But the language separates fields by commas, and an empty field
    cannot be seen among spaces. Use commas.

    Example on clay:
        - 0.0   0.0
        + 0.0, 0.0

    Finds: 4:2
    """
    last: ReadBlock | None = None
    values: set[Span] = set()
    for leaf, read in data_leaves(text):
        if read is not last:
            last, values = read, set(read.places.spans.values())
        for row in _rows(source, leaf, values):
            written = source[slice(*row)]
            if blank_separated(written):
                repair = Repair("safe", "put commas between the numbers", ((row, _GAP.sub(",", written)),))
                message = "the numbers are separated only by spaces: put commas between them"
                yield Problem(STY004, message, row, repair=repair)


def _rows(source: str, leaf: Leaf, values: set[Span]) -> Iterator[Span]:
    """Yield the lines of a run, or the text after a KEY=, of numbers and spaces only; a single value is a name."""
    if leaf.kind is Kind.RUN:
        yield from (trimmed(source, *match.span()) for match in first_of_lines(_BLANK_SEPARATED, source, leaf.span))
    elif match := _BEHIND_KEY.search(source, *leaf.span):
        row = trimmed(source, match.end(), leaf.span.end)
        if row not in values:
            yield row


@rule_of_text(
    STY007, lambda source: any(blank in source for blank in _ENDINGS) or source.endswith((" ", "\t")), off=True
)
def trailing_blank(text: TextOrigin, source: str) -> Iterator[Problem]:
    """A line ends with spaces or TABs.

    They are invisible, and an editor that removes them changes lines in the history of the deck. Remove them. Lines of
    blocks that are passed through unchanged are not checked. This rule is off unless it is selected.

    Example on ocean:
        -*OCEAN \x20
        +*OCEAN

    Finds: 2:7
    """  # noqa: D301 - a blank that an editor cannot take away
    for span in sorted(_own_lines(text)):
        for match in first_of_lines(_TRAILING, source, span):
            blanks = Span(*match.span())
            repair = Repair("safe", "remove them", ((blanks, ""),))
            yield Problem(STY007, "spaces or TABs at the end of the line: remove them", blanks, repair=repair)


def _own_lines(text: TextOrigin) -> Iterator[Span]:
    """Yield all lines except the data of blocks without a model, and data outside of blocks."""
    yield from head_lines(text)
    for leaf, read, kept in placed_leaves(text):
        if not kept and (read is not None or leaf.kind in (Kind.COMMENT, Kind.BLANK)):
            yield leaf.span


@rule_of_text(STY003, lambda source: _GATES[0].search(source) or _GATES[1].search(source))
def fortran_exponent(text: TextOrigin, source: str) -> Iterator[Problem]:
    """A number has the exponent D of Fortran's double precision.

    It is read as E here, but the language has only E, and other programs stop at the D or read the number without its
    exponent. Write E. A name such as `2D4` is not reported.

    Example on seabed:
        - STIFFNESS=5.0D4
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    numbers = _NumberFinder()
    for leaf, read in data_leaves(text):
        for match in first_of_lines(_SEEN, source, leaf.span):
            line = line_around(source, match.start())
            if spans := numbers.of_line(source, leaf.span, line, read):
                yield _problem(source, spans)


def _problem(source: str, numbers: list[Span]) -> Problem:
    """Return one problem for the numbers of a line, at the first of them."""
    new = [source[slice(*span)].translate(_TO_E) for span in numbers]
    more = f" (and {len(numbers) - 1} more on this line)" if len(numbers) > 1 else ""
    message = f"the exponent D is Fortran's: write {new[0]}{more}"
    repair = Repair("safe", "write E", tuple(zip(numbers, new, strict=True)))
    return Problem(STY003, message, numbers[0], repair=repair)


class _NumberFinder:
    """Finder of numbers among the values of a block; its knowledge of the last block is remembered."""

    def __init__(self) -> None:
        self.read: ReadBlock | None = None
        self.tables: set[int] = set()
        self.paths: dict[Span, Path] = {}

    def of_line(self, source: str, leaf: Span, line: Span, read: ReadBlock) -> list[Span]:
        """Return the numbers with a D on a line."""
        if read is not self.read:
            self.read = read
            self.tables = {run.start for runs in read.places.runs.values() for _, run in runs}
            self.paths = {span: path for path, span in read.places.spans.items()}
        if leaf.start in self.tables or line.start in self.tables:
            fields = row_fields(source, line, MOST_COLUMNS)
            return [field.span for field in fields if _NUMBER.fullmatch(field.text)]
        spans = (Span(*match.span()) for match in _NUMBER.finditer(source, *line))
        values = ((span, read.model.at(self.paths[span])[1]) for span in spans if span in self.paths)
        return [span for span, value in values if isinstance(value, int | float)]
