"""Prints how well faults are found: `python -m tests.faults [--write | --list]`."""

from __future__ import annotations

import sys

from tests.faults import report
from tests.faults.rates import Outcome, Run, run


def main(arguments: list[str]) -> None:
    """Print the rates; with --write also renew them in docs/linting.md, with --list name each fault not just found."""
    done = run()
    if "--write" in arguments:
        report.write(done)
    if "--list" in arguments:
        _list(done)
    sys.stdout.write(f"{report.by_kind(done)}\n{report.reasons()}\n{report.summary(done)}\n")
    sys.stdout.write(report.legal(done) + report.mean(done))


def _list(done: Run) -> None:
    for deck, finding in done.false:
        sys.stdout.write(f"false in {deck.name}: {finding!r}\n")
    for fault, outcome, found in done.outcomes:
        if outcome is not Outcome.FOUND:
            expected = f"{', '.join(fault.kind.codes)} at {', '.join(map(str, sorted(fault.lines)[:8]))}"
            said = ", ".join(f"{each.code} at {each.line}" for each in found[:8])
            sys.stdout.write(f"{outcome}: {fault.kind.slug} in {fault.deck.name}: expected {expected}; found {said}\n")


if __name__ == "__main__":
    main(sys.argv[1:])
