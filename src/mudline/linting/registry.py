"""All rules: the checks of reading and resolving, rules that only advise, and those of plugins; choosing among them."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from mudline.codes import all_codes
from mudline.diagnostics import PluginError
from mudline.linting import plugins
from mudline.linting.rule import RULES, Noticed, Rule, add, described_by
from mudline.resources import modules_of
from mudline.scene.checks import all_checks
from mudline.spelling import nearest


class UnknownRule(ValueError):  # noqa: N818 - the name of the fault, as callers catch it
    """A word that names no rule."""


@cache
def _collected() -> tuple[tuple[Rule, ...], tuple[str, ...]]:
    declared = {code.code: (code, code.page) for code in all_codes() if code.page}
    for found in all_checks():
        declared.setdefault(found.code.code, (found.code, found.find.__doc__ or ""))
    for code, page in declared.values():
        add(described_by(code, Noticed(code), page))
    modules_of("mudline.linting.rules")
    faults = plugins.load(RULES)
    return tuple(RULES[code] for code in sorted(RULES)), faults


def rules() -> tuple[Rule, ...]:
    """All rules, by code, those of installed plugins among them.

    Raises PluginError when a plugin cannot be used: a run with fewer rules than people believe is worse than none.
    """
    found, faults = _collected()
    if faults:
        raise PluginError(faults)
    return found


def find(word: str) -> list[Rule]:
    """The rules that a code, a prefix of a code or a slug names, in any case."""
    wanted = word.strip()
    code, slug = wanted.upper(), wanted.lower()
    exact = [found for found in rules() if code == found.code.code or slug == found.code.slug]
    if exact or not wanted.isalnum():
        return exact
    return [found for found in rules() if found.code.code.startswith(code)]


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
