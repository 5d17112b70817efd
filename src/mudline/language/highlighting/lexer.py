"""Lexer for Pygments, which finds it by the entry point `pygments.lexers`; only this module imports Pygments."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

from pygments.lexer import Lexer
from pygments.token import Comment, Generic, Keyword, Name, Number, Operator, Punctuation, String, Text, _TokenType

Found = tuple[int, _TokenType, str]

_LINE = re.compile(r"[^\n]*\n?")
_NAME = re.compile(r"[ \t]+")
_COMMENT = re.compile(r"[Cc](?:[ \t]|[-*=#_.~+]{2}|\r?$)")
_UNDECIDED = re.compile(r"C[A-Za-z]")
_KEY = re.compile(r"([ \t]*)([A-Za-z](?:[\w \t-]*[\w-])?)([ \t]*)=")
_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[EeDd][-+]?[0-9]+)?")
_NUMBERS = re.compile(rf"[ \t]*{_NUMBER.pattern}(?:[ \t]+{_NUMBER.pattern})+[ \t\r\n]*")
_INSIDE = r'(?:[^\[\]"\n]|"[^"\n]*")'
_FIELD = re.compile(
    rf'(?:(?<==)\[(?:{_INSIDE}|\[{_INSIDE}*\])*\]|(?<==)\[[^\n]*|"[^"\n]*"|\{{[^}}\n]*\}}|["{{][^\n]*|[^,\n"{{])+'
)
"""Field up to the next comma outside brackets, quotes and braces; without its closing mark it ends with the line."""
_SLASHED = re.compile(r"[ \t]*/[^\n]*/")
_EQUATION = re.compile(
    r'(?P<text>"[^"]*"?)|(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?)'
    r"|(?P<word>(?:and|or|not)(?![\w.]))|(?P<call>[^\W\d][\w.]*(?=[ \t]*\())|(?P<name>[^\W\d][\w.]*)"
    r"|(?P<operator>[-+*/^<>=!]+)|(?P<blank>\s+)|(?P<other>.)",
    re.IGNORECASE,
)
_IN_EQUATION = {
    "text": String.Double,
    "number": Number.Float,
    "word": Operator.Word,
    "call": Name.Function,
    "name": Name.Variable,
    "operator": Operator,
    "blank": Text.Whitespace,
    "other": Punctuation,
}


@cache
def _words() -> dict[str, Any]:
    words: dict[str, Any] = json.loads(Path(__file__).with_name("words.json").read_text(encoding="utf-8"))
    return {**words, "sections": frozenset(words["sections"]), "keywords": frozenset(words["keywords"])}


class DeckLexer(Lexer):
    """Lexer of riser and pipeline analysis decks in keyword text."""

    name = "mudline deck"
    aliases: ClassVar[list[str]] = ["mudline", "keyx"]
    filenames: ClassVar[list[str]] = ["*.keyx", "*.keyxm", "*.keyxi"]
    alias_filenames: ClassVar[list[str]] = ["*.das"]
    mimetypes: ClassVar[list[str]] = ["text/x-mudline"]

    def get_tokens_unprocessed(self, text: str) -> Iterator[Found]:
        """Yield the tokens of a text, line by line: offset, kind and text."""
        section = ""
        block: dict[str, Any] = {}
        for match in _LINE.finditer(text):
            line, at = match[0], match.start()
            body = line.lstrip(" \t")
            if body.startswith("$"):
                section, block = _canonical(body), {}
                known = section in _words()["sections"]
                yield from _whole(at, line, Generic.Heading if known else Generic.Subheading)
            elif body.startswith("*"):
                keyword = _canonical(body)
                block = _words()["read"].get(keyword, {})
                block = block if section in block.get("sections", ()) else {}
                yield from _whole(at, line, Keyword if keyword in _words()["keywords"] else Keyword.Pseudo)
            elif _is_comment(line, block):
                yield from _whole(at, line, Comment.Single)
            elif line:
                yield from _fields(at, line, block)


def _canonical(line: str) -> str:
    """Return the name on a line: upper case, single blanks, no blanks around a comma."""
    return re.sub(r" *, *", ",", _NAME.sub(" ", line.strip(" \t\r\n")[1:].strip(" \t"))).upper()


def _is_comment(line: str, block: dict[str, Any]) -> bool:
    """Return True if a line is a comment: `C` and no letter, or `C` and a letter if no setting of the keyword fits."""
    if _UNDECIDED.match(line):
        key = _KEY.match(line)
        return key is None or _key(key[2]) not in block.get("settings", {})
    return _COMMENT.match(line) is not None


def _key(written: str) -> str:
    return _NAME.sub(" ", written).upper()


def _whole(at: int, line: str, kind: _TokenType) -> Iterator[Found]:
    """Yield a line as a token of one kind, with separate tokens for the blanks around it."""
    body = line.strip(" \t\r\n")
    start = line.index(body)
    yield from _blank(at, line[:start])
    if body:
        yield at + start, kind, body
    yield from _blank(at + start + len(body), line[start + len(body) :])


def _blank(at: int, text: str) -> Iterator[Found]:
    if text:
        yield at, Text.Whitespace, text


def _fields(at: int, line: str, block: dict[str, Any]) -> Iterator[Found]:
    """Yield the fields of a setting or a row."""
    if _NUMBERS.fullmatch(line):
        for piece in re.finditer(r"\s+|\S+", line):
            yield at + piece.start(), Text.Whitespace if piece[0].isspace() else Number.Float, piece[0]
        return
    here = 0
    while here < len(line):
        choices: list[str] = []
        if key := _KEY.match(line, here):
            yield from _blank(at + here, key[1])
            known = _key(key[2]) in block.get("settings", {})
            yield at + key.start(2), Name.Attribute if known else Name.Property, key[2]
            yield from _blank(at + key.start(3), key[3])
            here = key.end()
            yield at + here - 1, Operator, "="
            choices = block.get("settings", {}).get(_key(key[2]), [])
        slashed = _SLASHED.match(line, here) if block.get("slashes") else None
        field = slashed or _FIELD.match(line, here)
        if field:
            yield from _field(at + here, field[0], choices)
            here = field.end()
        if here < len(line):
            yield at + here, Punctuation if line[here] == "," else Text.Whitespace, line[here]
            here += 1


def _field(at: int, written: str, choices: list[str]) -> Iterator[Found]:
    """Yield a field with the blanks around it."""
    text = written.strip(" \t\r")
    start = written.index(text)
    yield from _blank(at, written[:start])
    at += start
    if text.startswith("=["):
        yield from _equation(at, text)
    elif _NUMBER.fullmatch(text):
        yield at, Number.Float, text
    elif text.upper() in choices:
        yield at, Name.Constant, text
    elif text.startswith("{"):
        yield at, Name.Label, text
    elif text:
        yield at, String.Double if text.startswith('"') else String, text
    yield from _blank(at + len(text), written[start + len(text) :])


def _equation(at: int, text: str) -> Iterator[Found]:
    yield at, Operator, "=["
    closed = text.endswith("]")
    for match in _EQUATION.finditer(text, 2, len(text) - closed):
        yield at + match.start(), _IN_EQUATION[str(match.lastgroup)], match[0]
    if closed:
        yield at + len(text) - 1, Operator, "]"
