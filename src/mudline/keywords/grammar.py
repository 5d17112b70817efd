"""Level two: a keyword's rule over the lines of level one, read from the grammar when a deck has the keyword.

Lines that fit are read here, in a hundredth of the time that lark takes to compile the rule; the tree is the same. Of
other lines `mudline.keywords.recovery` finds which are wrong.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import NamedTuple, cast

from mudline.diagnostics import Span
from mudline.resources import grammar_file

END = "$END"
ROW = "ROW"

_NAME = re.compile(r"\b[a-z_][a-z_0-9]*+")
_OPENING = re.compile(rf"({_NAME.pattern})\s*:")
_TERMINAL = re.compile(r"\b[A-Z][A-Z_0-9]*+")
_WORD = re.compile(rf"\s*({_NAME.pattern}|{_TERMINAL.pattern}|[()|*+?])\s*")

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


class Node(NamedTuple):
    """A rule with the contents and rules below it."""

    rule: str
    children: list[Node | Content]


class Mismatch(NamedTuple):
    """A line that does not fit; `found` None is the end of the block. `missing`: the line that was left out instead."""

    found: Content | None
    expected: tuple[str, ...]
    missing: str


class Line(NamedTuple):
    """One of a sequence of terminals, with its index."""

    terminal: str
    at: int


class Tree(NamedTuple):
    """A rule with the terminals and rules below it: a `Node` of any lines that are these terminals."""

    rule: str
    children: list[Tree | Line]


# ---------------------------------------------------------------------------------------- the rules as they are written


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


def rules_below(rule: str) -> str:
    """Return the text of a rule and of those it leads to."""
    wanted, found = [rule], dict[str, str]()
    while wanted:
        name = wanted.pop()
        if name not in found:
            found[name] = _rules()[name]
            wanted += sorted(set(_NAME.findall(found[name])) & _rules().keys())
    return "".join(found.values())


def terminals_below(rule: str) -> list[str]:
    """Return the terminals of a rule and of those it leads to, each as often as it is written."""
    return _TERMINAL.findall(rules_below(rule))


def terminal_of(key: str) -> str:
    """The terminal of a setting line by its first key."""
    return "K_" + "".join(letter if letter.isalnum() else "_" for letter in key)


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


@cache
def first_terminals(rule: str) -> frozenset[str]:
    """Return the terminals with which the lines of a rule may begin."""
    words = _WORD.findall(_rules()[rule].partition(":")[2])
    return frozenset(_firsts(words[::-1])[0])


def _firsts(words: list[str]) -> tuple[set[str], bool]:
    """The terminals at the beginning of what stands before a closing bracket, and whether it may be left out."""
    found: set[str] = set()
    empty = False
    open_ = True
    while words and words[-1] != ")":
        word = words.pop()
        if word == "|":
            empty, open_ = empty or open_, True
            continue
        first, optional = _firsts(words) if word == "(" else ({word}, False)
        if word == "(":
            words.pop()
        elif not word.isupper():
            first = set(first_terminals(word))
        if words and words[-1] in {"*", "+", "?"}:
            optional = words.pop() != "+" or optional
        found |= first if open_ else set()
        open_ = open_ and optional
    return found, empty or open_


# ----------------------------------------------------------------------------------------------- lines that fit a rule

_Take = Callable[[Sequence[str], int, list[Tree | Line]], int]
"""Takes terminals from an index on, adds what they are, and returns the next index; -1 where they do not fit."""


@lru_cache(maxsize=1024)
def fitting(rule: str, terminals: tuple[str, ...]) -> Tree | None:
    """Return the tree of lines by their terminals, if all of them fit."""
    found: list[Tree | Line] = []
    if _named(rule)(terminals, 0, found) != len(terminals):
        return None
    return cast("Tree", found[0])


@cache
def _named(name: str) -> _Take:
    """Take a terminal, or the lines of a rule; what is below a rule whose name begins with _ is added without it."""

    def terminal(given: Sequence[str], start: int, found: list[Tree | Line]) -> int:
        if start == len(given) or given[start] != name:
            return -1
        found.append(Line(name, start))
        return start + 1

    if name.isupper():
        return terminal
    body = _body(name)

    def rule(given: Sequence[str], start: int, found: list[Tree | Line]) -> int:
        below: list[Tree | Line] = []
        end = body(given, start, below)
        found.append(Tree(name, below))
        return end

    return body if name.startswith("_") else rule


def _body(name: str) -> _Take:
    """What stands behind the colon of a rule."""
    text = _rules()[name].partition(":")[2]
    words: list[str] = []
    at = 0
    while at < len(text):
        word = _WORD.match(text, at)
        if word is None:
            raise ValueError(f"the rule {name} may have names, brackets, |, *, + and ? only, not {text[at:].strip()!r}")
        words.append(word[1])
        at = word.end()
    return _choice(words[::-1])


def _choice(words: list[str]) -> _Take:
    """Take the first of the sequences before a closing bracket that fits; `words` are in reverse, and are used up."""
    options = [_sequence(words)]
    while words and words[-1] == "|":
        words.pop()
        options.append(_sequence(words))

    def take(given: Sequence[str], start: int, found: list[Tree | Line]) -> int:
        before = len(found)
        for option in options:
            end = option(given, start, found)
            if end >= 0:
                return end
            del found[before:]
        return -1

    return take if len(options) > 1 else options[0]


def _sequence(words: list[str]) -> _Take:
    items: list[_Take] = []
    while words and words[-1] not in {"|", ")"}:
        word = words.pop()
        item = _choice(words) if word == "(" else _named(word)
        if word == "(":
            words.pop()
        if words and words[-1] in {"*", "+", "?"}:
            item = _repeated(item, words.pop())
        items.append(item)

    def take(given: Sequence[str], start: int, found: list[Tree | Line]) -> int:
        for item in items:
            start = item(given, start, found)
            if start < 0:
                return -1
        return start

    return take if len(items) > 1 else items[0]


def _repeated(item: _Take, sign: str) -> _Take:
    """As many as fit: lark, too, goes on with a list wherever it can."""

    def take(given: Sequence[str], start: int, found: list[Tree | Line]) -> int:
        first, before = start, len(found)
        while (end := item(given, start, found)) > start:
            start, before = end, len(found)
            if sign == "?":
                return start
        del found[before:]
        return -1 if sign == "+" and start == first else start

    return take


# ------------------------------------------------------------------------------------------------- the tree of a block


def tree_of(rule: str, contents: list[Content]) -> Node | None:
    """Return the tree of a block under its rule, if all of its lines fit."""
    terminals = tuple([content.terminal for content in contents])
    tree = (fitting if len(contents) <= SMALL else fitting.__wrapped__)(rule, terminals)
    return tree and _node(tree, contents)


def _node(tree: Tree, contents: list[Content]) -> Node:
    below = [_node(child, contents) if isinstance(child, Tree) else contents[child.at] for child in tree.children]
    return Node(tree.rule, below)
