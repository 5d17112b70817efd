"""Blocks with lines that do not fit the rule of their keyword: which lines are left out or missing, found by lark."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from functools import cache

from lark import Lark, Token, Tree, UnexpectedToken
from lark.lexer import Lexer
from lark.parsers.lalr_interactive_parser import InteractiveParser

from mudline.keywords.grammar import END, Content, Mismatch, Node, rules_below, terminals_below
from mudline.syntax.scanning import kept_parser


class _Given(Lexer):
    """No lexer: the tokens are fed one by one."""

    def __init__(self, _configuration: object) -> None:
        pass

    def lex(self, lexer_state: object, parser_state: object) -> Iterator[Token]:  # noqa: ARG002 - lark's signature
        """Nothing to cut."""
        return iter(())


@cache
def _parser(rule: str) -> Lark:
    """The parser of a rule and of those it leads to: the whole grammar takes as long to compile for each keyword."""
    part = f"{rules_below(rule)}%declare {' '.join(sorted(set(terminals_below(rule))))}\n"
    return kept_parser(rule, part, start=rule, lexer=_Given, keep_all_tokens=True, maybe_placeholders=False)


def by_lines(rule: str, contents: list[Content], *, insert: bool = True) -> tuple[Node, list[Mismatch]]:
    """Return the tree of a block line by line, whatever fits.

    A line that does not fit is left out, unless putting in a missing line before it makes it fit; each is reported.
    In a block with lines of unknown form none is missing for certain: there nothing is to `insert`.
    """
    parser = _parser(rule).parse_interactive()
    mismatches: list[Mismatch] = []
    for index, content in enumerate(contents):
        token = Token(content.terminal, "", start_pos=index)
        try:
            parser.feed_token(token)
        except UnexpectedToken:
            expected = tuple(sorted(parser.accepts()))
            mismatches.append(_recover(parser, token, content) if insert else Mismatch(content, expected, ""))
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
        if missing != END and _takes(parser, Token(missing, ""), token):
            parser.feed_token(Token(missing, ""))
            parser.feed_token(token)
            return Mismatch(content, expected, missing)
    return Mismatch(content, expected, "")


def _takes(parser: InteractiveParser, *tokens: Token) -> bool:
    """Whether a parser takes some tokens; the trial makes no tree, so that nothing has to be copied for it."""
    state = parser.parser_state
    rules = copy(state.parse_conf)
    rules.callbacks = {}
    fresh = type(state)(rules, state.lexer, [*state.state_stack], [*state.value_stack])
    trial = InteractiveParser(parser.parser, fresh, parser.lexer_thread)
    try:
        for token in tokens:
            trial.feed_token(token)
    except UnexpectedToken:
        return False
    return True


def _complete(parser: InteractiveParser) -> tuple[Tree[Token], Mismatch]:
    """Feed the mandatory lines that the end of a block lacks."""
    expected = tuple(sorted(parser.accepts()))
    fed: list[str] = []
    while END not in parser.accepts():
        fed.append(_next_needed(parser, fed))
        parser.feed_token(Token(fed[-1], ""))
    return parser.feed_eof(), Mismatch(None, expected, fed[0])


def _next_needed(parser: InteractiveParser, fed: list[str]) -> str:
    """A line that ends the block, or one that was not put in yet: of lines that may be repeated there is no end."""
    options = sorted(map(str, parser.accepts()))
    for option in options:
        trial = parser.copy()
        trial.feed_token(Token(option, ""))
        if END in trial.accepts():
            return option
    return next((option for option in options if option not in fed), options[0])


def _node(tree: Tree[Token], contents: list[Content]) -> Node:
    """Our own tree; a line that was put in has no content."""
    children: list[Node | Content] = []
    for child in tree.children:
        if isinstance(child, Tree):
            children.append(_node(child, contents))
        elif child.start_pos is not None:
            children.append(contents[child.start_pos])
    return Node(str(tree.data), children)
