"""Which rules run."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from mudline.lint.registry import Rule, find, rules


class UnknownRule(ValueError):
    """A word that names no rule."""


def select(chosen: Iterable[str] = (), ignored: Iterable[str] = (), also: Iterable[str] = ()) -> tuple[Rule, ...]:
    """The rules that codes, prefixes or slugs choose (none: all), and `also`, without those ignored.

    Raises UnknownRule, with a suggestion, for a word that names none.
    """
    wanted = _named(chosen) or {rule.code.code for rule in rules()}
    wanted = (wanted | _named(also)) - _named(ignored)
    return tuple(rule for rule in rules() if rule.code.code in wanted)


def _named(words: Iterable[str]) -> set[str]:
    found: set[str] = set()
    for word in words:
        named = find(word)
        if not named:
            known = [name for rule in rules() for name in (rule.code.code, rule.code.slug)]
            near = get_close_matches(word.upper(), known, 1) or get_close_matches(word.lower(), known, 1)
            hint = f": did you mean {near[0]}?" if near else ": `mudline rules` lists all rules"
            raise UnknownRule(f"{word!r} names no rule{hint}")
        found |= {rule.code.code for rule in named}
    return found
