"""One run of `mudline lint`: the settings of each deck, its findings, remembered or not, and fixed decks.

Remembered files are not linted again. Further files are linted in this or in other processes, and reported in the order
given. What lints is imported with the settings of the first file that is not remembered.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mudline.basics.outside import project_of
from mudline.basics.short_repr import counted
from mudline.checks.configuration import CallerSettings, Configuration, Configured
from mudline.checks.report import FileReport
from mudline.cli.inputs import Input, Inputs, many_files
from mudline.cli.lint_report import LintReport
from mudline.cli.streams import naming, notify, refusing, write_text
from mudline.cli.view import View
from mudline.language.deck.forms import form_of
from mudline.language.diagnostics import Coverage, Diagnostic, Edit, Fix, Severity
from mudline.tools.running.remembered import Memory

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
        with naming(given, "the baseline cannot be read: "):
            return read_baseline(path)
    except BaselineError as error:
        message = f"{given}: not a baseline: {error}: write a new one with --write-baseline"
        raise click.ClickException(message) from error


def checked_settings(config: str | None, given: CallerSettings, fixing: str = "none", *, isolated: bool) -> Settings:
    """Return the settings of a command line; ends the command for a word that names no rule."""
    from mudline.checks.engine import Fixing  # noqa: PLC0415 - remembered decks need no rules
    from mudline.checks.registry import UnknownRule, code_fault  # noqa: PLC0415 - as above
    from mudline.checks.settings import Settings  # noqa: PLC0415 - as above

    settings = Settings(Configured(config, isolated, code_fault), given, Fixing(fixing))
    with refusing(UnknownRule):
        settings.merged(Configuration())
    return settings


def lint_one(name: str, data: bytes, settings: LintSettings, folder: Path | None) -> FileReport:
    """Return the report on a file, as `mudline.checks.fixing` makes it. Runs in any process."""
    from mudline.checks import fixing  # noqa: PLC0415 - as above

    return fixing.lint_one(name, data, settings, folder)


_Read = tuple[Input, bytes, str, FileReport | None]
"""A file and its content, the key under which a new report is remembered, if any, and the remembered report."""


def lint_files(inputs: Inputs, settings: Callable[[], Settings], report: LintReport, memory: Memory | None) -> bool:
    """Lint all files and return True if the run fails.

    Remembered reports are not made again, except for standard input. Fixed decks are written or shown.
    """
    wanted = report.wanted

    def prepared(file: Input) -> tuple[_Read, tuple[str, bytes, LintSettings, Path | None] | None]:
        data = file.read()
        key = "" if memory is None or file.path is None else key_of(memory, report.configured, file, data)
        if memory is not None and key and (held := memory.get(key)) is not None:
            return (file, data, "", remembered(held, file.name)), None
        return (file, data, key, None), (file.name, data, settings().of(file.place), file.folder)

    recorded = _baseline(wanted.baseline, recording=wanted.recording)
    differs, documents = False, 0
    jobs = 1 if wanted.fixing else wanted.jobs  # another deck may continue a deck that is being fixed
    with closing(many_files(inputs, prepared, lint_one, report.view, jobs=jobs, bar=False)) as results:
        for (file, data, key, known), linted in results:
            result = linted or known or FileReport(file.name, ())
            if memory is not None and key:
                remember(memory, key, result)
            content = data
            if wanted.fixing:
                documents += form_of(file.name) != "keyword"
                differs = differs or (wanted.diff and result.changed is not None)
                content, result = _delivered(inputs, file, data, result, settings(), report.view, diff=wanted.diff)
            findings = list(result.found)
            if recorded is not None:
                if wanted.recording:
                    recorded.record(findings, content, file.place)
                findings = recorded.unknown(findings, content, file.place)
            report.add(file, content, findings, len(result.fixed))
            report.coverage.add(result.coverage)
    if memory is not None:
        memory.save()
    if documents:
        notify(f"{counted(documents, 'deck')} in JSON or YAML not fixed: only keyword text is")
    report.finish()
    if recorded is not None and wanted.baseline is not None:
        name = Path(wanted.baseline).as_posix()
        if wanted.recording:
            write_text(Path(wanted.baseline), [recorded.text()])
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
    unfixed = replace(settings.of(file.place), fixing=Fixing.NONE)
    return data, lint_one(file.name, data, unfixed, file.folder)


# -------------------------------------------------------------------------------------------------------- remembering


def key_of(memory: Memory, configured: Configured, file: Input, data: bytes) -> str:
    """Return the key of the findings of a file.

    Its name is part of the key: it gives units and form, and is in findings. So is its project: files outside are not
    shown, and may be refused.
    """
    configuration = configured.of(file.path)
    project = str(project_of(file.folder)) if file.folder else ""
    return memory.key(str(configuration.path), configuration.content, project, file.name, data)


def remember(memory: Memory, key: str, report: FileReport) -> None:
    """Store the report on a file, which depends on the content of files that it names, and of plugins."""
    from mudline.checks.registry import plugin_files  # noqa: PLC0415 - it imports all rules

    held = [[*asdict(report.coverage).values()], *map(asdict, report.found)]
    memory.put(key, held, (*report.looked_at, *plugin_files()))


def remembered(held: list[Any], name: str) -> FileReport:
    """Return the report on a file from what a memory holds."""
    return FileReport(name, tuple(_finding(**each) for each in held[1:]), coverage=Coverage(*held[0]))


def _finding(*, severity: str, fix: list[Any] | None, following: list[dict[str, Any]], **others: Any) -> Diagnostic:  # noqa: ANN401 - as JSON
    """Return a finding from what JSON makes of it."""
    return Diagnostic(
        **others,
        severity=Severity(severity),
        fix=None if fix is None else _fix(*fix),
        following=tuple(_finding(**each) for each in following),
    )


def _fix(applicability: str, message: str, edits: list[Any]) -> Fix:
    made = tuple(Edit((line, column), (last, end), text) for (line, column), (last, end), text in edits)
    return Fix(applicability, message, made)
