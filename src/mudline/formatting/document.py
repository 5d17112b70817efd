"""A whole file in canonical form; nothing is returned that would mean something else."""

from __future__ import annotations

from typing import cast

from mudline.deck.loading import dump, form_of, load_bytes
from mudline.deck.model import Deck, Section
from mudline.deck.reading import TextOrigin, read_source
from mudline.diagnostics import Span
from mudline.formatting.blocks import block_lines, comment_line
from mudline.keywords.model import Comment, Part
from mudline.keywords.reader import ReadBlock
from mudline.syntax.edits import TextEdit, apply_edits
from mudline.syntax.source import CONTROLS, END_MARK, Source
from mudline.syntax.tree import Kind, Leaf, RawBlock

_LINE_ENDS = ("\n", "\r\n", "\r")


def layout_edits(origin: TextOrigin) -> list[TextEdit]:
    """The edits that give a text that was read without an error the canonical layout.

    The texts of the edits have the most frequent line end of the file.
    """
    return _Layout(origin).edits()


def line_ends(text: str) -> dict[str, int]:
    """Count each kind of line end in a text, the most frequent first."""
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
        """The end-of-file marks of old systems among blanks, which formatting leaves unchanged."""
        return "".join(char for char in self.source.text[slice(*span)] if char == END_MARK)

    def _put(self, span: Span, lines: str) -> None:
        """Put lines, each with a LF, in the place of those of a span."""
        new = lines if self.end == "\n" else lines.replace("\n", self.end)
        if self.source.text[slice(*span)] != new:
            self.found.append(TextEdit(span, new))

    def _end_blanks(self) -> None:
        """Keep one of the blank lines before a line that is not blank."""
        for index, span in enumerate(self.blanks):
            self._put(span, "" if index else "\n")
        self.blanks.clear()

    def _head(self, canonical: str, leaf: Leaf) -> None:
        """A `$` or `*` line. Non-ASCII letters stay unchanged where changing their case could change their bytes."""
        self._end_blanks()
        written = self.text[slice(*leaf.span)].strip(" \t\r\n")
        known = written.isascii() or self.source.encoding == "utf-8"
        before = self.source.text[slice(*leaf.span)].partition(canonical[0])[0]
        controls = "".join(char for char in before if char in CONTROLS)
        self._put(leaf.span, f"{controls}{canonical if known else written}\n")

    def _kept(self, leaves: list[Leaf]) -> None:
        """Lines that stay unchanged, except for their line ends."""
        for leaf in leaves:
            self._end_blanks()
            if self.mixed or leaf.span.end == len(self.text):
                if marks := self._marks(leaf.span):
                    self._put(leaf.span, marks)
                    continue
                lines = self.text[slice(*leaf.span)].replace("\r\n", "\n")
                self._put(leaf.span, lines if lines.endswith("\n") else lines + "\n")

    def _stray(self, leaves: list[Leaf]) -> None:
        """Lines that belong to no keyword."""
        for leaf in leaves:
            if leaf.kind is Kind.BLANK:
                self.blanks.append(leaf.span)
            elif leaf.kind is Kind.COMMENT:
                self._end_blanks()
                self._put(leaf.span, comment_line(self.text, leaf.span))
            else:
                self._kept([leaf])

    def _block(self, raw: RawBlock, read: ReadBlock) -> None:
        """A block with a model."""
        for leaf in raw.leaves:
            if leaf.kind is Kind.BLANK:
                self.blanks.append(leaf.span)
            else:
                self._end_blanks()
        for span, lines in block_lines(self.text, raw, read):
            self._put(span, lines)


def same_meaning(one: Deck, other: Deck) -> bool:
    """Whether sections, blocks, values, comments and lines that are not read are equal.

    Blanks at the end of a comment and blank lines before the first section are ignored.
    """
    return (
        one.units == other.units
        and _preamble(one) == _preamble(other)
        and _same(one.comments, other.comments)
        and _same(one.sections, other.sections)
    )


def _preamble(deck: Deck) -> list[str]:
    lines = (line.rstrip(" \t") for line in deck.preamble)
    return [line for line in lines if line]


def _same(one: object, other: object) -> bool:
    if type(one) is not type(other):
        return False
    if isinstance(one, Comment) and isinstance(other, Comment):
        return one.before == other.before and one.text.rstrip(" \t") == other.text.rstrip(" \t")
    if isinstance(one, Section) and isinstance(other, Section):
        same = one.name == other.name and one.lines == other.lines
        return same and _same(one.comments, other.comments) and _same(one.blocks, other.blocks)
    if isinstance(one, Part) and isinstance(other, Part):
        names = type(one).model_fields
        return all(_same(getattr(one, name), getattr(other, name)) for name in names)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_same, one, other))
    return bool(one == other)


_ALTERED = "formatting would change its meaning, so it is left unchanged: please report this fault of mudline"
_REMARKS = "its YAML comments (#) would be lost, so it is left unchanged: remove them to format it"


class FormatError(Exception):
    """A file without an error that formatting leaves unchanged; the message says why."""


def formatted(data: bytes, name: str) -> bytes:
    """The content of a deck file in canonical form; the suffix of `name` selects keyword text, JSON or YAML.

    A keyword text keeps its encoding and its most frequent line end; a deck in JSON or YAML becomes what `dump` writes.
    Raises DeckError for a deck that has an error, and FormatError where something would be lost or changed.
    """
    form = form_of(name)
    if form != "keyword":
        return _document(data, name, form)
    source = Source.from_bytes(data, name)
    deck = read_source(source).require()
    edits = layout_edits(cast("TextOrigin", deck.origin))
    if not edits:
        return data
    after = source.to_bytes(apply_edits(source.text, edits))
    return _checked(deck, after, read_source(Source.from_bytes(after, name)))


def _document(data: bytes, name: str, form: str) -> bytes:
    deck = load_bytes(data, name).require()
    after = dump(deck, form).encode()
    if data.count(b"#") != after.count(b"#") and form == "yaml":  # those of the deck's texts are written again
        raise FormatError(_REMARKS)
    return _checked(deck, after, load_bytes(after, name))


def _checked(deck: Deck, after: bytes, again: Deck) -> bytes:
    """The new content, if it gives the same deck with the same findings."""
    findings = [[problem.code for problem in read.problems] for read in (deck, again)]
    if findings[0] != findings[1] or not same_meaning(deck, again):
        raise FormatError(_ALTERED)
    return after
