"""`mudline format`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.inputs import Input, Inputs, collect
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit, emit_deck
from mudline.cli.terminal import reason, tell, tell_diagnostics
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
    """Rewrite decks in canonical layout, in place: the same deck, line for line, its comments kept.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi and *.das) or - for standard input, whose deck
    is printed. A deck with an error is reported and left as it is.
    """
    inputs = collect(paths, stdin_name, gitignore=not every_file)
    run = _Run(inputs, view, check=check, diff=diff)
    for file, data in inputs.contents():
        run.add(file, data)
    return run.finish()


class _Run:
    """Formats one file after the other and counts them."""

    def __init__(self, inputs: Inputs, view: View, *, check: bool, diff: bool) -> None:
        self.inputs = inputs
        self.view = view
        self.check = check
        self.diff = diff
        self.changed = 0
        self.unchanged = 0
        self.failed = 0

    def add(self, file: Input, data: bytes) -> None:
        """Format a file, or tell why not."""
        try:
            new = formatted(data, file.name)
        except DeckError as error:
            tell_diagnostics(error.diagnostics)
            self.failed += 1
        except FormatError as error:
            tell(f"{file.name}: {error}")
            self.failed += 1
        else:
            self._deliver(file, data, new)

    def _deliver(self, file: Input, data: bytes, new: bytes) -> None:
        """Write, print or name what came out."""
        if self.check or self.diff:
            self._count(changed=new != data)
            if new != data:
                self._tell_change(file, data, new)
        elif file.path is None:
            emit_deck(new)
        elif new == data:
            self._count(changed=False)
        else:
            self._write(file, Path(file.path), new)

    def _count(self, *, changed: bool) -> None:
        self.changed += changed
        self.unchanged += not changed

    def _tell_change(self, file: Input, data: bytes, new: bytes) -> None:
        if self.check:
            emit([f"would reformat: {file.name}\n"])
        if self.diff:
            old, after = Source.from_bytes(data, file.name).text, Source.from_bytes(new, file.name).text
            lines = unified_diff(old, after, file.name)
            if self.view.color == "always" or (self.view.color == "auto" and sys.stdout.isatty()):
                printing("changes").print_diff(lines, self.view.color)
            else:
                emit(lines)

    def _write(self, file: Input, path: Path, new: bytes) -> None:
        try:
            write_atomically(path, new)
        except OSError as error:
            self.inputs.fail(f"{file.name}: cannot be written: {reason(error)}")
            self.failed += 1
            return
        self._count(changed=True)
        if self.view.verbose:
            tell(f"{file.name}: reformatted")

    def finish(self) -> int:
        """Tell how many files there were; returns the exit code."""
        if not self.view.quiet:
            would = "would be " if self.check or self.diff else ""
            told = [
                f"{_files(count)} {word}"
                for count, word in (
                    (self.changed, f"{would}reformatted"),
                    (self.unchanged, f"{would}left unchanged" if would else "left unchanged"),
                    (self.failed, "not formatted"),
                )
                if count
            ]
            if told:
                click.echo(", ".join(told), err=True)
        found = self.failed or (self.changed and (self.check or self.diff))
        return max(self.inputs.code, FOUND if found else DONE)


def _files(count: int) -> str:
    return f"{count} file{'s' * (count != 1)}"
