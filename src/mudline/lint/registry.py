"""What a rule is, and the list of all rules."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from importlib import import_module

from mudline.diagnostics import Code, Problem
from mudline.lint.context import LintContext

Check = Callable[[LintContext], Iterable[Problem]]

_MODULES = ("syntax_lines", "syntax_fields", "syntax_words", "references", "curves", "seabed", "legacy")
_HEADINGS = re.compile(r"^(Bad|Good|Finds|File):[ \t]*(.*)$", re.MULTILINE)
_RULES: dict[str, Rule] = {}


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule: its code, the function that finds, and what its docstring says.

    `title` is the first sentence, `why` the text behind it, `bad` a deck that it finds something in at `place` (line and
    column), `good` the same deck mended; `file` is the name that the examples are read under.
    """

    code: Code
    check: Check
    title: str
    why: str
    bad: str
    good: str
    place: tuple[int, int]
    file: str


def rule(code: Code) -> Callable[[Check], Check]:
    """Register a function as the rule of a code. Its docstring holds `Bad:`, `Good:` and `Finds: line:column`."""

    def register(check: Check) -> Check:
        _RULES[code.code] = _described(code, check)
        return check

    return register


def _described(code: Code, check: Check) -> Rule:
    text = inspect.getdoc(check) or ""
    parts = _HEADINGS.split(text)
    title, _, why = parts[0].strip().partition("\n")
    found = {name: (line + body) if name in ("Finds", "File") else body for name, line, body in _triples(parts[1:])}
    line, column = (int(number) for number in found["Finds"].strip().split(":"))
    file = found.get("File", "deck.keyxm").strip()
    bad, good = (_example(found[name]) for name in ("Bad", "Good"))
    return Rule(code, check, title.strip(), why.strip(), bad, good, (line, column), file)


def _triples(parts: list[str]) -> Iterable[tuple[str, str, str]]:
    return zip(parts[0::3], parts[1::3], parts[2::3], strict=True)


def _example(body: str) -> str:
    """The indented lines of an example, without their indentation."""
    lines = body.strip("\n").rstrip().splitlines()
    return "".join(f"{line.removeprefix('    ')}\n" for line in lines)


@cache
def rules() -> tuple[Rule, ...]:
    """All rules, by code."""
    for module in _MODULES:
        import_module(f"mudline.lint.rules.{module}")
    return tuple(_RULES[code] for code in sorted(_RULES))


def find(word: str) -> list[Rule]:
    """The rules that a code, a prefix of a code or a slug names."""
    wanted = word.strip()
    exact = [found for found in rules() if wanted.upper() == found.code.code or wanted.lower() == found.code.slug]
    if exact or not wanted.isalnum() or not wanted:
        return exact
    return [found for found in rules() if found.code.code.startswith(wanted.upper())]


