"""`mudline migrate`."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.cli import options
from mudline.cli.changes import tell_changes
from mudline.cli.exits import DONE, FOUND
from mudline.cli.inputs import Input, collect
from mudline.cli.options import View
from mudline.cli.streams import emit_deck
from mudline.cli.terminal import tell, tell_diagnostics
from mudline.cli.writing import write_bytes
from mudline.deck.loading import dump, form_of, load_bytes
from mudline.diagnostics import DeckError
from mudline.linting.output.visible import visible
from mudline.migration.migrating import Continuations, Migration, legacy_blocks, migrate
from mudline.migration.verification import Verdict, verify
from mudline.syntax.source import Source

_MOST_TOLD = 20


@click.command("migrate")
@options.paths
@click.option("-o", "--output", metavar="OUT", help="File to write instead of the deck itself; for one deck only.")
@click.option("--diff", is_flag=True, help="Print what would change, and write nothing.")
@click.option(
    "--verify",
    "proved",
    is_flag=True,
    help="Evaluate the old and the new deck first, and write only when all their laws agree bit by bit.",
)
@options.every_file
@options.stdin_name
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    output: str | None,
    diff: bool,
    proved: bool,
    every_file: bool,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Rewrite *EMBEDMENT, *ELASTIC SURFACE and *RIGID SURFACE as the new family of seabed keywords.

    PATHS are decks, directories, or - for standard input, whose new text is printed. Comments stay, as does every byte
    outside the legacy blocks. A deck that the new family cannot say is left as it is, with the reason.
    """
    inputs = collect(paths, stdin_name, gitignore=not every_file)
    if output is not None and len(inputs.files) > 1:
        raise click.UsageError("-o takes one deck; without it decks are rewritten where they stand")
    code = DONE
    continuations = Continuations(Path(file.path) for file in inputs.files if file.path is not None)
    for file, data in inputs.contents():
        run = _Run(file, data, output, view, continuations)
        try:
            code = max(code, run.migrate(units, diff=diff, proved=proved))
        except DeckError as error:
            tell_diagnostics(error.diagnostics)
            code = FOUND
    return max(inputs.code, code)


class _Run:
    """One deck."""

    def __init__(self, file: Input, data: bytes, output: str | None, view: View, continuations: Continuations) -> None:
        self.file = file
        self.continuations = continuations
        self.data = data
        self.target = Path(output) if output is not None else Path(file.path) if file.path is not None else None
        self.view = view

    def migrate(self, units: str | None, *, diff: bool, proved: bool) -> int:
        """Migrate the deck; returns the exit code. Raises DeckError for one that is left as it is."""
        deck = load_bytes(self.data, self.file.name, units=units, folder=self.file.folder)
        if not legacy_blocks(deck):
            self._note("no legacy seabed keyword")
            if not diff and (self.target is None or self.target != Path(self.file.path or "")):
                self._write(self.data, {})
            return DONE
        migration = migrate(deck, self.continuations.of(Path(self.file.path)) if self.file.path else ())
        if proved and not self._proved(verify(migration)):
            return FOUND
        content = self._content(migration)
        if diff:
            self._tell_changes(content, migration)
            return DONE
        return self._write(content, migration.files, _replaced(migration))

    def _content(self, migration: Migration) -> bytes:
        """The new deck in the form that its file's suffix tells."""
        form = form_of(self.file.name if self.target is None else self.target.name)
        if form == form_of(self.file.name):
            return migration.content
        return dump(migration.deck, form).encode()

    def _proved(self, verdict: Verdict) -> bool:
        for difference in verdict.differences[:_MOST_TOLD]:
            tell(f"{self.file.name}: {difference.what}: {difference.text}")
        if verdict.differences:
            count = _many(len(verdict.differences), "difference")
            tell(f"{self.file.name}: left as it is: {count} between the old deck and the new one")
        else:
            self._note(
                f"verified: {_many(verdict.elements, 'element')} of {_many(verdict.kinds, 'kind')}, and "
                f"{verdict.representatives} representative elements for its sets, at {verdict.positions} positions: "
                "forces, stiffnesses, friction, lateral resistance, suction and seabed are bitwise equal"
            )
        return not verdict.differences

    def _tell_changes(self, content: bytes, migration: Migration) -> None:
        name = visible(self.file.name)
        old, new = (Source.from_bytes(data, self.file.name).text for data in (self.data, content))
        tell_changes(old, new, name, self.view.color)
        for beside, data in migration.files.items():
            path = Path(self.file.name).with_name(beside).as_posix()
            tell_changes("", data.decode(), visible(path), self.view.color, created=True)

    def _write(self, content: bytes, files: dict[str, bytes], replaced: str = "") -> int:
        if self.target is None:
            if files:
                why = "its profile goes to a file of its own, and standard input has no place for one"
                tell(f"{self.file.name}: left as it is: {why}: give the deck as a file")
                return FOUND
            emit_deck(content)
            return DONE
        for name, data in files.items():
            write_bytes(self.target.with_name(name), data)
        write_bytes(self.target, content)
        if replaced:
            beside = "".join(f", {self.target.with_name(name).as_posix()}" for name in files)
            self._note(f"{replaced} -> {self.target.as_posix()}{beside}")
        return DONE

    def _note(self, text: str) -> None:
        if not self.view.quiet:
            tell(f"{self.file.name}: {text}")


def _many(count: int, thing: str) -> str:
    return f"{count} {thing}{'s' * (count != 1)}"


def _replaced(migration: Migration) -> str:
    return ", ".join(f"{count} *{keyword}" for keyword, count in migration.replaced.items())
