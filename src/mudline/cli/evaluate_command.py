"""`mudline evaluate`: its options, and whether they are for one deck or for many."""

from __future__ import annotations

from pathlib import Path
from typing import cast

import click

from mudline.cli import DONE, FOUND, options
from mudline.cli.evaluate_inputs import EvaluateInputs, read_headings
from mudline.cli.evaluate_one import Outputs, evaluate_one, show_plan
from mudline.cli.inputs import GivenDeck, takes_deck
from mudline.cli.result_files import suffix
from mudline.cli.view import View
from mudline.results.evaluation import Tension
from mudline.results.forms import form_names


@click.command("evaluate")
@click.option("--positions", metavar="FILE", help="Positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
@click.option(
    "--columns",
    multiple=True,
    metavar="NAME=HEADING,...",
    help='Headings of positions in a CSV of another program: time="Time [s]",node=Node,x=X. Repeatable.',
)
@click.option("--time-step", type=float, metavar="DT", help="Time between the steps of positions that have no times.")
@click.option("--elements", metavar="FILE", help="Elements as CSV, for decks whose elements come from *LINES.")
@click.option(
    "--tension",
    type=click.Choice(["keep", "cut"]),
    default="keep",
    show_default=True,
    help="Where a curve is negative in contact: keep the pull, or cut force and stiffness to 0.",
)
@click.option("--against", metavar="FILE", help="Compare with another program's element results, a CSV.")
@click.option(
    "-o",
    "--output",
    metavar=f"OUT.{'|'.join(form_names())}",
    help="Write the results; CSV and Parquet write OUT-nodes and OUT-summary beside it.",
)
@click.option("--plot", "picture", metavar="FILE.png|svg", help="Draw the results (needs the extra mudline[plot]).")
@click.option("--plan", "plan_only", is_flag=True, help="Print what the deck needs and what is left out, and why.")
@click.option(
    "--table",
    type=click.Choice(["elements", "nodes", "summary"]),
    default="elements",
    show_default=True,
    help="Which rows text and CSV on standard output show; a line at a step is a row of the summary.",
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
@takes_deck
def command(
    *,
    deck: GivenDeck,
    positions: str | None,
    columns: tuple[str, ...],
    time_step: float | None,
    elements: str | None,
    tension: str,
    against: str | None,
    output: str | None,
    picture: str | None,
    plan_only: bool,
    table: str,
    spreadsheet: bool,
    fail_on: str,
    output_format: str,
    view: View,
) -> int:
    """Evaluate contact forces and stiffnesses of a deck, at its own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the seabed on a node.
    """
    if spreadsheet and "csv" not in (output_format, suffix(Path(output or ""))):
        raise click.UsageError(options.CSV_ONLY)
    inputs = EvaluateInputs(cast("Tension", tension), elements, time_step, read_headings(columns))
    inputs.check(positions)
    outputs = Outputs(output, picture, against, table, output_format, spreadsheet, fail_on)
    if not outputs.have_libraries():
        return FOUND
    loaded = deck.load()
    if plan_only:
        show_plan(inputs.prepared(loaded, positions), output_format, view)
        return DONE
    return evaluate_one(loaded, inputs, positions, outputs, view)
