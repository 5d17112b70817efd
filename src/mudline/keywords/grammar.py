"""Level two: lark's parser of a keyword's rule, over the lines of level one."""

from __future__ import annotations

import pickle
import re
from collections.abc import Iterator, Sequence
from copy import copy
from functools import cache, lru_cache
from io import BytesIO
from pathlib import Path
from typing import NamedTuple, cast

import lark
from lark import Lark, Token, Tree, UnexpectedToken
from lark.lexer import Lexer
from lark.parsers.lalr_interactive_parser import InteractiveParser

from mudline.diagnostics import Span
from mudline.resources import grammar_file

END = "$END"
ROW = "ROW"
_FEW = 64
"""Lines of a block whose tree is remembered."""

_RULE = re.compile(r"^([a-z_][a-z_0-9]*)\s*:.*(?:\n[ \t]+.*)*", re.MULTILINE)
_NAME = re.compile(r"\b[a-z_][a-z_0-9]*\b")
_TERMINAL = re.compile(r"\b[A-Z][A-Z_0-9]*\b")
_COMMENT = re.compile(r"//.*")


class Content(NamedTuple):
    """A line of a block, or a run of rows, as lark's token: the terminal it is, its place, its position in the block."""

    type: str
    span: Span
    position: int


Node = Tree[Content]
"""A rule with the contents and rules below it."""


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
    """The rules of the grammar as they are written, by their names."""
    text = _COMMENT.sub("", grammar_file("blocks.lark").read_text(encoding="utf-8"))
    return {found[1]: found[0] for found in _RULE.finditer(text)}


def _below(rule: str) -> dict[str, str]:
    """A rule and those it leads to."""
    wanted, found = [rule], dict[str, str]()
    while wanted:
        name = wanted.pop()
        if name not in found:
            found[name] = _rules()[name]
            wanted += sorted({*_NAME.findall(found[name])} & _rules().keys())
    return found


@cache
def _parser(rule: str) -> Lark:
    """The parser of a rule: its tables as the package brings them, else compiled, which takes 2 ms."""
    if kept := _tables().get(rule):
        return Lark.load(BytesIO(kept))
    below = _below(rule)
    text = "\n".join(below.values())
    text += f"\n%declare {' '.join(sorted({*_TERMINAL.findall(text)}))}\n"
    return Lark(text, parser="lalr", start=rule, lexer=_Given, keep_all_tokens=True, maybe_placeholders=False)


@cache
def _tables() -> dict[str, bytes]:
    """What lark saved of each rule when the package was built; nothing in a checkout, or beside another lark."""
    path = grammar_file("blocks.tables")
    version, tables = pickle.loads(path.read_bytes()) if path.exists() else ("", {})  # noqa: S301 - a file of our own
    return tables if version == lark.__version__ else {}


def save_tables(path: Path) -> None:
    """Write the tables of all rules, for the package."""
    _tables.cache_clear()
    kept: dict[str, bytes] = {}
    for rule in _rules():
        if not rule.startswith("_"):
            saved = BytesIO()
            _parser(rule).save(saved)
            kept[rule] = saved.getvalue()
    path.write_bytes(pickle.dumps((lark.__version__, kept)))


@cache
def terminal_of(key: str) -> str:
    """The terminal of a setting line by its first key."""
    return "K_" + "".join(letter if letter.isalnum() else "_" for letter in key)


@cache
def first_terminals(rule: str) -> frozenset[str]:
    """Return the terminals with which the lines of a rule may begin."""
    return frozenset(_parser(rule).parse_interactive().accepts()) - {END}


def tree_of(rule: str, contents: Sequence[Content]) -> Node | None:
    """Return the tree of a block under its rule, if all of its lines fit."""
    parsed = _parsed if len(contents) <= _FEW else _parsed.__wrapped__
    tree = parsed(rule, tuple([content.type for content in contents]))
    return tree and _with_lines(tree, iter(contents))


@lru_cache(1024)
def _parsed(rule: str, terminals: tuple[str, ...]) -> Tree[_Bare] | None:
    """The tree of lines by their terminals: decks hold blocks of the same few forms."""
    parser = _parser(rule).parse_interactive()
    feed = parser.parser_state.feed_token
    try:
        for terminal in terminals:
            feed(_Bare(terminal))
        return cast("Tree[_Bare]", parser.feed_eof())
    except UnexpectedToken:
        return None


class _Bare(NamedTuple):
    """A line without a place."""

    type: str


def _with_lines(tree: Tree[_Bare], lines: Iterator[Content]) -> Node:
    """The tree with the lines themselves, which come in the order of its leaves."""
    return Tree(
        tree.data, [_with_lines(child, lines) if type(child) is Tree else next(lines) for child in tree.children]
    )


def by_lines(rule: str, contents: Sequence[Content], *, insert: bool = True) -> tuple[Node, list[Mismatch]]:
    """Return the tree of a block line by line, whatever fits.

    A line that does not fit is left out, unless putting in a missing line before it makes it fit; each is reported.
    In a block with lines of unknown form none is missing for certain: there nothing is to `insert`.
    """
    parser = _parser(rule).parse_interactive()
    mismatches: list[Mismatch] = []
    for content in contents:
        if _takes(parser, content):  # a parser that refuses a token has closed what it could before
            parser.feed_token(content)
            continue
        expected = tuple(sorted(parser.accepts()))
        options = (name for name in expected if insert and name != END and _takes(parser, _missing(name), content))
        missing = next(options, "")
        if missing:
            parser.feed_token(_missing(missing))
            parser.feed_token(content)
        mismatches.append(Mismatch(content, expected, missing))
    if END not in (expected := parser.accepts()):
        mismatches.append(Mismatch(None, tuple(sorted(expected)), _completed(parser)[0]))
    return _without_missing(cast("Node", parser.feed_eof())), mismatches


def _missing(terminal: str) -> Content:
    """The token of a line that is missing."""
    return Content(terminal, Span(0, 0), -1)


def _takes(parser: InteractiveParser, *tokens: Content) -> bool:
    """Whether a parser takes some tokens; the trial makes no tree, so that nothing has to be copied for it."""
    state = parser.parser_state
    rules = copy(state.parse_conf)
    rules.callbacks = {}
    trial = type(state)(rules, state.lexer, [*state.state_stack], [*state.value_stack])
    try:
        for token in tokens:
            trial.feed_token(token, token.type == END)
    except UnexpectedToken:
        return False
    return True


def _completed(parser: InteractiveParser) -> list[str]:
    """Feed the mandatory lines that the end of a block lacks: that which ends it, or one that was not put in yet."""
    fed: list[str] = []
    while END not in (options := sorted(parser.accepts())):
        ends = (option for option in options if _takes(parser, _missing(option), _missing(END)))
        fed.append(next(ends, "") or next((option for option in options if option not in fed), options[0]))
        parser.feed_token(_missing(fed[-1]))
    return fed


def _without_missing(node: Node) -> Node:
    """The tree of the lines that are there."""
    below = [_without_missing(child) if isinstance(child, Tree) else child for child in node.children]
    return Tree(node.data, [child for child in below if isinstance(child, Tree) or child.position >= 0])
