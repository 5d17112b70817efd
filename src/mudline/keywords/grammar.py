"""Level two: a keyword's rule over the lines of level one, compiled when first needed, with recovery from bad lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import pairwise
from typing import NamedTuple, cast

from lark import Lark, Token, Tree, UnexpectedToken
from lark.lexer import Lexer
from lark.parsers.lalr_interactive_parser import InteractiveParser

from mudline.diagnostics import Span
from mudline.resources import grammar_file
from mudline.syntax.scanning import kept_parser

END = "$END"
ROW = "ROW"

_NAME = re.compile(r"\b[a-z_][a-z_0-9]*+")
_OPENING = re.compile(rf"({_NAME.pattern})\s*:")
_TERMINAL = re.compile(r"\b[A-Z][A-Z_0-9]*+")

_RECORDS = re.compile(r"[a-z_]+: ([a-z_]+)\*\n")
_IN_BRACKETS = re.compile(r"\([^()]*\)")
_OPENED = re.compile(r"[a-z_]+: ([A-Z_0-9]+)(?![A-Z_0-9?*+])")

SMALL = 64
"""Contents of a block whose tree is remembered: decks of one family hold blocks of the same few forms."""


class Content(NamedTuple):
    """A line of a block, or a run of rows: the terminal it is, its place, and its position among the block's leaves."""

    terminal: str
    span: Span
    position: int


@dataclass(slots=True)
class Node:
    """A rule with the contents and rules below it."""

    rule: str
    children: list[Node | Content]


class Mismatch(NamedTuple):
    """A line that does not fit; `found` None is the end of the block. `missing`: the line that was left out instead."""

    found: Content | None
    expected: tuple[str, ...]
    missing: str


class _Given(Lexer):
    """No lexer: the tokens are fed one by one."""

    def __init__(self, _configuration: object) -> None:
        pass

    def lex(self, lexer_state: object, parser_state: object) -> Iterator[Token]:  # noqa: ARG002 - lark's signature
        """Nothing to cut."""
        return iter(())


@cache
def _rules() -> dict[str, str]:
    """The rules of the grammar, as they are written, by their names."""
    found: dict[str, str] = {}
    name = ""
    for line in grammar_file("blocks.lark").read_text(encoding="utf-8").splitlines():
        written = line.partition("//")[0].rstrip()
        if opening := _OPENING.match(written):
            name = opening[1]
        if written:
            found[name] = f"{found.get(name, '')}{written}\n"
    return found


def _part(rule: str) -> str:
    """The grammar of a rule and of those it leads to: the whole one takes as long to compile for each keyword."""
    wanted, found = [rule], dict[str, str]()
    while wanted:
        name = wanted.pop()
        if name not in found:
            found[name] = _rules()[name]
            wanted += sorted(set(_NAME.findall(found[name])) & _rules().keys())
    text = "".join(found.values())
    return f"{text}%declare {' '.join(sorted(set(_TERMINAL.findall(text))))}\n"


@cache
def _parser(rule: str) -> Lark:
    return kept_parser(rule, _part(rule), start=rule, lexer=_Given, keep_all_tokens=True, maybe_placeholders=False)


def terminal_of(key: str) -> str:
    """The terminal of a setting line by its first key."""
    return "K_" + "".join(letter if letter.isalnum() else "_" for letter in key)


def parse(rule: str, contents: list[Content]) -> tuple[Node, list[Mismatch]]:
    """The tree of a block under its rule.

    A line that does not fit is left out, unless putting in a missing line before it makes it fit; each is reported.
    """
    if len(contents) <= SMALL:
        tree = fitting(rule, tuple([content.terminal for content in contents]))
        if tree is not None:
            return _node(tree, contents), []
    return by_records(rule, contents) or by_lines(rule, contents)


class Records(NamedTuple):
    """The rule of the records of which a block is a list, and the terminal with which each of them begins."""

    rule: str
    opening: str


@cache
def records_of(rule: str) -> Records | None:
    """Return the records of a block of nothing else; None unless a terminal stands at their beginning, and only there.

    Such a block can be cut into records before it is parsed: its tree has no other one.
    """
    listed = _RECORDS.fullmatch(_rules()[rule])
    opened = listed and _OPENED.match(_rules()[listed[1]])
    if listed is None or opened is None:
        return None
    always = "|" not in _IN_BRACKETS.sub("", _rules()[listed[1]])
    once = terminals_below(listed[1]).count(opened[1]) == 1
    return Records(listed[1], opened[1]) if always and once else None


def terminals_below(rule: str) -> list[str]:
    """Return the terminals of a rule and of those it leads to, each as often as it is written."""
    return _TERMINAL.findall(_part(rule).partition("%declare")[0])


def by_records(rule: str, contents: list[Content]) -> tuple[Node, list[Mismatch]] | None:
    """Return the tree of a block, a record at a time; None where it has no records, or one does not fit."""
    records = records_of(rule)
    starts = [i for i, content in enumerate(contents) if content.terminal == records.opening] if records else []
    if records is None or starts[:1] != [0]:
        return None
    children: list[Node | Content] = []
    for start, stop in pairwise([*starts, len(contents)]):
        piece = contents[start:stop]
        tree = fitting(records.rule, tuple([content.terminal for content in piece])) if len(piece) <= SMALL else None
        if tree is None:
            return None
        children.append(_node(tree, piece))
    return Node(rule, children), []


@lru_cache(maxsize=1024)
def fitting(rule: str, terminals: tuple[str, ...]) -> Tree[Token] | None:
    """Return the tree of lines by their terminals, if all of them fit."""
    parser = _parser(rule).parse_interactive()
    try:
        for index, terminal in enumerate(terminals):
            parser.feed_token(Token(terminal, "", start_pos=index))
        return cast("Tree[Token]", parser.feed_eof())
    except UnexpectedToken:
        return None


def by_lines(rule: str, contents: list[Content]) -> tuple[Node, list[Mismatch]]:
    """Return the tree of a block line by line, whatever fits."""
    parser = _parser(rule).parse_interactive()
    mismatches: list[Mismatch] = []
    for index, content in enumerate(contents):
        token = Token(content.terminal, "", start_pos=index)
        try:
            parser.feed_token(token)
        except UnexpectedToken:
            mismatches.append(_recover(parser, token, content))
    try:
        tree = parser.feed_eof()
    except UnexpectedToken:
        tree, missing = _complete(parser)
        mismatches.append(missing)
    return _node(tree, contents), mismatches


def _recover(parser: InteractiveParser, token: Token, content: Content) -> Mismatch:
    """Feed the missing line before a token that does not fit, or drop the token."""
    expected = tuple(sorted(parser.accepts()))
    for missing in expected:
        trial = parser.copy()
        if missing == END:
            continue
        trial.feed_token(Token(missing, ""))
        if token.type in trial.accepts():
            parser.feed_token(Token(missing, ""))
            parser.feed_token(token)
            return Mismatch(content, expected, missing)
    return Mismatch(content, expected, "")


def _complete(parser: InteractiveParser) -> tuple[Tree[Token], Mismatch]:
    """Feed the mandatory lines that the end of a block lacks."""
    expected = tuple(sorted(parser.accepts()))
    first = expected[0]
    missing = first
    while END not in parser.accepts():
        parser.feed_token(Token(missing, ""))
        missing = min(parser.accepts())
    return parser.feed_eof(), Mismatch(None, expected, first)


def _node(tree: Tree[Token], contents: list[Content]) -> Node:
    """Our own tree; a line that was put in has no content."""
    children: list[Node | Content] = []
    for child in tree.children:
        if isinstance(child, Tree):
            children.append(_node(child, contents))
        elif child.start_pos is not None:
            children.append(contents[child.start_pos])
    return Node(str(tree.data), children)
