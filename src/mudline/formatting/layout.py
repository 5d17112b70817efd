"""The canonical layout of a keyword text, as edits."""

from __future__ import annotations

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Span
from mudline.formatting.blocks import block_lines, comment_line
from mudline.keywords.reader import ReadBlock
from mudline.syntax.edits import TextEdit
from mudline.syntax.source import CONTROLS, END_MARK
from mudline.syntax.tree import Kind, Leaf, RawBlock

_LINE_ENDS = ("\n", "\r\n", "\r")


def layout_edits(origin: TextOrigin) -> list[TextEdit]:
    """What has to change in a text that was read without an error, so that it has the canonical layout.

    The texts of the edits have the line end that prevails in the file.
    """
    return _Layout(origin).edits()


def line_ends(text: str) -> dict[str, int]:
    """How often a text has each kind of line end that it has, the commonest first."""
    crlf = text.count("\r\n")
    counts = dict(zip(_LINE_ENDS, (text.count("\n") - crlf, crlf, text.count("\r") - crlf), strict=True))
    return {end: count for end, count in sorted(counts.items(), key=lambda item: -item[1]) if count}


class _Layout:
    def __init__(self, origin: TextOrigin) -> None:
        self.origin = origin
        self.source = origin.source
        self.text = self.source.unified
        ends = line_ends(self.source.text)
        self.end = next(iter(ends), "\n")
        self.mixed = len(ends) > 1
        self.found: list[TextEdit] = []
        self.blanks: list[Span] = []

    def edits(self) -> list[TextEdit]:
        """All edits, in no order."""
        tree = self.origin.tree
        self._stray(tree.preamble.leaves)
        for index, section in enumerate(tree.sections):
            if section.head:
                self._head("$" + section.name, section.head)
            self._stray(section.leaves)
            for number, block in enumerate(section.blocks):
                self._head("*" + block.name, block.head)
                read = self.origin.read.get((index, number))
                if read is None:
                    self._kept(block.leaves)
                else:
                    self._block(block, read)
        for span in self.blanks:
            self._put(span, self._marks(span))
        return self.found

    def _marks(self, span: Span) -> str:
        """The end-of-file marks of old systems among blanks, which are no business of a layout."""
        return "".join(char for char in self.source.text[slice(*span)] if char == END_MARK)

    def _put(self, span: Span, lines: str) -> None:
        """Put lines, each with a LF, in the place of those of a span."""
        new = lines if self.end == "\n" else lines.replace("\n", self.end)
        if self.source.text[slice(*span)] != new:
            self.found.append(TextEdit(span, new))

    def _blank(self, leaf: Leaf) -> None:
        """Blank lines: whether one of them stays, the next line that is none decides."""
        self.blanks.append(leaf.span)

    def _go_on(self) -> None:
        """A line that is not blank follows: of the blank ones before it one stays."""
        for index, span in enumerate(self.blanks):
            self._put(span, "" if index else "\n")
        self.blanks.clear()

    def _head(self, canonical: str, leaf: Leaf) -> None:
        """A `$` or `*` line. Other letters than ASCII stay as they are where bytes would get another meaning."""
        self._go_on()
        written = self.text[slice(*leaf.span)].strip(" \t\r\n")
        known = written.isascii() or self.source.encoding == "utf-8"
        before = self.source.text[slice(*leaf.span)].partition(canonical[0])[0]
        controls = "".join(char for char in before if char in CONTROLS)
        self._put(leaf.span, f"{controls}{canonical if known else written}\n")

    def _kept(self, leaves: list[Leaf]) -> None:
        """Lines that stay as they are, but for their line ends."""
        for leaf in leaves:
            self._go_on()
            if self.mixed or leaf.span.end == len(self.text):
                if marks := self._marks(leaf.span):
                    self._put(leaf.span, marks)
                    continue
                lines = self.text[slice(*leaf.span)].replace("\r\n", "\n")
                self._put(leaf.span, lines if lines.endswith("\n") else lines + "\n")

    def _stray(self, leaves: list[Leaf]) -> None:
        """Lines under no keyword."""
        for leaf in leaves:
            if leaf.kind is Kind.BLANK:
                self._blank(leaf)
            elif leaf.kind is Kind.COMMENT:
                self._go_on()
                self._put(leaf.span, comment_line(self.text, leaf.span))
            else:
                self._kept([leaf])

    def _block(self, raw: RawBlock, read: ReadBlock) -> None:
        """A block with a model."""
        for leaf in raw.leaves:
            if leaf.kind is Kind.BLANK:
                self._blank(leaf)
            else:
                self._go_on()
        for span, lines in block_lines(self.text, raw, read):
            self._put(span, lines)
