"""Command `mudline format`."""

from __future__ import annotations

from collections import Counter

import click

from mudline.api.commands import formatted_file
from mudline.basics.short_repr import counted
from mudline.cli import DONE, FOUND, options
from mudline.cli.changes import deliver
from mudline.cli.inputs import GivenDecks, each_deck, takes_decks
from mudline.cli.streams import notify
from mudline.cli.view import View
from mudline.editing.formatting.document import FormatError

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
    outcomes, shown = Counter[str](), check or diff
    for file, data, new in each_deck(inputs, lambda file, data: formatted_file(data, file.name), view, FormatError):
        if new is None or not deliver(inputs, file, data, new, view, check="would reformat" * check, diff=diff):
            outcomes[_FAILED] += 1
        elif file.path is not None or shown:
            outcomes[_SAME if new == data else _CHANGED] += 1
            if new != data and view.verbose and not shown:
                notify(f"{file.name}: reformatted")
    words = {_CHANGED: f"would be {_CHANGED}" if shown else _CHANGED, _SAME: f"would be {_SAME}" if shown else _SAME}
    words[_FAILED] = _FAILED
    texts = [f"{counted(outcomes[outcome], 'file')} {word}" for outcome, word in words.items() if outcomes[outcome]]
    if texts and not view.quiet:
        click.echo(", ".join(texts), err=True)
    failing = outcomes[_FAILED] or (outcomes[_CHANGED] and shown)
    return max(inputs.code, FOUND if failing else DONE)
