"""`mudline batch`: many decks or load cases evaluated, with a row and a result file each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mudline.cli import FOUND, evaluate_inputs, on_cluster, options
from mudline.cli.batch_run import BatchOptions, evaluate_batch
from mudline.cli.evaluate_inputs import EvaluateInputs, takes_inputs
from mudline.cli.inputs import STDIN, collect
from mudline.cli.result_files import has_library, is_installed
from mudline.cli.view import View
from mudline.files import is_url

if TYPE_CHECKING:
    from mudline.cluster.scheduler import Scheduler

FORMS = ("csv", "json", "npz", "parquet")


@options.command("batch")
@takes_inputs(
    "Read the positions of the nodes: one file for all decks, a folder with a file NAME.csv, .npz or .npy for each, "
    "or a pattern such as {folder}/{name}.csv."
)
@evaluate_inputs.summary_only
@click.option(
    "-o",
    "--output",
    required=True,
    metavar="DIR",
    help="Write a result file for each deck and summary.parquet into this folder, or below this URL.",
)
@click.option(
    "--form",
    type=click.Choice(FORMS),
    help="Write result files in this form; without it Parquet, or NPZ where pyarrow is not installed.",
)
@options.output_format("text", "json", "csv")
@evaluate_inputs.fail_on
@click.option(
    "--jobs",
    type=click.IntRange(min=0),
    default=0,
    metavar="N",
    help="Use N processes; 0: one for each processor.",
)
@on_cluster.options
@click.option("--no-cache", is_flag=True, help="Evaluate every deck again, whatever DIR holds from before.")
@options.every_file
@options.decks
@options.units
@options.common
def command(
    *,
    inputs: EvaluateInputs,
    decks: tuple[str, ...],
    units: str | None,
    summary_only: bool,
    output: str,
    form: str | None,
    output_format: str,
    fail_on: str,
    jobs: int,
    scheduler: Scheduler | None,
    no_cache: bool,
    every_file: bool,
    view: View,
) -> int:
    """Evaluate many decks or load cases: a row for each, those that failed first, then the largest force.

    DECKS are files, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das) and URLs. What is in DIR already and
    has not changed is not evaluated again.
    """
    if STDIN in decks:
        raise click.UsageError("- is one deck, from standard input: use mudline evaluate")
    if summary_only and inputs.positions is None:
        raise click.UsageError("--summary-only is for time steps: give series with --positions")
    on_cluster.refuse(scheduler, {}, None, decks)
    if scheduler is None:
        for option, path in {"--positions": inputs.positions, "--elements": inputs.elements, "-o": output}.items():
            if path is not None and is_url(path):
                raise click.UsageError(f"{option} {path}: a URL needs --scheduler, such as local")
    form = form or ("parquet" if is_installed("parquet") else "npz")
    if not has_library(form):
        return FOUND
    given = BatchOptions(inputs, units, output, form, summary_only, output_format, fail_on, jobs, no_cache, scheduler)
    return evaluate_batch(collect(decks, gitignore=not every_file, urls=True), given, view)
