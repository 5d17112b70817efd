"""The leaves of a block to what its grammar knows: settings by their KEY, rows, and comments aside."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from mudline.codes import SYN004, SYN013
from mudline.diagnostics import Problem, Span
from mudline.keywords.findings import Findings
from mudline.keywords.formats import all_keys
from mudline.keywords.grammar import Content
from mudline.keywords.model import Block
from mudline.keywords.text import either, shown, suggested, suggestion
from mudline.syntax.fields import first_key, trimmed
from mudline.syntax.rows import line_spans
from mudline.syntax.tree import Kind, Leaf


class CommentLine(NamedTuple):
    """A comment: its position among the block's leaves, and what follows the C."""

    position: int
    text: str


@dataclass(slots=True)
class Contents:
    """The lines of one block, sorted out. `dropped` holds the positions of those left out."""

    text: str
    declared: type[Block]
    findings: Findings
    lines: list[Content] = field(default_factory=list)
    comments: list[CommentLine] = field(default_factory=list)
    dropped: list[int] = field(default_factory=list)

    def read(self, leaves: list[Leaf]) -> None:
        """Sort out all leaves."""
        for position, leaf in enumerate(leaves):
            match leaf.kind:
                case Kind.COMMENT:
                    self._comment(position, leaf)
                case Kind.UNDECIDED:
                    self._undecided(position, leaf)
                case Kind.SETTING:
                    self._setting(position, leaf.span)
                case Kind.RUN | Kind.TEXT:
                    self._rows(position, leaf)
                case _:
                    pass

    def _comment(self, position: int, leaf: Leaf) -> None:
        self.comments.append(CommentLine(position, line_text(self.text, leaf.span)[1:]))

    def _undecided(self, position: int, leaf: Leaf) -> None:
        """A line with C and a letter in column 1: a known key makes it data, else it is a comment, with a warning."""
        key = first_key(self.text, leaf.span)
        keys = all_keys(self.declared)
        if key in keys:
            self._setting(position, leaf.span)
            return
        self.findings.tell(ambiguous_comment(self.text, leaf.span, suggestion(key, keys)))
        self._comment(position, leaf)

    def _setting(self, position: int, span: Span) -> None:
        """A setting; one that is not known is taken for the one it resembles, or left out."""
        keys = all_keys(self.declared)
        key = first_key(self.text, span)
        meant = key if key in keys else suggested(key, keys)
        if meant != key:
            self.findings.lose(self._unknown(key, meant, span))
        if meant:
            self.lines.append(Content(meant, span, position))
        else:
            self.dropped.append(position)

    def _unknown(self, key: str, meant: str, span: Span) -> Problem:
        keys = sorted(all_keys(self.declared))
        allowed = either(f"{name}=" for name in keys) if keys else "no KEY= at all"
        body = trimmed(self.text, *span)
        end = self.text.find("=", body.start, body.end)
        guess = f" (did you mean {meant}=?)" if meant else ""
        message = f"no setting {shown(key)} in this keyword{guess}: it takes {allowed}"
        return Problem(SYN004, message, Span(body.start, end + 1))

    def _rows(self, position: int, leaf: Leaf) -> None:
        """Rows one by one; a tabular keyword takes what stands together as one run."""
        text = leaf.kind is Kind.TEXT
        if not self.declared.tabular:
            self.lines += [Content("", line, position, text) for line in line_spans(self.text, leaf.span)]
            return
        before = self.lines[-1] if self.lines else None
        if before and not before.key and before.span.end == leaf.span.start:
            self.lines[-1] = before._replace(span=Span(before.span.start, leaf.span.end), text=before.text and text)
        else:
            self.lines.append(Content("", leaf.span, position, text))


def line_text(text: str, span: Span) -> str:
    """A line without its end."""
    return text[slice(*span)].rstrip("\r\n")


def ambiguous_comment(text: str, span: Span, guess: str = "") -> Problem:
    """The finding about a line that begins with C and a letter."""
    message = (
        f"{shown(line_text(text, span))} begins with C in column 1 and is read as a comment (inferred){guess}: "
        "put a blank after the C, or indent the line if it is data"
    )
    return Problem(SYN013, message, trimmed(text, *span))
