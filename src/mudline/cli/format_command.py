"""`mudline format`."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from pathlib import Path

import click

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import Input, Inputs, collect
from mudline.cli.streams import counted, emit, emit_deck, notify, notify_diagnostics, reason
from mudline.cli.view import View, print_diff
from mudline.diagnostics import DeckError
from mudline.files import write_atomically
from mudline.formatting.changes import unified_diff
from mudline.formatting.document import FormatError, formatted
from mudline.syntax.source import Source


@click.command("format")
@options.paths
@click.option("--check", is_flag=True, help="Write nothing; name the files that would change, and exit with 1 if any.")
@click.option("--diff", is_flag=True, help="Write nothing; print what would change, and exit with 1 if anything.")
@options.every_file
@options.stdin_name
@options.common
def command(*, paths: tuple[str, ...], check: bool, diff: bool, every_file: bool, stdin_name: str, view: View) -> int:
    """Rewrite decks in canonical layout, in place: the same deck, line by line, comments included.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi and *.das) or - for standard input, whose deck
    is printed. A deck with an error is reported and left unchanged.
    """
    inputs = collect(paths, stdin_name, gitignore=not every_file)
    run = _Run(inputs, view, check=check, diff=diff)
    for file, data in inputs.contents():
        run.add(file, data)
    return run.finish()


@dataclass
class _Run:
    """Formats one file after the other and counts them."""

    inputs: Inputs
    view: View
    _: KW_ONLY
    check: bool
    diff: bool
    changed: int = 0
    unchanged: int = 0
    failed: int = 0

    def add(self, file: Input, data: bytes) -> None:
        """Format a file, or report why not."""
        try:
            new = formatted(data, file.name)
        except DeckError as error:
            notify_diagnostics(error.diagnostics)
            self.failed += 1
        except FormatError as error:
            notify(f"{file.name}: {error}")
            self.failed += 1
        else:
            self._deliver(file, data, new)

    def _deliver(self, file: Input, data: bytes, new: bytes) -> None:
        """Write, print or name the result."""
        if self.check or self.diff:
            self._count(changed=new != data)
            if new != data:
                self._show(file, data, new)
        elif file.path is None:
            emit_deck(new)
        elif new == data:
            self._count(changed=False)
        else:
            self._write(file, Path(file.path), new)

    def _count(self, *, changed: bool) -> None:
        self.changed += changed
        self.unchanged += not changed

    def _show(self, file: Input, data: bytes, new: bytes) -> None:
        if self.check:
            emit([f"would reformat: {file.name}\n"])
        if self.diff:
            old, after = Source.from_bytes(data, file.name).text, Source.from_bytes(new, file.name).text
            print_diff(unified_diff(old, after, file.name), self.view)

    def _write(self, file: Input, path: Path, new: bytes) -> None:
        try:
            write_atomically(path, new)
        except OSError as error:
            self.inputs.fail(f"{file.name}: cannot be written: {reason(error)}")
            self.failed += 1
            return
        self._count(changed=True)
        if self.view.verbose:
            notify(f"{file.name}: reformatted")

    def finish(self) -> int:
        """Report how many files there were; returns the exit code."""
        would = "would be " if self.check or self.diff else ""
        texts = [
            f"{counted(count, 'file')} {word}"
            for count, word in (
                (self.changed, f"{would}reformatted"),
                (self.unchanged, f"{would}left unchanged"),
                (self.failed, "not formatted"),
            )
            if count
        ]
        if texts and not self.view.quiet:
            click.echo(", ".join(texts), err=True)
        found = self.failed or (self.changed and would)
        return max(self.inputs.code, FOUND if found else DONE)
