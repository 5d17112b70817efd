"""Canonical form of a whole file, returned only if it has the same meaning."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from typing import cast

from mudline.editing.formatting.rows import AlignedRows, RowKind, cut
from mudline.language.codes.fields import SYN015
from mudline.language.codes.lines import SYN014
from mudline.language.deck.forms import form_of
from mudline.language.deck.keyword_text import same_meaning
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import Span
from mudline.language.keywords.model import FieldSpec, Path, Record, Row, record_schema
from mudline.language.keywords.reader import ReadBlock, all_keys
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Kind
from mudline.language.syntax.edits import TextEdit, apply_edits
from mudline.language.syntax.fields import FieldGroup, read_line, split
from mudline.language.syntax.rows import blank_separated, line_spans
from mudline.language.syntax.source import CONTROLS, END_MARK, Source
from mudline.language.syntax.tree import Leaf, LeafKind, RawBlock, is_data

_CUT_OFF = "the file ends right after a keyword and seems to be cut off: add what is missing, or a line end"
_COMMAS = "a number seems to have a decimal comma, which a blank after it would hide: correct it first (SYN015)"
_ALTERED = "formatting would change its meaning, so it is left unchanged: please report this fault of mudline"
_REMARKS = "its YAML comments (#) would be lost, so it is left unchanged: remove them to format it"


class FormatError(ValueError):
    """Reason why a file without an error is left unchanged by formatting."""


def formatted(data: bytes, name: str) -> bytes:
    """Return the content of a deck file in canonical form, as keyword text, JSON or YAML by the suffix of `name`.

    A keyword text keeps its encoding and its most frequent line end; a deck in JSON or YAML becomes the text of `dump`.
    Raises DeckError for a deck with an error, and FormatError if something would be lost or changed.
    """
    form = form_of(name)
    if form != "keyword":
        return _document(data, name, form)
    source = Source.from_bytes(data, name)
    deck = read_source(source).require()
    for code, why in ((SYN014, _CUT_OFF), (SYN015, _COMMAS)):
        if any(problem.code is code for problem in deck.problems):
            raise FormatError(why)
    mark = source.text.find(END_MARK, len(source.text.rstrip(f"{END_MARK} \t\r\n")))
    if mark >= 0:  # end-of-file marks of old systems stay at the end
        laid_out = Source.from_bytes(formatted(source.to_bytes(source.text[:mark]), name), name)
        return source.to_bytes(laid_out.text + END_MARK * source.text.count(END_MARK, mark))
    text = apply_edits(source.text, _DocumentLayout(cast("TextOrigin", deck.origin)).edits())
    after = source.to_bytes(_with_one_line_end(text, source.text))
    del text  # as much memory as the file
    return data if after == data else _checked(deck, after, read_source(Source.from_bytes(after, name)))


def _document(data: bytes, name: str, form: str) -> bytes:
    deck = load_bytes(data, name).require()
    after = dump(deck, form).encode()
    if data.count(b"#") != after.count(b"#") and form == "yaml":  # "#" in texts of the deck is written again
        raise FormatError(_REMARKS)
    return _checked(deck, after, load_bytes(after, name))


def _checked(deck: Deck, after: bytes, again: Deck) -> bytes:
    """Return the new content if it gives the same deck with the same findings; raises FormatError otherwise."""
    findings = [[problem.code for problem in read.problems] for read in (deck, again)]
    if findings[0] != findings[1] or not same_meaning(deck, again):
        raise FormatError(_ALTERED)
    return after


# -------------------------------------------------------------------------------------------------- the lines of a file

_CR = re.compile("\r\n?")


def _with_one_line_end(text: str, given: str) -> str:
    """Return a text with the line end that is most frequent in a given text."""
    if "\r" not in given:
        return text
    crlf = given.count("\r\n")
    counts = {"\n": given.count("\n") - crlf, "\r\n": crlf, "\r": given.count("\r") - crlf}
    return _CR.sub("\n", text).replace("\n", max(counts, key=lambda end: counts[end]))


class _DocumentLayout:
    """Edits that give a text, read without an error, the canonical layout, with LF in new lines."""

    def __init__(self, origin: TextOrigin) -> None:
        self.origin = origin
        self.source = origin.source
        self.text = self.source.unified
        self.collected: list[TextEdit] = []
        self.blanks: list[Span] = []

    def edits(self) -> list[TextEdit]:
        """Return all edits, in any order."""
        for where, section, block, _ in self.origin.tree.spots:
            if block is None:
                if section.head:
                    self._head("$" + section.name, section.head)
                self._stray(section.leaves)
                continue
            self._head("*" + block.name, block.head)
            if read := self.origin.read.get(where[:2]):
                self._block(block, read)
            else:
                self._kept(block.leaves)
        for span in self.blanks:
            self._put(span, "")
        return self.collected

    def _put(self, span: Span, lines: str) -> None:
        """Replace the lines of a span by lines that end with LF."""
        if self.text[slice(*span)].replace("\r\n", "\n") != lines:
            self.collected.append(TextEdit(span, lines))

    def _end_blanks(self) -> None:
        """Keep one of the blank lines before a line that is not blank."""
        for index, span in enumerate(self.blanks):
            self._put(span, "" if index else "\n")
        self.blanks.clear()

    def _head(self, canonical: str, leaf: Leaf) -> None:
        """Replace a `$` or `*` line; non-ASCII letters are unchanged where a change of case may change their bytes."""
        self._end_blanks()
        written = self.text[slice(*leaf.span)].strip(" \t\r\n")
        known = written.isascii() or self.source.encoding == "utf-8"
        before = self.source.text[slice(*leaf.span)].partition(canonical[0])[0]
        controls = "".join(char for char in before if char in CONTROLS)
        self._put(leaf.span, f"{controls}{canonical if known else written}\n")

    def _kept(self, leaves: list[Leaf]) -> None:
        """Leave lines unchanged; the last line of the file gets a line end."""
        for leaf in leaves:
            self._end_blanks()
            if leaf.span.end == len(self.text):
                self._put(leaf.span, self.text[slice(*leaf.span)].removesuffix("\n") + "\n")

    def _stray(self, leaves: list[Leaf]) -> None:
        """Lay out lines that belong to no keyword."""
        for leaf in leaves:
            if leaf.kind is LeafKind.BLANK:
                self.blanks.append(leaf.span)
            elif leaf.kind is LeafKind.COMMENT:
                self._end_blanks()
                self._put(leaf.span, comment_line(self.text, leaf.span))
            else:
                self._kept([leaf])

    def _block(self, raw: RawBlock, read: ReadBlock) -> None:
        """Lay out a block with a model."""
        for leaf in raw.leaves:
            if leaf.kind is LeafKind.BLANK:
                self.blanks.append(leaf.span)
            else:
                self._end_blanks()
        block = _BlockLayout(self.text, read)
        for span, lines in chain(chain.from_iterable(map(block.lines, raw.leaves)), block.flush()):
            self._put(span, lines)


# ------------------------------------------------------------------------------------------------- the lines of a block

_BLANKS = re.compile(r"[ \t]*")


Laid = tuple[Span, str]
"""Lines, each with a LF, and the span that they replace."""


def comment_line(text: str, span: Span) -> str:
    """Return a comment without trailing blanks."""
    return text[slice(*span)].rstrip(" \t\r\n") + "\n"


class _BlockLayout:
    """Layout of the lines of a block except its head and its blank lines.

    Attributes:
        kinds: kind of the row, or of the values of a KEY=, by the offset of its first character.
        choices: known choices by offset.
        whole: unknown choices by offset, which may contain commas.
        kept: offsets of lines that are not read.
    """

    def __init__(self, text: str, read: ReadBlock) -> None:
        self.text, self.places = text, read.places
        self.declared = type(read.model)
        self.keys = all_keys(self.declared)
        self.kinds: dict[int, RowKind] = {}
        self.choices: dict[int, str] = {}
        self.whole: dict[int, str] = {}
        self.kept = read.places.kept_starts
        self.rows: AlignedRows | None = None
        self._rows_of(read.model, ())
        for path, slot, value in read.model.walk():
            self._value(path, slot, value)

    def _rows_of(self, record: Record, path: Path) -> None:
        """Take the rows of a record: one of all its values, or one of each."""
        columns = record_schema(type(record)).columns
        plain = tuple(slot for slot in columns if not slot.row and not slot.many)
        whole = plain and len(plain) == len(columns) and (*path, plain[0].json) in self.places.spans
        for row in [plain] if whole else [(slot,) for slot in plain]:
            if span := self.places.spans.get((*path, row[0].json)):
                self.kinds[self._begin(span.start)] = RowKind(row[0], row)

    def _value(self, path: Path, slot: FieldSpec, value: object) -> None:
        """Take one value, or one of the values of a field."""
        span = self.places.spans.get(path)
        if isinstance(value, Record):
            self._rows_of(value, path)
        elif isinstance(value, Table) and slot.row:
            kind = RowKind(slot, tuple(record_schema(slot.row).columns), table=True)
            self.kinds |= {self._begin(run.start): kind for _, run in self.places.runs.get(path, ())}
        elif span and slot.many and path[-1] == 0:
            self.kinds[self._begin(span.start)] = RowKind(slot, (slot,), many=True)
        elif span and isinstance(value, Row):
            self.kinds[self._begin(span.start)] = RowKind(slot, tuple(record_schema(type(value)).columns))
        elif span and slot.kind is not Kind.NAME and value in slot.choices:
            if self.text[slice(*span)].strip(" \t").upper() == str(value).upper():  # no control character in it
                self.choices[span.start] = str(value)
        elif span and slot.about.opaque is not None and isinstance(value, str):
            self.whole[span.start] = value

    def _begin(self, start: int) -> int:
        """Return the offset behind the blanks at an offset."""
        match = _BLANKS.match(self.text, start)
        return match.end() if match else start

    def lines(self, leaf: Leaf) -> Iterator[Laid]:
        """Yield the lines that are complete at this leaf: rows are collected until their table ends."""
        if leaf.kind in (LeafKind.RUN, LeafKind.TEXT) and self.declared.tabular:
            yield from self._row(leaf.span)
        elif leaf.kind in (LeafKind.RUN, LeafKind.TEXT):
            for line in line_spans(self.text, leaf.span):
                yield from self._row(Span(line.start, min(line.end + 1, leaf.span.end)))
        elif leaf.span.start in self.kept:
            yield from self.flush()
        elif is_data(self.text, leaf, self.keys):
            yield from self.flush()
            yield leaf.span, self._setting(leaf.span)
        elif leaf.kind is not LeafKind.BLANK:
            yield leaf.span, comment_line(self.text, leaf.span)

    def flush(self) -> Iterator[Laid]:
        """Yield the rows collected so far."""
        if self.rows:
            yield from self.rows.laid_out()
        self.rows = None

    def _row(self, span: Span) -> Iterator[Laid]:
        """Add a row, or a run of rows, to collected rows of the same kind; otherwise start a new table."""
        kind = self.kinds.get(self._begin(span.start))
        if kind is None:  # not part of the model: left unchanged
            return
        if self.rows is None or self.rows.kind.slot is not kind.slot:
            yield from self.flush()
            self.rows = AlignedRows(self.text, kind)
        if kind.table:
            self.rows.members.append((span, []))
            return
        fields, _ = split(self.text, span, slashes=self.declared.slashes)
        texts = [self.choices.get(value.span.start, value.text) for value in fields]
        self.rows.members.append((span, cut(split_blanks(texts))))

    def _setting(self, span: Span) -> str:
        line = read_line(self.text, span, slashes=self.declared.slashes)
        first = line.groups[0]
        if whole := self.whole.get(first.fields[0].span.start):
            return f" {first.key}={whole}".rstrip(" ") + "\n"
        texts = [text for group in line.groups for text in self._group(group)]
        return " " + ", ".join(texts).rstrip(" ") + "\n"

    def _group(self, group: FieldGroup) -> list[str]:
        """Return `KEY=` with its first value, then the other values.

        A value that begins with a bracket keeps a blank before it: without the blank it would be an equation.
        """
        texts = [self.choices.get(value.span.start, value.text) for value in group.fields]
        kind = self.kinds.get(group.span.start)
        texts = cut(split_blanks(texts) if kind and len(kind.columns) > 1 else texts)
        first = group.fields[0].span.start
        blank = " " if texts[0].startswith("[") and self.text[first - 1] != "=" else ""
        return [f"{group.key}={blank}{texts[0]}", *texts[1:]]


def split_blanks(texts: list[str]) -> list[str]:
    """Return numbers separated only by blanks as fields."""
    return texts[0].split() if len(texts) == 1 and blank_separated(texts[0]) else texts
