"""The golden corpus: every deck gives the findings beside it, and survives all that mudline does with decks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import pytest

from mudline.checks.engine import Fixing, LintSettings
from mudline.checks.fixing import fix_bytes
from mudline.editing.formatting.document import formatted
from mudline.language.deck.loading import dump, load_bytes, load_path
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError, Diagnostic, Severity
from tests.checks import corpus
from tests.language.deck.test_forms import has_refused_values

DECKS = corpus.decks()
GOOD = [deck for deck in DECKS if corpus.name_of(deck).startswith("good/")]
NOT_SHOWN: set[str] = set()
"""Codes that no deck of the corpus shows."""
SUFFIXES = {"metric": ".keyxm", "imperial": ".keyxi", "user": ".keyx"}
"""Of a keyword text, by the units that it tells."""

each_deck = pytest.mark.parametrize("deck", DECKS, ids=corpus.name_of)


@cache
def as_written(deck: Path) -> Deck:
    """The deck of a file; raises DeckError for JSON or YAML that is no deck."""
    return load_path(deck)


def can_be_read(deck: Path) -> bool:
    """Whether reading a deck finds no error in it."""
    try:
        found = as_written(deck).problems
    except DeckError:
        return False
    return all(problem.weight is not Severity.ERROR for problem in found)


found_in = cache(corpus.found_in)
READABLE = [deck for deck in DECKS if can_be_read(deck)]
FIXABLE = [deck for deck in DECKS if any(one.fix for one in found_in(deck))]


def counted(found: Iterable[Diagnostic]) -> Counter[str]:
    """How many findings each code has, but for those of style, which the layout of a text brings and takes."""
    return Counter(one.code for one in found if not one.code.startswith("STY"))


def errors(found: Iterable[Diagnostic]) -> int:
    return sum(one.severity is Severity.ERROR for one in found)


# --------------------------------------------------------------------------------------------------------- findings


@each_deck
def test_a_deck_gives_the_findings_beside_it(deck: Path) -> None:
    assert corpus.beside(deck).exists(), "python -m tests.checks.corpus writes it"
    given = corpus.expected(deck)
    assert corpus.lines(found_in(deck), deck) == given.findings
    assert corpus.beside(deck).read_text(encoding="utf-8") == given.text()


@pytest.mark.parametrize("deck", GOOD, ids=corpus.name_of)
def test_a_good_deck_is_told_nothing_or_why(deck: Path) -> None:
    given = corpus.expected(deck)
    assert {corpus.severity_of(line) for line in given.findings} <= {"info"}
    assert bool(given.findings) == bool(given.option("why"))


def test_no_file_of_findings_is_left_over() -> None:
    assert {path.with_suffix("") for path in corpus.CORPUS.rglob(f"*{corpus.SUFFIX}")} == set(DECKS)


def test_every_rule_is_shown_by_a_deck() -> None:
    assert corpus.codes_not_shown() == NOT_SHOWN


# ------------------------------------------------------------------------------------------------------------ forms


@pytest.mark.untraced
@pytest.mark.parametrize("deck", READABLE, ids=corpus.name_of)
def test_a_deck_is_the_same_in_every_form(deck: Path) -> None:
    first = as_written(deck)
    for form, suffix in (("keyword", SUFFIXES[first.units]), ("json", ".json"), ("yaml", ".yaml")):
        if form != "keyword" and has_refused_values(first):
            with pytest.raises(DeckError, match="DOC002"):
                dump(first, form)
            continue
        text = dump(first, form).encode()
        again = load_bytes(text, f"{deck.stem}{suffix}", folder=deck.parent)
        assert again.sections == first.sections
        assert again.comments == first.comments
        assert again.preamble == first.preamble
        assert again.units == first.units


@pytest.mark.untraced
@pytest.mark.parametrize("deck", READABLE, ids=corpus.name_of)
def test_layout_is_settled_at_once_and_keeps_the_findings(deck: Path) -> None:
    once = formatted(deck.read_bytes(), deck.name)
    if once != deck.read_bytes():
        assert formatted(once, deck.name) == once
        assert counted(corpus.diagnostics(once, deck, corpus.expected(deck))) == counted(found_in(deck))


@pytest.mark.parametrize("deck", [deck for deck in DECKS if deck not in READABLE], ids=corpus.name_of)
def test_a_deck_with_an_error_of_reading_is_not_laid_out(deck: Path) -> None:
    with pytest.raises(DeckError):
        formatted(deck.read_bytes(), deck.name)


# ------------------------------------------------------------------------------------------------------------ fixes


@pytest.mark.untraced
@pytest.mark.parametrize("deck", FIXABLE, ids=corpus.name_of)
@pytest.mark.parametrize("fixing", [Fixing.SAFE, Fixing.UNSAFE])
def test_fixes_bring_no_error_and_are_soon_done(deck: Path, fixing: Fixing) -> None:
    data, options = deck.read_bytes(), corpus.expected(deck)
    settings = LintSettings(rules=options.rules, dialect=options.dialect, fixing=fixing)
    fixed = fix_bytes(data, deck.name, settings, deck.parent).changed
    if fixed is not None:
        assert errors(corpus.diagnostics(fixed, deck, options)) <= errors(found_in(deck))
        assert fix_bytes(fixed, deck.name, settings, deck.parent).changed is None
