"""`mudline evaluate`: results on the terminal or in a file, the plot, notes about what is doubtful or left out."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import NamedTuple

import click
from click.core import ParameterSource

from mudline.basics.quantities import csv_lines
from mudline.basics.short_repr import counted, listed_numbers
from mudline.checks.verdict import errors_beside
from mudline.cli import DONE, FOUND, evaluate_inputs, options
from mudline.cli.evaluate_inputs import EvaluateInputs, read_file, takes_inputs
from mudline.cli.evaluate_text import Screen, print_comparison, print_evaluation, print_series
from mudline.cli.inputs import GivenDeck
from mudline.cli.plots import Plot, plot_option, write_plot
from mudline.cli.result_files import beside, require_library, result_files
from mudline.cli.streams import emit, emit_json, notify, notify_diagnostics, notify_some, refusing
from mudline.cli.view import Progress, View
from mudline.model.results.against import ResultComparison
from mudline.model.results.evaluation import Evaluation, Prepared, ResultConsumer
from mudline.model.results.forms import FORMS, TABLES, Sink, plan_rows
from mudline.model.results.forms.text import text_writer
from mudline.model.results.plot_data import PlotData
from mudline.model.results.series import SERIES, SeriesSink, SeriesSummary
from mudline.model.results.summary_tables import plan_table
from mudline.model.results.warnings import ContactWarning, ContactWatch, caption


class Wanted(NamedTuple):
    """Destination of results: the file `output`, else standard output, in `form`; rows of `table`, or `every` row.

    Of a long series only the summary with `summary_only`.
    """

    output: str | None
    form: str
    table: str
    view: View
    every: bool
    summary_only: bool


def _numbers_of_elements(_context: click.Context, _option: click.Parameter, text: str | None) -> tuple[int, ...]:
    """Return the element numbers of `--plot-elements`, separated by commas; raises click.UsageError."""
    numbers = []
    for part in () if text is None else text.split(","):
        try:
            numbers.append(int(part))
        except ValueError as error:
            message = f"--plot-elements: {part.strip()!r} is not an element number; give numbers as 12,13"
            raise click.UsageError(message) from error
    return tuple(numbers)


@options.command("evaluate")
@takes_inputs("Read the positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
@options.option("--against", metavar="FILE", help="Compare with another program's element results, a CSV.")
@options.output(
    group=options.OUTPUT,
    metavar=f"OUT.{'|'.join(FORMS)}",
    help="Write the results; CSV and Parquet write OUT-nodes and OUT-summary beside it.",
)
@options.output_option(
    "--plot-elements",
    metavar="N,M",
    callback=_numbers_of_elements,
    help="Draw the force over penetration of these elements of a series, by number.",
)
@plot_option("the results", group=options.OUTPUT)
@options.flag("--plan", "plan_only", help="Print what the deck needs and what is left out, and why.")
@options.output_option(
    "--table",
    type=click.Choice(TABLES),
    default="elements",
    show_default=True,
    help="Show these rows in text and CSV on standard output; a line at a step is a row of the summary. Without this "
    "option rows of elements that show the same are one row, and of many those near touchdown are shown.",
)
@evaluate_inputs.summary_only
@evaluate_inputs.fail_on
@options.output_format("text", "json", "csv")
@click.argument("decks", nargs=-1, required=True, metavar="DECK", shell_complete=options.complete_files)
@options.stdin_name
@options.units
@options.common
def command(
    *,
    inputs: EvaluateInputs,
    decks: tuple[str, ...],
    stdin_name: str,
    units: str | None,
    against: str | None,
    output: str | None,
    plot: Plot,
    plot_elements: tuple[int, ...],
    plan_only: bool,
    table: str,
    fail_on: str,
    output_format: str,
    view: View,
) -> int:
    """Evaluate contact forces and stiffnesses of a deck, at its own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the seabed on a node.

    DECK is a file, or - for standard input; mudline batch evaluates several decks and folders.
    """
    if len(decks) > 1 or os.path.isdir(decks[0]):  # noqa: PTH112 - Path raises for a name that is too long
        raise click.UsageError("evaluate takes one deck: several decks and folders are for mudline batch")
    if inputs.summary_only:
        for option, given in {"--against": against, "--plot": plot, "--plan": plan_only}.items():
            if given:
                raise click.UsageError(f"{option} is not for --summary-only: leave one of them out")
    if plot_elements and plot is None:
        raise click.UsageError("--plot-elements is for a plot: give --plot")
    form = options.form_of_file(output, FORMS) if output else ""
    if form:
        require_library(form)
    deck = GivenDeck(decks[0], stdin_name, units).load()
    if plan_only:
        _show_plan(inputs.prepared(deck), output_format, view)
        return DONE
    source = click.get_current_context().get_parameter_source("table")
    every = table == "elements" and source is not ParameterSource.DEFAULT
    evaluation, wanted = inputs.evaluation(deck), Wanted(output, output_format, table, view, every, inputs.summary_only)
    warnings = _evaluate(evaluation, wanted, plot, plot_elements, against)
    errors = errors_beside(deck)
    if errors:
        notify(f"{deck.file} has {counted(len(errors), 'error')} in spite of which it can be evaluated:")
        notify_diagnostics(errors)
    return FOUND if errors or (warnings and fail_on == "warning") else DONE


def _show_plan(prepared: Prepared, form: str, view: View) -> None:
    """Print what a deck needs, and what is left out."""
    _, model, _ = prepared
    rows = plan_rows(model.plan)
    if form == "json":
        emit_json({"units": model.input.units, "plan": rows})
    elif form == "csv":
        emit(csv_lines([("stage", "active", "why"), *(row.values() for row in rows)]))
    else:
        view.printer().table(plan_table(rows, model.plan.steps))


def _evaluate(
    evaluation: Evaluation, wanted: Wanted, plot: Plot, plot_elements: tuple[int, ...], against: str | None
) -> list[ContactWarning]:
    """Evaluate a deck, print or write the results; returns what is doubtful. Raises DeckError, click.ClickException."""
    output, view = wanted.output, wanted.view
    comparison = read_file(against, lambda file: ResultComparison(file, evaluation)) if against else None
    with refusing(ValueError, before="--plot-elements: "):
        drawing = None if plot is None else PlotData.of_evaluation(evaluation, plot_elements)
    if not view.quiet:
        _notify_before(evaluation, comparison)
    shown = "" if output else wanted.form
    screen: Screen | SeriesSummary | None = None
    if shown == "text" and wanted.summary_only and evaluation.time is not None:
        screen = SeriesSummary(evaluation, "totals", "summary")
    elif shown == "text":
        screen = Screen(evaluation, wanted.table, view, every=wanted.every)
    slow, watch = SeriesSummary(evaluation, "suction"), ContactWatch(evaluation)
    with _sink(evaluation, comparison, wanted) as sink:
        consumers = [comparison, drawing, slow, watch, screen, sink]
        _run(evaluation, consumers, view, bar=wanted.summary_only or shown in {"", "text"})
        warnings = watch.warnings()
        if sink is not None:
            sink.finish(warnings)
    if drawing is not None:
        doubt = caption(warnings)
        write_plot(plot, lambda plots: plots.evaluation_figure(drawing, doubt), view)
    if not view.quiet:
        tables = SERIES if wanted.summary_only else TABLES
        _notify_after(watch, slow, output, beside(Path(output), tables) if output else {})
    if isinstance(screen, SeriesSummary):
        print_series(screen, view)
    elif screen is not None:
        print_evaluation(screen, view)
    if comparison is not None and wanted.form == "text":
        print_comparison(comparison, view)
    return warnings


def _sink(
    evaluation: Evaluation, comparison: ResultComparison | None, wanted: Wanted
) -> AbstractContextManager[Sink | SeriesSink | None]:
    """Open the destination of the rows: files, standard output, or none."""
    if wanted.output:
        path, only = Path(wanted.output), wanted.summary_only
        return result_files(evaluation, path, wanted.view, comparison, summary_only=only)
    if wanted.form == "text":
        return nullcontext()
    writer = partial(text_writer, wanted.form, writes={wanted.table: emit})
    if wanted.summary_only:
        return nullcontext(SeriesSink(evaluation, writer))
    return nullcontext(Sink(evaluation, wanted.form, writer, comparison, wanted.table))


def _run(evaluation: Evaluation, consumers: Sequence[ResultConsumer | None], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and pass them on, with a bar on a terminal."""
    with Progress(evaluation.steps, view, shown=bar) as progress:
        evaluation.run([one for one in consumers if one is not None], progress.advance)


# ----------------------------------------------------------------------------------------------------------- notes


def _notify_before(evaluation: Evaluation, comparison: ResultComparison | None) -> None:
    """Report what is left out, and what is guessed."""
    if evaluation.lengths_from_positions:
        notify(f"the length of {counted(evaluation.lengths_from_positions, 'element')} comes from the first positions")
    for note in evaluation.notes:
        notify(note)
    for stage, why in evaluation.model.input.left_out.items():
        notify(f"{stage}: {why}")
    if comparison is None:
        return
    for key, thing, where in (
        ("elements_not_in_deck", "element", f"of {comparison.file} not in the deck"),
        ("elements_not_in_file", "evaluated element", f"not in {comparison.file}"),
        ("times_not_evaluated", "time", f"of {comparison.file} not evaluated"),
        ("times_not_in_file", "evaluated time", f"not in {comparison.file}"),
    ):
        if numbers := comparison.unmatched[key]:
            notify(f"{counted(len(numbers), thing)} {where}: {listed_numbers(numbers)}")


def _notify_after(watch: ContactWatch, series: SeriesSummary, output: str | None, others: Mapping[str, Path]) -> None:
    """Report what is doubtful in the results, where suction is less than its power law gives, and the files."""
    warnings, evaluation = watch.warnings(), series.evaluation
    notify_some([f"warning: {one}" for one in warnings], "{} more warnings: JSON has all")
    if note := watch.note():
        notify(note)
    number = series.number(series.of("suction", "slow").largest.peak())
    if number is not None:
        (steps,) = series.counts["suction", "slow_steps"].tolist()
        when = f"at {steps} of {counted(evaluation.steps, 'step')}, element {number} first"
        notify(f"the pull-out velocity is below REGULARISATION= {when}: the suction force there is less than alpha v^n")
    for table, file in others.items():
        notify(f"{table} -> {file.as_posix()}")
    if output:
        notify(f"{evaluation.scene.deck.file} -> {Path(output).as_posix()}")
