"""`mudline lint`: options, the run over all files, and its findings on standard output and in files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import KW_ONLY, dataclass, field, replace
from pathlib import Path

import click

from mudline import __version__
from mudline.cli import DONE, FOUND, options
from mudline.cli.config_command import Configured, Given, merged
from mudline.cli.inputs import Input, Inputs, collect
from mudline.cli.lint_jobs import Effort, SettingsOf, lint_all
from mudline.cli.streams import counted, emit, emit_deck, notify, reason, write_text
from mudline.cli.view import View, print_changes
from mudline.deck.loading import form_of
from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.baseline import Baseline, BaselineError, read_baseline
from mudline.linting.configuration import Configuration
from mudline.linting.engine import Fixing
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.output import TEXT, form, form_names, visible
from mudline.syntax.source import Source

_CODES = "CODE[,CODE...]"


def _words(given: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(word for text in given for word in text.split(",") if word.strip())


def complete(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """What a shell completes after `--output-format`."""
    return [name for name in (TEXT, *form_names()) if name.startswith(incomplete)]


@click.command("lint")
@options.paths
@click.option(
    "--select", "chosen", multiple=True, metavar=_CODES, help="Run these rules only: codes, prefixes or slugs."
)
@click.option("--extend-select", "also", multiple=True, metavar=_CODES, help="Run these rules too.")
@click.option("--ignore", "ignored", multiple=True, metavar=_CODES, help="Do not run these rules.")
@click.option(
    "--fail-on",
    type=click.Choice([severity.value for severity in (Severity.ERROR, Severity.WARNING, Severity.INFO)]),
    help="Exit with 1 for findings of this severity or worse (default: warning).",
)
@click.option(
    "--output-format",
    "forms",
    multiple=True,
    metavar="FORM[=FILE]",
    shell_complete=complete,
    help=f"Format of standard output: {', '.join([f'{TEXT} (default)', *form_names()])}; "
    "=FILE writes a file too. Repeatable.",
)
@click.option("--fix", is_flag=True, help="Apply the safe fixes, in place; the deck of - is printed.")
@click.option("--unsafe-fixes", "unsafe", is_flag=True, help="With --fix or --diff: also apply fixes that guess.")
@click.option("--diff", is_flag=True, help="Print what --fix would change, and write nothing; exit with 1 if anything.")
@click.option("--baseline", metavar="FILE", help="Hide the findings that are recorded in this file.")
@click.option("--write-baseline", "recording", is_flag=True, help="Record all findings in the file of --baseline.")
@click.option(
    "--dialect",
    type=click.Choice(["mudline", "flexcom"]),
    help="The program that the decks are for (default: mudline); flexcom has no extension keywords.",
)
@click.option("--config", metavar="FILE", help="Use this configuration for all decks, not the nearest one of each.")
@click.option("--isolated", is_flag=True, help="Use no configuration file.")
@click.option("--statistics", is_flag=True, help="Count the findings of each rule instead of listing them.")
@click.option("--exit-zero", is_flag=True, help="Exit with 0 whatever is found.")
@click.option(
    "--jobs",
    type=click.IntRange(min=0),
    default=0,
    metavar="N",
    help="Use at most N processes, when that pays; 0 (default): one for each processor.",
)
@click.option("--no-cache", "uncached", is_flag=True, help="Lint every deck again, without the cache.")
@click.option("--watch", is_flag=True, help="Lint again whenever a deck or a configuration changes, until Ctrl-C.")
@options.every_file
@options.stdin_name
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    chosen: tuple[str, ...],
    also: tuple[str, ...],
    ignored: tuple[str, ...],
    fail_on: str | None,
    forms: tuple[str, ...],
    fix: bool,
    unsafe: bool,
    diff: bool,
    baseline: str | None,
    recording: bool,
    dialect: str | None,
    config: str | None,
    isolated: bool,
    statistics: bool,
    exit_zero: bool,
    jobs: int,
    uncached: bool,
    watch: bool,
    every_file: bool,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Find faults in decks: all findings of every file in one run.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi and *.das) or - for standard input.
    """
    fixing = Fixing.NONE if not (fix or diff) else Fixing.UNSAFE if unsafe else Fixing.SAFE
    given = Given(_words(chosen), _words(ignored), _words(also), fail_on, dialect, units, fixing)
    Configured(config, isolated)  # wrong usage is reported once, before anything is watched
    merged(Configuration(), given)  # a wrong code is reported whatever the files are
    wanted = outputs(forms)

    def once() -> int:
        configured = Configured(config, isolated)
        known = _baseline(baseline, recording=recording)
        inputs = collect(paths, stdin_name, configured.wanted, gitignore=not every_file)
        aside = diff or (fix and any(file.path is None for file in inputs.files))
        report = Report(wanted, view, statistics=statistics, aside=aside, fixing=fixing is not Fixing.NONE)
        effort = Effort(jobs, not uncached)
        run = Run(inputs, lambda file: configured.settings(file, given), report, known, recording, diff, effort)
        run.go()
        if known is not None and baseline is not None:
            _report_baseline(known, Path(baseline), view, recording=recording)
        failing = not exit_zero and (report.failing or run.differs)
        return max(inputs.code, FOUND if failing else DONE)

    if watch:
        from mudline.cli.lint_watch import Watched, refuse, watched  # noqa: PLC0415 - most runs end

        refuse({"--fix": fix, "--diff": diff, "--write-baseline": recording}, paths, wanted.form)
        watched(once, Watched(paths, tuple(path for path in (config, baseline) if path)), view)
    return once()


def _baseline(given: str | None, *, recording: bool) -> Baseline | None:
    """The known findings; none yet when they are to be recorded. Ends the command for a file that is not a baseline."""
    if given is None:
        if recording:
            raise click.UsageError("--write-baseline needs --baseline FILE: the file to write")
        return None
    path = Path(given)
    if recording:
        return Baseline(path.parent)
    try:
        return read_baseline(path)
    except OSError as error:
        raise click.ClickException(f"{given}: the baseline cannot be read: {reason(error)}") from error
    except BaselineError as error:
        message = f"{given}: not a baseline: {error}: write a new one with --write-baseline"
        raise click.ClickException(message) from error


def _report_baseline(known: Baseline, path: Path, view: View, *, recording: bool) -> None:
    """Write what was recorded, or report how much of it is no longer found."""
    if recording:
        write_text(path, [known.text()])
        if not view.quiet:
            notify(f"{path.as_posix()}: {counted(known.known.total(), 'finding')} recorded")
    elif view.verbose and (gone := known.gone()):
        notify(f"{path.as_posix()}: {counted(gone, 'recorded finding')} no longer there: write it again")


@dataclass
class Run:
    """All files: fixed decks are written or shown, known findings left out, the others reported.

    With `diff` nothing is written; `differs` says afterwards that something would have been.
    """

    inputs: Inputs
    settings_of: SettingsOf
    report: Report
    known: Baseline | None = None
    recording: bool = False
    diff: bool = False
    effort: Effort = field(default_factory=Effort)
    differs: bool = False
    documents: int = 0

    def go(self) -> None:
        """Lint all files."""
        with closing(lint_all(self.inputs, self.settings_of, self.effort)) as results:
            for file, data, result in results:
                self._take(file, data, result)
        if self.documents:
            notify(f"{counted(self.documents, 'deck')} in JSON or YAML not fixed: only keyword text is")
        self.report.finish()

    def _take(self, file: Input, data: bytes, result: FileReport) -> None:
        settings = self.settings_of(file)
        content = data if result.changed is None else result.changed
        if settings.fixing is not Fixing.NONE:
            self.documents += form_of(file.name) != "keyword"
            if result.note:
                notify(f"{file.name}: {result.note}")
            if not self._deliver(file, data, content):
                unfixed = replace(settings, fixing=Fixing.NONE)
                content, result = data, lint_one(file.name, data, unfixed, file.folder)
        found = self._unknown(file, content, list(result.found))
        self.report.add(file.name, content, found, len(result.fixed), settings.fail_on)

    def _unknown(self, file: Input, content: bytes, found: list[Diagnostic]) -> list[Diagnostic]:
        """The findings that the baseline does not hold."""
        if self.known is None:
            return found
        path = file.path or file.name
        if self.recording:
            self.known.record(found, content, path)
        return self.known.unknown(found, content, path)

    def _deliver(self, file: Input, data: bytes, content: bytes) -> bool:
        """Show, print or write what was fixed; returns whether the fixes are made."""
        if self.diff:
            if content != data:
                self.differs = True
                print_changes(data, content, visible(file.name), self.report.view)
        elif file.path is None:
            emit_deck(content)
        elif content != data:
            return self.inputs.replaced(file, content)
        return True


# -------------------------------------------------------------------------------------------------------- findings


@dataclass(frozen=True, slots=True)
class Outputs:
    """The format of standard output, and those of files."""

    form: str
    files: tuple[tuple[str, Path], ...]


def outputs(given: Sequence[str]) -> Outputs:
    """What `--output-format` asks for: FORM, or FORM=FILE. Raises click.UsageError."""
    known = [TEXT, *form_names()]
    printed: list[str] = []
    files: list[tuple[str, Path]] = []
    for word in given:
        name, mark, path = word.partition("=")
        if name not in known:
            raise click.UsageError(f"--output-format: {name!r} is not one of {', '.join(known)}")
        if not mark:
            printed.append(name)
        elif not path or name == TEXT:
            what = "text goes to the terminal: write concise=FILE" if path else f"write a file name behind {name}="
            raise click.UsageError(f"--output-format {word}: {what}")
        else:
            files.append((name, Path(path)))
    if len(set(printed)) > 1:
        raise click.UsageError(f"--output-format: standard output takes one form, not {', '.join(printed)}")
    return Outputs(printed[0] if printed else TEXT, tuple(files))


@dataclass
class Report:
    """What a run found. `aside`: standard output carries something else, and findings go to standard error."""

    outputs: Outputs
    view: View
    _: KW_ONLY
    statistics: bool
    aside: bool
    fixing: bool
    found: list[Diagnostic] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    fixed: int = 0
    failing: bool = False

    def add(self, name: str, data: bytes, found: list[Diagnostic], fixed: int, limit: Severity) -> None:
        """Add the findings that are left in one file, whose content is `data`, and the number of those fixed."""
        self.names.append(name)
        self.found += found
        self.fixed += fixed
        self.failing = self.failing or any(one.severity.rank >= limit.rank for one in found)
        if self._as_they_come and found:
            self.view.printer().findings(found, Source.from_bytes(data, name))
        if self.view.verbose:
            notify(f"{name}: {counted(len(found), 'finding')}")

    @property
    def _as_they_come(self) -> bool:
        return self.outputs.form == TEXT and not (self.view.quiet or self.statistics or self.aside)

    def finish(self) -> None:
        """Write and print what needs all findings."""
        found = sorted(self.found, key=lambda diagnostic: diagnostic.sort_key)
        for name, path in self.outputs.files:
            write_text(path, self._in_form(name, found))
        if self.aside:
            self._print_aside(found)
        elif self.statistics:
            emit(statistics_lines(found))
        elif self.outputs.form != TEXT:
            emit(self._in_form(self.outputs.form, found))
        elif self.view.quiet:
            emit(self._in_form("concise", found))
        elif self.names:
            self._summary(found)

    def _in_form(self, name: str, found: list[Diagnostic]) -> Iterator[str]:
        return form(name, self.names, __version__)(found)

    def _print_aside(self, found: list[Diagnostic]) -> None:
        name = "concise" if self.outputs.form == TEXT else self.outputs.form
        for piece in statistics_lines(found) if self.statistics else self._in_form(name, found):
            click.echo(piece, err=True, nl=False)
        if self.fixing and not self.view.quiet and name == "concise":
            click.echo(self._fixed_summary(found), err=True)

    def _summary(self, found: list[Diagnostic]) -> None:
        if self.fixing and (self.fixed or found):
            click.echo(self._fixed_summary(found))
        elif found:
            self.view.printer().summary(found, len(self.names))
        else:
            click.echo(f"No findings in {counted(len(self.names), 'file')}.")
        if hint := fixable(found):
            click.echo(hint)

    def _fixed_summary(self, found: list[Diagnostic]) -> str:
        total = counted(self.fixed + len(found), "finding")
        return f"Found {total} ({self.fixed} fixed, {len(found)} remaining) in {counted(len(self.names), 'file')}."


def fixable(found: list[Diagnostic]) -> str:
    """How many findings have fixes of each kind, or ""."""
    kinds = [one.fix.applicability for one in found if one.fix is not None]
    safe, unsafe = kinds.count("safe"), kinds.count("unsafe")
    if not kinds:
        return ""
    if not safe:
        return f"{unsafe} fixable with --fix --unsafe-fixes."
    return f"{safe} fixable with --fix" + (f", {unsafe} more with --unsafe-fixes." if unsafe else ".")


def statistics_lines(diagnostics: list[Diagnostic]) -> Iterator[str]:
    """Findings counted by rule, the most frequent first."""
    counts: dict[tuple[str, str], int] = {}
    for found in diagnostics:
        counts[found.code, found.slug] = counts.get((found.code, found.slug), 0) + 1
    for (code, slug), count in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        yield f"{count:6}  {code}  {slug}\n"
