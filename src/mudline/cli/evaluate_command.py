"""`mudline evaluate`: its options, and whether they are for one deck or for many."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import cast

import click
from click.core import ParameterSource

from mudline.cli import DONE, FOUND, options, pictures
from mudline.cli.evaluate_inputs import EvaluateInputs, read_headings
from mudline.cli.evaluate_one import Outputs, evaluate_one, show_plan
from mudline.cli.inputs import STDIN, GivenDeck, collect, refuses_bad_decks
from mudline.cli.pictures import Pictures
from mudline.cli.result_files import has_library, is_installed
from mudline.cli.view import View
from mudline.files import is_url, suffix_of
from mudline.results.evaluation import Tension
from mudline.results.forms import form_names
from mudline.results.panels import ANIMATIONS, PICTURES


@click.command("evaluate")
@click.option(
    "--positions",
    metavar="FILE",
    help="Read the positions of the nodes: CSV, NPZ or NPY, one state or time steps. Several decks: also a folder with "
    "a file NAME.csv for each, or a pattern such as {folder}/{name}.csv.",
)
@click.option(
    "--columns",
    multiple=True,
    metavar="NAME=HEADING,...",
    help='Name the columns of positions in a CSV of another program: time="Time [s]",node=Node,x=X. Repeatable.',
)
@click.option(
    "--time-step", type=float, metavar="DT", help="Set the time between the steps of positions that have no times."
)
@click.option(
    "--elements", metavar="FILE", help="Read the elements from a CSV, for decks whose elements come from *LINES."
)
@click.option(
    "--tension",
    type=click.Choice(["keep", "cut"]),
    default="keep",
    show_default=True,
    help="Keep the tension where a curve is negative in contact, or cut force and stiffness to 0.",
)
@click.option("--against", metavar="FILE", help="Compare with another program's element results, a CSV.")
@click.option(
    "-o",
    "--output",
    metavar=f"OUT.{'|'.join(form_names())}",
    help="Write the results; CSV and Parquet write OUT-nodes and OUT-summary beside it. Of several decks: the folder.",
)
@click.option(
    "--form",
    type=click.Choice(form_names()),
    help="Write the files of several decks in this form; without it Parquet, or NPZ where pyarrow is not installed.",
)
@click.option(
    "--jobs",
    type=click.IntRange(min=0),
    default=0,
    metavar="N",
    help="Use N processes for several decks, or for --summary-only; 0: one for each processor.",
)
@click.option(
    "--no-cache",
    is_flag=True,
    help="Evaluate every deck again, whatever -o DIR holds from before; with --summary-only begin again.",
)
@click.option(
    "--summary-only",
    is_flag=True,
    help="Keep of a long series only extremes with their times, counts and envelopes; a run that was stopped goes on.",
)
@click.option(
    "--chunk",
    type=click.IntRange(min=1),
    metavar="STEPS",
    help="Evaluate this many steps at a time in a process of --summary-only.",
)
@click.option(
    "--plot",
    "picture",
    metavar=f"FILE.{'|'.join(PICTURES)}",
    help="Draw the results (needs the extra mudline[plot]).",
)
@pictures.options
@click.option(
    "--animate", metavar=f"FILE.{'|'.join(ANIMATIONS)}", help="Draw the steps of a series as moving pictures."
)
@click.option("--plan", "plan_only", is_flag=True, help="Print what the deck needs and what is left out, and why.")
@click.option(
    "--table",
    type=click.Choice(["elements", "nodes", "summary"]),
    default="elements",
    show_default=True,
    help="Show these rows in text and CSV on standard output; a line at a step is a row of the summary.",
)
@options.spreadsheet
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning"]),
    default="error",
    show_default=True,
    help="Exit with 1 for warnings about the results too.",
)
@options.output_format("text", "json", "csv")
@options.every_file
@options.decks
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    decks: tuple[str, ...],
    stdin_name: str,
    units: str | None,
    every_file: bool,
    form: str | None,
    jobs: int,
    no_cache: bool,
    summary_only: bool,
    chunk: int | None,
    positions: str | None,
    columns: tuple[str, ...],
    time_step: float | None,
    elements: str | None,
    tension: str,
    against: str | None,
    output: str | None,
    picture: str | None,
    panels: str | None,
    plot_elements: str | None,
    animate: str | None,
    plan_only: bool,
    table: str,
    spreadsheet: bool,
    fail_on: str,
    output_format: str,
    view: View,
) -> int:
    """Evaluate contact forces and stiffnesses of decks, at their own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the seabed on a node.

    DECKS is one deck or - for standard input; or several decks and directories (searched for *.keyx, *.keyxm, *.keyxi,
    *.das), or URLs: a row for each deck is then printed, those that failed and those with the largest force first.
    """
    inputs = EvaluateInputs(cast("Tension", tension), elements, time_step, read_headings(columns))
    inputs.check(positions)
    _check_chunk(chunk, summary_only=summary_only)
    _refuse_urls({"--positions": positions, "--elements": elements, "-o": output})
    if _are_many(decks):
        from mudline.cli.evaluate_many import ManyOptions, evaluate_many  # noqa: PLC0415 - one deck starts quicker

        _refuse_options(_OF_ONE, "is for one deck: give a single file")
        form = form or ("parquet" if is_installed("parquet") else "npz")
        if output is not None and not has_library(form):
            return FOUND
        if spreadsheet and "csv" not in (output_format, form):
            raise click.UsageError(options.CSV_ONLY)
        many = ManyOptions(inputs, units, positions, output, form, output_format, fail_on, spreadsheet, jobs, no_cache)
        return evaluate_many(collect(decks, gitignore=not every_file, urls=True), many, view)
    _check_one(form, (output_format, suffix_of(output or "")), spreadsheet=spreadsheet)
    if summary_only:
        from mudline.cli.evaluate_series import SeriesOptions, evaluate_series  # noqa: PLC0415 - others start quicker

        _refuse_options(_OF_STEPS, "is not for --summary-only: leave one of them out")
        series = SeriesOptions(output, table, output_format, spreadsheet, fail_on, chunk, jobs, no_cache)
        return evaluate_series(GivenDeck(decks[0], stdin_name, units), inputs, positions, series, view)
    wanted = Pictures.asked_for(picture, animate, panels, plot_elements, option="--plot")
    outputs = Outputs(output, wanted, against, table, output_format, spreadsheet, fail_on)
    if not outputs.have_libraries():
        return FOUND
    deck = GivenDeck(decks[0], stdin_name, units).load()
    if plan_only:
        show_plan(inputs.prepared(deck, positions), output_format, view)
        return DONE
    return evaluate_one(deck, inputs, positions, outputs, view)


def _check_one(form: str | None, written: Sequence[str], *, spreadsheet: bool) -> None:
    """Refuse options about forms that do not fit one deck; raises click.UsageError."""
    if form is not None:
        raise click.UsageError("--form is for several decks: the suffix of -o gives the form of the results of one")
    if spreadsheet and "csv" not in written:
        raise click.UsageError(options.CSV_ONLY)


def _check_chunk(chunk: int | None, *, summary_only: bool) -> None:
    if chunk is not None and not summary_only:
        raise click.UsageError("--chunk is for --summary-only: add it")


_OF_STEPS = {
    "against": "--against",
    "picture": "--plot",
    "panels": "--panels",
    "plot_elements": "--plot-elements",
    "animate": "--animate",
    "plan_only": "--plan",
}
"""Options of one deck that need the results of single steps, or none."""
_OF_ONE = {**_OF_STEPS, "table": "--table", "summary_only": "--summary-only"}


def _are_many(decks: Sequence[str]) -> bool:
    """Whether several decks or a folder are given; raises click.UsageError for standard input among others."""
    if len(decks) > 1 and STDIN in decks:
        raise click.UsageError("- is one deck, from standard input: give it alone")
    return len(decks) > 1 or is_url(decks[0]) or os.path.isdir(decks[0])  # noqa: PTH112 - Path raises for a name that is too long


def _refuse_urls(given: Mapping[str, str | None]) -> None:
    """Raise click.UsageError for a URL where a file is needed."""
    for option, path in given.items():
        if path is not None and is_url(path):
            raise click.UsageError(f"{option} {path}: give the path of a file, not a URL")


def _refuse_options(names: Mapping[str, str], why: str) -> None:
    """Raise click.UsageError for one of these options that was given."""
    context = click.get_current_context()
    for name, option in names.items():
        if context.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise click.UsageError(f"{option} {why}")
