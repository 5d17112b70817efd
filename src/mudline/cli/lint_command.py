"""`mudline lint`."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.inputs import collect
from mudline.cli.lint_jobs import Effort
from mudline.cli.lint_outputs import complete, outputs
from mudline.cli.lint_report import Report
from mudline.cli.lint_run import Run
from mudline.cli.lint_settings import Configured, Given, merged
from mudline.cli.lint_watch import Watched, refuse, watched
from mudline.cli.options import View
from mudline.cli.terminal import reason, tell
from mudline.cli.writing import write_text
from mudline.diagnostics import Severity
from mudline.linting.baseline import Baseline, BaselineError, read_baseline
from mudline.linting.configuration import Configuration
from mudline.linting.engine import Fixing
from mudline.linting.output.formats import TEXT, form_names

_CODES = "CODE[,CODE...]"


def _words(given: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(word for text in given for word in text.split(",") if word.strip())


@click.command("lint")
@options.paths
@click.option(
    "--select", "chosen", multiple=True, metavar=_CODES, help="Run these rules only: codes, prefixes or slugs."
)
@click.option("--extend-select", "also", multiple=True, metavar=_CODES, help="Run these rules too.")
@click.option("--ignore", "ignored", multiple=True, metavar=_CODES, help="Leave these rules out.")
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
    help=f"Form of what is printed: {', '.join([f'{TEXT} (default)', *form_names()])}; "
    "with =FILE written besides. Repeatable.",
)
@click.option("--fix", is_flag=True, help="Make the safe fixes, in place; the deck of - is printed.")
@click.option("--unsafe-fixes", "unsafe", is_flag=True, help="With --fix or --diff: make the fixes that guess, too.")
@click.option("--diff", is_flag=True, help="Print what --fix would change, and write nothing; 1 if that is anything.")
@click.option("--baseline", metavar="FILE", help="Hide the findings that are recorded in this file.")
@click.option("--write-baseline", "recording", is_flag=True, help="Record all findings in the file of --baseline.")
@click.option(
    "--dialect",
    type=click.Choice(["mudline", "flexcom"]),
    help="The program that the decks are for (default: mudline); flexcom knows no extension keywords.",
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
@click.option("--no-cache", "uncached", is_flag=True, help="Look at every deck, and remember nothing of it.")
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
    Configured(config, isolated)  # wrong usage is told once, before anything is watched
    merged(Configuration(), given)  # a wrong code is told whatever the files are
    told = outputs(forms)

    def once() -> int:
        configured = Configured(config, isolated)
        known = _baseline(baseline, recording=recording)
        inputs = collect(paths, stdin_name, configured.wanted, gitignore=not every_file)
        aside = diff or (fix and any(file.path is None for file in inputs.files))
        report = Report(told, view, statistics=statistics, aside=aside, fixing=fixing is not Fixing.NONE)
        effort = Effort(jobs, not uncached)
        run = Run(inputs, lambda file: configured.settings(file, given), report, known, recording, diff, effort)
        run.go()
        if known is not None and baseline is not None:
            _tell_baseline(known, Path(baseline), view, recording=recording)
        failing = not exit_zero and (report.failing or run.differs)
        return max(inputs.code, FOUND if failing else DONE)

    if watch:
        refuse({"--fix": fix, "--diff": diff, "--write-baseline": recording}, paths, told)
        watched(once, Watched(paths, tuple(path for path in (config, baseline) if path)), view)
    return once()


def _baseline(given: str | None, *, recording: bool) -> Baseline | None:
    """The known findings; none yet when they are to be recorded. Ends the command for a file that is no baseline."""
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
        message = f"{given}: this is no baseline: {error}: write a new one with --write-baseline"
        raise click.ClickException(message) from error


def _tell_baseline(known: Baseline, path: Path, view: View, *, recording: bool) -> None:
    """Write what was recorded, or tell of what is recorded and no longer there."""
    if recording:
        write_text(path, [known.text()])
        if not view.quiet:
            count = known.known.total()
            tell(f"{path.as_posix()}: {count} finding{'s' * (count != 1)} recorded")
    elif view.verbose and (gone := known.gone()):
        tell(f"{path.as_posix()}: {gone} recorded finding{'s' * (gone != 1)} no longer there: write it again")
