"""The rates as tables, for docs/linting.md and the terminal."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from mudline.language.diagnostics import Severity
from tests.faults.kind import KINDS
from tests.faults.known import BURIED, MISSED
from tests.faults.rates import Outcome, Run

PAGE = Path(__file__).parents[2] / "docs" / "linting.md"
_BEGIN, _END = "<!-- Rates of faults: made by `make docs` -->\n", "<!-- End of the rates -->\n"


def share(part: int, whole: int) -> str:
    """A part in per cent, with one decimal."""
    return f"{100.0 * part / whole:.1f} %" if whole else "-"


def summary(run: Run) -> str:
    """A row a group of kinds, and the total; then the legal decks."""
    head = "| group | kinds | faults | found | missed | buried |\n| --- | --- | --- | --- | --- | --- |\n"
    groups = list(dict.fromkeys(kind.group for kind in KINDS))
    rows = [_counts(group, run, [kind.slug for kind in KINDS if kind.group == group]) for group in groups]
    return head + "".join([*rows, _counts("all", run, [kind.slug for kind in KINDS])])


def _counts(name: str, run: Run, slugs: Iterable[str]) -> str:
    kinds = set(slugs)
    counts = Counter(outcome for fault, outcome, _ in run.outcomes if fault.kind.slug in kinds)
    total = counts.total()
    shares = " | ".join(f"{counts[each]} ({share(counts[each], total)})" for each in _ORDER)
    return f"| {name} | {len(kinds)} | {total} | {shares} |\n"


_ORDER = (Outcome.FOUND, Outcome.MISSED, Outcome.BURIED)


def legal(run: Run) -> str:
    """What was said of the legal decks, in words."""
    errors = {deck.name for deck, each in run.false if each.severity is Severity.ERROR}
    warnings = {deck.name for deck, each in run.false} - errors
    return (
        f"Of the {run.decks} legal decks {len(errors)} have a false error ({share(len(errors), run.decks)}) and "
        f"{len(warnings)} a false warning ({share(len(warnings), run.decks)}).\n"
    )


def mean(run: Run) -> str:
    """How many warnings and errors a fault has, in words."""
    told = sum(each.severity is not Severity.INFO for _, _, found in run.outcomes for each in found)
    return f"A fault has {told / len(run.outcomes):.3f} warnings and errors, on the average.\n"


def by_kind(run: Run) -> str:
    """A row a kind."""
    counts: dict[str, Counter[Outcome]] = {kind.slug: Counter() for kind in KINDS}
    for fault, outcome, _ in run.outcomes:
        counts[fault.kind.slug][outcome] += 1
    head = "| kind | what was done | expected | faults | found | missed | buried |\n" + "| --- " * 7 + "|\n"
    rows = [
        f"| `{kind.slug}` | {_cell(kind.did)} | {', '.join(kind.codes)} | {counts[kind.slug].total()} | "
        f"{' | '.join(str(counts[kind.slug][each]) for each in _ORDER)} |\n"
        for kind in KINDS
    ]
    return head + "".join(rows)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def reasons() -> str:
    """Return the kinds of which faults are missed or buried, with the reason of each, as a list."""
    known = (("missed", MISSED), ("buried", BURIED))
    return "".join(f"{outcome}: {slug}: {reason}\n" for outcome, kinds in known for slug, reason in kinds.items())


def section(run: Run) -> str:
    """What stands in the page, between its two marks."""
    return f"\n{summary(run)}\n{legal(run)}\n"


def page(run: Run) -> str:
    """The text of docs/linting.md with the rates of a run."""
    text = PAGE.read_text(encoding="utf-8")
    parts = re.split(f"(?s)(?<={re.escape(_BEGIN)}).*(?={re.escape(_END)})", text)
    assert len(parts) == 2
    return section(run).join(parts)


def write(run: Run) -> None:
    """Write the rates of a run into docs/linting.md."""
    PAGE.write_text(page(run), encoding="utf-8", newline="\n")
