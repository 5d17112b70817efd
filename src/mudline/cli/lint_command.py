"""Command `mudline lint`: its options, the result for unchanged decks, and `--watch`."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cache, partial
from pathlib import Path
from typing import NoReturn

import click

from mudline.basics.files import version_of
from mudline.basics.outside import CONFIGURATIONS
from mudline.basics.overwriting import claim
from mudline.checks.configuration import CallerSettings, ConfigurationError, Configured
from mudline.checks.output import TEXT, form_names
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import STDIN, GivenDecks, takes_decks
from mudline.cli.lint_report import LintOptions, LintReport, outputs
from mudline.cli.lint_run import checked_settings, lint_files
from mudline.cli.streams import notify
from mudline.cli.view import View
from mudline.language.deck.searching import Search, is_in_any_form
from mudline.language.diagnostics import Severity
from mudline.tools.running.remembered import of_working_folder

_RULES, _FIXES, _KNOWN = "Rules", "Fixes", "Known findings"

_rules = partial(
    options.option,
    group=_RULES,
    multiple=True,
    metavar="CODE[,CODE...]",
    callback=lambda _context, _option, given: tuple(word for text in given for word in text.split(",") if word.strip()),
    shell_complete=options.complete_rules,
)


@options.command("lint")
@_rules("--select", "chosen", help="Run these rules only: codes, prefixes or slugs.")
@_rules("--extend-select", "also", help="Run these rules too.")
@_rules("--ignore", "ignored", help="Do not run these rules.")
@options.output_option(
    "--fail-on",
    type=click.Choice([severity.value for severity in (Severity.ERROR, Severity.WARNING, Severity.INFO)]),
    help="Exit with 1 for findings of this severity or worse (default: warning).",
)
@options.output_option(
    "--output-format",
    "forms",
    multiple=True,
    metavar="FORM[=FILE]",
    shell_complete=options.completing(lambda: (TEXT, *form_names())),
    help=f"Print findings in this format: {', '.join([f'{TEXT} (default)', *form_names()])}. "
    "With =FILE, also write a file. Repeatable.",
)
@options.flag("--fix", group=_FIXES, help="Apply the safe fixes in place; for -, print the fixed deck.")
@options.flag("--unsafe-fixes", "unsafe", group=_FIXES, help="With --fix or --diff: also apply unsafe fixes.")
@options.flag("--diff", group=_FIXES, help="Print the changes of --fix, and write nothing; exit with 1 if any.")
@options.option("--baseline", group=_KNOWN, metavar="FILE", help="Hide the findings that are recorded in this file.")
@options.flag("--write-baseline", "recording", group=_KNOWN, help="Record all findings in the file of --baseline.")
@options.option(
    "--dialect",
    group=_RULES,
    type=click.Choice(["mudline", "flexcom"]),
    help="Check decks for this program (default: mudline); flexcom has no extension keywords.",
)
@options.no_outside
@options.config
@options.isolated
@options.force_exclude
@options.output_option("--statistics", is_flag=True, help="Count the findings of each rule instead of listing them.")
@options.output_option("--exit-zero", is_flag=True, help="Exit with 0 even if there are findings.")
@options.jobs
@options.run_option("--no-cache", "uncached", is_flag=True, help="Lint every deck again, without the cache.")
@options.run_option(
    "--watch", is_flag=True, help="Lint again whenever a deck or a configuration changes, until Ctrl-C."
)
@options.gathered("given", CallerSettings)
@options.gathered("wanted", LintOptions)
@takes_decks()
def command(
    *,
    given: CallerSettings,
    wanted: LintOptions,
    decks: GivenDecks,
    forms: tuple[str, ...],
    unsafe: bool,
    config: str | None,
    isolated: bool,
    force_exclude: bool,
    exit_zero: bool,
    uncached: bool,
    watch: bool,
    view: View,
) -> int:
    """Find faults in decks: all findings of every file in one run.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that begin
    as decks do), or - for standard input. With -v, files of directories that are skipped are named too.
    """
    fixing = "none" if not wanted.fixing else "unsafe" if unsafe else "safe"
    form, files = outputs(forms)
    if wanted.baseline and wanted.recording:
        claim(wanted.baseline, "--baseline")
    Configured(config, isolated)  # wrong usage is reported once, before anything is watched
    settings = partial(checked_settings, config, given, fixing, isolated=isolated)

    def once() -> int:
        configured = Configured(config, isolated)
        skipped: list[str] | None = [] if view.verbose else None
        inputs = decks.collect(configured.includes, configured=configured, skipped=skipped, force_exclude=force_exclude)
        for line in sorted(skipped or ()):
            notify(line)
        aside = wanted.diff or (wanted.fix and any(file.path is None for file in inputs.files))
        report = LintReport(form, files, view, configured, wanted, aside)
        memory = None if uncached or wanted.fixing else of_working_folder("lint", repr(given))
        failing = lint_files(inputs, cache(settings), report, memory)
        return max(inputs.code, FOUND if failing and not exit_zero else DONE)

    if watch:
        settings()
        refuse({"--fix": wanted.fix, "--diff": wanted.diff, "--write-baseline": wanted.recording}, decks.paths, form)
        watched(once, [*decks.paths, *(path for path in (config, wanted.baseline) if path)], view)
    return once()


# ------------------------------------------------------------------------------------------------------------- --watch

WAIT = 0.3
"""Seconds between two checks for changes."""

_PRINTED = (TEXT, "concise")

State = dict[str, tuple[int, ...]]
"""Properties of files that a change of their content changes, by file."""


def refuse(writing: Mapping[str, bool], paths: Sequence[str], form: str) -> None:
    """Raise click.UsageError for options that cannot be combined with --watch."""
    for option, given in writing.items():
        if given:
            raise click.UsageError(f"--watch and {option} exclude each other: give one of them")
    if STDIN in paths:
        raise click.UsageError("--watch needs files: standard input can be read once only")
    if form not in _PRINTED:
        raise click.UsageError(
            f"--watch prints {' or '.join(_PRINTED)}, not {form}; "
            f"--output-format {form}=FILE writes a file after each change"
        )


def watched(once: Callable[[], int], paths: Sequence[str], view: View) -> NoReturn:
    """Lint now and after each change, until KeyboardInterrupt. An error that ends a run is reported."""
    while True:
        before = state(paths)
        click.clear()
        try:
            once()
        except (ConfigurationError, click.ClickException) as error:
            notify(str(error))
        view.note(f"{time.strftime('%H:%M:%S')}: waiting for changes; Ctrl-C ends")
        wait_for_change(paths, before)


def wait_for_change(paths: Sequence[str], before: State) -> None:
    """Return as soon as the files differ from `before` and no longer change: editors write in several steps."""
    last, now = before, state(paths)
    while now == before or now != last:
        time.sleep(WAIT)
        last, now = now, state(paths)


def state(paths: Sequence[str]) -> State:
    """Return the state of the given files, of decks below folders and next to files, and of their configurations."""
    return {file: version_of(file) for path in paths for file in _near(path)}


def _is_watched(path: str) -> bool:
    return os.path.basename(path) in CONFIGURATIONS or is_in_any_form(path)  # noqa: PTH119 - called for many files


def _near(given: str) -> Iterator[str]:
    """Yield the decks and configurations in or below a folder, or a file and those next to it; and those above."""
    folder = given if os.path.isdir(given) else os.path.dirname(given) or "."  # noqa: PTH112, PTH120 - Path raises for a long name
    if folder == given:
        yield from (path for _, path in Search(folder).files(_is_watched))
    else:
        yield given
        with suppress(OSError):
            yield from filter(_is_watched, map(str, Path(folder).iterdir()))
    for parent in Path(os.path.abspath(folder)).parents:  # noqa: PTH100 - links stay what they are called
        yield from (str(parent / name) for name in CONFIGURATIONS)
