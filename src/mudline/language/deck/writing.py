"""A deck to the bytes of a keyword file: what nobody changed of the text that it was read from stays as it is."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher
from itertools import chain

from mudline.basics.sequences import differing
from mudline.language.codes import DOC002
from mudline.language.deck.keyword_text import Lines, canonical_text, pieces_of, to_keyword
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem, Span
from mudline.language.syntax.edits import OverlapError, TextEdit, edited_bytes, replacement_in_layout
from mudline.language.syntax.fields import split
from mudline.language.syntax.rows import line_spans
from mudline.language.syntax.source import Source

_MOST_COMPARED = 10_000
"""Lines of a block and its changed form, between the first and the last that differ, which are compared one by one."""


def keyword_file(deck: Deck) -> bytes:
    """The deck in the encoding and with the line ends of the text that it was read from, else in UTF-8 with LF.

    Of a changed line the fields that are the same stay, and columns in line as far as there are blanks for it. What the
    file then says is read back and compared. Raises DeckError for what a keyword file cannot say, or its encoding.
    """
    text = to_keyword(deck)
    if not isinstance(deck.origin, TextOrigin):
        return text.encode()
    source = deck.origin.source
    old, new = pieces_of(read_source(source, units=deck.units)), pieces_of(deck)
    tree = deck.origin.tree
    spans = [tree.preamble.span, *(spot.span for spot in tree.spots if spot.where.section >= 0)]
    try:
        for by_lines in (True, False):
            try:
                content = edited_bytes(source, _edits(source, spans, old, new, by_lines=by_lines))
            except OverlapError:
                continue
            if canonical_text(read_source(Source.from_bytes(content, source.name), units=deck.units)) == text:
                return content
        return edited_bytes(source, [TextEdit(Span(0, len(source.text)), text)])
    except UnicodeEncodeError as error:
        letter = error.object[error.start]
        message = (
            f"{letter!r} cannot be written in the file's encoding, {source.encoding}: save the file as UTF-8 first"
        )
        raise DeckError(deck.diagnose([Problem(DOC002, message)])) from error


def _edits(source: Source, spans: list[Span], old: list[Lines], new: list[Lines], *, by_lines: bool) -> list[TextEdit]:
    """The edits that make the new pieces of the old ones."""
    found: dict[Span, TextEdit] = {}
    for first, last, start, end in _changes(old, new):
        heads = [piece[:1] for piece in old[first:last]], [piece[:1] for piece in new[start:end]]
        at = spans[first].start if first < len(spans) else len(source.text)
        inserted: list[str] = []
        matcher = SequenceMatcher(None, *heads, autojunk=False)
        for kind, i, k, j, n in matcher.get_opcodes():
            if kind == "equal":
                for one, other in zip(range(first + i, first + k), new[start + j : start + n], strict=True):
                    if old[one] != other:
                        edits = _changed(source, spans[one], old[one], other, by_lines=by_lines)
                        found |= {edit.span: edit for edit in edits}
                continue
            for one in range(first + i, first + k):
                found[spans[one]] = TextEdit(spans[one], "")
            inserted = list(chain.from_iterable(new[start + j : start + n]))
            at = spans[first + k - 1].end if k else at
            if inserted:
                before = "" if at == 0 or source.unified[at - 1] == "\n" else "\n"
                edit = TextEdit(Span(at, at), before + "".join(f"{line}\n" for line in inserted))
                found[edit.span] = edit
    return list(found.values())


def _changes(old: list[Lines], new: list[Lines]) -> Iterator[tuple[int, int, int, int]]:
    matcher = SequenceMatcher(None, old, new, autojunk=False)
    return (places for kind, *places in matcher.get_opcodes() if kind != "equal")  # type: ignore[misc]


def _changed(source: Source, span: Span, old: Lines, new: Lines, *, by_lines: bool) -> Iterator[TextEdit]:
    """The edits of one piece: of its lines that differ, if its text has those of the old one each on a line."""
    text = source.unified
    lines = [Span(line.start, line.start + len(text[slice(*line)].rstrip("\r\n"))) for line in line_spans(text, span)]
    lines = [line for line in lines if text[slice(*line)].strip()]
    if not lines:
        yield TextEdit(Span(span.start, span.start), "".join(f"{line}\n" for line in new))
        return
    if not by_lines or len(lines) != len(old):
        yield TextEdit(Span(lines[0].start, lines[-1].end), "\n".join(new))
        return
    for first, last, start, end in differing(old, new, _MOST_COMPARED):
        if last - first == end - start:
            for line, before, after in zip(lines[first:last], old[first:last], new[start:end], strict=True):
                yield from _fields(source, line, before, after)
        else:
            added = "".join(f"\n{line}" for line in new[start:end])
            # Each line goes with the line end before it: every piece but the preamble begins with its head.
            begin = lines[first - 1].end if first else span.start
            yield TextEdit(Span(begin, lines[last - 1].end if last > first else begin), added)


def _fields(source: Source, line: Span, old: str, new: str) -> Iterator[TextEdit]:
    """The edits of the fields that differ, or of the whole line if it has other fields."""
    if old == new:
        return
    given, before, after = (
        split(text, place)[0]
        for text, place in ((source.unified, line), (old, Span(0, len(old))), (new, Span(0, len(new))))
    )
    if not len(given) == len(before) == len(after):
        yield TextEdit(line, new)
        return
    for field, one, two in zip(given, before, after, strict=True):
        if one.text != two.text:
            yield from replacement_in_layout(source, field.span, two.text)
