"""How well the linter finds single faults, and how little it blames in legal decks."""

from __future__ import annotations

import pytest

from mudline.language.diagnostics import Severity
from tests.faults import report
from tests.faults.kind import KINDS, MODULES
from tests.faults.known import BURIED, MISSED
from tests.faults.rates import Outcome, Run, run

LEAST_FOUND, MOST_BURIED, MOST_FALSE = 0.965, 0.025, 0.02
"""Shares of the faults, and of the legal decks."""


def test_every_kind_says_what_was_done_and_what_is_expected() -> None:
    assert len(KINDS) == len({kind.slug for kind in KINDS}) >= 60
    assert all(kind.did.endswith(".") and kind.codes for kind in KINDS)
    functions = {
        name.replace("_", "-")
        for module in MODULES
        for name, found in vars(module).items()
        if getattr(found, "__module__", "") == module.__name__ and not name.startswith("_")
    }
    assert functions < {kind.slug for kind in KINDS}, "a function without its row in kinds.txt"


@pytest.mark.slow
@pytest.mark.untraced
def test_faults_are_found_and_legal_decks_are_not_blamed() -> None:
    """One test, as each of its parts needs the same run of some seconds."""
    done = run()
    _assert_size(done)
    _assert_found(done)
    _assert_known(done)
    _assert_not_blamed(done)
    assert report.page(done) == report.PAGE.read_text(encoding="utf-8"), "run make docs"


def _assert_size(done: Run) -> None:
    """Enough faults of all kinds, in enough decks of all units, each with its place."""
    assert {fault.deck.units for fault, _, _ in done.outcomes} == {"metric", "imperial", "user"}
    assert {fault.kind.slug for fault, _, _ in done.outcomes} == {kind.slug for kind in KINDS}
    assert all(fault.lines for fault, _, _ in done.outcomes)
    assert len(done.outcomes) >= 250
    assert done.decks >= 60


def _assert_found(done: Run) -> None:
    found = sum(outcome is not Outcome.MISSED for _, outcome, _ in done.outcomes)
    assert found >= LEAST_FOUND * len(done.outcomes)
    buried = sum(outcome is Outcome.BURIED for _, outcome, _ in done.outcomes)
    assert buried <= MOST_BURIED * len(done.outcomes)


def _assert_known(done: Run) -> None:
    """The lists of what is missed and buried name each such kind, and no other one."""
    assert _kinds(done, Outcome.MISSED) == set(MISSED)
    assert _kinds(done, Outcome.BURIED) == set(BURIED)


def _kinds(done: Run, outcome: Outcome) -> set[str]:
    return {fault.kind.slug for fault, each, _ in done.outcomes if each is outcome}


def _assert_not_blamed(done: Run) -> None:
    assert not [finding for _, finding in done.false if finding.severity is Severity.ERROR]
    assert len({deck.name for deck, _ in done.false}) <= MOST_FALSE * done.decks
