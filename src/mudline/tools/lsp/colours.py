"""Colours: tokens of the lexer as semantic tokens, for editors without a grammar of their own."""

from __future__ import annotations

from lsprotocol import types
from pygments.token import Comment, Generic, Keyword, Name, Number, Operator, String, _TokenType

from mudline.language.deck.forms import form_of
from mudline.language.highlighting.lexer import DeckLexer
from mudline.tools.lsp.documents import OpenDocument, units_of

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
