"""Command `mudline set`."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Sequence
from typing import NamedTuple

import click

from mudline.basics.short_repr import counted
from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.checks.rules.slips import CODES, UNT008
from mudline.cli import DONE, FOUND, options
from mudline.cli.changes import print_changes
from mudline.cli.inputs import CHANGED, GivenDecks, Input, Inputs, each_deck, require_text, takes_decks
from mudline.cli.streams import emit, emit_deck, notify, notify_diagnostics, refusing
from mudline.cli.view import View
from mudline.editing.assignment.assigning import Assigned, AssignmentError, assigned
from mudline.editing.assignment.fields import ConditionError, FieldTarget, parse_condition, target_of
from mudline.editing.assignment.paths import Assignment, PathError, WrittenOperand, parse_assignment
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import Diagnostic, Severity
from mudline.language.syntax.edits import TextEdit, edited_bytes
from mudline.language.syntax.source import Source

_CHANGED, _SAME, _WITHOUT, _UNMET, _REFUSED = "changed", "the same already", "without it", "not selected", "refused"
_UNWRITTEN = "not written"


@options.command("set")
@click.argument("assignment", metavar="KEYWORD.FIELD=VALUE")
@options.option(
    "--where",
    "condition",
    metavar="CONDITION",
    help="Change only decks for which this holds, such as 'OCEAN.depth > 100 and UNITS.units == METRIC'.",
)
@options.flag("--force", help="Also set a value that is far outside the usual range in the units of the deck.")
@options.check
@options.diff
@takes_decks()
def command(
    *, assignment: str, decks: GivenDecks, condition: str | None, force: bool, check: bool, diff: bool, view: View
) -> int:
    """Change one value in many decks, in place; comments, columns and all other values stay as written.

    The field is given as in TIME.step=0.05, and that of one record as in SEABED PROPERTIES[set=TDZ].stiffness=50000.
    PATHS are decks, directories, or - for standard input, whose deck is printed. No deck is changed, and the exit code
    is 1, if in any deck the value is an equation, is not unique, is refused by the checks, or would be far outside the
    usual range. New warnings are shown.
    """
    with refusing(PathError):
        change = parse_assignment(assignment)
        target = target_of(change.path, WrittenOperand.of(change.value))
        where = None if condition is None else parse_condition(condition)
    inputs = decks.collect()
    run = _SetRun(change, target, where, decks.units, force, view)
    counts, printed = Counter[str](), list[bytes]()
    planned = list[tuple[Input, int, Sequence[TextEdit]]]()  # with a hash of the content that the edits are for
    for file, data, made in each_deck(inputs, run.change, view, AssignmentError, ConditionError):
        outcome = _REFUSED if made is None else made if isinstance(made, str) else _CHANGED if made.edits else _SAME
        counts[outcome] += 1
        done = made if isinstance(made, Assigned) and made.edits else None
        if file.path is None and not (check or diff):
            printed.append(_edited(file, data, done.edits if done else ()))
        if done is None:
            continue
        words = f"{file.name}:{done.line}: {done.before} -> {done.after}"
        if view.verbose:
            notify(words)
        if check:
            emit([f"would change: {words}\n"])
        if diff:
            print_changes(data, _edited(file, data, done.edits), file.name, view)
        if file.path is not None:
            planned.append((file, hash(data), done.edits))
    if not (check or diff):
        _write(inputs, planned, printed, counts)
    changed = "would be changed" if check or diff else "changed"
    words_of = {_CHANGED: changed} | {outcome: outcome for outcome in (_UNWRITTEN, _SAME, _WITHOUT, _UNMET, _REFUSED)}
    texts = [f"{counts[outcome]} {word}" for outcome, word in words_of.items() if counts[outcome]]
    if texts and not view.quiet:
        click.echo(f"{counted(counts.total(), 'deck')}: {', '.join(texts)}", err=True)
    nowhere = counts[_WITHOUT] and not any(counts[name] for name in (_CHANGED, _UNWRITTEN, _SAME, _REFUSED))
    if nowhere:
        notify(f"no deck has {change.path}")
    would_change = counts[_CHANGED] and (check or diff)
    return max(inputs.code, FOUND if counts[_REFUSED] or nowhere or would_change else DONE)


class _SetRun(NamedTuple):
    """The change of a run, and the decks for which it is made."""

    assignment: Assignment
    target: FieldTarget
    condition: Callable[[Deck], bool] | None
    units: str | None
    force: bool
    view: View

    def change(self, file: Input, data: bytes) -> Assigned | str:
        """Return the changed deck, or the outcome of a deck without a change. Raises errors for refused decks."""
        if form_of(file.name) != KEYWORD:
            raise AssignmentError("only decks in keyword text are changed: convert it first")
        deck = require_text(load_bytes(data, file.name, units=self.units, folder=file.folder))
        if self.condition is not None and not self.condition(deck):
            return _UNMET
        change = assigned(deck, self.assignment, self.target, self.units)
        if change is None:
            return _WITHOUT
        if change.edits:
            self._judge(file, data, change)
        return change

    def _judge(self, file: Input, data: bytes, change: Assigned) -> None:
        """Show warnings that a deck has only with its new value; raises AssignmentError for an unusual value."""
        after = self._findings(file, _edited(file, data, change.edits))
        if not after:
            return
        before = {(finding.code, finding.line, finding.message) for finding in self._findings(file, data)}
        new = [finding for finding in after if (finding.code, finding.line, finding.message) not in before]
        unusual = [finding for finding in new if finding.code in CODES and finding.line == change.line]
        if unusual and not self.force:
            what = f"{self.target.path} would be unusual in the units of the deck"
            raise AssignmentError(f"{what}: correct the value, or give --force", change.line, unusual)
        if not self.view.quiet:
            remarks = [finding for finding in new if finding.code == UNT008.code and finding.line == change.line]
            warnings = [finding for finding in new if finding.severity is not Severity.INFO]
            notify_diagnostics(warnings + remarks, refused=False)

    def _findings(self, file: Input, data: bytes) -> list[Diagnostic]:
        return lint_bytes(data, file.name, rules(), units=self.units, folder=file.folder)


def _write(
    inputs: Inputs,
    planned: Sequence[tuple[Input, int, Sequence[TextEdit]]],
    printed: Sequence[bytes],
    counts: Counter[str],
) -> None:
    """Write the files, each in one step, unless a deck was refused or a file cannot be written."""
    locked = [file for file, _, _ in planned if not os.access(file.path or "", os.W_OK)]
    for file in locked:
        inputs.fail(f"{file.name}: cannot be written: permission denied")
    if counts[_REFUSED] or locked or inputs.code:
        if counts[_CHANGED]:
            counts[_UNWRITTEN] = counts.pop(_CHANGED)
            notify(f"nothing was written: {counted(counts[_UNWRITTEN], 'deck')} would have changed")
        return
    for content in printed:
        emit_deck(content)
    for file, held, edits in planned:
        data = inputs.content(file)  # read again: the contents of many would fill the memory
        if data is not None and hash(data) != held:
            inputs.fail(f"{file.name}: {CHANGED}")
        elif data is not None and inputs.replaced(file, data, _edited(file, data, edits)):
            continue
        counts.subtract([_CHANGED])
        counts[_UNWRITTEN] += 1


def _edited(file: Input, data: bytes, edits: Sequence[TextEdit]) -> bytes:
    return edited_bytes(Source.from_bytes(data, file.name), edits) if edits else data
