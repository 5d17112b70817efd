"""Command `mudline format`."""

from __future__ import annotations

from collections import Counter

import click

from mudline.basics.short_repr import counted
from mudline.checks.engine import read_deck
from mudline.cli import DONE, FOUND, options
from mudline.cli.changes import deliver
from mudline.cli.inputs import GivenDecks, Input, Inputs, takes_decks
from mudline.cli.streams import notify, notify_diagnostics
from mudline.cli.view import View
from mudline.editing.formatting.document import FormatError, formatted
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.diagnostics import DeckError, Diagnostic

_CHANGED, _SAME, _FAILED = "reformatted", "left unchanged", "not formatted"


@options.command("format")
@options.check
@options.diff
@options.force_exclude
@takes_decks(units=False)
def command(*, decks: GivenDecks, check: bool, diff: bool, force_exclude: bool, view: View) -> int:
    """Rewrite decks in canonical layout, in place; contents and comments stay the same, line by line.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi and *.das) or - for standard input, whose deck
    is printed. A deck with an error is reported and left unchanged.
    """
    inputs = decks.collect(force_exclude=force_exclude)
    outcomes = Counter(_outcome(inputs, *each, view, check=check, diff=diff) for each in inputs.contents())
    would = "would be " if check or diff else ""
    words = {_CHANGED: f"{would}{_CHANGED}", _SAME: f"{would}{_SAME}", _FAILED: _FAILED}
    texts = [f"{counted(outcomes[outcome], 'file')} {word}" for outcome, word in words.items() if outcomes[outcome]]
    if texts and not view.quiet:
        click.echo(", ".join(texts), err=True)
    failing = outcomes[_FAILED] or (outcomes[_CHANGED] and (check or diff))
    return max(inputs.code, FOUND if failing else DONE)


def _outcome(inputs: Inputs, file: Input, data: bytes, view: View, *, check: bool, diff: bool) -> str:
    """Write, print or name the formatted deck, and return the outcome; "" for a deck that is printed."""
    try:
        new = formatted(data, file.name)
    except DeckError as error:
        notify_diagnostics(_causes(file, data) or error.diagnostics)
        return _FAILED
    except FormatError as error:
        notify(f"{file.name}: {error}")
        return _FAILED
    if not deliver(inputs, file, data, new, view, check="would reformat" if check else "", diff=diff):
        return _FAILED
    if file.path is None and not (check or diff):
        return ""
    if new != data and view.verbose and not (check or diff):
        notify(f"{file.name}: reformatted")
    return _SAME if new == data else _CHANGED


def _causes(file: Input, data: bytes) -> list[Diagnostic]:
    """Why a keyword text cannot be read, as lint says it."""
    from mudline.checks.verdict import unreadable_causes  # noqa: PLC0415 - only where a deck is refused

    return unreadable_causes(read_deck(data, file.name)) if form_of(file.name) == KEYWORD else []
