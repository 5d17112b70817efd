"""Which rules concern a keyword: found by asking the rules, so that no list has to be kept.

A rule concerns a keyword when its text names the keyword, when its bad deck has the finding in such a block, or when it
finds something in the keyword's example, standing alone or spoilt in one of the ways that happen to decks. The rules
on syntax (SYN) hold for every keyword and are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import OpaqueKeyword
from mudline.language.rules import Rule

Declared = type[Block] | OpaqueKeyword

_NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d*)?(?:E\d+)?(?![\w.])")
_LAST = re.compile(rf"{_NUMBER.pattern}$", re.MULTILINE)
_ALL = re.compile(r"=ALL\b")


def keyword_of(declared: Declared) -> str:
    """The name of a keyword."""
    return declared.keyword if isinstance(declared, OpaqueKeyword) else str(declared.model_fields["keyword"].default)


def rules_of(declared: Declared) -> list[Rule]:
    """The rules that concern a keyword, by code."""
    own = [rule for rule in rules() if not rule.code.code.startswith(("SYN", "STY"))]
    found = _in_examples(declared)
    return [rule for rule in own if rule.code.code in found or keyword_of(declared) in _named_by(rule)]


@cache
def _named_by(rule: Rule) -> set[str]:
    """The keywords in the text of a rule, and the one that its bad deck has the finding in."""
    named = set(_keyword().findall(f"{rule.page.title}\n{rule.page.why}"))
    return named | set(_keyword().findall("\n".join(rule.page.bad.splitlines()[: rule.page.place[0]]))[-1:])


@cache
def _keyword() -> re.Pattern[str]:
    """Any known keyword with its asterisk, the longest first."""
    names = sorted(catalogue.keywords(), key=len, reverse=True)
    return re.compile(rf"\*({'|'.join(map(re.escape, names))})(?![A-Z-])")


def _in_examples(declared: Declared) -> set[str]:
    """Codes of what is found in the lines of the example and its variations."""
    return {code for deck in _variations(declared) for code in _codes_in(deck)}


@cache
def _codes_in(deck: str) -> frozenset[str]:
    return frozenset(found.code for found in lint_bytes(deck.encode(), "deck.keyxm", rules()) if found.line > 1)


def _variations(declared: Declared) -> Iterator[str]:
    """The example alone, and spoilt: no such set, cut short, lines twice, other values, negative ones, huge ones."""
    keyword, *lines = declared.example.splitlines()
    others = [_LAST.sub(r"\g<0>7", line) for line in lines]
    huge = [_LAST.sub(("1.7E308", "-1.7E308")[index % 2], line) for index, line in enumerate(lines)]
    spoilt = [
        [_ALL.sub("=Nowhere", line) for line in lines],
        lines + lines,
        [line for line in lines for _ in range(2)],
        [each for pair in zip(lines, others, strict=True) for each in dict.fromkeys(pair)],
        *([pattern.sub(r"-\g<0>", line) for line in lines] for pattern in (_NUMBER, _LAST)),
        huge,
        *(lines[:fewer] for fewer in range(1, len(lines))),
    ]
    for deck in (lines, *spoilt):
        yield "\n".join([f"${declared.sections[0]}", keyword, *deck, ""])
