"""Colours, outline and folding ranges of a deck, and its canonical layout."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from lsprotocol import types
from pygments.token import Comment, Generic, Keyword, Name, Number, Operator, String, _TokenType

from mudline.basics.limits import MOST_OUTLINED
from mudline.editing.formatting.document import FormatError, formatted
from mudline.language.deck.forms import form_of
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import DeckError, Span, Where
from mudline.language.highlighting.lexer import DeckLexer
from mudline.language.keywords.model import record_schema
from mudline.language.keywords.reader import ReadBlock
from mudline.language.syntax.fields import trimmed
from mudline.language.syntax.tree import LeafKind, RawBlock
from mudline.tools.lsp.decks import Analysis, OpenDocument, failed, units_of

# ----------------------------------------------------------------------------------------------------------- colours

_KINDS: dict[_TokenType, types.SemanticTokenTypes] = {
    Generic.Heading: types.SemanticTokenTypes.Namespace,
    Keyword: types.SemanticTokenTypes.Keyword,
    Comment.Single: types.SemanticTokenTypes.Comment,
    Name.Attribute: types.SemanticTokenTypes.Property,
    Name.Constant: types.SemanticTokenTypes.EnumMember,
    Name.Function: types.SemanticTokenTypes.Function,
    Name.Variable: types.SemanticTokenTypes.Variable,
    Name.Label: types.SemanticTokenTypes.Variable,
    Number.Float: types.SemanticTokenTypes.Number,
    Operator: types.SemanticTokenTypes.Operator,
    Operator.Word: types.SemanticTokenTypes.Operator,
    String: types.SemanticTokenTypes.String,
    String.Double: types.SemanticTokenTypes.String,
}
"""Token types that are coloured; unknown sections, keywords and settings stay plain."""

_NAMES = list(dict.fromkeys(kind.value for kind in _KINDS.values()))
LEGEND = types.SemanticTokensLegend(_NAMES, [])


def tokens(document: OpenDocument) -> types.SemanticTokens:
    """Return the tokens of a deck in keyword text, each relative to the previous token as the protocol counts.

    There are none for JSON and YAML, which editors colour themselves, nor for a text too long to be read at once.
    """
    if document.is_long or form_of(document.name) != "keyword":
        return types.SemanticTokens([])
    plain = document.text.replace("\r\n", " \n").replace("\r", "\n")  # of the same length
    data: list[int] = []
    line = column = 0
    for at, kind, written in DeckLexer().get_tokens_unprocessed(plain):
        if kind not in _KINDS:
            continue
        place, length = document.position(at), units_of(written)
        along = place.character - column * (place.line == line)
        data += [place.line - line, along, length, _NAMES.index(_KINDS[kind].value), 0]
        line, column = place.line, place.character
    return types.SemanticTokens(data)


# ----------------------------------------------------------------------------------------------------------- outline


def outline(analysis: Analysis) -> Iterator[types.DocumentSymbol]:
    """Yield sections, their blocks, and the named records in these: sets, curves, parameters."""
    for index, section in enumerate(analysis.origin.tree.sections):
        if section.head:
            blocks = [_block(analysis, Where(index, number), raw) for number, raw in enumerate(section.blocks)]
            head, end = section.head.span, section.span.end
            yield _symbol(analysis, f"${section.name}", types.SymbolKind.Module, head, end, blocks)


def _symbol(
    analysis: Analysis,
    name: str,
    kind: types.SymbolKind,
    head: Span,
    stop: int,
    children: list[types.DocumentSymbol] | None = None,
) -> types.DocumentSymbol:
    text = analysis.document.text
    line = trimmed(text, *head)
    whole = Span(line.start, max(trimmed(text, head.start, stop).end, line.end))
    place = analysis.document.range
    return types.DocumentSymbol(name.strip() or "?", kind, place(whole), place(line), children=children)


def _block(analysis: Analysis, where: Where, raw: RawBlock) -> types.DocumentSymbol:
    read = None if analysis.document.is_long else analysis.origin.read.get(where[:2])
    records = list(_records(analysis, read, raw.span.end)) if read else []
    return _symbol(analysis, f"*{raw.name}", types.SymbolKind.Class, raw.head.span, raw.span.end, records)


def _records(analysis: Analysis, read: ReadBlock, stop: int) -> Iterator[types.DocumentSymbol]:
    """Yield the named records of a block."""
    block = read.model
    for slot in record_schema(type(block)).slots:
        records = getattr(block, slot.name, None) if slot.record else None
        named = [(index, record.known_as()) for index, record in enumerate((records or ())[:MOST_OUTLINED])]
        shown = [(index, name) for index, name in named if isinstance(name, str)]
        if not shown:
            continue
        spans = [read.places.find((slot.json, index)) for index, _ in shown]
        ends = [*(span.start for span in spans[1:]), stop]
        kind = types.SymbolKind.Variable if block.facts.defines == "parameters" else types.SymbolKind.Object
        for (_, name), span, end in zip(shown, spans, ends, strict=True):
            yield _symbol(analysis, name, kind, span, end)


# ----------------------------------------------------------------------------------------------------------- folding


def folding(analysis: Analysis) -> Iterator[types.FoldingRange]:
    """Yield the folding ranges: sections, blocks, and comments of more than one line."""
    origin = analysis.origin
    spans = [(span, types.FoldingRangeKind.Comment) for span in _comments(origin)]
    for section in origin.tree.sections:
        regions = (section.span, *(block.span for block in section.blocks))
        spans += [(span, types.FoldingRangeKind.Region) for span in regions]
    document = analysis.document
    for span, kind in sorted(spans, key=lambda each: each[1] is types.FoldingRangeKind.Comment):
        body = trimmed(document.text, *span)
        first, last = document.line_at(body.start), document.line_at(max(body.end - 1, body.start))
        if last > first:
            yield types.FoldingRange(first, last, kind=kind)


def _comments(origin: TextOrigin) -> Iterator[Span]:
    for is_comment, leaves in groupby(origin.tree.leaves(), lambda leaf: leaf.kind is LeafKind.COMMENT):
        if is_comment:
            spans = [leaf.span for leaf in leaves]
            yield Span(spans[0].start, spans[-1].end)


# -------------------------------------------------------------------------------------------------------- formatting


def formatting(analysis: Analysis) -> list[types.TextEdit]:
    """Return the change to canonical layout; raises JsonRpcException for a deck that cannot be formatted."""
    document = analysis.document
    if analysis.context is None:
        return []
    try:
        after = formatted(document.as_file(), document.name)
    except DeckError as error:
        first = error.diagnostics[0]
        raise failed(f"not formatted: correct the error in line {first.line} first ({first.code})") from error
    except FormatError as error:
        raise failed(f"not formatted: {error}") from error
    return document.difference(after)
