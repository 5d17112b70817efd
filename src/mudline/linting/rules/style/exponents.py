"""Numbers as Fortran writes them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.keywords.model import Part, layout
from mudline.keywords.places import Path
from mudline.keywords.reader import ReadBlock
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.style.lines import data_leaves, first_of_lines, first_told, line_around
from mudline.syntax.rows import row_fields

STY003 = Code("STY003", "fortran-exponent", Severity.WARNING)

_EXPONENT = r"(?<=[0-9.]{0})[-+]?+[0-9]"
_GATES = (re.compile("D" + _EXPONENT.format("D")), re.compile("d" + _EXPONENT.format("d")))
"""Two patterns that begin with one letter each: these are found many times as fast as one with either."""

_SEEN = re.compile(r"[0-9.][dD][-+]?+[0-9]")
_NUMBER = re.compile(r"(?<![^ \t\n,=])[-+]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)[dD][-+]?[0-9]++(?![^ \t\r\n,])")
_MOST_COLUMNS = 64
_TO_E = str.maketrans("dD", "eE")


@rule(STY003)
def fortran_exponent(context: LintContext) -> Iterator[Problem]:
    """A number has the exponent D of Fortran's double precision.

    It is read as E here, but the language knows E alone, and a reader in another programming language stops at the D or
    reads the number without its exponent. Write E. A name such as `2D4` is none of this.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
        - STIFFNESS=5.0D4
        + STIFFNESS=5.0E4

    Finds: 5:12
    """
    if context.text and any(gate.search(context.text.source.unified) for gate in _GATES):
        yield from first_told(_exponents(context.text))


def _exponents(text: TextOrigin) -> Iterator[Problem]:
    source = text.source.unified
    numbers = _Numbers()
    for leaf, read in data_leaves(text):
        for match in first_of_lines(_SEEN, source, leaf.span):
            line = line_around(source, match.start())
            if found := numbers.of_line(source, leaf.span, line, read):
                yield _problem(source, found)


def _problem(source: str, found: list[Span]) -> Problem:
    """One finding for the numbers of a line, at the first of them."""
    new = [source[slice(*span)].translate(_TO_E) for span in found]
    more = f" (and {len(found) - 1} more on this line)" if len(found) > 1 else ""
    message = f"the exponent D is Fortran's: write {new[0]}{more}"
    repair = Repair("safe", "write E", tuple(zip(found, new, strict=True)))
    return Problem(STY003, message, found[0], repair=repair)


class _Numbers:
    """Tells the numbers of a block from its names; what is known of the block asked for last is kept."""

    def __init__(self) -> None:
        self.read: ReadBlock | None = None
        self.tables: set[int] = set()
        self.paths: dict[Span, Path] = {}

    def of_line(self, source: str, leaf: Span, line: Span, read: ReadBlock) -> list[Span]:
        """The numbers with a D on a line."""
        if read is not self.read:
            self.read = read
            self.tables = {run.start for runs in read.places.runs.values() for _, run in runs}
            self.paths = {span: path for path, span in read.places.spans.items()}
        if leaf.start in self.tables or line.start in self.tables:
            fields = row_fields(source, line, _MOST_COLUMNS)
            return [field.span for field in fields if _NUMBER.fullmatch(field.text)]
        spans = (Span(*match.span()) for match in _NUMBER.finditer(source, *line))
        return [span for span in spans if span in self.paths and _is_number(read.model, self.paths[span])]


def _is_number(part: Part, path: Path) -> bool:
    """Whether a number was read at a path of a block."""
    at: object = part
    for step in path:
        at = _inner(at, step)
    return isinstance(at, int | float)


def _inner(at: object, step: str | int) -> object:
    """What stands at one step of a path; None where reading found nothing."""
    if isinstance(at, list) and isinstance(step, int):
        return at[step] if step < len(at) else None
    if not isinstance(at, Part):
        return None
    found = layout(type(at))
    slots = found.columns[step : step + 1] if isinstance(step, int) else [s for s in found.slots if s.json == step]
    return getattr(at, slots[0].name, None) if slots else None
