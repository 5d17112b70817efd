"""`mudline evaluate`: its options, and what is refused of them."""

from __future__ import annotations

import os

import click

from mudline.cli import DONE, FOUND, evaluate_inputs, options, pictures
from mudline.cli.evaluate_inputs import EvaluateInputs, takes_inputs
from mudline.cli.evaluate_one import evaluate_one, evaluate_series
from mudline.cli.evaluate_text import print_plan
from mudline.cli.inputs import GivenDeck, refuses_bad_decks
from mudline.cli.pictures import Picture
from mudline.cli.result_files import form_of_file, has_library
from mudline.cli.streams import emit, emit_json
from mudline.cli.view import View
from mudline.files import is_url
from mudline.quantities import csv_lines
from mudline.results.evaluation import Prepared
from mudline.results.forms import FORMS, plan_rows


@options.command("evaluate")
@takes_inputs("Read the positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
@click.option("--against", metavar="FILE", help="Compare with another program's element results, a CSV.")
@options.option(
    "-o",
    "--output",
    group=options.OUTPUT,
    metavar=f"OUT.{'|'.join(FORMS)}",
    help="Write the results; CSV and Parquet write OUT-nodes and OUT-summary beside it.",
)
@pictures.options
@click.option("--plan", "plan_only", is_flag=True, help="Print what the deck needs and what is left out, and why.")
@options.option(
    "--table",
    group=options.OUTPUT,
    type=click.Choice(["elements", "nodes", "summary"]),
    default="elements",
    show_default=True,
    help="Show these rows in text and CSV on standard output; a line at a step is a row of the summary.",
)
@evaluate_inputs.summary_only
@evaluate_inputs.fail_on
@options.output_format("text", "json", "csv")
@click.argument("decks", nargs=-1, required=True, metavar="DECK", shell_complete=options.complete_files)
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    inputs: EvaluateInputs,
    decks: tuple[str, ...],
    stdin_name: str,
    units: str | None,
    against: str | None,
    output: str | None,
    picture: str | None,
    plot_elements: str | None,
    plan_only: bool,
    table: str,
    summary_only: bool,
    fail_on: str,
    output_format: str,
    view: View,
) -> int:
    """Evaluate contact forces and stiffnesses of a deck, at its own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the seabed on a node.

    DECK is a file, or - for standard input; mudline batch evaluates several decks, folders and URLs.
    """
    if len(decks) > 1 or is_url(decks[0]) or os.path.isdir(decks[0]):  # noqa: PTH112 - Path raises for a name that is too long
        raise click.UsageError("evaluate takes one deck: several decks, folders and URLs are for mudline batch")
    if summary_only:
        for option, given in (("--against", against), ("--plot", picture), ("--plan", plan_only)):
            if given:
                raise click.UsageError(f"{option} is not for --summary-only: leave one of them out")
        if inputs.positions is None:
            raise click.UsageError("--summary-only is for time steps: give a series with --positions")
    wanted = Picture.asked_for(picture, plot_elements)
    form = form_of_file(output)
    if (form and not has_library(form)) or not wanted.has_library():
        return FOUND
    deck = GivenDeck(decks[0], stdin_name, units).load()
    if plan_only:
        _show_plan(inputs.prepared(deck), output_format, view)
        return DONE
    evaluation = inputs.evaluation(deck)
    if summary_only:
        if evaluation.time is None:
            raise click.UsageError(f"--summary-only is for time steps: {inputs.positions} is one state")
        warnings = evaluate_series(evaluation, output, table, output_format, view)
    else:
        warnings = evaluate_one(
            evaluation,
            view,
            output=output,
            picture=wanted,
            against=against,
            table=table,
            output_format=output_format,
        )
    return FOUND if warnings and fail_on == "warning" else DONE


def _show_plan(prepared: Prepared, form: str, view: View) -> None:
    """Print what a deck needs, and what is left out."""
    rows = plan_rows(prepared.model.plan)
    if form == "json":
        emit_json({"units": prepared.scene.units, "plan": rows})
    elif form == "csv":
        emit(csv_lines([("stage", "active", "why"), *(row.values() for row in rows)]))
    else:
        print_plan(prepared.model.plan, view)
