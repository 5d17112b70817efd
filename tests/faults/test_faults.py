"""How well the linter finds single faults, and how little it blames in legal decks."""

from __future__ import annotations

from functools import cache

import pytest

from mudline.diagnostics import Severity
from tests.faults import report
from tests.faults.known import BURIED, MISSED
from tests.faults.rates import KINDS, Outcome, Run, run

LEAST_FOUND, MOST_BURIED, MOST_FALSE = 0.98, 0.01, 0.02
"""Shares of the faults, and of the legal decks."""


@cache
def done() -> Run:
    return run()


def _kinds(outcome: Outcome) -> set[str]:
    return {fault.kind.slug for fault, each, _ in done().outcomes if each is outcome}


def test_there_are_many_kinds_faults_and_legal_decks_in_all_units() -> None:
    decks = {fault.deck.name: fault.deck.units for fault, _, _ in done().outcomes}
    assert len(KINDS) == len({kind.slug for kind in KINDS}) >= 60
    assert len(done().outcomes) >= 250
    assert done().decks >= 60
    assert set(decks.values()) == {"metric", "imperial", "user"}


def test_every_kind_happens_to_a_deck_and_says_what_was_done() -> None:
    assert {fault.kind.slug for fault, _, _ in done().outcomes} == {kind.slug for kind in KINDS}
    assert all(kind.did.endswith(".") and kind.codes for kind in KINDS)
    assert all(fault.lines for fault, _, _ in done().outcomes)


@pytest.mark.untraced
def test_faults_are_found_at_their_place() -> None:
    found = sum(outcome is not Outcome.MISSED for _, outcome, _ in done().outcomes)
    assert found >= LEAST_FOUND * len(done().outcomes)


def test_findings_that_follow_do_not_bury_them() -> None:
    others = [outcome for fault, outcome, _ in done().outcomes if fault.kind.slug not in BURIED]
    assert others.count(Outcome.BURIED) <= MOST_BURIED * len(others)


def test_what_is_missed_or_buried_is_known() -> None:
    assert _kinds(Outcome.MISSED) == set(MISSED)
    assert _kinds(Outcome.BURIED) == set(BURIED)


def test_legal_decks_have_no_false_error_and_hardly_a_warning() -> None:
    assert not [finding for _, finding in done().false if finding.severity is Severity.ERROR]
    assert len({deck.name for deck, _ in done().false}) <= MOST_FALSE * done().decks


def test_the_rates_in_the_documentation_are_those_of_this_run() -> None:
    assert report.page(done()) == report.PAGE.read_text(encoding="utf-8")
