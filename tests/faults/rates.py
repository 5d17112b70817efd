"""Runs the linter over all legal decks and all faults, and says what it found, missed, buried and blamed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from tempfile import TemporaryDirectory
from zlib import crc32

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.diagnostics import Diagnostic, Severity
from tests.faults.draft import Draft, NotHere
from tests.faults.kind import KINDS, Kind
from tests.faults.legal import LegalDeck, legal_decks

PER_KIND = 4
"""Decks that a fault of one kind is done to, of different units where there are such decks."""


class Outcome(StrEnum):
    """What became of a fault: a buried one is found, and more than one other finding stands beside it."""

    FOUND = "found"
    BURIED = "buried"
    MISSED = "missed"


@dataclass(frozen=True)
class Fault:
    """One fault in one deck: the damaged text, and the lines at which it must be found."""

    kind: Kind
    deck: LegalDeck
    text: str
    lines: frozenset[int]


@dataclass
class Run:
    """What the linter said: the outcome of every fault, and the findings in legal decks that are no infos."""

    outcomes: list[tuple[Fault, Outcome, list[Diagnostic]]] = field(default_factory=list)
    false: list[tuple[LegalDeck, Diagnostic]] = field(default_factory=list)
    decks: int = 0


def faults(decks: list[LegalDeck]) -> Iterator[Fault]:
    """All faults: every kind in up to `PER_KIND` of the decks in which it can happen."""
    for kind in KINDS:
        possible = [fault for deck in decks if (fault := damaged(kind, deck))]
        possible.sort(key=lambda fault: crc32(f"{fault.kind.slug} {fault.deck.name}".encode()))
        rank: Counter[str] = Counter()
        order: list[tuple[int, Fault]] = []
        for fault in possible:
            order.append((rank[fault.deck.units], fault))
            rank[fault.deck.units] += 1
        yield from (fault for _, fault in sorted(order, key=lambda each: each[0])[:PER_KIND])


def damaged(kind: Kind, deck: LegalDeck) -> Fault | None:
    """A deck with a fault of a kind; None where the fault cannot happen."""
    draft = Draft(deck)
    try:
        kind.damage(draft)
    except NotHere:
        return None
    return Fault(kind, deck, draft.text, draft.expected)


def run() -> Run:
    """Lint everything, in this process."""
    decks = legal_decks()
    done = Run(decks=len(decks))
    with TemporaryDirectory() as name:
        folder = Path(name)
        own: dict[str, Counter[str]] = {}
        for deck in decks:
            for file, data in deck.files.items():
                (folder / file).write_bytes(data)
            found = _lint(deck, deck.data, folder)
            own[deck.name] = Counter(each.code for each in found)
            done.false += [(deck, each) for each in found if each.severity is not Severity.INFO]
        for fault in faults(decks):
            found = _lint(fault.deck, fault.text.encode(), folder)
            done.outcomes.append((fault, _outcome(fault, found, own[fault.deck.name]), found))
    return done


def _lint(deck: LegalDeck, data: bytes, folder: Path) -> list[Diagnostic]:
    return lint_bytes(data, f"{deck.name}.{deck.suffix}", select(), folder=folder)


def _outcome(fault: Fault, found: list[Diagnostic], own: Counter[str]) -> Outcome:
    """A legal deck's own infos are no others; all other findings are, of whatever severity."""
    if not any(_says(fault, each) for each in found):
        return Outcome.MISSED
    new = Counter(each.code for each in found) - own
    return Outcome.FOUND if new.total() <= 2 else Outcome.BURIED


def _says(fault: Fault, finding: Diagnostic) -> bool:
    severe = finding.severity is not Severity.INFO
    return severe and finding.code in fault.kind.codes and finding.line in fault.lines
