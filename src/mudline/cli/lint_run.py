"""One run of `mudline lint`: the settings of each deck, its findings without the known ones, and fixed decks.

Remembered files are not linted again. Further files are linted in this or in other processes, and reported in the order
given. What lints is imported with the settings of the first file that is not remembered.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from mudline.checks.configuration import CallerSettings, Configuration, Configured
from mudline.checks.report import FileReport
from mudline.cli.inputs import Input, Inputs
from mudline.cli.known_findings import KnownFindings
from mudline.cli.lint_report import LintReport
from mudline.cli.many_files import many_files
from mudline.cli.streams import counted, notify, reason, write_text
from mudline.cli.view import Progress, View
from mudline.language.deck.forms import form_of

if TYPE_CHECKING:
    from mudline.checks.engine import LintSettings
    from mudline.checks.settings import Settings
    from mudline.checks.suppression import Baseline


def _baseline(given: str | None, *, recording: bool) -> Baseline | None:
    """Return the known findings, none yet if they are to be recorded; ends the command for an invalid file."""
    if given is None:
        if recording:
            raise click.UsageError("--write-baseline needs --baseline FILE: the file to write")
        return None
    from mudline.checks.suppression import Baseline, BaselineError, read_baseline  # noqa: PLC0415 - most runs have none

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


def checked_settings(config: str | None, given: CallerSettings, fixing: str = "none", *, isolated: bool) -> Settings:
    """Return the settings of a command line; ends the command for a word that names no rule."""
    from mudline.checks.engine import Fixing  # noqa: PLC0415 - remembered decks need no rules
    from mudline.checks.registry import UnknownRule, code_fault  # noqa: PLC0415 - as above
    from mudline.checks.settings import Settings  # noqa: PLC0415 - as above

    settings = Settings(Configured(config, isolated, code_fault), given, Fixing(fixing))
    try:
        settings.merged(Configuration())
    except UnknownRule as error:
        raise click.UsageError(str(error)) from error
    return settings


def lint_one(name: str, data: bytes, settings: LintSettings, folder: Path | None) -> FileReport:
    """Return the report on a file, as `mudline.checks.fixing` makes it. Runs in any process."""
    from mudline.checks import fixing  # noqa: PLC0415 - as above

    return fixing.lint_one(name, data, settings, folder)


class _Read(NamedTuple):
    """A file; `key` is the key of its report in the memory, if any, and `known` the remembered report."""

    file: Input
    data: bytes
    key: str = ""
    known: FileReport | None = None


def lint_files(
    inputs: Inputs,
    settings: Callable[[], Settings],
    report: LintReport,
    known: KnownFindings | None,
    baseline: str | None,
    *,
    recording: bool,
    diff: bool,
    jobs: int,
) -> bool:
    """Lint all files and return True if the run fails.

    Remembered reports are not made again, except for standard input. Fixed decks are written or shown; with `diff` they
    are only shown. `baseline` is the file of findings to be left out, or to be recorded.
    """

    def prepared(file: Input) -> tuple[_Read, tuple[str, bytes, LintSettings, Path | None] | None]:
        data = file.read()
        key = "" if known is None or file.path is None else known.key(file, data)
        if known is not None and key and (remembered := known.get(key, file.name)) is not None:
            return _Read(file, data, known=remembered), None
        return _Read(file, data, key), (file.name, data, settings().of(file.path or file.name), file.folder)

    recorded = _baseline(baseline, recording=recording)
    differs, documents = False, 0
    jobs = 1 if report.fixing else jobs  # another deck may continue a deck that is being fixed
    progress = Progress(len(inputs.files), report.view, shown=False)
    with closing(many_files(inputs, prepared, lint_one, progress, jobs=jobs)) as results:
        for (file, data, key, remembered), linted in results:
            result = linted or remembered or FileReport(file.name, ())
            if known is not None and key:
                known.put(key, result)
            content = data
            if report.fixing:
                documents += form_of(file.name) != "keyword"
                differs = differs or (diff and result.changed is not None)
                content, result = _delivered(inputs, file, data, result, settings(), report.view, diff=diff)
            findings = list(result.found)
            if recorded is not None:
                path = file.path or file.name
                if recording:
                    recorded.record(findings, content, path)
                findings = recorded.unknown(findings, content, path)
            report.add(file, content, findings, len(result.fixed))
            report.coverage.add(result.coverage)
    if known is not None:
        known.memory.save()
    if documents:
        notify(f"{counted(documents, 'deck')} in JSON or YAML not fixed: only keyword text is")
    report.finish()
    if recorded is not None and baseline is not None:
        name = Path(baseline).as_posix()
        if recording:
            write_text(Path(baseline), [recorded.text()])
            report.view.note(f"{name}: {counted(recorded.known.total(), 'finding')} recorded")
        elif report.view.verbose and (gone := recorded.gone()):
            notify(f"{name}: {counted(gone, 'recorded finding')} no longer there: write it again")
    return report.failing or differs


def _delivered(
    inputs: Inputs, file: Input, data: bytes, result: FileReport, settings: Settings, view: View, *, diff: bool
) -> tuple[bytes, FileReport]:
    """Write or show a fixed deck; return its content and the report on it, those of the old one if it stays."""
    from mudline.checks.engine import Fixing  # noqa: PLC0415 - most runs change nothing
    from mudline.cli.changes import deliver  # noqa: PLC0415 - as above

    if result.note:
        notify(f"{file.name}: {result.note}")
    content = data if result.changed is None else result.changed
    if deliver(inputs, file, data, content, view, diff=diff):
        return content, result
    unfixed = replace(settings.of(file.path or file.name), fixing=Fixing.NONE)
    return data, lint_one(file.name, data, unfixed, file.folder)
