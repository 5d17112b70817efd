"""Grammars of the package as lark parsers, from tables in the package; without tables they are compiled.

The second level of reading is below: the parser of a keyword's rule, applied to the lines of the first level.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Sequence
from copy import copy
from functools import cache, lru_cache
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple, cast

import lark
from lark import Lark, Transformer, Tree, UnexpectedToken
from lark.grammar import NonTerminal
from lark.load_grammar import Grammar, load_grammar
from lark.parsers.lalr_interactive_parser import InteractiveParser

from mudline.basics.files import write_atomically
from mudline.basics.resources import grammar_file
from mudline.language.diagnostics import Span

Makes = type[Transformer[Any, Any]]
"""Class without state, whose methods create the results of the parser in place of a tree."""


@cache
def parser(name: str, start: str = "start", makes: Makes | None = None) -> Lark:
    """Return the LALR parser for a rule of a grammar.

    Compiling a grammar takes ten times as long as loading its tables.
    """
    saved = _tables(name, makes).get(start)
    return Lark.load(BytesIO(saved)) if saved else _compiled(name, start, makes)


def save_tables(name: str, makes: Makes | None = None) -> Path:
    """Write the tables of the parsers for all rules of a grammar beside it; return the file."""
    tables: dict[str, bytes] = {}
    for start in (str(rule) for rule, *_ in definitions(name).rule_defs if not rule.startswith("_")):
        saved = BytesIO()
        _compiled(name, start, makes).save(saved)
        tables[start] = saved.getvalue()
    path = grammar_file(f"{name}.lark").with_suffix(".tables")
    write_atomically(path, pickle.dumps((*_stamp(name, makes), tables)))
    return path


def _compiled(name: str, start: str, makes: Makes | None) -> Lark:
    return Lark(
        _below(definitions(name), start),
        parser="lalr",
        lexer="basic",
        start=start,
        keep_all_tokens=True,
        maybe_placeholders=False,
        transformer=makes and makes(),
    )


@cache
def definitions(name: str) -> Grammar:
    """Return the rules and terminals of a grammar."""
    return cast("Grammar", load_grammar(_text(name), f"{name}.lark", [], global_keep_all_tokens=False)[0])


def _text(name: str) -> str:
    return grammar_file(f"{name}.lark").read_text(encoding="utf-8")


def _stamp(name: str, makes: Makes | None) -> tuple[str, str, str]:
    """Return the key of the tables: version of lark, class of the results, and the grammar."""
    return lark.__version__, f"{makes.__module__}.{makes.__qualname__}" if makes else "", _text(name)


@cache
def _tables(name: str, makes: Makes | None) -> dict[str, bytes]:
    """Return the tables that were created when the package was built; none for another lark, class or grammar."""
    path = grammar_file(f"{name}.tables")
    if not path.exists():
        return {}
    *stamp, tables = pickle.loads(path.read_bytes())  # noqa: S301 - a file of the package
    return tables if tuple(stamp) == _stamp(name, makes) else {}


def _below(grammar: Grammar, start: str) -> Grammar:
    """Return the part of a grammar that a rule needs: lark compiles all rules that it gets."""
    rules = {str(rule[0]): rule for rule in grammar.rule_defs}
    needed: dict[str, None] = {}
    waiting = [start]
    while waiting:
        name = waiting.pop()
        if name not in needed:
            needed[name] = None
            inside = rules[name][2].scan_values(lambda each: isinstance(each, NonTerminal))
            waiting += [inner.name for inner in inside if inner.name in rules]  # other names are aliases
    return Grammar([rules[name] for name in needed], grammar.term_defs, grammar.ignore)


# ------------------------------------------------------------------------------------------------ the lines of a block

END = "$END"
ROW = "ROW"
_FEW = 64
"""Greatest number of lines of a block whose tree is cached: decks hold blocks of the same few forms."""


class Content(NamedTuple):
    """Line of a block, or run of rows, as a token of lark: lark needs only its `type`, the terminal."""

    type: str
    span: Span


Node = Tree[Content]
"""Rule with the contents and rules below it."""


class Mismatch(NamedTuple):
    """Line that does not fit; `found` None is the end of the block, `missing` the line that was left out before it."""

    found: Content | None
    expected: tuple[str, ...]
    missing: str


@cache
def terminal_of(key: str) -> str:
    """Return the terminal of a setting line by its first key."""
    return "K_" + "".join(letter if letter.isalnum() else "_" for letter in key)


@cache
def first_terminals(rule: str) -> frozenset[str]:
    """Return the terminals with which the lines of a rule may begin."""
    return frozenset(_begin(rule).accepts()) - {END}


def _begin(rule: str) -> InteractiveParser:
    return parser("blocks", rule).parse_interactive()


def tree_of(rule: str, contents: Sequence[Content]) -> Node | None:
    """Return the tree of a block under its rule if all of its lines fit, else None."""
    parsed = _parsed if len(contents) <= _FEW else _parsed.__wrapped__
    tree = parsed(rule, tuple([content.type for content in contents]))
    return tree and _with_lines(tree, iter(contents))


def _with_lines(tree: Node, lines: Iterator[Content]) -> Node:
    """Return a tree whose leaves are replaced by other lines, in order."""
    return Tree(
        tree.data, [_with_lines(child, lines) if type(child) is Tree else next(lines) for child in tree.children]
    )


@lru_cache(1024)
def _parsed(rule: str, terminals: tuple[str, ...]) -> Node | None:
    """Return the tree of a sequence of terminals; None if the rule does not fit."""
    state = _begin(rule)
    try:
        _feed(state, *map(_placeless, terminals))
        return cast("Node", state.feed_eof())
    except UnexpectedToken:
        return None


def by_lines(rule: str, contents: Sequence[Content], *, insert: bool = True) -> tuple[Node, list[Mismatch]]:
    """Return the tree of the lines of a block that fit, and the mismatches.

    A line that does not fit is left out, unless it fits after a missing line; both are reported. With `insert` False no
    line counts as missing: so it is in a block with lines of unknown form.
    """
    state = _begin(rule)
    mismatches: list[Mismatch] = []
    for content in contents:
        if _takes(state, content):  # a parser that refuses a token has already closed rules
            _feed(state, content)
            continue
        expected = tuple(sorted(state.accepts()))
        options = (name for name in expected if insert and name != END and _takes(state, _placeless(name), content))
        missing = next(options, "")
        if missing:
            _feed(state, _placeless(missing), content)
        mismatches.append(Mismatch(content, expected, missing))
    if END not in (expected_last := state.accepts()):
        mismatches.append(Mismatch(None, tuple(sorted(expected_last)), _complete(state)))
    return _without_missing(cast("Node", state.feed_eof())), mismatches


def _placeless(terminal: str) -> Content:
    """Return the token of a missing line."""
    return Content(terminal, Span(-1, -1))


def _feed(state: InteractiveParser, *tokens: Content) -> None:
    feed: Any = state.feed_token  # takes whatever has a type
    for token in tokens:
        feed(token)


def _takes(state: InteractiveParser, *tokens: Content) -> bool:
    """Return True if a parser accepts the tokens; the trial builds no tree, so that nothing has to be copied."""
    present = state.parser_state
    rules = copy(present.parse_conf)
    rules.callbacks = {}
    trial = type(present)(rules, present.lexer, [*present.state_stack], [*present.value_stack])
    try:
        for token in tokens:
            trial.feed_token(cast("Any", token), token.type == END)
    except UnexpectedToken:
        return False
    return True


def _complete(state: InteractiveParser) -> str:
    """Feed the mandatory lines that are missing at the end of a block; return the first.

    Each of them is a line that ends the block, or a line that was not inserted yet.
    """
    fed: list[str] = []
    while END not in (options := sorted(state.accepts())):
        ends = (option for option in options if _takes(state, _placeless(option), _placeless(END)))
        fed.append(next(ends, "") or next((option for option in options if option not in fed), options[0]))
        _feed(state, _placeless(fed[-1]))
    return fed[0]


def _without_missing(node: Node) -> Node:
    """Return the tree without missing lines."""
    below = [_without_missing(child) if isinstance(child, Tree) else child for child in node.children]
    return Tree(node.data, [child for child in below if isinstance(child, Tree) or child.span.start >= 0])
