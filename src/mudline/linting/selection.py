"""Which rules run."""

from __future__ import annotations

from collections.abc import Iterable

from mudline.linting.registry import Rule, find, rules
from mudline.spelling import nearest


class UnknownRule(ValueError):  # noqa: N818 - the name of the fault, as callers catch it
    """A word that names no rule."""


def select(chosen: Iterable[str] = (), ignored: Iterable[str] = (), also: Iterable[str] = ()) -> tuple[Rule, ...]:
    """The rules that codes, prefixes of codes or slugs choose, and `also`, without those ignored; by code.

    Nothing chosen means all rules but those that are off. A rule that is off runs when a word in `chosen` or `also`
    names it, were it by a prefix. What is ignored is left out, whatever else names it.

    Raises UnknownRule, with a suggestion, for a word that names none.
    """
    wanted = _named(chosen) or {rule.code.code for rule in rules() if not rule.off}
    wanted = (wanted | _named(also)) - _named(ignored)
    return tuple(rule for rule in rules() if rule.code.code in wanted)


def _named(words: Iterable[str]) -> set[str]:
    found: set[str] = set()
    for word in words:
        named = find(word)
        if not named:
            raise UnknownRule(f"{word!r} names no rule{_hint(word)}")
        found |= {rule.code.code for rule in named}
    return found


def _hint(word: str) -> str:
    codes = [rule.code.code for rule in rules()]
    if word.isalpha():  # a code has digits: this was to be a beginning
        codes = sorted({code.rstrip("0123456789") for code in codes})
    slugs = [rule.code.slug for rule in rules()]
    near = nearest(word, slugs) or nearest(word, codes)
    return f": did you mean {near}?" if near else ": `mudline rules` lists all rules"
