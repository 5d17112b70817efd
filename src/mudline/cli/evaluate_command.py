"""`mudline evaluate`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import cast

import click

from mudline.cli import options
from mudline.cli.exits import DONE
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.terminal import reason, tell
from mudline.cli.writing import write_text, writing
from mudline.contact import LawKind
from mudline.results.csv_lines import csv_lines
from mudline.results.evaluation import Evaluation, Prepared, Tension, evaluate_scene, prepare
from mudline.results.formats import csv_text, json_text, plan_rows, write_npz
from mudline.scene.build import resolve
from mudline.scene.external import ExternalElements, read_external
from mudline.scene.model import Scene
from mudline.scene.positions import Positions, read_positions


@click.command("evaluate")
@options.deck
@click.option("--positions", metavar="FILE", help="Positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
@click.option("--elements", metavar="FILE", help="Elements as CSV, for decks whose elements come from *LINES.")
@click.option(
    "--tension",
    type=click.Choice(["keep", "cut"]),
    default="keep",
    show_default=True,
    help="Where a curve is negative in contact: keep the pull, or cut force and stiffness to 0.",
)
@click.option(
    "-o", "--output", metavar="OUT.csv|json|npz", help="Write the results; CSV writes OUT-nodes.csv beside it."
)
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
    elements: str | None,
    tension: str,
    output: str | None,
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
    suffix = _output_suffix(output)
    loaded = load(deck, units=units, stdin_name=stdin_name)
    scene = resolve(loaded, _read_elements(elements) if elements else None).require()
    given = _read_positions(positions, scene) if positions else None
    pull = cast("Tension", tension)
    if plan_only:
        _plan(prepare(scene, given, pull), output_format, view)
        return DONE
    evaluation = evaluate_scene(scene, given, pull)
    if not view.quiet:
        _notes(evaluation, given)
    if output:
        _write(evaluation, Path(output), suffix, quiet=view.quiet)
    elif output_format == "json":
        emit(json_text(evaluation))
    elif output_format == "csv":
        emit(csv_text(evaluation, table))
    else:
        printing("evaluate").print_evaluation(evaluation, table, view)
    return DONE


def _output_suffix(output: str | None) -> str:
    if output is None:
        return ""
    suffix = Path(output).suffix.lower()
    if suffix not in {".csv", ".json", ".npz"}:
        raise click.UsageError(f"{output}: results are written as .csv, .json or .npz")
    return suffix


def _read_elements(path: str) -> ExternalElements:
    try:
        return read_external(Path(path))
    except OSError as error:
        raise click.ClickException(f"{path}: {reason(error)}") from error


def _read_positions(path: str, scene: Scene) -> Positions:
    try:
        return read_positions(Path(path), scene.nodes)
    except OSError as error:
        raise click.ClickException(f"{path}: {reason(error)}") from error


def _notes(evaluation: Evaluation, given: Positions | None) -> None:
    """What a reader of the results should know."""
    if given is not None and given.missing:
        nodes, left_out = _count(given.missing, "node"), _count(evaluation.skipped, "element")
        tell(f"no positions for {nodes}: {left_out} left out")
    if evaluation.lengths_from_positions:
        tell(f"the length of {_count(evaluation.lengths_from_positions, 'element')} comes from the first positions")
    if rigid := int((evaluation.scene.law == LawKind.RIGID).sum()):
        tell(f"{_count(rigid, 'element')} on a rigid bed: a constraint, whose reaction is not evaluated")
    for stage, why in evaluation.model.input.left_out.items():
        tell(f"{stage}: {why}")


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'s' * (number != 1)}"


def _plan(prepared: Prepared, form: str, view: View) -> None:
    rows = plan_rows(prepared.model.plan)
    if form == "json":
        emit([json.dumps({"units": prepared.scene.units, "plan": rows}, indent=1, ensure_ascii=False), "\n"])
    elif form == "csv":
        emit(csv_lines([("stage", "active", "why"), *(row.values() for row in rows)]))
    else:
        printing("evaluate").print_plan(prepared.model.plan, view)


def _write(evaluation: Evaluation, path: Path, suffix: str, *, quiet: bool) -> None:
    if suffix == ".npz":
        with writing(path) as stream:
            write_npz(evaluation, stream)
    elif suffix == ".json":
        write_text(path, json_text(evaluation))
    else:
        write_text(path, csv_text(evaluation, "elements"))
        nodes = path.with_name(f"{path.stem}-nodes{path.suffix}")
        write_text(nodes, csv_text(evaluation, "nodes"))
        if not quiet:
            tell(f"nodes -> {nodes.as_posix()}")
    if not quiet:
        tell(f"{evaluation.scene.deck.file} -> {path.as_posix()}")
