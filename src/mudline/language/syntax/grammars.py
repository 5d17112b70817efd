"""Grammars of the package as lark parsers, from tables in the package; without tables they are compiled."""

from __future__ import annotations

import pickle
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any, cast

import lark
from lark import Lark, Transformer
from lark.grammar import NonTerminal
from lark.load_grammar import Grammar, load_grammar

from mudline.basics.files import write_atomically
from mudline.basics.resources import grammar_file

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
    grammar, _ = load_grammar(_text(name), f"{name}.lark", [], global_keep_all_tokens=False)
    return cast("Grammar", grammar)


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
