"""One run of `mudline lint`: the settings of each deck, its findings without the known ones, and fixed decks.

Remembered files are not linted again. Further files are linted in this or in other processes, and reported in the order
given.
"""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import click

from mudline.checks.configuration import CallerSettings, Configuration, Configured
from mudline.checks.engine import Fixing, LintSettings
from mudline.checks.fixing import FileReport, lint_one
from mudline.checks.registry import UnknownRule, code_fault, plugin_files
from mudline.checks.settings import Settings
from mudline.checks.suppression import Baseline, BaselineError, read_baseline
from mudline.cli.inputs import Input, Inputs
from mudline.cli.known_findings import KnownFindings
from mudline.cli.lint_report import LintReport
from mudline.cli.many_files import many_files
from mudline.cli.streams import counted, notify, reason, write_text
from mudline.cli.view import Progress, View
from mudline.language.deck.forms import form_of


def _baseline(given: str | None, *, recording: bool) -> Baseline | None:
    """Return the known findings, none yet if they are to be recorded; ends the command for an invalid file."""
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


def checked_settings(
    config: str | None, given: CallerSettings, fixing: str, *, isolated: bool, fail_on: str | None
) -> Settings:
    """Return the settings of a command line; ends the command for a word that names no rule."""
    settings = Settings(Configured(config, isolated, code_fault), given, fail_on, Fixing(fixing))
    try:
        settings.merged(Configuration())
    except UnknownRule as error:
        raise click.UsageError(str(error)) from error
    return settings


def lint_files(
    inputs: Inputs,
    settings: Settings,
    report: LintReport,
    known: KnownFindings | None,
    baseline: str | None,
    *,
    recording: bool,
    diff: bool,
    jobs: int,
) -> bool:
    """Lint all files and return True if the run fails.

    Fixed decks are written or shown; with `diff` they are only shown. `baseline` is the file of findings to be left
    out, or to be recorded.
    """
    recorded = _baseline(baseline, recording=recording)
    fixing = settings.fixing is not Fixing.NONE
    differs, documents = False, 0
    if fixing:  # another deck may continue a deck that is being fixed
        jobs = 1
    with closing(_lint_all(inputs, settings, known, jobs, report.view)) as results:
        for file, data, result in results:
            own, content = settings.of(file.path or file.name), data if result.changed is None else result.changed
            if fixing:
                documents += form_of(file.name) != "keyword"
                if result.note:
                    notify(f"{file.name}: {result.note}")
                differs = differs or (diff and content != data)
                from mudline.cli.changes import deliver  # noqa: PLC0415 - most runs change nothing

                if not deliver(inputs, file, data, content, report.view, diff=diff):
                    unfixed = replace(own, fixing=Fixing.NONE)
                    content, result = data, lint_one(file.name, data, unfixed, file.folder)  # noqa: PLW2901 - of the deck as it stays
            findings = list(result.found)
            if recorded is not None:
                path = file.path or file.name
                if recording:
                    recorded.record(findings, content, path)
                findings = recorded.unknown(findings, content, path)
            report.add(file.name, content, findings, len(result.fixed), own.fail_on)
            report.coverage.add(result.coverage)
    if documents:
        notify(f"{counted(documents, 'deck')} in JSON or YAML not fixed: only keyword text is")
    report.finish()
    if recorded is None or baseline is None:
        return report.failing or differs
    name = Path(baseline).as_posix()
    if recording:
        write_text(Path(baseline), [recorded.text()])
        report.view.note(f"{name}: {counted(recorded.known.total(), 'finding')} recorded")
    elif report.view.verbose and (gone := recorded.gone()):
        notify(f"{name}: {counted(gone, 'recorded finding')} no longer there: write it again")
    return report.failing or differs


# ----------------------------------------------------------------------------------------------------------- many files


class _Read(NamedTuple):
    """A file; `key` is the key of its report in the memory, if any, and `known` the remembered report."""

    file: Input
    data: bytes
    key: str = ""
    known: FileReport | None = None


def _lint_all(
    inputs: Inputs, settings: Settings, known: KnownFindings | None, jobs: int, view: View
) -> Generator[tuple[Input, bytes, FileReport], None, None]:
    """Yield each readable file with its content and its report, in the order of the files.

    Remembered reports are not made again, except for standard input. Known files are not read either, and the content
    of those without findings is empty.
    """
    plugins = plugin_files() if known is not None else ()

    def prepared(file: Input) -> tuple[_Read, tuple[str, bytes, LintSettings, Path | None] | None]:
        own = settings.of(file.path or file.name)
        if known is not None and file in known.known:
            data, (findings, coverage) = known.known[file]
            return _Read(file, data, known=FileReport(file.name, findings, coverage=coverage)), None
        data = file.read()
        key = "" if known is None or file.path is None else known.key(file, data)
        if known is not None and key and (remembered := known.get(key)) is not None:
            return _Read(file, data, key, FileReport(file.name, remembered[0], coverage=remembered[1])), None
        return _Read(file, data, key), (file.name, data, own, file.folder)

    progress = Progress(len(inputs.files), view, shown=False)
    with closing(many_files(inputs, prepared, lint_one, progress, jobs=jobs)) as reports:
        for item, linted in reports:
            report = linted or item.known or FileReport(item.file.name, ())
            if known is not None and item.key and item.known is None:
                known.put(item.key, report.found, report.coverage, (*report.looked_at, *plugins))
            yield item.file, item.data, report
    if known is not None:
        known.memory.save()
