"""`mudline evaluate`."""

from __future__ import annotations

import json
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import cast

import click

from mudline.cli import options
from mudline.cli.evaluate_files import read_against, read_elements, read_positions_of
from mudline.cli.evaluate_notes import SlowSuction, tell_before, tell_behind
from mudline.cli.evaluate_outputs import (
    PICTURES,
    Several,
    Sink,
    Taker,
    draw,
    files,
    form_of,
    has_library,
    printed,
    result_forms,
    run,
)
from mudline.cli.exits import DONE, FOUND
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.results.against import Comparison
from mudline.results.columns import ElementTable, NodeTable
from mudline.results.evaluation import Evaluation, Prepared, Tension, evaluate_scene, prepare
from mudline.results.formats import CsvForm, JsonForm, plan_rows
from mudline.results.plot_data import PlotData
from mudline.results.quantities import csv_lines
from mudline.results.totals import Digest
from mudline.scene.build import resolve

MOST_ROWS = 40
"""Lines of a table on the terminal, unless more is asked for."""


@click.command("evaluate")
@options.deck
@click.option("--positions", metavar="FILE", help="Positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
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
    metavar=f"OUT.{'|'.join(result_forms())}",
    help="Write the results; CSV and Parquet write the nodes to OUT-nodes beside it.",
)
@click.option("--plot", "picture", metavar="FILE.png|svg", help="Draw the results (needs the extra mudline[plot]).")
@click.option("--plan", "plan_only", is_flag=True, help="Tell what the scene needs and what was left out, and why.")
@click.option(
    "--table",
    type=click.Choice(["elements", "nodes"]),
    default="elements",
    show_default=True,
    help="Which rows text and CSV on standard output show.",
)
@options.output_format("text", "json", "csv")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    deck: str,
    positions: str | None,
    time_step: float | None,
    elements: str | None,
    tension: str,
    against: str | None,
    output: str | None,
    picture: str | None,
    plan_only: bool,
    table: str,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Contact forces and stiffnesses of a deck, at its own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the bed on a node.
    """
    for needed in (form_of(output, result_forms()), form_of(picture, PICTURES)):
        if needed and not has_library(needed):
            return FOUND
    loaded = load(deck, units=units, stdin_name=stdin_name)
    pull = cast("Tension", tension)
    scene = resolve(loaded, read_elements(elements) if elements else None).require_evaluable(pull)
    given = read_positions_of(positions, scene, time_step) if positions else None
    if plan_only:
        _plan(prepare(scene, given, pull), output_format, view)
        return DONE
    evaluation = evaluate_scene(scene, given, pull)
    comparison = Comparison(evaluation, read_against(against, evaluation)) if against else None
    if not view.quiet:
        tell_before(evaluation, comparison)
    drawing = PlotData(evaluation) if picture else None
    shown = "" if output else output_format
    digest = Digest(evaluation, None if view.verbose else MOST_ROWS) if shown == "text" else None
    slow = SlowSuction()
    takers: list[Taker] = [taker for taker in (comparison, drawing, digest, slow) if taker is not None]
    with _sink(evaluation, comparison, output, shown, table, view) as sink:
        run(evaluation, [*takers, sink], view, bar=shown in {"", "text"})
        sink.finish({} if comparison is None else {"against": comparison.summary()})
    if picture and drawing is not None:
        draw(drawing, Path(picture), view)
    if not view.quiet:
        tell_behind(evaluation, slow, Path(output) if output else None)
    if digest is not None:
        printing("evaluate").print_evaluation(digest, table, view)
    if comparison is not None and output_format == "text":
        printing("against").print_comparison(comparison, view)
    return DONE


def _sink(
    evaluation: Evaluation, comparison: Comparison | None, output: str | None, shown: str, table: str, view: View
) -> AbstractContextManager[Sink]:
    """Where the rows go: files, standard output, or nowhere."""
    elements = ElementTable(evaluation, None if comparison is None else comparison.others)
    if output:
        return files(evaluation, elements, Path(output), view)
    if shown == "json":
        return nullcontext(printed(JsonForm(evaluation, elements)))
    if shown == "csv":
        return nullcontext(printed(CsvForm(evaluation, elements if table == "elements" else NodeTable(evaluation))))
    return nullcontext(Several())


def _plan(prepared: Prepared, form: str, view: View) -> None:
    rows = plan_rows(prepared.model.plan)
    if form == "json":
        emit([json.dumps({"units": prepared.scene.units, "plan": rows}, indent=1, ensure_ascii=False), "\n"])
    elif form == "csv":
        emit(csv_lines([("stage", "active", "why"), *(row.values() for row in rows)]))
    else:
        printing("evaluate").print_plan(prepared.model.plan, view)
