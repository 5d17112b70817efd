"""Level two: the rule of a keyword over the lines of level one, compiled when first needed, with recovery."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass, field
from functools import cache
from typing import Any, NamedTuple, Protocol, cast

from lark import Lark, Token, Tree, UnexpectedToken

from mudline.diagnostics import Span
from mudline.resources import grammar_file

END = "$END"
ROW = "ROW"


class Content(NamedTuple):
    """A line of a block, or a run of rows: its place, and its position among the block's leaves.

    `key` is the KEY that a setting begins with, "" for rows; `text` says that a row does not begin like a number.
    """

    key: str
    span: Span
    position: int
    text: bool = False

    @property
    def terminal(self) -> str:
        """What the line is to the grammar."""
        return terminal_of(self.key) if self.key else ROW


@dataclass(slots=True)
class Node:
    """A rule with the contents and rules below it."""

    rule: str
    children: list[Node | Content]


class Mismatch(NamedTuple):
    """A line that does not fit; `found` None is the end of the block. `missing`: the line that was put in before it."""

    found: Content | None
    expected: tuple[str, ...]
    missing: str


class _Cursor(Protocol):
    """What is used of lark's interactive parser, which has no types of its own."""

    parser_state: Any

    def feed_token(self, token: Token) -> object: ...
    def feed_eof(self) -> object: ...
    def accepts(self) -> set[str]: ...
    def copy(self, *, deepcopy_values: bool) -> _Cursor: ...


def terminal_of(key: str) -> str:
    """The terminal of a setting line by its first key."""
    return "K_" + "".join(letter if letter.isalnum() else "_" for letter in key)


@cache
def _paragraphs() -> dict[str, str]:
    """The rules of each keyword: the grammar file has a paragraph for one."""
    lines = grammar_file("blocks.lark").read_text(encoding="utf-8").split("\n")
    text = "\n".join(line for line in lines if not line.startswith("//"))
    return {paragraph.partition(":")[0]: paragraph for paragraph in text.strip().split("\n\n")}


@cache
def _parser(rule: str) -> Lark:
    text = _paragraphs()[rule]
    words = (word.strip("()*+?|") for word in text.split())
    terminals = sorted({word for word in words if word.isupper()})
    return Lark(f"{text}\n%declare {' '.join(terminals)}\n", start=rule, parser="lalr", lexer="basic")


def parse(rule: str, contents: list[Content]) -> tuple[Node, list[Mismatch]]:
    """The tree of a block under its rule.

    A line that does not fit is reported. If putting in a missing line before it makes it fit, that is done; else, and
    for text that may be anything, the line is left out.
    """
    run = _Run(cast("_Cursor", _parser(rule).parse_interactive()))
    for index, content in enumerate(contents):
        run.feed(index, content)
    tree = run.finish()
    return _node(tree, contents), run.mismatches


@dataclass(slots=True)
class _Run:
    """One pass over the lines of a block. `known` remembers how a state recovers from a terminal."""

    cursor: _Cursor
    mismatches: list[Mismatch] = field(default_factory=list)
    known: dict[tuple[object, ...], tuple[tuple[str, ...], str]] = field(default_factory=dict)

    def feed(self, index: int, content: Content) -> None:
        """Go on by one line; where it does not fit, feed what is missing before it, or leave it out."""
        token = Token(content.terminal, "", start_pos=index)
        try:
            self.cursor.feed_token(token)
        except UnexpectedToken:
            expected, missing = self._recovery(content.terminal)
            missing = "" if content.text else missing
            self.mismatches.append(Mismatch(content, expected, missing))
            if missing:
                self.cursor.feed_token(Token(missing, ""))
                self.cursor.feed_token(token)

    def finish(self) -> Tree[Token]:
        """The tree, with the mandatory lines that the end of the block lacks."""
        missing: list[str] = []
        expected = tuple(sorted(self.cursor.accepts()))
        while END not in self.cursor.accepts():
            missing.append(min(self.cursor.accepts()))
            self.cursor.feed_token(Token(missing[-1], ""))
        if missing:
            self.mismatches.append(Mismatch(None, expected, missing[0]))
        return cast("Tree[Token]", self.cursor.feed_eof())

    def _recovery(self, terminal: str) -> tuple[tuple[str, ...], str]:
        """What was expected instead of a terminal, and which of it makes the terminal fit, or ""."""
        state = (*self.cursor.parser_state.state_stack, terminal)
        if state not in self.known:
            expected = tuple(sorted(self.cursor.accepts()))
            self.known[state] = expected, next((one for one in expected if self._fits(one, terminal)), "")
        return self.known[state]

    def _fits(self, missing: str, terminal: str) -> bool:
        if missing == END:
            return False
        trial = self.cursor.copy(deepcopy_values=False)
        trial.parser_state.parse_conf = copy(trial.parser_state.parse_conf)
        trial.parser_state.parse_conf.callbacks = {}  # nothing is built: the trees are shared with the real parser
        trial.feed_token(Token(missing, ""))
        return terminal in trial.accepts()


def _node(tree: Tree[Token], contents: list[Content]) -> Node:
    """Our own tree; a line that was put in has no content."""
    return Node(str(tree.data), list(_children(tree, contents)))


def _children(tree: Tree[Token], contents: list[Content]) -> Iterator[Node | Content]:
    for child in tree.children:
        if isinstance(child, Tree):
            yield _node(child, contents)
        elif child.start_pos is not None:
            yield contents[child.start_pos]
